"""What is done towards somewhere begins with turning there: "a picture of what is behind you"."""

from __future__ import annotations

from voxml.terms import Form, Quantity, Term, Unit

from .arguments import Arg, Kind, head_noun
from .phrases import YOU, ahead

_SIDES = (Term("left"), Term("right"))
_BEHIND = Term("behind", (YOU,))
_SCENES = frozenset(
    {"area", "side", "view", "surroundings", "spot", "scene"}
)  # nothing by themselves but where they are


def turning_to(arg: Arg, headings: frozenset[Form]) -> Form | None:
    """The program that turns to what the argument says; None where it says no direction."""
    match arg.kind, arg.form:
        case Kind.SIDE, side:
            return Term("turn", (side,))
        case Kind.HEADING, heading:
            return Term("face", (heading,))
        case Kind.FACING, Term("facing", (place,)):
            return Term("face", (place,))
        case Kind.OF | Kind.LOCATION, Term("of", (place,)):
            return _turning(place, headings)
        case Kind.LOCATION, place:
            return _turning(place, headings)
    return None


def seen_at(arg: Arg) -> Arg:
    """What is seen straight ahead, or at a place, of what was said about where: "a picture in front of you"."""
    match arg.kind, arg.form:
        case Kind.AXIS, Term("forward") as way:
            return Arg(Kind.OF, Term("of", (ahead(way),)))
        case (Kind.PLACE, place) | (Kind.LOCATION, Term("in_front_of", (Term("you"),)) as place):
            return Arg(Kind.OF, Term("of", (place,)))
    return arg


def is_angle(arg: Arg) -> bool:
    """Whether the argument says by how much to turn."""
    return arg.kind is Kind.QUANTITY and isinstance(arg.form, Quantity) and arg.form.unit is Unit.DEGREE


def _turning(place: Form, headings: frozenset[Form]) -> Form | None:
    if place in headings:
        return Term("face", (place,))
    match place:
        case Term("on", (Term() as side,)) if side in _SIDES:
            return Term("turn", (side,))
        case Term("to" | "facing", (Term() as heading,)) if heading in headings:
            return Term("face", (heading,))
        case Term(relation, (Term("you"),)) if Term(relation.removesuffix("_of")) in headings:
            return Term("face", (Term(relation.removesuffix("_of")),))
        case Term("left_of" | "right_of" as relation, (Term("you"),)):
            return Term("turn", (Term(relation.removesuffix("_of")),))
        case Term("the" | "a" | "your", (core, *modifiers)) if _scene(place):
            found = (_turning(each, headings) for each in (*_side_of(core), *modifiers))
            return next((turning for turning in found if turning is not None), None)
    return Term("turn_around") if place == _BEHIND else None


def _scene(phrase: Form) -> bool:
    return head_noun(phrase) in _SCENES


def _side_of(core: Form) -> tuple[Form, ...]:
    """The "left" of "the left side", as a place."""
    match core:
        case Term(side, (_,)) if Term(side) in _SIDES:
            return (Term("on", (Term(side),)),)
    return ()

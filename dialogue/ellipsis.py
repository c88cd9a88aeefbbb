"""Fragments completed by what was done before: "turn left" ... "ten more", "the other way", "again"."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from grammar.forms import Form, Quantity, Term, Unit
from grounding.descriptions import DETERMINERS
from grounding.relations import COMPASS_RAD
from voxml.vocabulary import Lexicon

from .units import like

_OPPOSITE = {"left": "right", "right": "left", "forward": "back", "back": "forward"}
_OPPOSITE |= {"north": "south", "south": "north", "east": "west", "west": "east"}
_SIDES = frozenset({"left", "right"})
_AXES = frozenset({"forward", "back"})
_WAYS = _SIDES | _AXES | frozenset(COMPASS_RAD)
_AMOUNTS = frozenset({"little", "max", "more"})
_PRONOUNS = frozenset({"it", "them", "there", "here"})


def completed(fragment: Form, last: Form, lexicon: Lexicon) -> Form | None:
    """The instruction that a fragment amounts to after ``last``; None if it does not lean on that."""
    if isinstance(fragment, Term) and fragment.pred in _WHOLE:
        return _WHOLE[fragment.pred](fragment, last)
    clause = last
    while isinstance(clause, Term) and clause.pred in ("seq", "repeat"):
        clause = clause.args[-1]
    if not isinstance(clause, Term):
        return None
    if isinstance(fragment, Quantity):
        return _with_amount(fragment, clause, lexicon)
    if not isinstance(fragment, Term):
        return None
    if _is_place(fragment, lexicon):
        return _with_place(fragment, clause, lexicon)
    if fragment.pred in _AMOUNTS:
        return _with_amount(fragment.args[0] if fragment.args else fragment, clause, lexicon)
    if not fragment.args and fragment.pred in _WAYS:
        return _with_way(fragment, clause)
    return _reversed(clause) if fragment.pred == "other" else None


def alone(fragment: Form, lexicon: Lexicon) -> Form | None:
    """The instruction that a fragment probably is when it leans on nothing: a way to turn or go, a place to be at."""
    if not isinstance(fragment, Term):
        return None
    if _is_place(fragment, lexicon):
        return Term("go", (fragment if fragment.pred in lexicon.relations else Term("to", (fragment,)),))
    if fragment.args or fragment.pred not in _WAYS:
        return None
    verb = "turn" if fragment.pred in _SIDES else "go" if fragment.pred in _AXES else "face"
    return Term(verb, (fragment,))


def _is_place(fragment: Term, lexicon: Lexicon) -> bool:
    return fragment.pred in lexicon.relations or fragment.pred in DETERMINERS | _PRONOUNS


# ------------------------------------------------------------------ once more
def _again(fragment: Term, last: Form) -> Form | None:
    sides = [arg for arg in fragment.args if isinstance(arg, Term) and arg.pred in _SIDES]
    again = _sided(last, sides[0]) if sides else last
    return None if sides and again == last and sides[0] not in _leaves(last) else again


def _leaves(form: Form) -> tuple[Form, ...]:
    if not isinstance(form, Term) or not form.args:
        return (form,)
    return tuple(leaf for arg in form.args for leaf in _leaves(arg))


def _sided(form: Form, side: Term) -> Form:
    """The form with every side in it made this one."""
    if not isinstance(form, Term):
        return form
    if form.pred in _SIDES and not form.args:
        return side
    return replace(form, args=tuple(_sided(arg, side) for arg in form.args))


def _repeated(fragment: Term, last: Form) -> Form | None:
    """ "Do that twice" is twice more; "twice", said afterwards, is once more."""
    times, *again = fragment.args
    if not isinstance(times, Quantity):
        return None
    more = times.value if again else times.value - 1
    return Term("repeat", (Quantity(max(more, 1)), last))


def _reversed(form: Form) -> Form | None:
    """The form with its way turned round, or None if it has none."""
    if not isinstance(form, Term):
        return None
    if not form.args and form.pred in _OPPOSITE:
        return Term(_OPPOSITE[form.pred])
    for index, arg in enumerate(form.args):
        turned = _reversed(arg)
        if turned is not None:
            return replace(form, args=(*form.args[:index], turned, *form.args[index + 1 :]))
    return Term("go", (Term("back"), *form.args)) if form.pred == "go" and not _leads(form) else None


def opposite_way(form: Form) -> Term | None:
    """The opposite of the way that was gone or turned; None where there was none."""
    ways = (leaf.pred for leaf in _leaves(form) if isinstance(leaf, Term) and leaf.pred in _OPPOSITE)
    way = next(ways, None)
    return None if way is None else Term(_OPPOSITE[way])


def _leads(form: Term) -> bool:
    """Whether it goes to some place rather than some way."""
    return any(isinstance(arg, Term) and arg.args for arg in form.args)


# ------------------------------------------------------------------ ways and amounts
def _with_way(way: Term, last: Term) -> Form | None:
    """The last instruction, if it had a way of this kind, with the new one."""
    kind = next((k for k in (_SIDES, _AXES, frozenset(COMPASS_RAD)) if way.pred in k), frozenset())
    ways = [arg for arg in last.args if isinstance(arg, Term) and not arg.args and arg.pred in kind]
    if not ways:
        return None
    return replace(last, args=tuple(way if arg == ways[0] else arg for arg in last.args))


def _with_amount(amount: Form, last: Term, lexicon: Lexicon) -> Form | None:
    """The last movement, by this amount; a bare number has the unit of the one before."""
    unit = Unit.DEGREE if last.pred == "turn" else Unit.METRE
    if isinstance(amount, Quantity):
        before = next((arg for arg in last.args if isinstance(arg, Quantity)), None)
        amount = like(amount.value, before, unit, lexicon) if amount.unit is Unit.COUNT else amount
        unit = amount.unit
    if last.pred not in ("turn", "go", "sidestep"):
        return Term("go", (Term("forward"), amount)) if unit is Unit.METRE else None
    if (last.pred == "turn") is not (unit is Unit.DEGREE):
        return None
    if _leads(last):
        return Term("go", (Term("forward"), amount))
    kept = tuple(arg for arg in last.args if isinstance(arg, Term) and not arg.args and arg.pred not in _AMOUNTS)
    return replace(last, args=(*(kept or ((Term("forward"),) if last.pred == "go" else ())), amount))


# ------------------------------------------------------------------ places and things
def _with_place(place: Term, last: Term, lexicon: Lexicon) -> Form | None:
    """The last instruction about a place or thing, with the new one."""
    is_path = place.pred in lexicon.relations
    for index, arg in enumerate(last.args):
        if not isinstance(arg, Term) or not (arg.args or arg.pred in _PRONOUNS):
            continue
        was_path = arg.pred in lexicon.relations
        if is_path and not was_path:
            return None
        new = replace(arg, args=(place, *arg.args[1:])) if was_path and not is_path else place
        return replace(last, args=(*last.args[:index], new, *last.args[index + 1 :]))
    return None


def _back(fragment: Term, last: Form) -> Form:
    return Term("go", (Term("to", (fragment,)),))


_WHOLE: Mapping[str, Callable[[Term, Form], Form | None]] = {
    "again": _again,
    "redo": _again,
    "repeat": _repeated,
    "back_there": _back,
}
"""What leans on everything that was said last, not on its last clause."""

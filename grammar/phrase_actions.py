"""What the rules for arguments and noun phrases mean, by the rule's name in the ``.lark`` file."""

from __future__ import annotations

from typing import Any

from voxml.terms import Form, Quantity, Term, Unit
from voxml.vocabulary import Reading

from . import phrases
from .arguments import Arg, Args, Kind
from .machine import Refused
from .phrases import YOU, Extreme, Pre, Such, pred_of
from .tables import Action

_ALONE = frozenset({"through", "out_of", "past", "across", "around", "along", "over", "down", "up"})
_IN_FRONT = Term("in_front_of", (YOU,))


def _arg(kind: Kind) -> Action:
    return lambda form: Arg(kind, form)


def _path(relation: Form, place: Form) -> Arg:
    return Arg(Kind.PATH, phrases.relation(relation, place))


def _path_alone(relation: Form) -> Arg:
    """ "go through", "go around": a way without what it leads past; "go to" wants its place."""
    if pred_of(relation) not in _ALONE:
        raise Refused("a thing or place")
    return Arg(Kind.PATH, relation)


def _path_point(relation: Form, x: Quantity, y: Quantity) -> Arg:
    """ "to 2 3", "to coordinates 2 3": a place on the map."""
    point = Term("point", (Quantity(x.value, Unit.METRE), Quantity(y.value, Unit.METRE)))
    return Arg(Kind.PATH, Term(pred_of(relation), (point,)))


def _path_axis(relation: Form, axis: Form) -> Arg:
    """ "toward the back"; "to back" rather begins "to back up"."""
    if pred_of(relation) == "to":
        raise Refused("a thing or place")
    return Arg(Kind.AXIS, axis)


def _event(readings: tuple[Reading, ...]) -> Arg:
    return Arg(Kind.EVENT, Term("event"), readings)


def of_place(args: Args) -> Arg:
    """ "(a picture of what is) on your left"."""
    return Arg(Kind.OF, Term("of", (where(args[0]),)))


def _measure(measure: Form, amount: Form) -> Arg:
    return Arg(Kind.MEASURE, Term(pred_of(measure), (amount,)))


def where(arg: Arg) -> Form:
    """A place as a modifier: "on your left" is ``on(left)``."""
    if arg.kind is Kind.SIDE:
        return phrases.on_side(arg.form)
    if arg.kind is Kind.AXIS:
        return phrases.ahead(arg.form)
    return arg.form


def _seen(*parts: Any) -> Form:
    """ "the door (that) you see"; what you face is in front of you."""
    return _IN_FRONT if pred_of(parts[-1]) == "face" else Term("visible")


ARGUMENT_ACTIONS: dict[str, Action] = {
    "first": lambda arg: (arg,),
    "first_np": lambda form: (Arg(Kind.PHRASE, form),),
    "more": lambda args, arg: (*args, arg),
    "axis": _arg(Kind.AXIS),
    "side": _arg(Kind.SIDE),
    "arg_heading": _arg(Kind.HEADING),
    "quantity": _arg(Kind.QUANTITY),
    "quantity_more": _arg(Kind.QUANTITY),
    "vague": _arg(Kind.VAGUE),
    "number": _arg(Kind.NUMBER),
    "number_by": lambda by, number: Arg(Kind.NUMBER, number),
    "times": lambda number, times: Arg(Kind.REPEAT, number),
    "repeat": _arg(Kind.REPEAT),
    "path": _path,
    "path_alone": _path_alone,
    "path_point": _path_point,
    "path_place": lambda relation, place: Arg(Kind.PATH, Term(pred_of(relation), (place,))),
    "path_axis": _path_axis,
    "place": _arg(Kind.PLACE),
    "location": lambda relation, place: Arg(Kind.LOCATION, phrases.relation(relation, place)),
    "facing": lambda facing, what: Arg(Kind.FACING, Term("facing", (what,))),
    "facing_heading": lambda facing, what: Arg(Kind.FACING, Term("facing", (what,))),
    "facing_side": lambda facing, side: Arg(Kind.SIDE, side),
    "of": lambda of, what: Arg(Kind.OF, Term("of", (what,))),
    "of_side": lambda of, side: Arg(Kind.OF, Term("of", (phrases.on_side(side),))),
    "of_quantity": lambda of, amount: Arg(Kind.QUANTITY, amount),
    "of_view": lambda of, view, *place: Arg(Kind.OF, Term("of", (view,))),
    "of_what": lambda of, what, be, args: of_place(args),
    "manner": _arg(Kind.MANNER),
    "way": lambda demonstrative, way: Arg(Kind.WAY, Term(pred_of(demonstrative), (Term("way"),))),
    "opposite": _arg(Kind.WAY),
    "event": _event,
    "measure": _measure,
    "measure_too": lambda mark, measure, amount: _measure(measure, amount),
    "measure_counted": lambda mark, number, measure: _measure(measure, number),
}

NOUN_PHRASE_ACTIONS: dict[str, Action] = {
    "both": lambda one, mark, other: Term("and", (one, other)),
    "alternatives": lambda one, mark, other: Term("or", (one, other)),
    "determined": phrases.phrase,
    "demonstrative": lambda form: form,
    "bare": phrases.bare_phrase,
    "pronoun": lambda form: form,
    "indefinite": lambda form, posts: Term(pred_of(form), phrases.places(posts)),
    "nominal": phrases.nominal,
    "nominal_post": lambda noun, posts: phrases.nominal(noun, (), posts),
    "nominal_pre": lambda pres, noun: phrases.nominal(noun, pres),
    "nominal_around": lambda pres, noun, others, posts=(): phrases.nominal(noun, (*pres, *others), posts),
    "nominal_pre_post": lambda pres, noun, posts: phrases.nominal(noun, pres, posts),
    "headless": phrases.headless,
    "headless_post": phrases.headless,
    "compound": phrases.compound,
    "one_pre": lambda pre: (pre,),
    "more_pres": lambda pres, pre: (*pres, pre),
    "more_pres_marked": lambda pres, mark, pre: (*pres, pre),
    "more_pres_or": lambda pres, mark, pre: (*pres, pre),
    "ordinal": lambda form: Pre(form, True),
    "cardinal": lambda form: Pre(form, True),
    "adjective": lambda form: Pre(form, False),
    "one_post": lambda post: (post,),
    "more_posts": lambda posts, post: (*posts, post),
    "relation": phrases.relation,
    "relation_of_two": phrases.relation_of_two,
    "relation_you": lambda relation, you: Term(pred_of(relation), (YOU,)),
    "on_side": phrases.on_side,
    "ahead": phrases.ahead,
    "relation_heading": lambda facing, heading: Term("facing", (heading,)),
    "numbered": lambda mark, number: Term("number", (number,)),
    "numbered_bare": lambda number: Term("number", (number,)),
    "toward_heading": lambda mark, heading: Term("to", (heading,)),
    "at_place": lambda place: place,
    "that_facing": lambda *parts: _IN_FRONT,
    "that_such": lambda that, quality: Such(quality),
    "that_not_such": lambda that, mark, quality: Term("not", (quality,)),
    "that_not": lambda that, mark, place: Term("not", (place,)),
    "not_there": lambda mark, place: Term("not", (place,)),
    "excepted": lambda mark, other: Term("not", (other,)),
    "extreme_to": lambda ordering, place: Extreme(ordering, (place,)),
    "extreme_you": lambda ordering, you: Extreme(ordering, (Term("to", (you,)),)),
    "that_extreme_to": lambda that, ordering, place: Extreme(ordering, (place,)),
    "extreme_of": lambda ordering, relation, what: Extreme(ordering, (Term(pred_of(relation), (what,)),)),
    "that_extreme_of": lambda that, ordering, relation, what: Extreme(ordering, (Term(pred_of(relation), (what,)),)),
    "seen": _seen,
    "where_thing": lambda that, thing, be, *post: Term("with", (thing, *post)),
    "where_seen": lambda that, you, see, thing: Term("with", (thing,)),
}

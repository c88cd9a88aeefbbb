"""What the rules for questions, conditions and statements mean, by the rule's name in the ``.lark`` file."""

from __future__ import annotations

from typing import Any

from voxml.terms import Form, Term
from voxml.vocabulary import Reading

from . import phrases
from .arguments import Args
from .phrase_actions import where
from .phrases import YOU, Nominal, pred_of
from .tables import Action

Posts = tuple[Form, ...]
_FROM = frozenset({"from"})


def _count_where(how_many: Form, what: Nominal, be: Form, posts: Posts) -> Form:
    return Term("count", (what.described(), *what.modifiers, *phrases.places(posts)))


def _see_kind(determiner: str) -> Action:
    """ "what blocks are on the left", "which door is on the left"."""

    def action(what: Form, kind: Nominal, *rest: Any) -> Form:
        posts = rest[1] if len(rest) > 1 else ()
        return Term("see", (phrases.phrase(Term(determiner), kind), *phrases.places(posts)))

    return action


def _is_last(be: Form, determiner: Form, what: Nominal) -> Form:
    """ "is the block on the left": what was taken for a modifier is asked about."""
    return Term("is", phrases.without_last(phrases.phrase(determiner, what)))


def _which_ordered(which: Form, kind: Nominal, be: Form, ordering: Form) -> Form:
    """ "which door is nearest": the same as which is the nearest door."""
    return phrases.phrase(Term("which"), phrases.ordered(kind, ordering))


def _see_where(see: Form, args: Args) -> Form:
    return Term("see", (Term("what"), *map(where, args)))


def _done_verb(readings: tuple[Reading, ...]) -> Form:
    return Term("done", (Term(readings[0].entry.lex.pred),))


def _far(far: Form, what: Form) -> Form:
    """ "how far is the door", "how far is the cone from the door"."""
    parted = phrases.parted(what, _FROM)
    return Term("distance", (what,) if parted is None else (parted[0], *parted[1].args))


def _property(pred: str, at: int) -> Action:
    """A question for one property of what stands at this place in the rule."""
    return lambda *parts: Term(pred, (parts[at],))


CONDITION_ACTIONS: dict[str, Action] = {
    "seeing": lambda who, see, what: Term(pred_of(see), (what,)),
    "existing": lambda there, what: Term("exists", (what,)),
    "being": lambda what, be, place: Term("is", (what, place)),
    "within": lambda you, be, distance, relation, what: Term("within", (distance, what)),
    "you_being": lambda you, be, place: Term("is", (YOU, place)),
    "done_verb": _done_verb,
}

QUESTION_ACTIONS: dict[str, Action] = {
    "q_form": lambda form, args=(): form,
    "q_see_where": _see_where,
    "q_where": _property("where", 1),
    "q_where_you": lambda where_is, you: Term("where", (YOU,)),
    "q_count": lambda how_many, what, *rest: Term("count", (what.described(), *what.modifiers)),
    "q_count_where": _count_where,
    "q_exists_any": lambda there, posts: Term("exists", (Term("anything"), *phrases.places(posts))),
    "q_see": _property("exists", 1),
    "q_kind": _property("what", 4),
    "q_far": _far,
    "q_far_place": _property("distance", 1),
    "q_property": lambda kind, what: Term(pred_of(kind), (what,)),
    "q_what": _property("what", 2),
    "q_what_where": lambda what, be, posts: Term("see", (Term("what"), *phrases.places(posts))),
    "q_what_kind": _see_kind("what"),
    "q_see_kind": _see_kind("what"),
    "q_which_where": _see_kind("which"),
    "q_which": lambda which, be, determiner, kind: phrases.phrase(Term("which"), kind),
    "q_which_such": lambda which, kind, be, quality: Term("is", (phrases.phrase(Term("which"), kind), quality)),
    "q_which_ordered": _which_ordered,
    "q_is": lambda be, this, what: Term("is", (this, what)),
    "q_is_last": _is_last,
    "q_is_where": lambda be, what, place: Term("is", (what, place)),
    "q_able": _property("can", 1),
    "q_able_to": lambda able, what: Term("can", (Term(pred_of(able), (what,)),)),
    "q_know_what": _property("what", 2),
    "q_know_where": _property("where", 2),
    "q_know_far": _property("distance", 2),
    "q_know": _property("know", 1),
}

STATEMENT_ACTIONS: dict[str, Action] = {
    "is_a": lambda what, be, thing: Term("is", (what, thing)),
    "is_not": lambda what, be, mark, thing: Term("not", (Term("is", (what, thing)),)),
    "i_see": _property("see", 2),
    "is_where": lambda what, be, place: Term("is", (what, place)),
    "is_such": lambda what, be, quality: Term("is", (what, quality)),
    "there_is": _property("exists", 1),
}

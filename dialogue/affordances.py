"""What things afford: which ways of going make sense with which things, by the entries of the lexicon."""

from __future__ import annotations

from grammar.forms import Form, Term
from grounding import Entity
from grounding.descriptions import describe
from voxml.vocabulary import Lexicon

from .plans import Refusal, Refused, Stops

_AFFORDED = frozenset({"through", "into", "out_of", "over", "under", "up", "down", "along", "onto", "across"})


def check_afforded(relation: str, landmark: Form, lexicon: Lexicon) -> None:
    """Whether one can go so with what is named, whether or not there is one.

    Raises:
        Stops: it is a kind of thing that does not afford it.
    """
    description = describe(landmark)
    if description is not None and not _affords(relation, description.noun, lexicon):
        raise Stops(Refused(Refusal.NOT_AFFORDED, Term(relation, (landmark,))))


def check_thing(relation: str, thing: Entity, lexicon: Lexicon) -> None:
    """The same of a thing that is known.

    Raises:
        Stops: it is a thing that does not afford it.
    """
    if not _affords(relation, thing.type, lexicon):
        raise Stops(Refused(Refusal.NOT_AFFORDED, Term(relation, (Term("the", (Term(thing.type),)),))))


def _affords(relation: str, noun: str, lexicon: Lexicon) -> bool:
    entry = lexicon.objects.get(noun)
    if relation not in _AFFORDED or entry is None or noun == "object":
        return True
    ways = (arg for each in entry.affordances for arg in each.event.args if isinstance(arg, Term))
    return any(way.pred == relation for way in ways)

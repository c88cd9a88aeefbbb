"""What a question is answered from, and what an answer is."""

from __future__ import annotations

from dataclasses import dataclass

from dialogue.session import Session
from dialogue.wording import name_entities
from grammar.forms import Form, Term
from grounding import Ambiguous, Entity, Grounded, Reason, Unresolved, World, resolve
from grounding.descriptions import DETERMINERS
from voxml.vocabulary import Lexicon

THING = Term("object")
_NUMBERS = DETERMINERS | {"plural", "count"}


@dataclass(frozen=True, slots=True)
class Report:
    """What to say, and the things it is about, nearest first."""

    text: str
    entities: tuple[Entity, ...] = ()


class Needs(Exception):  # noqa: N818 - a result that ends an answer early, never seen outside this folder
    """It cannot be answered, for this is not known."""

    def __init__(self, outcome: Unresolved) -> None:
        self.outcome = outcome


@dataclass(frozen=True, slots=True)
class Asked:
    """A question with what it is answered from."""

    args: tuple[Form, ...]
    session: Session
    lexicon: Lexicon

    @property
    def world(self) -> World:
        """The world as it is known."""
        return self.session.world

    def things(self, form: Form) -> tuple[Entity, ...]:
        """Everything that a description may mean: a question about several is answered for each.

        Raises:
            Needs: nothing is meant.
        """
        match resolve(form, self.world, self.lexicon):
            case Grounded(referents):
                things = tuple(each for each in referents if isinstance(each, Entity))
                if not things:  # a place or a heading
                    raise Needs(Unresolved(Reason.NOTHING_FITS, form))
                return things
            case Ambiguous(_, candidates):
                return candidates
            case Unresolved() as failure:
                raise Needs(failure)

    def fitting(self, noun: Form, places: tuple[Form, ...]) -> tuple[Entity, ...]:
        """The things of a kind; none if there is none of it.

        Raises:
            Needs: a landmark is not known.
        """
        noun, places = bare(noun, places)
        every = Term("all", (noun, *places))
        outcome = resolve(every, self.world, self.lexicon)
        if isinstance(outcome, Unresolved) and (outcome.reason is not Reason.NOTHING_FITS or outcome.form != every):
            raise Needs(outcome)
        found = outcome.referents if isinstance(outcome, Grounded) else ()
        return tuple(each for each in found if isinstance(each, Entity))

    def names(self, things: tuple[Entity, ...]) -> tuple[str, ...]:
        """What tells them apart."""
        return name_entities(things, self.world)


def bare(noun: Form, places: tuple[Form, ...]) -> tuple[Form, tuple[Form, ...]]:
    """A noun phrase without its determiner and number, and its modifiers."""
    while isinstance(noun, Term) and noun.pred in _NUMBERS and noun.args:
        first, *rest = noun.args[1:] if noun.pred == "count" else noun.args
        noun, places = first, (*rest, *places)
    return noun, places


def capital(text: str) -> str:
    """As a sentence begins."""
    return text[:1].upper() + text[1:]


def uncapital(text: str) -> str:
    """As it goes on within a sentence."""
    return text if text.startswith("I ") else text[:1].lower() + text[1:]

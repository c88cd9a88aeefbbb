"""Names that the lexicon does not have: what a person calls a thing, a place or a routine when teaching it."""

from __future__ import annotations

from collections.abc import Sequence

from voxml.terms import Name, Term
from voxml.vocabulary import Lexicon, Reading, Sense

from .machine import Edge
from .tokens import MARKS, Token

WORDS_MAX = 3
_INTRODUCING = frozenset({":", ","})


class NameReader:
    """Finds where names may stand, by the words of one lexicon."""

    def __init__(self, lexicon: Lexicon) -> None:
        self._known = lexicon.vocabulary()
        self._naming = frozenset(lexicon.closed.table("CALL"))
        self._nouns = {
            word: sense.value
            for word, senses in lexicon.single_words().items()
            for sense in senses
            if sense.category == "NOUN" and isinstance(sense.value, Term)
        }
        self._teaching = frozenset(word for word, senses in lexicon.single_words().items() if _is_taught(senses))

    def may_name(self, texts: Sequence[str]) -> bool:
        """Whether anything in the utterance can be a name."""
        return not (
            self._known.issuperset(texts) and self._naming.isdisjoint(texts) and self._teaching.isdisjoint(texts)
        )

    def edges(self, tokens: Sequence[Token], at: int) -> tuple[Edge, ...]:
        """A new name, in any letters; a name that is told in passing, which is seen by its capital alone."""
        if at and tokens[at - 1].text in self._teaching:
            return self._routine(tokens, at)
        length = self._unknown(tokens, at)
        if length:
            name = Name(" ".join(token.written for token in tokens[at : at + length]))
            given = (Edge("NAME_GIVEN", name, length),) if tokens[at].written[:1].isupper() else ()
            return (Edge("NEW_NAME", name, length), *given)
        last = _ends(tokens, at + 1)
        if last and tokens[at].text in self._nouns and any(token.text in self._naming for token in tokens[:at]):
            return (Edge("NEW_NAME", Term("the", (self._nouns[tokens[at].text],)), 1),)
        return ()

    def _unknown(self, tokens: Sequence[Token], at: int) -> int:
        """How many words of no lexicon stand here, up to the end of the clause; 0 where there are others."""
        end = at
        while not _ends(tokens, end) and tokens[end].text not in self._known and tokens[end].text.isalpha():
            end += 1
        return end - at if _ends(tokens, end) and end - at <= WORDS_MAX else 0

    def _routine(self, tokens: Sequence[Token], at: int) -> tuple[Edge, ...]:
        """ "(learn) the L shape: ..." names what is then told."""
        end = at
        while not _ends(tokens, end):
            end += 1
        if not at < end <= at + WORDS_MAX + 1 or end >= len(tokens) or tokens[end].text not in _INTRODUCING:
            return ()
        return (Edge("NAME", Name(" ".join(token.written for token in tokens[at:end])), end - at),)


def _ends(tokens: Sequence[Token], at: int) -> bool:
    return at >= len(tokens) or tokens[at].text in MARKS


def _is_taught(senses: tuple[Sense, ...]) -> bool:
    """Whether the word is a verb that can only take a name, such as "learn"."""
    readings: list[Reading] = []
    for sense in senses:
        if sense.category == "VERB" and isinstance(sense.value, tuple):
            readings.extend(sense.value)
    return bool(readings) and all(any("name" in slot.types for slot in each.entry.args) for each in readings)

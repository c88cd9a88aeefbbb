"""What people say before they have said it, taken out before parsing: the utterance as it was meant.

The kinds of disfluency, and the names, are those of Shriberg (1994), Preliminaries to a Theory of Speech Disfluencies:
filled pauses, word fragments, repetitions, and repairs with or without an editing term.
"""

from __future__ import annotations

from collections.abc import Sequence

from voxml.vocabulary import Lexicon

from .abandoned import Abandoned
from .amounts import AmountReader
from .editing import EditingTerms
from .fragments import Fragments
from .hesitations import Hesitations
from .known_words import KnownWords
from .repairs import Repairs
from .replaced_amounts import without_replaced_amounts
from .restarts import Break, Restarts
from .tokens import Token


class Fluency:
    """Cleans the tokens of utterances with the words of one language."""

    def __init__(self, lexicon: Lexicon, amounts: AmountReader) -> None:
        self._words = KnownWords(lexicon, amounts)
        terms = EditingTerms(lexicon.closed, self._words)
        self._hesitations = Hesitations(lexicon.closed, self._words)
        self._fragments = Fragments(lexicon.closed, self._words)
        self._restarts = Restarts(self._words, terms)
        self._abandoned = Abandoned(self._words)
        self._repairs = Repairs(self._words, terms)
        self._fluent = self._never_disfluent(terms)

    def _never_disfluent(self, terms: EditingTerms) -> frozenset[str]:
        """Words that, each said once, need no mending."""
        vocabulary = self._words.vocabulary
        doubtful = terms.last_words | self._hesitations.last_words
        return frozenset(word for word in vocabulary - doubtful if len(word) > 1 or word == "a")

    def _is_fluent(self, texts: Sequence[str]) -> bool:
        """Whether nothing can be amiss: only known words, none of them twice, and none that begins like the next."""
        if not self._fluent.issuperset(texts) or len(set(texts)) < len(texts):
            return False
        return not any(map(str.startswith, texts[1:], texts))

    def clean(self, tokens: Sequence[Token]) -> tuple[tuple[Token, ...], bool]:
        """The tokens as they were meant, and whether they begin by taking something back ("no, I mean ...")."""
        texts = [token.text for token in tokens]
        if self._is_fluent(texts):
            return tuple(tokens), False
        kept, after_pauses = self._hesitations.without(tokens)
        kept, after_fragments = self._fragments.without(kept)
        breaks = dict.fromkeys(after_pauses, Break.PAUSE) | dict.fromkeys(after_fragments, Break.FRAGMENT)
        kept = self._abandoned.without(self._restarts.without(kept, breaks))
        kept, corrects = self._repairs.applied(kept)
        kept = [token for token in kept if token.text not in self._hesitations.editing]
        return tuple(without_replaced_amounts(kept, self._words.amounts)), corrects

    def cleaned_again(self, tokens: Sequence[Token]) -> tuple[Token, ...]:
        """What may be left of clean tokens that cannot be read: neither beginnings of the words behind them, known or
        not, nor phrases that only keep the turn."""
        return tuple(self._fragments.without_beginnings(self._hesitations.without_discourse(tokens)))

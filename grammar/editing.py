"""Editing terms: what is said between what was wrong and what is right, such as "I mean", "no", "sorry"."""

from __future__ import annotations

from collections.abc import Sequence

from voxml.words import ClosedClasses

from .fixed_phrases import FixedPhrases
from .known_words import KnownWords
from .tokens import MARKS

_PHRASE_KINDS = frozenset({"number", "direction", "thing"})


class EditingTerms:
    """The editing terms of one language. Lengths are in words, 0 for none."""

    def __init__(self, closed: ClosedClasses, words: KnownWords) -> None:
        self._words = words
        self._strong = FixedPhrases.of(closed, "edit")
        self._weak = FixedPhrases.of(closed, "edit_weak")
        self._aside = FixedPhrases.of(closed, "edit_aside")
        self._of_phrases = FixedPhrases.of(closed, "edit_phrase")
        self._of_amounts = FixedPhrases.of(closed, "edit_amount")
        self._trailing = FixedPhrases.of(closed, "edit_trailing")
        correcting = (each.words for each in closed.words_of("edit_trailing") if each.text == "corrects")
        self._correcting = FixedPhrases(correcting)
        self._relative = frozenset(closed.table("relative"))
        tables = (self._strong, self._weak, self._of_phrases, self._of_amounts, self._trailing)
        self.last_words = frozenset().union(*(table.last_words for table in tables))

    def strong(self, texts: Sequence[str], at: int) -> int:
        """A term that can be nothing else, as "let's do" is before an amount."""
        return self._strong.length(texts, at) or self._before_phrase(texts, at)

    def weak(self, texts: Sequence[str], at: int) -> int:
        """A term that may be something else: "no", "wait"."""
        return self._weak.length(texts, at)

    def any(self, texts: Sequence[str], at: int) -> int:
        return self.strong(texts, at) or self.weak(texts, at)

    def aside(self, texts: Sequence[str], at: int) -> int:
        """A term that takes nothing back where there is nothing before it to repair: "turn, sorry, left"."""
        return self._aside.length(texts, at) or self._before_phrase(texts, at)

    def trailing(self, texts: Sequence[str], at: int) -> bool:
        """Whether the utterance ends with a term that takes nothing of it back: "left, I said"."""
        length = self._trailing.length(texts, at)
        if not length or at + length < len(texts) or texts[at - 1] in self._relative:
            return False
        return not any(begin + self.strong(texts, begin) == len(texts) for begin in range(at))  # "I am sorry"

    def corrects(self, texts: Sequence[str], at: int) -> bool:
        """Whether that term takes back what was said earlier, as "sorry" does not."""
        return self._correcting.length(texts, at) > 0

    def end(self, texts: Sequence[str], at: int) -> int:
        """Behind all the terms, and the marks between them, from ``at`` on: "no, wait, I mean"; ``at`` for none."""
        end = at + self.any(texts, at)
        while at < end < len(texts):
            more = 1 if texts[end] in MARKS else self.any(texts, end)
            if not more:
                break
            end += more
        return end

    def _before_phrase(self, texts: Sequence[str], at: int) -> int:
        """A term that is one only before an amount, or before some phrase that may replace another."""
        of_amounts = self._of_amounts.length(texts, at) if at else 0
        end = at + (of_amounts or self._of_phrases.length(texts, at))
        if end == at or end >= len(texts) or (at and self._words.joins(texts, at - 1)):
            return 0
        kind = self._words.kind(texts, end)
        if of_amounts:
            return of_amounts if kind == "number" else 0
        return end - at if kind in _PHRASE_KINDS and not self._words.begins_clause(texts, end) else 0

"""Editing terms: what is said between what was wrong and what is right, such as "I mean", "no", "sorry"."""

from __future__ import annotations

from collections.abc import Sequence

from voxml.words import ClosedClasses

from .fixed_phrases import FixedPhrases
from .known_words import KnownWords
from .tokens import MARKS


class EditingTerms:
    """The editing terms of one language. Lengths are in words, 0 for none."""

    def __init__(self, closed: ClosedClasses, words: KnownWords) -> None:
        self._words = words
        self._strong = FixedPhrases.of(closed, "edit")
        self._weak = FixedPhrases.of(closed, "edit_weak")
        self._trailing = FixedPhrases.of(closed, "edit_trailing")
        self._aside = FixedPhrases.of(closed, "edit_aside")
        self._of_amounts = FixedPhrases.of(closed, "edit_amount")
        tables = (self._strong, self._weak, self._trailing, self._of_amounts)
        self.words = frozenset().union(*(table.first_words for table in tables))

    def strong(self, texts: Sequence[str], at: int) -> int:
        """A term that can be nothing else, as "let's do" is before an amount."""
        return self._strong.length(texts, at) or self._before_amount(texts, at)

    def weak(self, texts: Sequence[str], at: int) -> int:
        """A term that may be something else: "no", "wait"."""
        return self._weak.length(texts, at)

    def any(self, texts: Sequence[str], at: int) -> int:
        return self.strong(texts, at) or self.weak(texts, at)

    def aside(self, texts: Sequence[str], at: int) -> int:
        """A term that takes nothing back where nothing of the kind of what follows stands before: "turn, sorry, left"."""
        return self._aside.length(texts, at) or self._before_amount(texts, at)

    def trailing(self, texts: Sequence[str], at: int) -> bool:
        """Whether the utterance ends with a term that takes nothing back: "left, I said"."""
        length = self._trailing.length(texts, at)
        return length > 0 and at + length == len(texts)

    def end(self, texts: Sequence[str], at: int) -> int:
        """Behind all the terms, and the marks between them, from ``at`` on: "no, wait, I mean"; ``at`` for none."""
        end = at + self.any(texts, at)
        while at < end < len(texts):
            more = 1 if texts[end] in MARKS else self.any(texts, end)
            if not more:
                break
            end += more
        return end

    def _before_amount(self, texts: Sequence[str], at: int) -> int:
        length = self._of_amounts.length(texts, at) if at else 0
        if not length or at + length >= len(texts) or self._words.joins(texts, at - 1) or texts[at - 1] in MARKS:
            return 0
        return length if self._words.amounts.numbers.number(texts, at + length) is not None else 0

"""Repairs with an editing term: "turn left forty, I mean, fifty degrees".

A repair is reparandum, interregnum, repair (Shriberg 1994, Preliminaries to a Theory of Speech Disfluencies): in the
example the reparandum "forty" begins at the nearest word of the kind with which the repair begins.
"""

from __future__ import annotations

from collections.abc import Sequence

from .editing import EditingTerms
from .known_words import KnownWords
from .tokens import MARKS, Token

_TRAILING_MAX = 3


class Repairs:
    """Puts repairs in place of what they repair, with the words of one language."""

    def __init__(self, words: KnownWords, terms: EditingTerms) -> None:
        self._words = words
        self._terms = terms

    def applied(self, tokens: list[Token]) -> tuple[list[Token], bool]:
        """The tokens as they were meant, and whether they begin by taking something back ("no, I mean ...")."""
        tokens, trails = self._without_trailing(tokens)
        tokens, leads = self._without_leading(tokens)
        texts = [token.text for token in tokens]
        at = 1
        while at < len(tokens):
            mended = self._mended(tokens, texts, at)
            if mended is None:
                at += 1
            else:
                tokens, at = mended, 1
                texts = [token.text for token in tokens]
        return tokens, leads or trails

    def _without_trailing(self, tokens: list[Token]) -> tuple[list[Token], bool]:
        """ "left, I said" and "the red one, I mean" take back what was said before them."""
        texts = [token.text for token in tokens]
        for at in range(max(1, len(tokens) - _TRAILING_MAX), len(tokens)):
            if self._terms.trailing(texts, at):
                return tokens[:at], self._terms.corrects(texts, at)
        return tokens, False

    def _without_leading(self, tokens: list[Token]) -> tuple[list[Token], bool]:
        texts = [token.text for token in tokens]
        at = 0
        while at < len(tokens):
            length = 1 if texts[at] in MARKS else self._leading(texts, at)
            if not length:
                break
            at += length
        corrects = any(text not in MARKS for text in texts[:at])
        return (tokens[at:] if corrects else tokens), corrects

    def _leading(self, texts: Sequence[str], at: int) -> int:
        """How long the term at the beginning is; 0 where nothing but a refusal follows it."""
        length = self._terms.strong(texts, at) or self._weak_before_strong(texts, at)
        rest = texts[at + length :]
        return 0 if all(text in MARKS or self._words.refuses(text) for text in rest) else length

    def _weak_before_strong(self, texts: Sequence[str], at: int) -> int:
        """How long the "no," of "no, I mean" is."""
        end = at + self._terms.weak(texts, at)
        while at < end < len(texts) and texts[end] in MARKS:
            end += 1
        return end - at if end > at and self._terms.strong(texts, end) else 0

    # ------------------------------------------------------------ one repair
    def _mended(self, tokens: list[Token], texts: list[str], at: int) -> list[Token] | None:
        """The tokens with the repair behind the term at ``at`` in its place; None where there is none."""
        end = self._terms.end(texts, at)
        if end == at or end >= len(texts):
            return None
        fluent = at
        while fluent and texts[fluent - 1] in MARKS:
            fluent -= 1
        if fluent and self._words.begins_clause(texts, end) and not self._is_direction(texts, end):
            begun = self._clause_start(texts[:fluent], texts[end:])
            return [*tokens[:begun], *tokens[end:]] if self._words.is_to_do(texts[begun:fluent]) else None
        start = self._counterpart(texts[:fluent], self._words.kind(texts, end))
        if start is None:
            return [*tokens[:at], *tokens[end:]] if at + self._terms.aside(texts, at) == end else None
        length = self._words.length(texts, end)
        rest = tokens[start + self._words.length(texts[:fluent], start) : fluent] if end + length == len(texts) else []
        return [*tokens[:start], *tokens[end:], *rest]

    def _is_direction(self, texts: Sequence[str], at: int) -> bool:
        """Whether all that follows is a direction that may be a verb too: "(go forward, no,) back"."""
        if at + self._words.length(texts, at) < len(texts):
            return False
        return self._words.kind(texts, at) == "direction" and "VERB" in self._words.kinds(texts, at)

    def _counterpart(self, before: Sequence[str], kind: str | None) -> int | None:
        """Where in the last clause of ``before`` the nearest words of a kind stand."""
        if kind is None:
            return None
        first = self._words.clause_starts(before)[-1]
        alike = [at >= first and self._words.kind(before, at) == kind for at in range(len(before))]
        last = next((at for at in range(len(before) - 1, -1, -1) if alike[at]), None)
        while last and alike[last - 1]:
            last -= 1
        return last

    def _clause_start(self, before: Sequence[str], repair: Sequence[str]) -> int:
        """Where the clauses begin that clauses replace: the last one, or as many back as the repair has, if it begins
        as that one did ("turn left and go forward, no, turn right and go forward").
        """
        starts = self._words.clause_starts(before)
        count = len(self._words.clause_starts(repair))
        for start in starts[-count:]:
            if before[start] == repair[0]:
                return start
        return starts[-1]

"""Clauses given up before they were whole, for another with the same verb: "go to the go forward"."""

from __future__ import annotations

from collections.abc import Sequence

from voxml.terms import Unit

from .known_words import KnownWords
from .tokens import Token

_CLAUSE_MAX = 16
_LEAD_MAX = 8
_ANGLE_MIN = 90.0  # such numbers are angles without their unit: "turn one eighty"


class Abandoned:
    """Takes abandoned clauses out of utterances, with the words of one language."""

    def __init__(self, words: KnownWords) -> None:
        self._words = words

    def without(self, tokens: list[Token]) -> list[Token]:
        """The tokens without what was given up."""
        texts = [token.text for token in tokens]
        at = 1 if len(set(texts)) < len(texts) else len(texts)
        while at < len(texts):
            start = self._request(texts, at)
            start = self._clause(texts, at) if start is None else start
            if start is None:
                at += 1
            else:
                del tokens[start:at], texts[start:at]
                at = max(start, 1)
        return tokens

    def _request(self, texts: Sequence[str], at: int) -> int | None:
        """Where a request began that begins anew at ``at``, at most one word later: "can you move can you turn"."""
        leads = self._words.leads
        if not leads.length(texts, at) or self._words.joins(texts, at - 1) or self._forbidden(texts, at):
            return None
        for start in range(max(0, at - _LEAD_MAX), at - 1):
            length = leads.length(texts, start)
            if length > 1 and at - length - start in (0, 1):
                return start
        return None

    def _forbidden(self, texts: Sequence[str], at: int) -> bool:
        """Whether a "not" or "never" stands before what may be said anew: that is not given up."""
        return any(
            self._words.denies(texts[before]) or self._words.forbids.length(texts, before)
            for before in range(max(0, at - _LEAD_MAX), at)
        )

    def _clause(self, texts: Sequence[str], at: int) -> int | None:
        """Where a clause began that still lacked its noun, or its unit, when its verb was said again at ``at``."""
        if not self._words.begins_clause(texts, at):
            return None
        earliest = max(0, at - _CLAUSE_MAX)
        start = next((index for index in range(at - 2, earliest - 1, -1) if texts[index] == texts[at]), None)
        if start is None or (start and not self._words.joins(texts, start - 1)):
            return None
        lacks_noun = self._words.is_open(texts[at - 1]) and not self._words.is_thing(texts, at)
        return start if lacks_noun or self._counts_anew(texts, start, at) else None

    def _counts_anew(self, texts: Sequence[str], start: int, at: int) -> bool:
        """Whether the clause from ``start`` ends with a number, and the one from ``at`` has one with a unit there:
        "move forward three move forward four feet".
        """
        amounts = self._words.amounts
        for index in range(start + 1, at):
            number = amounts.numbers.number(texts, index)
            if number is not None:
                again = at + index - start
                amount = amounts.amount(texts, again)
                if number[1] != at or list(texts[start:index]) != list(texts[at:again]) or amount is None:
                    return False
                return amount[0].quantity.unit is not Unit.DEGREE or number[0] < _ANGLE_MIN
        return False

"""Numbers in words, digits and mixtures, read from tokens."""

from __future__ import annotations

import re
from collections.abc import Sequence

from .number_words import NumberWords

_DIGITS = re.compile(r"[0-9]+(?:\.[0-9]+)?|\.[0-9]+")
_SLASHED = re.compile(r"([0-9]+)/([1-9][0-9]*)")
VALUE_MAX = 1e6

Read = tuple[float, int]
"""A value, and the position behind the last token it was read from."""


class NumberReader:
    """Reads numbers with the words of one language. Indices are token positions; ends are exclusive."""

    def __init__(self, words: NumberWords) -> None:
        self._words = words
        self._heads = words.units.keys() | words.multipliers.keys() | words.fractions.keys()
        self._starters = words.starters()

    def is_number_word(self, token: str) -> bool:
        """Whether the token is a number by itself or the head of one: "ten", "45", "hundred", "half"."""
        return token in self._heads or token[0].isdigit()

    def may_start(self, token: str) -> bool:
        """Whether a number can begin with this token."""
        return token in self._starters or token[0].isdigit() or (token[0] == "." and len(token) > 1)

    def may_belong(self, token: str) -> bool:
        """Whether the word may stand inside a number: besides those it can begin with, "and", "of", "oh"."""
        words = self._words
        return self.may_start(token) or token in words.joining or token in words.of or token in words.inner_zero

    def is_spelt(self, tokens: Sequence[str], at: int) -> bool:
        """Whether the word is one of at least three different digits said one by one, or of those behind a point."""
        start = end = at
        while start and self._words.digit(tokens[start - 1]):
            start -= 1
        while end < len(tokens) and self._words.digit(tokens[end]):
            end += 1
        if start and tokens[start - 1] in self._words.point:
            return True
        return end - start > 2 and len(set(tokens[start:end])) > 1

    def number(self, tokens: Sequence[str], at: int) -> Read | None:
        """The longest number that begins here, with its end."""
        if at >= len(tokens) or not self.may_start(tokens[at]):
            return None
        if tokens[at] in self._words.minus:
            found = self.number(tokens, at + 1)
            return None if found is None or found[0] < 0 else (-found[0], found[1])
        part = self.fraction(tokens, at)
        found = self._cardinal(tokens, at) or self._vague(tokens, at) if part is None else self._of_many(tokens, part)
        if found is None or found[0] > VALUE_MAX:
            return None
        return self._with_fraction(tokens, *found)

    def spelt(self, tokens: Sequence[str], at: int) -> Read | None:
        """A number said digit by digit: "four five", "one two zero"."""
        said = ""
        while at < len(tokens) and (digit := self._words.digit(tokens[at])):
            said, at = said + digit, at + 1
        return (float(said), at) if 1 < len(said) < 6 and said[0] != "0" else None

    def fraction(self, tokens: Sequence[str], at: int) -> Read | None:
        """A part of one: "half", "a half", "three quarters", "1/2"."""
        fractions = self._words.fractions
        slashed = _SLASHED.fullmatch(tokens[at]) if "/" in tokens[at] else None
        if slashed:
            return float(slashed[1]) / float(slashed[2]), at + 1
        if tokens[at] in fractions:
            return fractions[tokens[at]], at + 1
        if at + 1 < len(tokens) and tokens[at + 1] in fractions:
            count = 1.0 if tokens[at] in self._words.articles else self._words.units.get(tokens[at], 0.0)
            if 0 < count < 10:
                return count * fractions[tokens[at + 1]], at + 2
        return None

    def _of_many(self, tokens: Sequence[str], part: Read) -> Read:
        """ "half", or "half a dozen"."""
        start = part[1] + 1 if part[1] < len(tokens) and tokens[part[1]] in self._words.articles else part[1]
        if start >= len(tokens) or tokens[start] not in self._words.multipliers:
            return part
        return part[0] * self._words.multipliers[tokens[start]], start + 1

    def _vague(self, tokens: Sequence[str], at: int) -> Read | None:
        start = at + 1 if tokens[at] in self._words.articles else at
        if start >= len(tokens) or tokens[start] not in self._words.vague:
            return None
        end = start + 1
        has_of = end < len(tokens) and tokens[end] in self._words.of
        return self._words.vague[tokens[start]], end + 1 if has_of else end

    def _with_fraction(self, tokens: Sequence[str], value: float, at: int) -> Read:
        """ "(two) and a half", "(one) and three quarters", "(two) point five"."""
        if at + 1 < len(tokens) and tokens[at] in self._words.point and value == int(value):
            return self._decimals(tokens, value, at)
        if at + 1 < len(tokens) and tokens[at] in self._words.joining:
            rest = self.fraction(tokens, at + 1)
            if rest is not None and rest[0] < 1 <= value:
                return value + rest[0], rest[1]
        if at < len(tokens) and value == int(value) >= 1 and _SLASHED.fullmatch(tokens[at]):
            rest = self.fraction(tokens, at)
            if rest is not None:
                return value + rest[0], rest[1]
        return value, at

    def _decimals(self, tokens: Sequence[str], value: float, at: int) -> Read:
        """The digits behind the point at ``at``, said one by one or written as one token."""
        digits, end = "", at + 1
        while end < len(tokens):
            said = self._decimal(tokens[end])
            if not said or (digits and len(said) > 1):
                break
            digits, end = digits + said, end + 1
        return (value + float(f"0.{digits}"), end) if digits else (value, at)

    def _decimal(self, word: str) -> str:
        if word.isdecimal():
            return word
        if word in self._words.inner_zero:
            return "0"
        return str(int(self._words.units[word])) if word in self._words.units else ""

    def _cardinal(self, tokens: Sequence[str], at: int) -> Read | None:
        word, words = tokens[at], self._words
        if word in words.point:
            value, end = self._decimals(tokens, 0.0, at)
            return (value, end) if end > at else None
        spelt = self.spelt(tokens, at) if word in words.units else None
        if spelt is not None and any(words.digit(token) == "0" for token in tokens[at + 1 : spelt[1]]):
            return spelt
        if _DIGITS.fullmatch(word):
            end = at + 1
            scale = words.multipliers.get(tokens[end]) if end < len(tokens) else None
            return (float(word), end) if scale is None else self._scaled(tokens, float(word) * scale, end + 1)
        if word in words.articles:
            scale = words.multipliers.get(tokens[at + 1]) if at + 1 < len(tokens) else None
            return None if scale is None else self._scaled(tokens, scale, at + 2)
        if word in words.multipliers:
            return self._scaled(tokens, words.multipliers[word], at + 1)
        return self._spoken(tokens, at)

    def _spoken(self, tokens: Sequence[str], at: int) -> Read | None:
        found = self._below_hundred(tokens, at)
        if found is None:
            return None
        value, end = found
        if end < len(tokens) and tokens[end] in self._words.multipliers:
            return self._scaled(tokens, value * self._words.multipliers[tokens[end]], end + 1)
        return self._hundreds_unsaid(tokens, value, end) if 1 <= value <= 9 else found

    def _hundreds_unsaid(self, tokens: Sequence[str], value: float, end: int) -> Read:
        """ "one twenty", "three sixty", "one thirty five", "one oh five"."""
        zero = end < len(tokens) and tokens[end] in self._words.inner_zero
        rest = (0.0, end + 1) if zero else self._below_hundred(tokens, end)
        if rest is not None and rest[0] >= 10:
            return value * 100 + rest[0], rest[1]
        if rest is not None and rest[0] == 0:
            last = self._below_hundred(tokens, rest[1])
            if last is not None and 1 <= last[0] <= 9:
                return value * 100 + last[0], last[1]
        return value, end

    def _scaled(self, tokens: Sequence[str], value: float, at: int) -> Read:
        """What follows "hundred" or "thousand": "(a hundred) thousand", "(two hundred) and eighty"."""
        scale = self._words.multipliers.get(tokens[at], 0.0) if at < len(tokens) else 0.0
        if scale > value:
            return self._scaled(tokens, value * scale, at + 1)
        start = at + 1 if at < len(tokens) and tokens[at] in self._words.joining else at
        rest = self._spoken(tokens, start) if start < len(tokens) else None
        return (value + rest[0], rest[1]) if rest is not None and 0 < rest[0] < value else (value, at)

    def _below_hundred(self, tokens: Sequence[str], at: int) -> Read | None:
        units = self._words.units
        value = units.get(tokens[at]) if at < len(tokens) else None
        if value is None:
            return None
        joined = at + 1 < len(tokens) and tokens[at + 1] in self._words.tens_joining
        after = at + 2 if joined else at + 1
        one = units.get(tokens[after]) if after < len(tokens) else None
        if value >= 20 and one is not None and 1 <= one <= 9:
            return value + one, after + 1
        return value, at + 1

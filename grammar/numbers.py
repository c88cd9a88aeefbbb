"""Numbers and quantities in words, digits and mixtures, read from tokens."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from voxml.terms import Quantity, Unit, parse_form
from voxml.words import ClosedClasses

from .tokens import MARKS

_DIGITS = re.compile(r"[0-9]+(?:\.[0-9]+)?|\.[0-9]+")
_SLASHED = re.compile(r"([0-9]+)/([1-9][0-9]*)")
VALUE_MAX = 1e6
RATIO_SLACK = 1e-6

Read = tuple[float, int]


@dataclass(frozen=True, slots=True)
class Amount:
    """A quantity as it was said; ``more`` where it adds to what was done before ("another two feet")."""

    quantity: Quantity
    more: bool


class NumberReader:
    """Reads numbers and quantities with the words of one language. Indices are token positions; ends are exclusive."""

    def __init__(self, closed: ClosedClasses) -> None:
        self._units = {word: float(value) for word, value in closed.table("number").items()}
        self._multipliers = {word: float(value) for word, value in closed.table("multiplier").items()}
        self._fractions = {word: float(value) for word, value in closed.table("fraction").items()}
        roles: dict[str, set[str]] = {}
        for word, role in closed.table("number_word").items():
            roles.setdefault(role, set()).add(word)
        self._articles = frozenset(roles.pop("article", ()))
        self._and = frozenset(roles.pop("and", ()))
        self._tens_and = frozenset(closed.table("tens_and"))
        self._point = frozenset(roles.pop("point", ()))
        self._minus = frozenset(roles.pop("minus", ()))
        self._range = frozenset(roles.pop("range", ()))
        self._of = frozenset(roles.pop("of", ()))
        self._inner_zero = frozenset(roles.pop("zero", ()))
        self._vague_counts = {word: float(value) for value, words in roles.items() for word in words}
        self._more = frozenset(closed.table("more"))
        self._approximate = {word.words for word in closed.words_of("amount_lead")}
        self._approximate_first = frozenset(words[0] for words in self._approximate)
        self._lengths = _units(closed, "unit")
        self._last_lengths = _units(closed, "unit_last")
        self._starters = frozenset(
            {*self._units, *self._multipliers, *self._fractions, *self._vague_counts, *self._articles}
            | {*self._point, *self._minus, *self._more, *self._approximate_first}
        )

    def may_start(self, token: str) -> bool:
        """Whether a number or quantity can begin with this token."""
        return token in self._starters or token[0].isdigit() or (token[0] == "." and len(token) > 1)

    def is_number_word(self, token: str) -> bool:
        """Whether the token is a number by itself or the head of one: "ten", "45", "hundred", "half"."""
        return token in self._units or token in self._multipliers or token in self._fractions or token[0].isdigit()

    def is_unit(self, token: str) -> bool:
        return any(len(words) == 1 for words, _ in self._lengths.get(token, ()))

    # ------------------------------------------------------------ quantities
    def amount(self, tokens: Sequence[str], at: int) -> tuple[Amount, int] | None:
        """A number with its unit: "five feet", "another half a meter", "ten more degrees", "3 ft 2 in"."""
        at, more = self._past_lead(tokens, at)
        found = self._whole_unit(tokens, at) or self._amount_number(tokens, at)
        if found is None:
            return None
        value, at = found
        at, more = self._skip_more(tokens, at, more)
        unit = self._unit(tokens, at)
        if unit is None:
            return None
        quantity, at = unit
        value, at = self._and_fraction(tokens, value, at)
        total = value * quantity.value
        rest = self._smaller(tokens, at, quantity)
        if rest is not None:
            total, at = total + rest[0], rest[1]
        at, more = self._skip_more(tokens, at, more, only_plain=True)
        return Amount(Quantity(round(total, 9), quantity.unit), more), at

    def _past_lead(self, tokens: Sequence[str], at: int) -> tuple[int, bool]:
        """Past "about another" and the like, but not into "a full turn", which is the name of a unit."""
        if self._whole_unit(tokens, at) is not None:
            return at, False
        at, more = self._skip_more(tokens, self._skip_approximate(tokens, at), False)
        at = self._skip_approximate(tokens, at)
        return self._skip_more(tokens, at, more) if more else (at, more)

    def _whole_unit(self, tokens: Sequence[str], at: int) -> Read | None:
        """One of a unit whose name begins like a number or what leads to one: "(a) quarter turn", "a full turn"."""
        start = at + 1 if at < len(tokens) and tokens[at] in self._articles else at
        unit = self._unit(tokens, start)
        if unit is None or not (tokens[start] in self._fractions or (start > at and unit[1] > start + 1)):
            return None
        return 1.0, start

    def more(self, tokens: Sequence[str], at: int) -> Read | None:
        """A number that adds, without its unit: "ten more", "another ten"."""
        start, added = self._skip_more(tokens, at, False)
        found = self.number(tokens, start)
        if found is None:
            return None
        end, more = self._skip_more(tokens, found[1], added)
        return (found[0], end) if more else None

    def _skip_approximate(self, tokens: Sequence[str], at: int) -> int:
        """Past "about", "for", "at least", "maybe": the amount is taken as said."""
        while at < len(tokens) and tokens[at] in self._approximate_first:
            length = next((n for n in (3, 2, 1) if tuple(tokens[at : at + n]) in self._approximate), 0)
            if not length:
                break
            at += length
        return at

    def _skip_more(self, tokens: Sequence[str], at: int, more: bool, only_plain: bool = False) -> tuple[int, bool]:
        if at + 1 < len(tokens) and tokens[at] in self._articles and tokens[at + 1] in self._more:
            at += 1
        while at < len(tokens) and tokens[at] in self._more and not (only_plain and tokens[at] not in self._more):
            at, more = at + 1, True
        return at, more

    def _amount_number(self, tokens: Sequence[str], at: int) -> Read | None:
        found = self.number(tokens, at)
        if found is None:
            return (
                (1.0, at)
                if 0 < at < len(tokens) and tokens[at - 1] in self._more and self._unit(tokens, at)
                else self._article(tokens, at)
            )
        value, end = found
        upper = self.number(tokens, end + 1) if end < len(tokens) and tokens[end] in self._range else None
        if upper is not None:  # "two to three feet": the less is safe
            return min(value, upper[0]), self._skip_of(tokens, upper[1])
        corrected = self.number(tokens, end) if end < len(tokens) else None
        if corrected is not None:  # "two three feet": the second replaces the first
            value, end = corrected
        return value, self._skip_of(tokens, end)

    def _article(self, tokens: Sequence[str], at: int) -> Read | None:
        if at + 1 < len(tokens) and tokens[at] in self._articles and self._unit(tokens, at + 1):
            return 1.0, at + 1
        return None

    def _skip_of(self, tokens: Sequence[str], at: int) -> int:
        """Past "of a", "a", "of" between a fraction and its unit."""
        end = at
        if end < len(tokens) and tokens[end] in self._of:
            end += 1
        if end < len(tokens) and tokens[end] in self._articles:
            end += 1
        return end if end < len(tokens) and self._unit(tokens, end) else at

    def _unit(self, tokens: Sequence[str], at: int) -> tuple[Quantity, int] | None:
        if at >= len(tokens):
            return None
        for words, quantity in self._lengths.get(tokens[at], ()):
            if tuple(tokens[at : at + len(words)]) == words:
                return quantity, at + len(words)
        if at + 1 < len(tokens) and tokens[at + 1] not in MARKS and tokens[at + 1] not in self._and:
            return None
        return next(((quantity, at + 1) for _, quantity in self._last_lengths.get(tokens[at], ())), None)

    def _and_fraction(self, tokens: Sequence[str], value: float, at: int) -> Read:
        """A rest of the same unit: "(a foot) and a half"."""
        if at + 1 < len(tokens) and tokens[at] in self._and:
            rest = self._fraction(tokens, at + 1)
            if rest is not None and self._unit(tokens, rest[1]) is None:
                return value + rest[0], rest[1]
        return value, at

    def _smaller(self, tokens: Sequence[str], at: int, unit: Quantity) -> Read | None:
        """A rest in a smaller unit of the same kind: "(two feet) and three inches"."""
        start = at + 1 if at < len(tokens) and tokens[at] in self._and else at
        found = self.number(tokens, start)
        rest = None if found is None else self._unit(tokens, found[1])
        if found is None or rest is None or not _divides(rest[0], unit) or found[0] * rest[0].value >= unit.value:
            return None
        return found[0] * rest[0].value, rest[1]

    # ------------------------------------------------------------ numbers
    def number(self, tokens: Sequence[str], at: int) -> Read | None:
        """The longest number that begins here, with its end."""
        if at >= len(tokens):
            return None
        if tokens[at] in self._minus:
            found = self.number(tokens, at + 1)
            return None if found is None or found[0] < 0 else (-found[0], found[1])
        found = (
            self._part_of(tokens, at)
            or self._fraction(tokens, at)
            or self._cardinal(tokens, at)
            or self._vague(tokens, at)
        )
        if found is None or found[0] > VALUE_MAX:
            return None
        return self._with_fraction(tokens, *found)

    def _vague(self, tokens: Sequence[str], at: int) -> Read | None:
        start = at + 1 if tokens[at] in self._articles else at
        if start >= len(tokens) or tokens[start] not in self._vague_counts:
            return None
        end = start + 1
        return self._vague_counts[tokens[start]], end + 1 if end < len(tokens) and tokens[end] in self._of else end

    def _part_of(self, tokens: Sequence[str], at: int) -> Read | None:
        """ "half a dozen"."""
        part = self._fraction(tokens, at)
        if part is None:
            return None
        start = part[1] + 1 if part[1] < len(tokens) and tokens[part[1]] in self._articles else part[1]
        if start >= len(tokens) or tokens[start] not in self._multipliers:
            return None
        return part[0] * self._multipliers[tokens[start]], start + 1

    def _fraction(self, tokens: Sequence[str], at: int) -> Read | None:
        """ "half", "a half", "one half", "three quarters", "1/2"."""
        slashed = _SLASHED.fullmatch(tokens[at])
        if slashed:
            return float(slashed[1]) / float(slashed[2]), at + 1
        if tokens[at] in self._fractions:
            return self._fractions[tokens[at]], at + 1
        if at + 1 < len(tokens) and tokens[at + 1] in self._fractions:
            count = 1.0 if tokens[at] in self._articles else self._units.get(tokens[at], 0.0)
            if 0 < count < 10:
                return count * self._fractions[tokens[at + 1]], at + 2
        return None

    def _with_fraction(self, tokens: Sequence[str], value: float, at: int) -> Read:
        """ "(two) and a half", "(one) and three quarters", "(two) point five"."""
        if at + 1 < len(tokens) and tokens[at] in self._point and value == int(value):
            return self._decimals(tokens, value, at)
        if at + 1 < len(tokens) and tokens[at] in self._and:
            rest = self._fraction(tokens, at + 1)
            if rest is not None and rest[0] < 1 <= value:
                return value + rest[0], rest[1]
        if at < len(tokens) and value == int(value) >= 1 and _SLASHED.fullmatch(tokens[at]):
            rest = self._fraction(tokens, at)
            if rest is not None:
                return value + rest[0], rest[1]
        return value, at

    def _decimals(self, tokens: Sequence[str], value: float, at: int) -> Read:
        digits, end = "", at + 1
        while end < len(tokens):
            word = tokens[end]
            said = (
                word
                if word.isdigit()
                else "0"
                if word in self._inner_zero
                else str(int(self._units[word]))
                if word in self._units
                else ""
            )
            if not said or (digits and len(said) > 1):
                break
            digits, end = digits + said, end + 1
        return (value + float(f"0.{digits}"), end) if digits else (value, at)

    def _cardinal(self, tokens: Sequence[str], at: int) -> Read | None:
        word = tokens[at]
        if word in self._point:
            value, end = self._decimals(tokens, 0.0, at)
            return (value, end) if end > at else None
        if _DIGITS.fullmatch(word):
            end = at + 1
            scale = self._multipliers.get(tokens[end]) if end < len(tokens) else None
            return (float(word), end) if scale is None else self._scaled(tokens, float(word) * scale, end + 1)
        if word in self._articles:
            scale = self._multipliers.get(tokens[at + 1]) if at + 1 < len(tokens) else None
            return None if scale is None else self._scaled(tokens, scale, at + 2)
        if word in self._multipliers:
            return self._scaled(tokens, self._multipliers[word], at + 1)
        return self._spoken(tokens, at)

    def _spoken(self, tokens: Sequence[str], at: int) -> Read | None:
        found = self._below_hundred(tokens, at)
        if found is None:
            return None
        value, end = found
        if end < len(tokens) and tokens[end] in self._multipliers:
            return self._scaled(tokens, value * self._multipliers[tokens[end]], end + 1)
        if 1 <= value <= 9:  # "one twenty", "three sixty", "one thirty five", "one oh five"
            zero = end < len(tokens) and tokens[end] in self._inner_zero
            rest = (0.0, end + 1) if zero else self._below_hundred(tokens, end)
            if rest is not None and rest[0] >= 10:
                return value * 100 + rest[0], rest[1]
            if rest is not None and rest[0] == 0:
                last = self._below_hundred(tokens, rest[1])
                if last is not None and 1 <= last[0] <= 9:
                    return value * 100 + last[0], last[1]
        return value, end

    def _scaled(self, tokens: Sequence[str], value: float, at: int) -> Read:
        """What follows "hundred" or "thousand": "(a hundred) and eighty", "(two thousand) five hundred"."""
        start = at + 1 if at < len(tokens) and tokens[at] in self._and else at
        rest = self._spoken(tokens, start) if start < len(tokens) else None
        return (value + rest[0], rest[1]) if rest is not None and 0 < rest[0] < value else (value, at)

    def _below_hundred(self, tokens: Sequence[str], at: int) -> Read | None:
        value = self._units.get(tokens[at]) if at < len(tokens) else None
        if value is None:
            return None
        after = at + 2 if at + 1 < len(tokens) and tokens[at + 1] in self._tens_and else at + 1
        one = self._units.get(tokens[after]) if after < len(tokens) else None
        if value >= 20 and one is not None and 1 <= one <= 9:
            return value + one, after + 1
        return value, at + 1


def _divides(smaller: Quantity, unit: Quantity) -> bool:
    """Inches divide feet and centimetres metres; feet do not divide steps."""
    ratio = unit.value / smaller.value
    return smaller.unit is unit.unit and ratio > 1 and abs(ratio - round(ratio)) < RATIO_SLACK


def _units(closed: ClosedClasses, name: str) -> dict[str, tuple[tuple[tuple[str, ...], Quantity], ...]]:
    table: dict[str, list[tuple[tuple[str, ...], Quantity]]] = {}
    for word in closed.words_of(name):
        quantity = parse_form(word.text)
        assert isinstance(quantity, Quantity), word
        assert quantity.unit is not Unit.COUNT, word
        table.setdefault(word.words[0], []).append((word.words, quantity))
    return {first: tuple(sorted(found, key=lambda item: -len(item[0]))) for first, found in table.items()}

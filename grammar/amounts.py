"""Quantities as people say them: a number with its unit, about how much of it, how much more."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from voxml.terms import Quantity, Unit, parse_form
from voxml.words import ClosedClasses

from .fixed_phrases import FixedPhrases
from .number_words import number_words
from .numbers import NumberReader, Read
from .tokens import MARKS

RATIO_SLACK = 1e-6


@dataclass(frozen=True, slots=True)
class Amount:
    """A quantity as it was said; ``more`` where it adds to what was done before ("another two feet")."""

    quantity: Quantity
    more: bool


class AmountReader:
    """Reads quantities with the words of one language. Indices are token positions; ends are exclusive."""

    def __init__(self, closed: ClosedClasses) -> None:
        words = number_words(closed)
        self.numbers = NumberReader(words)
        self._words = words
        self._more = frozenset(closed.table("more"))
        self._leads = FixedPhrases.of(closed, "amount_lead")
        self._units = _units(closed, "unit")
        self._last_units = _units(closed, "unit_last")
        self._parted_units = _units(closed, "unit_whole")
        self._starters = self._more | self._leads.first_words

    def may_start(self, token: str) -> bool:
        """Whether a number or quantity can begin with this token."""
        return token in self._starters or self.numbers.may_start(token)

    def is_unit(self, token: str) -> bool:
        return self.unit_of(token) is not None

    def unit_of(self, token: str) -> Quantity | None:
        """One of the unit that the word is by itself."""
        return next((quantity for words, quantity in self._units.get(token, ()) if len(words) == 1), None)

    def may_belong(self, token: str) -> bool:
        """Whether the word may stand inside an amount, before its unit: "a", "and", "point", "more"."""
        return token in self._more or self.numbers.may_belong(token)

    def amount(self, tokens: Sequence[str], at: int) -> tuple[Amount, int] | None:
        """A number with its unit: "five feet", "another half a meter", "ten more degrees", "3 ft 2 in"."""
        at, more = self._past_lead(tokens, at)
        found = self._one_named(tokens, at) or self._number(tokens, at)
        if found is None:
            return None
        value, at = found
        at, more = self._past_more(tokens, at, more)
        unit = self._unit(tokens, at) or self._parted_unit(tokens, value, at)
        if unit is None:
            return None
        quantity, at = unit
        value, at = self._and_fraction(tokens, value, at)
        total = value * quantity.value
        rest = self._smaller(tokens, at, quantity)
        if rest is not None:
            total, at = total + rest[0], rest[1]
        at, more = self._past_more(tokens, at, more)
        return Amount(Quantity(round(total, 9), quantity.unit), more), at

    def more(self, tokens: Sequence[str], at: int) -> Read | None:
        """A number that adds, without its unit: "ten more", "another ten"."""
        if self._more.isdisjoint(tokens):
            return None
        start, added = self._past_more(tokens, at, False)
        found = self.numbers.number(tokens, start)
        if found is None:
            return None
        end, more = self._past_more(tokens, found[1], added)
        return (found[0], end) if more else None

    def with_unit_before(self, tokens: Sequence[str], at: int) -> tuple[Quantity, int] | None:
        """A number that leaves out the unit said with the amount before it: "(one meter and back) two"."""
        found = self.numbers.number(tokens, at)
        unit = None if found is None else self._unit_before(tokens, at)
        if found is None or unit is None:
            return None
        return Quantity(round(found[0] * unit.value, 9), unit.unit), found[1]

    def _unit_before(self, tokens: Sequence[str], at: int) -> Quantity | None:
        for start in range(at - 1, 0, -1):
            unit = self._unit(tokens, start)
            if unit is not None and self.numbers.is_number_word(tokens[start - 1]):
                return unit[0]
        return None

    def adds_to(self, tokens: Sequence[str], at: int) -> bool:
        """Whether an "and a half" begins here that belongs to the unit before it."""
        if at + 1 >= len(tokens) or tokens[at] not in self._words.joining:
            return False
        rest = self.numbers.fraction(tokens, at + 1)
        return rest is not None and self._unit(tokens, rest[1]) is None

    # ------------------------------------------------------------ before the number
    def _past_lead(self, tokens: Sequence[str], at: int) -> tuple[int, bool]:
        """Past "about another" and the like, but not into "a full turn", which is the name of a unit."""
        if at >= len(tokens) or tokens[at] not in self._starters or self._one_named(tokens, at) is not None:
            return at, False
        at, more = self._past_more(tokens, self._past_approximate(tokens, at), False)
        at = self._past_approximate(tokens, at)
        return self._past_more(tokens, at, more) if more else (at, more)

    def _past_approximate(self, tokens: Sequence[str], at: int) -> int:
        """Past "about", "for", "at least", "maybe": the amount is taken as said."""
        while length := self._leads.length(tokens, at):
            at += length
        return at

    def _past_more(self, tokens: Sequence[str], at: int, more: bool) -> tuple[int, bool]:
        if at + 1 < len(tokens) and tokens[at] in self._words.articles and tokens[at + 1] in self._more:
            at += 1
        while at < len(tokens) and tokens[at] in self._more:
            at, more = at + 1, True
        return at, more

    # ------------------------------------------------------------ the number
    def _one_named(self, tokens: Sequence[str], at: int) -> Read | None:
        """One of a unit whose name begins like a number or what leads to one: "(a) quarter turn", "a full turn"."""
        start = at + 1 if at < len(tokens) and tokens[at] in self._words.articles else at
        unit = self._unit(tokens, start)
        if unit is None or not (tokens[start] in self._words.fractions or (start > at and unit[1] > start + 1)):
            return None
        return 1.0, start

    def _number(self, tokens: Sequence[str], at: int) -> Read | None:
        found = self._spelt(tokens, at) or self.numbers.number(tokens, at)
        if found is None:
            return self._one_more(tokens, at) or self._article(tokens, at)
        value, end = found
        upper = self.numbers.number(tokens, end + 1) if end < len(tokens) and tokens[end] in self._words.range else None
        if upper is not None:  # "two to three feet": the less is safe
            return min(value, upper[0]), self._past_of(tokens, upper[1])
        second = self.numbers.number(tokens, end) if end < len(tokens) else None
        if second is not None:
            value, end = _replaced(value, second[0]), second[1]
        return value, self._past_of(tokens, end)

    def _spelt(self, tokens: Sequence[str], at: int) -> Read | None:
        """ "four five degrees" is forty five, "one zero feet" ten; of "one two feet" the second rather replaces the
        first.
        """
        found = self.numbers.spelt(tokens, at)
        unit = None if found is None else self._unit(tokens, found[1])
        if found is None or unit is None:
            return None
        return found if unit[0].unit is Unit.DEGREE or "0" in f"{found[0]:.0f}" else None

    def _one_more(self, tokens: Sequence[str], at: int) -> Read | None:
        """ "another meter"."""
        said = 0 < at < len(tokens) and tokens[at - 1] in self._more and self._unit(tokens, at) is not None
        return (1.0, at) if said else None

    def _article(self, tokens: Sequence[str], at: int) -> Read | None:
        if at + 1 < len(tokens) and tokens[at] in self._words.articles and self._unit(tokens, at + 1):
            return 1.0, at + 1
        return None

    def _past_of(self, tokens: Sequence[str], at: int) -> int:
        """Past "of a", "a", "of" between a fraction and its unit."""
        end = at
        if end < len(tokens) and tokens[end] in self._words.of:
            end += 1
        if end < len(tokens) and tokens[end] in self._words.articles:
            end += 1
        return end if end < len(tokens) and self._unit(tokens, end) else at

    # ------------------------------------------------------------ the unit
    def _unit(self, tokens: Sequence[str], at: int) -> tuple[Quantity, int] | None:
        found = _named(self._units, tokens, at)
        if found is not None or at >= len(tokens) or tokens[at] not in self._last_units:
            return found
        ends = at + 1 >= len(tokens) or tokens[at + 1] in MARKS or tokens[at + 1] in self._words.joining
        return _named(self._last_units, tokens, at) if ends else None

    def _parted_unit(self, tokens: Sequence[str], value: float, at: int) -> tuple[Quantity, int] | None:
        """A unit of which there can only be a part: "one and a half turns"; two turns are turned twice."""
        return None if value == int(value) else _named(self._parted_units, tokens, at)

    def _and_fraction(self, tokens: Sequence[str], value: float, at: int) -> Read:
        """A rest of the same unit: "(a foot) and a half"."""
        rest = self.numbers.fraction(tokens, at + 1) if self.adds_to(tokens, at) else None
        return (value, at) if rest is None else (value + rest[0], rest[1])

    def _smaller(self, tokens: Sequence[str], at: int, unit: Quantity) -> Read | None:
        """A rest in a smaller unit of the same kind: "(two feet) and three inches"."""
        start = at + 1 if at < len(tokens) and tokens[at] in self._words.joining else at
        found = self.numbers.number(tokens, start)
        rest = None if found is None else self._unit(tokens, found[1])
        if found is None or rest is None or not _divides(rest[0], unit) or found[0] * rest[0].value >= unit.value:
            return None
        return found[0] * rest[0].value, rest[1]


def _replaced(first: float, second: float) -> float:
    """The number that a second one turns the first into: "two three" is three, "a hundred and twenty thirty" 130, and
    "twenty five six" 26: the digits that were said anew."""
    scale = 10.0 if second < 10 else 100.0
    return first - first % scale + second if first > scale and first % scale and second < scale else second


def _divides(smaller: Quantity, unit: Quantity) -> bool:
    """Inches divide feet and centimetres metres; feet do not divide steps."""
    ratio = unit.value / smaller.value
    return smaller.unit is unit.unit and ratio > 1 and abs(ratio - round(ratio)) < RATIO_SLACK


Units = dict[str, tuple[tuple[tuple[str, ...], Quantity], ...]]


def _units(closed: ClosedClasses, name: str) -> Units:
    """Units by the first word of their names, the longest names first."""
    table: dict[str, list[tuple[tuple[str, ...], Quantity]]] = {}
    for word in closed.words_of(name):
        quantity = parse_form(word.text)
        assert isinstance(quantity, Quantity), word
        assert quantity.unit is not Unit.COUNT, word
        table.setdefault(word.words[0], []).append((word.words, quantity))
    return {first: tuple(sorted(found, key=lambda item: -len(item[0]))) for first, found in table.items()}


def _named(units: Units, tokens: Sequence[str], at: int) -> tuple[Quantity, int] | None:
    if at >= len(tokens):
        return None
    for words, quantity in units.get(tokens[at], ()):
        if len(words) == 1 or tuple(tokens[at : at + len(words)]) == words:
            return quantity, at + len(words)
    return None

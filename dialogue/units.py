"""Bare numbers in the unit of what they replace: "go forward five feet" ... "no, three"."""

from __future__ import annotations

from functools import lru_cache

from grammar.forms import Quantity, Unit, parse_form
from voxml.vocabulary import Lexicon

_STEPS = 4  # people say halves and quarters
_ALIKE = 10.0  # and seldom correct a number to one of another order of magnitude


def like(number: float, before: Quantity | None, unit: Unit, lexicon: Lexicon) -> Quantity:
    """A number of ``unit``; a length in the unit in which the one before was said, as far as its value tells.

    That is the first of the lexicon in which it is a round number, and this one not too far from it.
    """
    if before is None or before.unit is not unit or unit is not Unit.METRE or not before.value:
        return Quantity(number, unit)
    for factor in _lengths_m(lexicon):
        steps = _STEPS * before.value / factor
        alike = 1 / _ALIKE <= number * factor / before.value <= _ALIKE
        if alike and abs(steps - round(steps)) < 1e-6:
            return Quantity(number * factor, unit)
    return Quantity(number, unit)


@lru_cache(maxsize=8)
def _lengths_m(lexicon: Lexicon) -> tuple[float, ...]:
    """The units of length, in the order of the lexicon."""
    units = (parse_form(word.text) for word in lexicon.closed.words_of("unit"))
    lengths = (unit.value for unit in units if isinstance(unit, Quantity) and unit.unit is Unit.METRE)
    return tuple(dict.fromkeys(lengths))

"""Amounts that another replaces without a word: "ten deg, ten feet", "two feet three feet"."""

from __future__ import annotations

from collections.abc import Sequence

from .amounts import AmountReader
from .tokens import Token

_EVEN = 1e-6  # of the ratio of two amounts


def without_replaced_amounts(tokens: list[Token], amounts: AmountReader) -> list[Token]:
    """The tokens without each amount right behind which the same number, or one of the same dimension, stands."""
    texts = [token.text for token in tokens]
    at = 0
    while at < len(tokens):
        end = _replacement(texts, at, amounts)
        if end is None:
            at += 1
        else:
            del tokens[at:end], texts[at:end]
    return tokens


def _replacement(texts: Sequence[str], at: int, amounts: AmountReader) -> int | None:
    """Where the amount begins that replaces the one at ``at``."""
    numbers = amounts.numbers
    if not numbers.is_number_word(texts[at]) or (at and numbers.is_number_word(texts[at - 1])):
        return None
    number = numbers.number(texts, at)
    if number is None or number[1] >= len(texts):
        return None
    start = number[1] + 1 if amounts.is_unit(texts[number[1]]) else number[1]
    again = numbers.number(texts, start) if start > number[1] else None
    if again is not None and again[0] == number[0]:
        return None if _is_one_amount(texts, at, start, amounts) else start
    return _same_dimension(texts, at, amounts)


def _is_one_amount(texts: Sequence[str], at: int, second: int, amounts: AmountReader) -> bool:
    """Whether the amount at ``at`` has its smaller unit at ``second``: "six feet six inches", but not "five steps,
    five feet", which does not come out even.
    """
    whole, part = amounts.amount(texts, at), amounts.amount(texts, second)
    if whole is None or part is None or whole[1] <= second or not part[0].quantity.value:
        return False
    ratio = whole[0].quantity.value / part[0].quantity.value
    return abs(ratio - round(ratio)) < _EVEN


def _same_dimension(texts: Sequence[str], at: int, amounts: AmountReader) -> int | None:
    first = amounts.amount(texts, at)
    if first is None or first[1] >= len(texts) or not amounts.numbers.is_number_word(texts[first[1]]):
        return None
    second = amounts.amount(texts, first[1])
    same = second is not None and second[0].quantity.unit is first[0].quantity.unit
    return first[1] if same else None

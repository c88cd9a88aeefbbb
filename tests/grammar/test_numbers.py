"""Numbers and quantities as people say them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from grammar.amounts import AmountReader
from grammar.tokens import Tokenizer
from voxml.vocabulary import load_lexicon

CLOSED = load_lexicon().closed
AMOUNTS = AmountReader(CLOSED)
READER = AMOUNTS.numbers
TOKENIZE = Tokenizer(CLOSED)
ONES = [
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"),
    *("thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"),
]
TENS = ["twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"]


def words(value: int) -> str:
    """English for 0 to 999."""
    if value < 20:
        return ONES[value]
    if value < 100:
        return TENS[value // 10 - 2] + (f" {ONES[value % 10]}" if value % 10 else "")
    rest = value % 100
    return f"{ONES[value // 100]} hundred" + (f" and {words(rest)}" if rest else "")


def texts(text: str) -> list[str]:
    return [token.text for token in TOKENIZE(text)]


@given(st.integers(0, 999))
def test_every_number_below_a_thousand_is_read_from_its_words(value: int) -> None:
    said = words(value).split()
    assert READER.number(said, 0) == (value, len(said))


@given(st.integers(1, 9), st.integers(10, 99))
def test_hundreds_may_go_unsaid(hundreds: int, rest: int) -> None:
    said = f"{words(hundreds)} {words(rest)}".split()
    assert READER.number(said, 0) == (hundreds * 100 + rest, len(said))


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("a hundred and eighty", 180), ("one oh five", 105), ("three sixty", 360), ("point five", 0.5),
        ("one point two five", 1.25), ("three and a half", 3.5), ("half", 0.5), ("three quarters", 0.75), ("1/2", 0.5),
        ("2 1/2", 2.5), ("a couple of", 2), ("minus two", -2), ("45", 45), ("1.5", 1.5), ("two hundred seventy", 270),
    ],
)  # fmt: skip
def test_numbers(text: str, value: float) -> None:
    said = texts(text)
    assert READER.number(said, 0) == (value, len(said))


@pytest.mark.parametrize(
    ("text", "quantity"),
    [
        ("five feet", "1.524m"), ("3ft", "0.9144m"), ("half a meter", "0.5m"), ("a foot", "0.3048m"),
        ("two feet three inches", "0.6858m"), ("one and a half meters", "1.5m"), ("a foot and a half", "0.4572m"),
        ("two three feet", "0.9144m"), ("about ten feet", "3.048m"), ("90°", "90deg"), ("a quarter turn", "90deg"),
        ("half a turn", "180deg"), ("thirty seconds", "30s"), ("two minutes", "120s"), ("a couple of steps", "1.5m"),
    ],
)  # fmt: skip
def test_quantities_are_metres_degrees_and_seconds(text: str, quantity: str) -> None:
    said = texts(text)
    found = AMOUNTS.amount(said, 0)
    assert found is not None
    assert (str(found[0].quantity), found[1]) == (quantity, len(said))


@pytest.mark.parametrize("text", ["another two feet", "two more feet", "two feet more", "an additional two feet"])
def test_an_amount_that_adds_says_so(text: str) -> None:
    found = AMOUNTS.amount(texts(text), 0)
    assert found is not None
    assert found[0].more


def test_units_of_other_systems_are_not_added_up() -> None:
    found = AMOUNTS.amount(texts("a step two feet"), 0)
    assert found is not None
    assert found[1] == 2


@given(
    st.lists(
        st.sampled_from([*ONES, *TENS, "hundred", "a", "and", "half", "of", "point", "feet", "minus", "oh"]), max_size=8
    )
)
def test_any_words_are_read_without_error_and_within_bounds(said: list[str]) -> None:
    for at in range(len(said)):
        for found in (READER.number(said, at), AMOUNTS.amount(said, at), AMOUNTS.more(said, at)):
            assert found is None or at < found[1] <= len(said)

"""What Kirby does not understand: where it went wrong, what could have stood there, and what is nearest."""

from __future__ import annotations

import pytest

from grammar import NotUnderstood, parse

THING = "a thing or place"
TO_DO = "something to do"
AMOUNT = "an amount with its unit"

UNKNOWN = [
    ("go to the flurb", "flurb", THING, "go to the door"),
    ("find the dodecahedron", "dodecahedron", THING, "find the door"),
    ("go around the aardvark", "aardvark", THING, "go around the door"),
    ("go through the zorp on the left", "zorp", THING, "go through the door on the left"),
    ("go forward until you see a dragon", "dragon", THING, "go forward until you see a door"),
    ("back up until you hit the zebra", "zebra", THING, "back up until you hit the door"),
    ("take a picture of the waterfall", "waterfall", THING, "take a picture of the door"),
    ("how many unicorns do you see", "unicorns", THING, "how many doors do you see"),
    ("bring me a cappuccino", "cappuccino", THING, "bring me a door"),
    ("where is the submarine", "submarine", THING, "where is the door"),
    ("turn toward the volcano", "volcano", THING, "turn toward the door"),
    ("what is the meaning of life", "meaning", THING, None),
    ("stop the music", "music", THING, None),
    ("go to the third quux", "quux", TO_DO, "go to the third door"),
    ("frobnicate the door", "frobnicate", TO_DO, "find the door"),
    ("please levitate two meters", "levitate", TO_DO, None),
    ("turn left and yodel", "yodel", TO_DO, None),
    ("order a pizza", "order", TO_DO, None),
    ("go forward two parsecs", "parsecs", AMOUNT, "go forward two meters"),
    ("move three furlongs forward", "furlongs", AMOUNT, "move three meters forward"),
    ("the robot moved yesterday", "moved", TO_DO, None),
]


@pytest.mark.parametrize(("text", "strange", "expected", "nearest"), UNKNOWN, ids=[row[0] for row in UNKNOWN])
def test_a_refusal_says_where_what_and_what_instead(
    text: str, strange: str, expected: str, nearest: str | None
) -> None:
    refusal = parse(text)
    assert isinstance(refusal, NotUnderstood)
    assert text[slice(*refusal.span)] == strange
    assert expected in refusal.expected
    assert refusal.nearest == nearest


@pytest.mark.parametrize("text", ["turn the lights on", "go to the", "turn left until", "find the red"])
def test_what_breaks_off_is_told_at_its_end(text: str) -> None:
    refusal = parse(text)
    assert isinstance(refusal, NotUnderstood)
    assert refusal.span == (len(text), len(text))
    assert refusal.expected


def test_expectations_are_english() -> None:
    """Nothing of the machinery shows in what people are told."""
    for text, *_ in UNKNOWN:
        refusal = parse(text)
        assert isinstance(refusal, NotUnderstood)
        assert not any("_" in reason or reason.isupper() for reason in refusal.expected)

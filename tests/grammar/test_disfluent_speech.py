"""Fluent commands made disfluent at every place, in the ways Shriberg (1994) tells apart: they mean what they meant.

Every filled pause, repetition, broken-off word and restart that can be put into a command is tried. What comes of it
must be the form of the fluent command, or be asked back; never another form.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from grammar import parse

COMMANDS = (
    "turn left ninety degrees",
    "pivot to your right thirty five degrees",
    "rotate a hundred and twenty degrees to the left",
    "can you spin right two hundred and seventy degrees",
    "turn one eighty degrees to the right",
    "go forward ten feet",
    "please move straight ahead two and a half meters",
    "drive twenty two inches forward",
    "robot proceed forward half a meter",
    "could you back up three steps",
    "move backward another six yards",
    "face northeast",
    "turn to face the window",
    "make a sharp right turn",
    "turn around",
    "take a photo",
    "send me a picture",
    "go through the second doorway on your left",
    "walk to the end of the corridor",
    "okay drive around the wooden table",
    "approach the person near the stairs",
    "turn right then go forward four feet",
    "go forward one meter and take an image",
    "face south and then back up five feet",
)
NO_COMMANDS = (
    "how far did you turn left",
    "do not go forward",
    "the robot turned right before lunch",
    "what would happen if you went back",
    "i was going to say go left",
    "why are you moving forward",
    "my brother can drive two miles",
    "is the door on your left open",
)
HARMLESS = ("stop", "not(", "is(")
PAUSES = ("uh", "um", "er", "erm", "hmm", "ah", "uhhh")
EDITS = ("no", "sorry", "i mean", "no wait", "uh i mean")
CONNECTIVES = frozenset({"and", "then"})


def outcome(text: str) -> tuple[str, ...] | None:
    """The forms of an utterance that is acted on; None where it is asked back."""
    acts = parse(text)
    if not isinstance(acts, tuple) or any(act.repaired for act in acts):
        return None
    return tuple(str(act.form) for act in acts)


def with_pauses(words: list[str]) -> Iterator[list[str]]:
    for at in range(len(words) + 1):
        for pause in PAUSES:
            yield [*words[:at], pause, *words[at:]]


def with_repetitions(words: list[str]) -> Iterator[list[str]]:
    """One to three words again, with or without a pause before them."""
    for start in range(len(words)):
        for end in range(start + 1, min(start + 3, len(words)) + 1):
            if end == start + 1 or CONNECTIVES.isdisjoint(words[start:end]):
                yield [*words[:end], *words[start:]]
                yield [*words[:end], "uh", *words[start:]]


def with_fragments(words: list[str]) -> Iterator[list[str]]:
    """A word's beginning before it: as transcribed with and without a hyphen, and with a pause behind it."""
    for at, word in enumerate(words):
        for length in range(1, len(word)):
            for rest in ("", "-"):
                yield [*words[:at], word[:length] + rest, *words[at:]]
            yield [*words[:at], word[:length], "um", *words[at:]]


def with_restarts(words: list[str]) -> Iterator[list[str]]:
    """The first clause begun, given up anywhere, and begun again from its first word."""
    ends = (at for at, word in enumerate(words[1:], 1) if word in CONNECTIVES and words[at - 1] != "hundred")
    end = next(ends, len(words))
    for at in range(1, end):
        for between in ("", "um", *EDITS):
            yield [*words[:at], *between.split(), *words]


@pytest.mark.parametrize("disfluent", [with_pauses, with_repetitions, with_fragments, with_restarts])
@pytest.mark.parametrize("command", COMMANDS)
def test_a_disfluent_command_means_the_same_or_is_asked_back(
    command: str, disfluent: Callable[[list[str]], Iterator[list[str]]]
) -> None:
    meant = outcome(command)
    assert meant is not None
    said = [" ".join(words) for words in disfluent(command.split())]
    others = {text: found for text in said if (found := outcome(text)) not in (meant, None)}
    assert not others
    assert sum(outcome(text) == meant for text in said) >= 0.85 * len(said)


@pytest.mark.parametrize("disfluent", [with_pauses, with_repetitions, with_fragments, with_restarts])
@pytest.mark.parametrize("text", NO_COMMANDS)
def test_what_is_no_command_becomes_none_by_disfluency(
    text: str, disfluent: Callable[[list[str]], Iterator[list[str]]]
) -> None:
    for words in disfluent(text.split()):
        forms = outcome(" ".join(words)) or ()
        assert all(form.startswith(HARMLESS) for form in forms), words

"""Typed lines -> events: plain text is said; lines with a slash stand in for hands."""

from __future__ import annotations

import math
from dataclasses import dataclass

from dialogue.events import Gesture, GestureKind, PointedObject, PointedPlace, Pointing, Utterance
from robot.geometry import Point
from robot.messages import COORDINATE_MAX_M

HELP = """\
Say what Kirby should do: go forward two meters, turn left, go to the first fiducial on the right, stop, ...
  /point X Y      point at a place on the map      /point ID      point at a fiducial or an object
  /gesture NAME   thumbs up, open palm, ...        /quit          leave (so does Ctrl-D)"""


@dataclass(frozen=True, slots=True)
class BadLine:
    """A slash line that is no command; ``reason`` says what to type instead."""

    reason: str


@dataclass(frozen=True, slots=True)
class Help:
    """The person asked what can be typed."""


@dataclass(frozen=True, slots=True)
class Quit:
    """The person wants to leave."""


Line = Utterance | Pointing | Gesture | BadLine | Help | Quit


def read_line(text: str, time_s: float) -> Line | None:
    """What a line stands for; None for an empty one."""
    text = text.strip()
    if not text:
        return None
    if not text.startswith("/"):
        return Utterance(text, time_s)
    command, _, rest = text[1:].partition(" ")
    match command.lower():
        case "point":
            return _pointing(rest.split(), time_s)
        case "gesture":
            return _gesture(" ".join(rest.lower().split()), time_s)
        case "help":
            return Help()
        case "quit" | "exit":
            return Quit()
    return BadLine(f"there is no /{command}: type /point X Y, /point ID, /gesture NAME, /help or /quit")


def _pointing(words: list[str], time_s: float) -> Pointing | BadLine:
    if len(words) == 1:
        return Pointing(PointedObject(words[0]), time_s)
    try:
        x_m, y_m = map(float, words)
    except ValueError:
        return BadLine("/point takes a place or a thing: /point 1.5 -0.5, or /point 3")
    if not (math.isfinite(x_m) and math.isfinite(y_m) and max(abs(x_m), abs(y_m)) <= COORDINATE_MAX_M):
        return BadLine(f"/point takes metres on the map, at most {COORDINATE_MAX_M:g} either way")
    return Pointing(PointedPlace(Point(x_m, y_m)), time_s)


def _gesture(name: str, time_s: float) -> Gesture | BadLine:
    try:
        return Gesture(GestureKind(name), time_s)
    except ValueError:
        known = ", ".join(kind.value for kind in GestureKind)
        return BadLine(f"/gesture takes one of: {known}")

"""What a typed line stands for."""

import pytest

from dialogue.events import Gesture, GestureKind, PointedObject, PointedPlace, Pointing, Utterance
from kirby.lines import BadLine, Help, Quit, read_line
from robot.geometry import Point


def test_plain_text_is_said():
    assert read_line("  go forward ", 3.0) == Utterance("go forward", 3.0)


@pytest.mark.parametrize("text", ["", "   ", "\n"])
def test_an_empty_line_is_nothing(text):
    assert read_line(text, 0.0) is None


def test_pointing_at_a_place_and_at_a_thing():
    assert read_line("/point 1.5 -0.5", 1.0) == Pointing(PointedPlace(Point(1.5, -0.5)), 1.0)
    assert read_line("/point 3", 1.0) == Pointing(PointedObject("3"), 1.0)


def test_gestures_go_by_their_names():
    assert read_line("/gesture  Thumbs   up", 1.0) == Gesture(GestureKind.THUMBS_UP, 1.0)


def test_help_and_leaving():
    assert read_line("/help", 0.0) == Help()
    assert read_line("/quit", 0.0) == read_line("/exit", 0.0) == Quit()


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        ("/point", "/point 1.5 -0.5"),
        ("/point a b", "/point 1.5 -0.5"),
        ("/point 1 2 3", "/point 1.5 -0.5"),
        ("/point nan 1", "metres on the map"),
        ("/point 1e9 1", "metres on the map"),
        ("/gesture wave", "thumbs up"),
        ("/jump", "/gesture NAME"),
    ],
)
def test_a_bad_line_says_what_to_type(text, advice):
    line = read_line(text, 0.0)
    assert isinstance(line, BadLine)
    assert advice in line.reason

"""Every question that Kirby or the robot asks, against every way to answer it."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from talk import BLOCKS, Talk

from dialogue import State
from dialogue.events import Gesture, GestureKind, RobotFeedback, Say
from grounding import StandsFor
from robot.messages import FeedbackCode, feedback

NAMED = StandsFor("1", "block", ("red",), ("rosie",))
RED, BLUE = ["go to 1.65 -1"], ["go to 2.65 1"]


def which() -> Talk:
    talk = Talk(BLOCKS.taught(NAMED))
    assert talk.say("go(to(the(block)))") == []
    return talk


def where() -> Talk:
    talk = Talk()
    assert talk.say("go(to(there))") == []
    return talk


def side() -> Talk:
    talk = Talk()
    assert talk.say("turn(45deg)") == []
    return talk


def sure() -> Talk:
    talk = Talk()
    assert talk.say("~turn(left)") == []
    return talk


def strayed() -> Talk:
    talk = Talk()
    talk.say("go(forward)")
    talk.robot(FeedbackCode.HELP, "k1")
    return talk


def left_over() -> Talk:
    talk = Talk()
    talk.handle(RobotFeedback(feedback(FeedbackCode.PAUSED), 0.0))
    talk.robot(FeedbackCode.QUEUE, "k1")
    return talk


Ask = Callable[[], Talk]
ASKED: tuple[tuple[Ask, State], ...] = (
    (which, State.AWAITING_REFERENT),
    (where, State.AWAITING_PLACE),
    (side, State.AWAITING_SIDE),
    (sure, State.AWAITING_CONFIRMATION),
    (strayed, State.AWAITING_CHOICE),
    (left_over, State.AWAITING_RECOVERY),
)


@pytest.mark.parametrize(("ask", "state"), ASKED, ids=lambda value: getattr(value, "__name__", ""))
def test_it_is_asked(ask: Ask, state: State) -> None:
    assert ask().state is state


@pytest.mark.parametrize(
    ("ask", "answer", "commands"),
    [
        # by a description or a word
        (which, "?the(red(one))", RED),
        (which, "?left", BLUE),
        (where, "?the(red(block))", RED),
        (where, "?to(the(red(block)))", RED),
        (side, "?right", ["turn right 45"]),
        (strayed, "?keep_going", ["keep going"]),
        (strayed, "go_back", ["go back"]),
        (left_over, "continue", ["continue"]),
        (left_over, "cancel", ["cancel"]),
        # by an ordinal or a number
        (which, "?the(second(one))", BLUE),
        (which, "?2", BLUE),
        (which, "?the(last(one))", BLUE),
        (side, "?the(second(one))", ["turn right 45"]),
        (strayed, "?the(first(one))", ["keep going"]),
        (strayed, "?2", ["go back"]),
        (left_over, "?the(last(one))", ["go back"]),
        # by a name
        (which, '?"rosie"', RED),
        (where, "?north", []),
        # any of them, or none
        (which, "?any", RED),
        (side, "?any", ["turn left 45"]),
        (which, "?neither", []),
        # yes and no
        (sure, "yes", ["turn left 90"]),
        (strayed, "yes", ["keep going"]),
        (left_over, "yes", ["continue"]),
        (strayed, "no", ["go back"]),
        (left_over, "no", ["cancel all"]),
        (which, "no", []),
        (where, "no", []),
        (side, "no", []),
        (sure, "no", []),
    ],
)
def test_answered_in_words(ask: Ask, answer: str, commands: list[str]) -> None:
    assert ask().say(answer) == commands


@pytest.mark.parametrize(
    ("ask", "kind", "commands"),
    [
        (which, GestureKind.THUMBS_UP, []),
        (where, GestureKind.THUMBS_UP, []),
        (side, GestureKind.THUMBS_UP, []),
        (sure, GestureKind.THUMBS_UP, ["turn left 90"]),
        (strayed, GestureKind.THUMBS_UP, ["keep going"]),
        (left_over, GestureKind.THUMBS_UP, ["continue"]),
        (which, GestureKind.THUMBS_DOWN, []),
        (where, GestureKind.THUMBS_DOWN, []),
        (side, GestureKind.THUMBS_DOWN, []),
        (sure, GestureKind.THUMBS_DOWN, []),
        (strayed, GestureKind.THUMBS_DOWN, ["go back"]),
        (left_over, GestureKind.THUMBS_DOWN, ["cancel all"]),
        (side, GestureKind.SERVO_RIGHT, ["turn right 45"]),
    ],
)
def test_answered_with_a_gesture(ask: Ask, kind: GestureKind, commands: list[str]) -> None:
    assert ask().gesture(kind) == commands


@pytest.mark.parametrize(
    ("ask", "place", "commands"),
    [
        (which, (3.0, 1.0), BLUE),
        (where, (1.0, 2.0), ["go to 1 2"]),
        (side, (1.0, -2.0), ["turn right 45"]),
        (sure, (1.0, 2.0), []),
        (strayed, (1.0, 2.0), []),
        (left_over, (1.0, 2.0), []),
    ],
)
def test_answered_by_pointing(ask: Ask, place: tuple[float, float], commands: list[str]) -> None:
    assert ask().point(*place) == commands


@pytest.mark.parametrize("ask", [which, where, side, sure])
@pytest.mark.parametrize("kind", [GestureKind.THUMBS_DOWN])
def test_what_is_declined_is_let_go(ask: Ask, kind: GestureKind) -> None:
    talk = ask()
    outputs = talk.handle(Gesture(kind, talk.time_s))
    assert outputs == (Say("Okay, I won't."),)
    assert talk.state is State.IDLE


@pytest.mark.parametrize(("ask", "state"), ASKED, ids=lambda value: getattr(value, "__name__", ""))
def test_a_new_command_is_always_allowed(ask: Ask, state: State) -> None:
    talk = ask()
    talk.say("turn(right)")
    # What is left over from before must be dropped first: that is offered.
    assert talk.state is (State.AWAITING_CONFIRMATION if state is State.AWAITING_RECOVERY else State.EXECUTING)


def test_point_and_thumbs_up_goes_there_even_where_the_robot_asks() -> None:
    talk = strayed()
    talk.point(1.0, 2.0)
    assert talk.gesture(GestureKind.THUMBS_UP) == ["go to 1 2"]


@pytest.mark.parametrize("reply", ["~yes", "~no"])
def test_a_nod_that_was_hardly_heard_moves_nothing(reply: str) -> None:
    talk = strayed()
    assert talk.say(reply.removeprefix("~"), confidence=0.3) == []
    assert talk.state is State.AWAITING_CONFIRMATION

"""Conversations in plain words, by what is sent: stops and their place, corrections, once more, names and routines."""

from __future__ import annotations

import pytest

from dialogue.events import CameraMove, Dispatch, Gesture, GestureKind, MoveCamera, Output, Say
from grounding import World
from kirby.agent import Agent
from kirby.worlds import find_world
from robot.geometry import Point
from robot.messages import FeedbackCode, encode_command, feedback

RED, BLUE = ["go to 2.06 -0.48", "turn right 13"], ["go to 2.26 0.55", "turn left 13"]


class Talk:
    """A conversation in a known world; the robot never answers but when it is told to."""

    def __init__(self, *lines: str) -> None:
        self.agent = Agent(World.explored(find_world("five_things")), clock=lambda: 0.0)
        for line in lines:
            self.say(line)

    def say(self, text: str) -> list[str]:
        return sent(self.agent.hear(text))

    def reply(self, text: str) -> str:
        return " ".join(output.text for output in self.agent.hear(text) if isinstance(output, Say))

    def gesture(self, kind: GestureKind | str) -> list[str]:
        return sent(self.agent.gesture(kind))


def sent(outputs: tuple[Output, ...]) -> list[str]:
    return [encode_command(c) for output in outputs if isinstance(output, Dispatch) for c in output.commands]


# ------------------------------------------------------------------ stops
@pytest.mark.parametrize(
    ("text", "commands"),
    [
        ("go forward and stop", ["go forward 1"]),
        ("turn left, go forward two meters and then stop", ["turn left 90", "go forward 2"]),
        ("go forward, stop, turn left", ["go forward 1", "turn left 90"]),
        ("go forward stop", ["stop"]),
        ("turn left. Stop!", ["stop"]),
        ("stop and turn left", ["stop", "turn left 90"]),
    ],
)
def test_a_stop_that_ends_an_instruction_does_not_halt_it(text: str, commands: list[str]) -> None:
    assert Talk().say(text) == commands


def test_stop_and_something_else_drops_what_was_done() -> None:
    assert Talk("go forward").say("stop and turn left") == ["stop", "cancel all", "turn left 90"]


@pytest.mark.parametrize("text", ["stop", "don't turn left", "go back, stop, turn right"])
def test_what_may_mean_stop_stops_a_robot_that_moves(text: str) -> None:
    assert Talk("turn left").say(text)[0] == "stop"


def test_calling_off_is_done_whatever_becomes_of_the_rest() -> None:
    assert Talk("turn left").say("never mind, go to the piano") == ["cancel"]


def test_never_mind_takes_back_what_kirby_asks() -> None:
    talk = Talk("go to the block")
    assert talk.reply("never mind") == "Okay, I won't."
    assert not talk.agent.asking


# ------------------------------------------------------------------ corrections
@pytest.mark.parametrize(
    ("before", "text", "commands"),
    [
        (["turn left"], "no, right", ["cancel all", "turn right 90"]),
        (["go to the red block"], "no, the other one", ["cancel all", *BLUE]),
        (["go forward two meters", "turn left"], "no, right", ["cancel command k2", "turn right 90"]),
        (["go to the red block", "turn around"], "no, the blue one", ["cancel all", *BLUE, "turn left 180"]),
        (["go forward", "go to the red block", "turn around"], "no, the blue one",
         ["cancel command k4", "cancel command k3", "cancel command k2", *BLUE, "turn left 180"]),
        (["turn left", "no, right"], "no, left", ["cancel all", "turn left 90"]),
        (["go to the block"], "no, the wastebasket", ["go to 2.76 -0.67", "turn right 13"]),
        ([], "no, left", ["stop"]),
    ],
)  # fmt: skip
def test_only_what_was_wrong_is_cancelled(before: list[str], text: str, commands: list[str]) -> None:
    assert Talk(*before).say(text) == commands


def test_an_offer_that_was_declined_is_no_instruction_to_repeat() -> None:
    talk = Talk("go forward")
    talk.agent.feedback(feedback(FeedbackCode.PAUSED, id="k9"))
    talk.say("turn left")
    talk.say("no")
    assert talk.reply("again") == "I am paused on 'go forward 1 meter'. Shall I drop it and go forward 1 meter?"


# ------------------------------------------------------------------ once more, and back
@pytest.mark.parametrize(
    ("before", "text", "commands"),
    [
        (["go forward two meters, then turn left"], "do that again", ["go forward 2", "turn left 90"]),
        (["go forward two meters, then turn left"], "do that twice", ["go forward 2", "turn left 90"] * 2),
        (["turn left"], "turn the other way", ["turn right 90"]),
        (["take a picture"], "another one", ["take picture"]),
        (["go forward five feet"], "three more", ["go forward 0.9144"]),
        (["go forward fifty centimeters"], "thirty more", ["go forward 0.3"]),
        (["go to the red block"], "and back again", ["go to 0 0"]),
        ([], "go to the red block and back again", [*RED, "go to 0 0"]),
        ([], "go forward and then go back", ["go forward 1", "go to 0 0"]),
        (["go forward"], "go back", ["go back"]),
    ],
)
def test_once_more_and_back(before: list[str], text: str, commands: list[str]) -> None:
    assert Talk(*before).say(text) == commands


def test_going_back_goes_where_the_whole_instruction_began() -> None:
    """The robot's own command knows where its last movement began: here the turn at the end."""
    talk = Talk("go to the red block")
    talk.agent.feedback(feedback(FeedbackCode.SUCCESS_GO_TO, at=Point(2.06, -0.48), id="k1"))
    assert talk.say("go back") == ["cancel all", "go to 0 0"]


# ------------------------------------------------------------------ names and routines
def test_names_are_used_like_any_other_description() -> None:
    talk = Talk("fiducial one is Rosie")
    assert talk.say("go to Rosie") == RED
    assert talk.reply("where is Rosie").startswith("Rosie is")
    talk.agent.point("2")
    assert talk.reply("call this one Bob") == "The blue block is Bob from now on."
    assert talk.say("face Bob")


def test_a_name_is_given_to_what_is_pointed_at_when_kirby_asks() -> None:
    talk = Talk("call this one Rosie")
    talk.agent.point("1")
    assert talk.say("go to Rosie") == RED


def test_a_routine_is_taught_done_shown_and_forgotten() -> None:
    hook = ["go forward 1", "turn right 90", "go forward 2"]
    talk = Talk("learn the hook: go forward 1m, turn right, then go forward 2m")
    assert talk.say("do the hook twice") == [*hook, *hook]
    assert talk.gesture("hook") == hook
    assert talk.reply("forget the hook") == "I have forgotten the hook."
    assert talk.gesture("hook") == []


def test_a_routine_goes_back_to_where_it_began() -> None:
    talk = Talk("learn the errand: go forward two meters, then go back")
    assert talk.say("turn left") == ["turn left 90"]
    assert talk.say("do the errand") == ["go forward 2", "go to 0 0"]


# ------------------------------------------------------------------ hands
def test_a_servo_nudges_what_was_moved_last() -> None:
    talk = Talk()
    assert talk.gesture(GestureKind.SERVO_LEFT) == ["turn left 15"]
    assert talk.agent.gesture(GestureKind.PUSH_LEFT) == (MoveCamera(CameraMove.SWITCH_LEFT),)
    assert talk.agent.gesture(GestureKind.SERVO_LEFT) == (MoveCamera(CameraMove.ROTATE_LEFT),)
    talk.say("go forward")
    assert talk.gesture(GestureKind.SERVO_RIGHT) == ["turn right 15"]


def test_a_servo_at_the_view_turns_the_view() -> None:
    outputs = Talk().agent.handle(Gesture(GestureKind.SERVO_LEFT, 0.0, at_view=True))
    assert outputs == (MoveCamera(CameraMove.ROTATE_LEFT),)


# ------------------------------------------------------------------ the common ground, asked after
@pytest.mark.parametrize(
    ("before", "text", "reply"),
    [
        (["go to the red block"], "what did you understand",
         "I understood: go to the red block. That came to: go to (2.06, -0.48) and turn right 13 degrees."),
        (["go forward", "turn left"], "what are you doing",
         "I am doing 'go forward 1 meter', then 'turn left 90 degrees'."),
        (["go to the block"], "why", "Because what you said fits each of them."),
        (["turn 45 degrees"], "why", "Because you did not say which way."),
        (["go to the piano"], "why", "I don't see a piano."),
        (["turn left"], "why", "Because you told me to turn left 90 degrees."),
        (["go to the first block on the right"], "whose right", "I take 'right' to be my own, as I face."),
        (["go to the block left of the wastebasket"], "which left do you mean",
         "I take 'left of the wastebasket' to be as I see it when I look at it."),
        ([], "are you able to fly", "No: I can't fly: that takes wings."),
        ([], "can you reach the red block", "Yes."),
    ],
)  # fmt: skip
def test_kirby_tells_what_it_made_of_it(before: list[str], text: str, reply: str) -> None:
    assert Talk(*before).reply(text) == reply

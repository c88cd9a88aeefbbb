"""`cancel command ID`: one command of several is dropped, and what comes after it is reckoned anew."""

import pytest

from robot.geometry import ORIGIN, Pose
from robot.messages import CancelCommand, Envelope, Malformed, decode_command, encode_command
from robot.queue import IDLE, Here, Mode, Received, Tell, handle


class Queue:
    def __init__(self, *texts):
        self.state, self.entry = IDLE, 0
        for number, text in enumerate(texts):
            self.send(text, f"k{number}")

    def send(self, text, id):
        self.entry += 1
        event = Received(self.entry, Envelope(decode_command(text), id))
        self.state, effects = handle(self.state, event, Here(Pose(0.4, 0.0, 0.0) if self.entry > 3 else ORIGIN))
        return [(e.feedback.code.value, e.feedback.id) for e in effects if isinstance(e, Tell)]


def test_one_that_waits_goes_and_those_after_it_are_reckoned_anew():
    queue = Queue("go forward 1", "go forward 2", "go forward 3")
    assert queue.send("cancel command k1", "c") == [("CANCELLED_GOAL", "k1"), ("CANCELLED_GOAL", "c")]
    assert [goal.id for goal in queue.state.goals] == ["k0", "k2"]
    assert queue.state.goals[1].end.x_m == pytest.approx(4.0)
    assert queue.state.mode is Mode.MOVING


def test_the_one_being_done_goes_as_with_cancel():
    queue = Queue("go forward 1", "go forward 2", "go forward 3")
    told = queue.send("cancel command k0", "c")
    assert told == [("CANCELLED_GOAL", "k0"), ("CANCELLED_GOAL", "c"), ("FORWARD", "k1")]
    assert queue.state.goals[0].end.x_m == pytest.approx(2.4)  # from where the robot really is


def test_one_that_is_not_there_changes_nothing():
    queue = Queue("go forward 1", "go forward 2")
    before = queue.state
    assert queue.send("cancel command k9", "c") == [("INVALID", "c")]
    assert queue.state == before


def test_on_the_wire():
    assert decode_command("cancel command k-1") == CancelCommand("k-1")
    assert encode_command(CancelCommand("k-1")) == "cancel command k-1"
    for text in ("cancel command", "cancel command a b", "cancel command " + "x" * 65):
        with pytest.raises(Malformed, match="cancel command ID"):
            decode_command(text)

"""What is done when something has happened: ends, conditions, searches and waits."""

from __future__ import annotations

import pytest
from talk import BLOCKS, Talk, sent

from dialogue import State
from dialogue.events import RobotFeedback, Say, Tick, Utterance, WorldUpdate
from grounding import World
from robot.geometry import ORIGIN, Point, Segment
from robot.messages import FeedbackCode, Fiducial, Fiducials, Odom, feedback

WALL = Segment(Point(3.4, -1.0), Point(3.4, 1.0))
GREEN = Fiducial("7", (2.0, 0.0, 0.1), (0.0, 0.0, 3.141593))


def see(talk: Talk, *markers: Fiducial) -> list[str]:
    """Two blocks are seen already; what else is."""
    known = tuple(
        Fiducial(e.id, (e.pose.x_m, e.pose.y_m, 0.1), (0.0, 0.0, e.pose.yaw_rad)) for e in BLOCKS.entities.items
    )
    return sent(talk.handle(WorldUpdate(talk.time_s, fiducials=Fiducials((*known, *markers)))))


def be_at(talk: Talk, x_m: float, y_m: float) -> list[str]:
    odom = Odom(1, 1, (x_m, y_m, 0.0), (0.0, 0.0, 0.0), 0.0, 0.0, 0.0)
    return sent(talk.handle(WorldUpdate(talk.time_s, odom=odom)))


def test_until_something_new_is_seen() -> None:
    talk = Talk()
    assert talk.say("until(see(a(fiducial)),patrol)") == ["patrol 16 1.5 1"]
    assert see(talk) == []
    assert see(talk, GREEN) == ["stop patrol"]


def test_a_movement_without_an_amount_goes_as_far_as_the_map_lets_it() -> None:
    talk = Talk(World(ORIGIN, walls=(WALL,)))
    assert talk.say("until(see(a(fiducial)),go(forward))") == ["go forward 3"]
    assert see(talk, GREEN)[0] == "cancel"


def test_what_comes_after_the_end_is_done_from_where_the_robot_is() -> None:
    talk = Talk()
    talk.say("seq(until(see(the(fiducial,number(7))),patrol),go(to(the(fiducial,number(7)))))")
    assert see(talk, GREEN) == ["stop patrol", "go to 1.65 0"]


def test_when_waits_without_moving() -> None:
    talk = Talk()
    assert talk.say("when(reach(the(red(block))),turn(left))") == []
    assert be_at(talk, 0.5, 0.0) == []
    assert be_at(talk, 1.6, -1.0) == ["turn left 90"]
    assert be_at(talk, 1.6, -1.0) == []


@pytest.mark.parametrize(
    ("form", "commands"),
    [
        ("if(see(a(block)),turn(left))", ["turn left 90"]),
        ("if(exists(a(chair)),turn(left))", []),
        ("if(exists(a(chair)),turn(left),turn(right))", ["turn right 90"]),
        ("if(not(exists(a(chair))),turn(left))", ["turn left 90"]),
        ("if(face(east),turn(left))", ["turn left 90"]),
        ("if(face(north),turn(left))", []),
    ],
)
def test_if_is_settled_at_once(form: str, commands: list[str]) -> None:
    assert Talk().say(form) == commands


def test_what_is_known_is_found_by_going_there() -> None:
    assert Talk().say("find(the(red(block)))") == ["go to 1.65 -1"]


def test_what_is_not_known_is_found_by_patrolling_until_it_is_seen() -> None:
    talk = Talk()
    assert talk.say("find(the(fiducial,number(7)))") == ["patrol 16 1.5 1"]
    assert see(talk, GREEN) == ["stop patrol", "go to 1.65 0"]


def test_what_is_not_found_is_said() -> None:
    talk = Talk()
    talk.say("find(the(fiducial,number(7)))")
    assert talk.robot(FeedbackCode.FINISH_PATROL, "k1") == [
        "no more explorable waypoints",
        "I did not find fiducial 7.",
    ]
    assert see(talk, GREEN) == []


def test_waiting_begins_when_the_robot_has_ended() -> None:
    talk = Talk()
    assert talk.say("seq(go(forward),wait(5s),turn(left))") == ["go forward 1"]
    manager = talk.manager
    assert sent(manager.handle(Tick(100.0))) == []
    manager.handle(RobotFeedback(feedback(FeedbackCode.SUCCESS_FORWARD, at=Point(1.0, 0.0), id="k1"), 101.0))
    assert sent(manager.handle(Tick(105.0))) == []
    assert sent(manager.handle(Tick(106.0))) == ["turn left 90"]


def test_a_new_movement_drops_what_was_left() -> None:
    talk = Talk()
    talk.say("when(reach(the(red(block))),turn(left))")
    talk.say("go(forward)")
    assert be_at(talk, 1.6, -1.0) == []


def test_nothing_begins_while_a_question_is_open() -> None:
    talk = Talk()
    talk.say("when(reach(the(red(block))),turn(left))")
    talk.say("go(to(the(block)))")
    assert talk.state is State.AWAITING_REFERENT
    assert be_at(talk, 1.6, -1.0) == []
    assert talk.say("no") == ["turn left 90"]


def test_a_stop_ends_what_waits_to_begin() -> None:
    talk = Talk()
    talk.say("seq(wait(5s),turn(left))")
    assert talk.say("stop") == ["stop"]
    assert sent(talk.manager.handle(Tick(100.0))) == []


def test_nothing_begins_between_a_stop_and_its_pause() -> None:
    talk = Talk()
    talk.say("until(see(the(fiducial,number(7))),patrol)")
    talk.say("stop")
    assert see(talk, GREEN) == []
    talk.robot(FeedbackCode.PAUSED, "k2")
    talk.say("continue")
    going_on = RobotFeedback(feedback(FeedbackCode.RESTARTING, id="k3"), talk.time_s)
    assert sent(talk.handle(going_on)) == ["stop patrol"]


def test_a_condition_that_cannot_be_told_is_refused() -> None:
    outputs = Talk().handle(Utterance("until(open(the(door)),go(forward))", 0.0))
    assert [type(output) for output in outputs] == [Say]


def test_all_of_them_are_visited_in_a_short_order() -> None:
    commands = Talk().say("visit(all(block))")
    assert [command for command in commands if command.startswith("go to")] == ["go to 1.65 -1", "go to 2.65 1"]

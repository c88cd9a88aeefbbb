"""The dialogue manager, step by step. What is said is written as forms, so that no grammar is needed here."""

from __future__ import annotations

import json

import pytest
from talk import BLOCKS, Talk, parse, sent

from dialogue import Activity, DialogueManager, Session, State
from dialogue.codec import UnreadableError, from_data, to_data
from dialogue.events import (
    CameraMove,
    Event,
    Gesture,
    GestureKind,
    Highlight,
    MoveCamera,
    PointedPlace,
    Pointing,
    RobotFeedback,
    Say,
    Tone,
    Utterance,
    WorldUpdate,
)
from robot.geometry import Point
from robot.messages import FeedbackCode, Odom, feedback
from voxml.vocabulary import load_lexicon

Code = FeedbackCode


@pytest.mark.parametrize(
    ("form", "commands"),
    [
        ("go(forward)", ["go forward 1"]),
        ("go(back,2m)", ["go forward -2"]),
        ("go(north,2m)", ["turn left 90", "go forward 2"]),
        ("turn(left)", ["turn left 90"]),
        ("turn(right,45deg)", ["turn right 45"]),
        ("turn(180deg)", ["turn left 180"]),
        ("turn_around", ["turn left 180"]),
        ("face(south)", ["turn right 90"]),
        ("face(east)", []),
        ("patrol", ["patrol 16 1.5 1"]),
        ("patrol(8,2m,0.5m)", ["patrol 8 2 0.5"]),
        ("stop", ["stop"]),
        ("go_back", ["go back"]),
        ("keep_going", ["keep going"]),
        ("take_picture", ["take picture"]),
        ("go(to(point(2m,3m)))", ["go to 2 3"]),
        ("go(to(the(red(block))))", ["go to 1.65 -1"]),
        ("go(behind(the(red(block))))", ["go to 2.55 -1"]),
        ("go(in_front_of(the(red(block))))", ["go to 1.45 -1"]),
        ("go(between(the(red(block)),the(blue(block))))", ["go to 2.5 0"]),
        ("go(north_of(the(blue(block))))", ["go to 3 1.55"]),
        ("go(past(the(blue(block))))", ["go to 3.522 1.174"]),
        ("approach(the(blue(block)))", ["go to 2.65 1"]),
        ("seq(turn(left),face(north))", ["turn left 90"]),
        ("seq(turn_around,go(forward))", ["turn left 180", "go forward 1"]),
        ("repeat(2,turn(left))", ["turn left 90", "turn left 90"]),
        ("go(forward) & turn(left)", ["go forward 1", "turn left 90"]),
    ],
)
def test_programs_become_commands_by_their_bodies(form: str, commands: list[str]) -> None:
    assert Talk().say(form) == commands


@pytest.mark.parametrize(
    "form", ["go(forward,1000m)", "dance", "go(to(the(chair)))", "seq(go(forward),dance)", "go(forward) & dance"]
)
def test_what_cannot_be_done_moves_nothing_and_is_said(form: str) -> None:
    talk = Talk()
    outputs = talk.handle(Utterance(form, 0.0))
    assert not sent(outputs)
    assert [output.tone for output in outputs if isinstance(output, Say)] == [Tone.REFUSAL]
    assert talk.state is State.IDLE


def test_a_program_that_repeats_too_often_is_refused() -> None:
    assert Talk().say("repeat(1000000,turn(left))") == []


def test_what_is_meant_is_shown() -> None:
    assert Highlight(("1",), ()) in Talk().handle(Utterance("go(to(the(red(block))))", 0.0))


def test_plans_follow_the_robots_ideal_pose() -> None:
    talk = Talk()
    assert talk.say("turn(left)") == ["turn left 90"]
    assert talk.say("face(north)") == []


def test_once_the_robot_is_elsewhere_plans_start_from_there() -> None:
    talk = Talk()
    talk.say("turn(left)")
    talk.robot(Code.CANCELLED_GOAL, "k1")
    talk.handle(WorldUpdate(5.0, odom=Odom(1, 1, (0.0, 0.0, 0.0), (0.0, 0.0, 0.7854), 0.0, 0.0, 5.0)))
    assert talk.say("face(north)") == ["turn left 45"]


# ------------------------------------------------------------------ nothing moves by guess
def test_a_repaired_reading_is_confirmed_before_anything_moves() -> None:
    talk = Talk()
    assert talk.say("~turn(left)") == []
    assert talk.state is State.AWAITING_CONFIRMATION
    assert talk.say("yes") == ["turn left 90"]


def test_a_repaired_reading_that_is_denied_is_dropped() -> None:
    talk = Talk()
    talk.say("~turn(left)")
    assert talk.say("no") == []
    assert talk.state is State.IDLE


def test_what_was_hardly_heard_is_confirmed() -> None:
    talk = Talk()
    assert talk.say("turn(left)", confidence=0.3) == []
    assert talk.gesture(GestureKind.THUMBS_UP) == ["turn left 90"]


@pytest.mark.parametrize("text", ["stop", "~stop", "seq(stop,dance)"])
def test_stop_acts_at_once(text: str) -> None:
    talk = Talk()
    talk.say("~turn(left)")
    assert talk.say(text, confidence=0.1)[:1] == ["stop"]


def test_what_is_not_understood_is_said_with_what_was_expected() -> None:
    outputs = Talk().handle(Utterance("blorp", 0.0))
    assert outputs == (Say("I didn't understand 'blorp': I expected go or turn.", Tone.REFUSAL),)


# ------------------------------------------------------------------ pointing
def test_pointing_before_or_after_the_word() -> None:
    before, after = Talk(), Talk()
    before.point(1.0, 2.0)
    assert before.say("go(to(there))") == ["go to 1 2"]
    assert after.say("go(to(there))") == []
    assert after.point(1.0, 2.0) == ["go to 1 2"]


def test_two_pointings_in_one_sentence_go_to_their_words_in_order() -> None:
    talk = Talk()
    talk.point(1.0, 2.0)
    talk.point(3.0, 4.0)
    assert talk.say("seq(go(to(there)),go(to(there)))") == ["go to 1 2", "go to 3 4"]


def test_a_pointing_is_used_once() -> None:
    talk = Talk()
    talk.point(1.0, 2.0)
    talk.say("go(to(there))")
    assert talk.say("go(to(there))") == []
    assert talk.state is State.AWAITING_PLACE


def test_a_missing_pointing_is_asked_for_and_the_rest_is_kept() -> None:
    talk = Talk()
    talk.point(1.0, 2.0)
    assert talk.say("seq(go(to(there)),turn(left),go(to(there)))") == []
    assert talk.point(3.0, 4.0) == ["go to 1 2", "turn left 90", "go to 3 4"]


# ------------------------------------------------------------------ questions
@pytest.mark.parametrize("answer", ["?the(red(one))", "?the(first(one))", "?1", '?entity("1")', "?the(one,on(right))"])
def test_which_one_is_answered_by_description_or_order(answer: str) -> None:
    talk = Talk()
    assert talk.say("go(to(the(block)))") == []
    assert talk.say(answer) == ["go to 1.65 -1"]


def test_an_answer_that_fits_none_is_asked_again_and_let_go_in_the_end() -> None:
    talk = Talk()
    talk.say("go(to(the(block)))")
    for state in (State.AWAITING_REFERENT, State.AWAITING_REFERENT, State.IDLE):
        assert talk.say("?the(green(one))") == []
        assert talk.state is state


def test_a_side_is_asked_for() -> None:
    talk = Talk()
    assert talk.say("turn(45deg)") == []
    assert talk.say("?left") == ["turn left 45"]


def test_a_question_over_a_moving_robot_ends_where_the_robot_is() -> None:
    talk = Talk()
    talk.say("go(forward)")
    talk.say("go(to(the(block)))")
    talk.robot(Code.SUCCESS_FORWARD, "k1", Point(1.0, 0.0))
    assert talk.state is State.AWAITING_REFERENT
    talk.say("no")
    assert talk.state is State.IDLE


# ------------------------------------------------------------------ the robot's news
def test_success_is_told_in_the_papers_words() -> None:
    talk = Talk()
    talk.say("go(to(point(2m,3m)))")
    assert talk.robot(Code.GO_TO, "k1", Point(2.0, 3.0)) == ["looking for path to (2, 3)"]
    assert talk.robot(Code.SUCCESS_GO_TO, "k1", Point(2.0, 3.0)) == ["successfully navigated to (2, 3)"]
    assert talk.state is State.IDLE


def test_a_stray_robot_overrides_any_question() -> None:
    talk = Talk()
    talk.say("go(forward)")
    talk.say("go(to(the(block)))")
    talk.robot(Code.STRAYED, "k1")
    assert talk.robot(Code.HELP, "k1") == ["user input is required: keep going OR go back. Shall I keep going?"]
    assert (talk.state, talk.manager.session.question) == (State.AWAITING_CHOICE, None)


@pytest.mark.parametrize(
    ("answer", "command"),
    [("keep_going", "keep going"), ("go_back", "go back"), ("turn(left)", "turn left 90"), ("yes", "keep going"),
     ("no", "go back")],
)  # fmt: skip
def test_every_answer_to_help_works(answer: str, command: str) -> None:
    talk = Talk()
    talk.say("go(forward)")
    talk.robot(Code.HELP, "k1")
    assert talk.say(answer) == [command]
    assert talk.manager.session.activity is Activity.MOVING


def test_a_pause_that_nobody_asked_for_is_something_left_over() -> None:
    talk = Talk()
    outputs = talk.handle(RobotFeedback(feedback(Code.PAUSED), 1.0))
    assert sent(outputs) == ["queue"]
    outputs = talk.handle(RobotFeedback(feedback(Code.QUEUE, detail="go forward 3", id="k1"), 2.0))
    assert outputs == (Say("I am paused on 'go forward 3': continue, cancel or go back?", Tone.QUESTION),)
    assert talk.say("continue") == ["continue"]


def test_gestures_of_the_camera_turn_the_view_and_nothing_else() -> None:
    outputs = Talk().handle(Gesture(GestureKind.PUSH_LEFT, 0.0))
    assert outputs == (MoveCamera(CameraMove.SWITCH_LEFT),)


# ------------------------------------------------------------------ state as a value
def test_a_session_is_written_and_read_back_at_any_point() -> None:
    talk = Talk()
    steps = [
        lambda: talk.say("go(forward)"),
        lambda: talk.point(1.0, 2.0),
        lambda: talk.say("go(to(the(block)))"),
        lambda: talk.robot(Code.HELP, "k1"),
        lambda: talk.say("~turn(left)"),
    ]
    for step in steps:
        step()
        data = json.loads(json.dumps(to_data(talk.manager.session, Session)))
        assert from_data(data, Session) == talk.manager.session


@pytest.mark.parametrize("data", [[], {"state": "flying"}, {"tasks": [{"id": 3}]}, {"sent": True}, {"nonsense": 1}])
def test_what_is_not_a_session_is_refused(data: object) -> None:
    with pytest.raises(UnreadableError):
        from_data(data, Session)


def test_the_same_events_give_the_same_outputs() -> None:
    events: list[Event] = [
        Utterance("go(to(the(block)))", 1.0),
        Pointing(PointedPlace(Point(2.0, -1.0)), 2.0),
        RobotFeedback(feedback(Code.HELP, id="k1"), 3.0),
        Utterance("go(to(there))", 4.0),
        Gesture(GestureKind.THUMBS_UP, 5.0),
    ]
    first, second = (DialogueManager(load_lexicon(), parse, Session(world=BLOCKS)) for _ in range(2))
    assert [first.handle(e) for e in events] == [second.handle(e) for e in events]
    assert first.session == second.session

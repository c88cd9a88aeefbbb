"""Any events in any order: no exception, nothing sent by guess, stop always obeyed, replay equal to the run."""

from __future__ import annotations

import json

from hypothesis import given, settings
from hypothesis import strategies as st

from dialogue import DialogueManager, Session, State
from dialogue.codec import from_data, to_data
from dialogue.events import (
    Dispatch,
    Event,
    Gesture,
    GestureKind,
    PointedObject,
    PointedPlace,
    PointedRay,
    Pointing,
    RobotFeedback,
    Tick,
    Utterance,
    WorldUpdate,
)
from grammar.acts import DialogueAct, Function, NotUnderstood
from grammar.forms import parse_form
from grounding import Entities, Entity, World
from robot.geometry import ORIGIN, Point, Pose
from robot.messages import Control, FeedbackCode, Fiducial, Fiducials, Odom, feedback
from voxml.vocabulary import load_lexicon

WORLD = World(
    ORIGIN,
    Entities(
        (
            Entity("1", "block", Pose(2.0, -1.0, 3.0), ("red",), fiducial_id="1"),
            Entity("2", "block", Pose(3.0, 1.0, 3.0), ("blue",), fiducial_id="2"),
            Entity("t", "table", Pose(4.0, 0.0, 3.0)),
        )
    ),
)
FORMS = (
    "stop", "go(forward)", "turn(45deg)", "go(to(there))", "go(to(the(block)))", "go(to(that(one)))", "turn(this(way))",
    "seq(go(to(there)),go(to(that(block))))", "patrol", "keep_going", "go_back", "continue", "cancel", "cancel(all)",
    "come_here", "dance", "it", "left", "1", "the(first(one))", "the(red(one))", "there", "north", "queue", "99m",
    "the(block,near(the(table)),left_of(the(block)))", "go(to(it))", "find(the(piano))", '"rosie"', "stop_patrol",
    "until(see(a(block)),go(forward))", "when(reach(the(red(block))),turn(left))", "find(the(fiducial,number(3)))",
    "seq(go(forward),wait(5s),turn(left))", "if(exists(a(block)),turn(left),turn(right))", "visit(all(block))",
    "again", "again(left)", "more(10)", "more(little)", "other(way)", "repeat(2)", "repeat(2,again)", "45deg", "2m",
    "the(other(one))", "to(the(block))", "not(that(one))", "turn(right)", "go(to(back_there))",
    "go(through(the(wall)))",
    "where(you)", "see(what)", "what(that)", "count(block,on(left))", "is(it,red)", "is(you,near(the(table)))", "why",
    "doing", "going(where)", "color(the(block))", "distance(there)", "exists(anything)", "is(this,a(cone))",
    'learn("loop",seq(go(forward),perform("loop")))', 'perform("loop")', 'forget("loop")', "name(that(one),the(home))",
    "name(this(spot),the(home))", "go(to(the(home)))", "open(the(box))", "count(the(block))", "show(the(block))",
)  # fmt: skip
places = st.builds(Point, st.floats(-5, 5), st.floats(-5, 5))
targets = (
    places.map(PointedPlace)
    | st.sampled_from(["1", "2", "t", "nothing"]).map(PointedObject)
    | st.builds(PointedRay, places, st.floats(-4, 4))
)
times = st.floats(0, 100)
odoms = st.builds(
    lambda at, yaw: Odom(1, 1, (at.x_m, at.y_m, 0.0), (0.0, 0.0, yaw), 0.0, 0.0, 0.0), places, st.floats(-3, 3)
)
feedbacks = st.builds(
    lambda code, at, number: feedback(code, at=at, detail="go forward 1", id=None if number < 1 else f"k{number}"),
    st.sampled_from(list(FeedbackCode)),
    places,
    st.integers(-1, 12),
)
sightings = st.lists(st.sampled_from(["1", "2", "3"]), unique=True).map(
    lambda seen: Fiducials(tuple(Fiducial(name, (float(name), 1.0, 0.1), (0.0, 0.0, 3.0)) for name in seen))
)
utterances = st.builds(
    lambda function, form, mark, time_s, confidence: Utterance(f"{function.value} {mark}{form}", time_s, confidence),
    st.sampled_from(list(Function)),
    st.sampled_from(FORMS),
    st.sampled_from(["", "~"]),
    times,
    st.sampled_from([0.2, 1.0]),
)
events = st.one_of(
    utterances,
    st.builds(Utterance, st.just("blorp"), times),
    st.builds(Pointing, targets, times, st.floats(0, 1), st.floats(0, 1)),
    st.builds(Gesture, st.sampled_from([*GestureKind, "L shape"]), times),
    st.builds(RobotFeedback, feedbacks, times),
    st.builds(WorldUpdate, times, odoms, st.none(), sightings),
    st.builds(Tick, times),
)


def parse(text: str) -> tuple[DialogueAct, ...] | NotUnderstood:
    """``FUNCTION form``, the form marked with ``~`` where it was repaired."""
    if text == "blorp":
        return NotUnderstood((0, 5), ("go",), "go")
    function, _, form = text.partition(" ")
    repaired = form[1:] if form.startswith("~") else None
    return (DialogueAct(Function(function), parse_form(form.removeprefix("~")), (0, len(text)), repaired),)


def manager(session: Session | None = None) -> DialogueManager:
    return DialogueManager(load_lexicon(), parse, session or Session(world=WORLD))


@settings(max_examples=300, deadline=None)
@given(st.lists(events, max_size=30))
def test_any_order_of_events(history: list[Event]) -> None:
    run, replay = manager(), manager()
    for event in history:
        before = run.session
        outputs = run.handle(event)
        sent = [command for output in outputs if isinstance(output, Dispatch) for command in output.commands]
        ids = [name for output in outputs if isinstance(output, Dispatch) for name in output.ids]
        _check_step(event, before, sent)
        assert len(ids) == len(sent)
        assert (run.session.question is None) == (run.session.state in _WITHOUT_QUESTION)
        # From here on a conversation that was put away and taken up again does the same.
        stored = from_data(json.loads(json.dumps(to_data(replay.session, Session))), Session)
        replay = manager(stored)
        assert replay.handle(event) == outputs
    assert replay.session == run.session


_WITHOUT_QUESTION = {
    State.IDLE, State.EXECUTING, State.PATROLLING, State.PAUSED, State.AWAITING_CHOICE, State.AWAITING_RECOVERY,
}  # fmt: skip


def _check_step(event: Event, before: Session, sent: list[object]) -> None:
    match event:
        case Utterance(text) if text.startswith("instruct") and text.removeprefix("instruct ").strip("~") == "stop":
            assert Control.STOP in sent
        case Gesture(GestureKind.OPEN_PALM):
            assert Control.STOP in sent
        case Utterance(text) if text.startswith("instruct ~"):
            assert not sent or before.agenda is not None, "a repaired reading was acted on unconfirmed"
        case RobotFeedback() | WorldUpdate() | Tick():
            assert set(sent) <= {Control.QUEUE} or before.agenda is not None, "something moved that nobody asked for"
        case Pointing():
            assert not sent or before.question is not None or before.agenda is not None

"""Whatever comes in whatever order: what must hold of the queue at every step."""

import math

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from robot.geometry import ORIGIN, Pose
from robot.messages import Control, Envelope, FeedbackCode, GoForward, GoTo, Patrol, Side, Turn
from robot.queue import (
    IDLE,
    QUEUE_MAX,
    Arrived,
    Begin,
    Estimated,
    Failed,
    Forget,
    Garbled,
    Halt,
    Here,
    Mode,
    Photograph,
    PictureFailed,
    PictureTaken,
    Received,
    Reset,
    Resumed,
    Tell,
    handle,
    state_from_json,
    state_to_json,
)

centimetres = st.integers(-500, 500).map(lambda n: n / 100)
movements = st.one_of(
    st.builds(GoForward, centimetres),
    st.builds(GoTo, centimetres, centimetres),
    st.builds(Turn, st.sampled_from(Side), st.integers(1, 720)),
    st.builds(Patrol, st.integers(3, 5), st.just(1.0), st.just(0.5)),
)
ENDINGS = {
    "SUCCESS_FORWARD",
    "SUCCESS_GO_TO",
    "SUCCESS_VERIFY_ROTATION",
    "SUCCESS_GO_BACK",
    "UNREACHABLE",
    "STRAYED",
    "CANCELLED_GOAL",
    "STOP_PATROL",
    "FINISH_PATROL",
    "PICTURE",
    "INVALID",
}


class QueueMachine(RuleBasedStateMachine):
    def __init__(self):
        super().__init__()
        self.state, self.pose, self.entry = IDLE, ORIGIN, 0
        self.live, self.endings = {}, {}
        self.pursuing = False

    def feed(self, event):
        before = self.state
        self.state, effects = handle(before, event, Here(self.pose, 0.1))
        for effect in effects:
            match effect:
                case Begin():
                    self.pursuing = True
                case Halt():
                    self.pursuing = False
                case Forget(entry):
                    assert self.live.pop(entry), "an entry ends exactly once"
                case Tell(feedback) if feedback.id in self.endings and feedback.code.value in ENDINGS:
                    self.endings[feedback.id] += 1
        if isinstance(event, Arrived | Failed) and not any(isinstance(e, Begin) for e in effects):
            self.pursuing = False
        return effects

    def send(self, command):
        self.entry += 1
        self.live[self.entry] = True
        name = f"c{self.entry}"
        if not isinstance(command, Control) or command in (Control.GO_BACK, Control.TAKE_PICTURE):
            self.endings[name] = 0
        return name, self.feed(Received(self.entry, Envelope(command, name)))

    @rule(command=movements)
    def move(self, command):
        before = self.state
        _, effects = self.send(command)
        refused = any(isinstance(e, Tell) and e.feedback.code is FeedbackCode.INVALID for e in effects)
        if before.mode is Mode.PAUSED and self.entry > before.admitted:
            assert refused
        if refused:
            assert self.state == before

    @rule(command=st.sampled_from([c for c in Control if c is not Control.STOP]))
    def control(self, command):
        name, effects = self.send(command)
        if command not in (Control.GO_BACK, Control.TAKE_PICTURE):
            assert any(isinstance(e, Tell) and e.feedback.id == name for e in effects)

    @rule()
    def stop(self):
        _, effects = self.send(Control.STOP)
        assert Halt() in effects
        assert not any(isinstance(e, Begin) for e in effects)
        assert self.state.mode is not Mode.MOVING

    @rule()
    def garble(self):
        self.entry += 1
        self.live[self.entry] = True
        before = self.state
        self.feed(Garbled(self.entry, "not a command"))
        assert self.state == before

    @rule(x=centimetres, y=centimetres, yaw=st.floats(-math.pi, math.pi))
    def wander(self, x, y, yaw):
        self.pose = Pose(x, y, yaw)

    @precondition(lambda self: self.pursuing)
    @rule(event=st.sampled_from([Arrived(), Failed(), Estimated()]))
    def news(self, event):
        self.feed(event)

    @rule(event=st.sampled_from([Arrived(), Failed(), Estimated()]))
    def stale_news(self, event):
        if self.state.mode is not Mode.MOVING:
            before = self.state
            assert self.feed(event) == ()
            assert self.state == before

    @rule(good=st.booleans(), which=st.integers(0, 3))
    def picture(self, good, which):
        asked = [g.entry for g in (*self.state.pictures, *self.state.goals[:1]) if not g.moves]
        if asked:
            entry = asked[which % len(asked)]
            self.feed(PictureTaken(entry, "p.png") if good else PictureFailed(entry))

    @rule(unhandled=st.booleans())
    def restart(self, unhandled):
        self.state = state_from_json(state_to_json(self.state))
        self.pursuing = False
        effects = self.feed(Resumed(self.entry, unhandled))
        assert not any(isinstance(e, Begin) for e in effects)

    @rule()
    def reset(self):
        self.feed(Reset())
        assert self.state == IDLE

    @invariant()
    def wheels_turn_in_moving_alone(self):
        assert not self.pursuing or self.state.mode is Mode.MOVING

    @invariant()
    def moving_means_something_is_being_done(self):
        assert (self.state.mode is Mode.MOVING) <= (self.state.current is not None)
        if self.state.mode is Mode.MOVING and self.state.current.goal.moves:
            assert self.pursuing
        if self.state.mode is Mode.READY:
            assert not self.state.goals

    @invariant()
    def every_goal_is_live_and_ends_once(self):
        held = {goal.entry for goal in (*self.state.goals, *self.state.pictures)}
        assert held == set(self.live)
        for name, count in self.endings.items():
            assert count == (int(name[1:]) not in held)

    @invariant()
    def queue_is_bounded_and_storable(self):
        assert len(self.state.pending) <= QUEUE_MAX
        assert state_from_json(state_to_json(self.state)) == self.state


TestQueue = QueueMachine.TestCase
TestQueue.settings = settings(max_examples=60, stateful_step_count=60, deadline=None)


def test_a_picture_asked_for_twice_is_photographed_for_each():
    state, _ = handle(IDLE, Received(1, Envelope(Control.TAKE_PICTURE)), Here(ORIGIN))
    state, effects = handle(state, Resumed(1, False), Here(ORIGIN))
    assert state.mode is Mode.PAUSED
    state, effects = handle(state, Received(2, Envelope(Control.CONTINUE)), Here(ORIGIN))
    assert Photograph(1) in effects

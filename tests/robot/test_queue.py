"""Every row and paragraph of RSB's "Commands" and "Feedback codes", and the original's faults, on the pure queue."""

import math

import pytest

from robot.geometry import ORIGIN, Point, Pose
from robot.messages import Envelope, decode_command
from robot.navigation.goals import Reach, Rotate
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
    Started,
    Tell,
    handle,
    state_from_json,
    state_to_json,
)


class Bench:
    """The queue with a robot that is wherever the test puts it."""

    def __init__(self):
        self.state, self.pose, self.turned_rad, self.entry = IDLE, ORIGIN, 0.0, 0
        self.effects, self.forgotten, self.target = (), set(), None

    def event(self, event):
        self.state, self.effects = handle(self.state, event, Here(self.pose, self.turned_rad))
        assert state_from_json(state_to_json(self.state)) == self.state
        for effect in self.effects:
            self.target = effect.target if isinstance(effect, Begin) else self.target
        self.forgotten |= {e.entry for e in self.effects if isinstance(e, Forget)}
        return self.codes

    def send(self, text, id=None):
        self.entry += 1
        return self.event(Received(self.entry, Envelope(decode_command(text), id)))

    def arrive(self):
        target = self.target
        place, yaw = self.pose.point, self.pose.yaw_rad + getattr(target, "angle_rad", 0.0)
        if isinstance(target, Reach):
            place, yaw = target.place, yaw if target.yaw_rad is None else target.yaw_rad
        self.pose = Pose(place.x_m, place.y_m, yaw)
        return self.event(Arrived())

    @property
    def codes(self):
        return [e.feedback.code.value for e in self.effects if isinstance(e, Tell)]

    @property
    def told(self):
        return [(e.feedback.code.value, e.feedback.id) for e in self.effects if isinstance(e, Tell)]

    @property
    def messages(self):
        return [e.feedback.message for e in self.effects if isinstance(e, Tell)]

    @property
    def halted(self):
        return Halt() in self.effects


@pytest.fixture
def bench():
    return Bench()


def place(x, y):
    return pytest.approx((x, y), abs=1e-9)


def at(target):
    return (target.place.x_m, target.place.y_m)


def test_start_says_ready(bench):
    assert bench.event(Started()) == ["READY"]
    assert bench.messages == ["waiting for commands"]


def test_go_forward_is_told_from_beginning_to_end(bench):
    assert bench.send("go forward 2", "a") == ["FORWARD"]
    assert bench.messages == ["looking for path to (2, 0)"]
    assert at(bench.target) == place(2, 0)
    assert bench.arrive() == ["SUCCESS_FORWARD", "READY"]
    assert bench.messages[0] == "successfully navigated to (2, 0)"
    assert bench.told[0] == ("SUCCESS_FORWARD", "a")
    assert bench.forgotten == {1}


def test_negative_distance_lies_behind(bench):
    bench.send("go forward -1.5")
    assert at(bench.target) == place(-1.5, 0)
    assert bench.target.reverse


def test_go_to_keeps_the_heading_of_before(bench):
    bench.pose = Pose(1, 1, 0.7)
    assert bench.send("go to 3 -2") == ["GO_TO"]
    assert bench.target == Reach(Point(3, -2), 0.7)
    assert bench.arrive() == ["SUCCESS_GO_TO", "READY"]


def test_a_stand_in_for_a_place_without_room_is_told(bench):
    bench.send("go to 3 -2")
    assert bench.event(Arrived(Point(2.8, -2.0))) == ["SUCCESS_GO_TO", "READY"]
    assert bench.effects[0].feedback.message == "successfully navigated to (2.8, -2), the nearest free place"


def test_turns_estimate_then_verify(bench):
    assert bench.send("turn right") == ["ESTIMATE_ROTATION"]
    assert bench.target == Rotate(pytest.approx(-math.pi / 2), pytest.approx(-math.pi / 2))
    assert bench.event(Estimated()) == ["SUCCESS_ESTIMATE_ROTATION", "VERIFY_ROTATION"]
    assert bench.arrive() == ["SUCCESS_VERIFY_ROTATION", "READY"]


def test_a_turn_may_exceed_a_full_turn(bench):
    bench.send("turn left 720")
    assert bench.target.angle_rad == pytest.approx(4 * math.pi)


def test_movements_queue_from_the_ideal_end_of_the_one_before(bench):
    for text in ("go forward 1", "turn left 90", "go forward 1"):
        bench.send(text)
    bench.pose = Pose(1.04, 0.03, 0.05)  # arrived a little off
    bench.event(Arrived())
    assert bench.target == Rotate(pytest.approx(math.pi / 2 - 0.05), pytest.approx(math.pi / 2))
    bench.pose = Pose(1.04, 0.03, math.pi / 2 - 0.02)
    bench.event(Arrived())
    assert at(bench.target) == place(1, 1)


def test_small_errors_do_not_add_up_over_commands_given_one_by_one(bench):
    bench.send("go forward 1")
    bench.pose = Pose(0.97, 0.02, 0.03)
    bench.event(Arrived())
    bench.send("go forward 1")
    assert at(bench.target) == place(2, 0)


def test_a_robot_that_was_carried_away_starts_from_where_it_is(bench):
    bench.send("go forward 1")
    bench.arrive()
    bench.pose = Pose(5, 5, 0)
    bench.send("go forward 1")
    assert at(bench.target) == place(6, 5)


def test_the_heading_is_not_taken_on_the_way_to_another_place(bench):
    bench.pose = Pose(0, 0, 1.0)
    bench.send("turn left 10")
    bench.send("go to 1 1")
    bench.send("go to 2 2")
    bench.arrive()
    assert bench.target == Reach(Point(1, 1), None)
    bench.arrive()
    assert bench.target.yaw_rad == pytest.approx(1.0 + math.radians(10))


def test_stop_pauses_and_continue_resumes(bench):
    bench.send("go forward 2")
    target = bench.target
    assert bench.send("stop", "s") == ["PAUSED"]
    assert bench.halted
    assert bench.messages == ["paused current goal"]
    assert bench.state.mode is Mode.PAUSED
    assert bench.send("continue") == ["RESTARTING"]
    assert bench.messages == ["restarting current goal"]
    assert bench.target == target


@pytest.mark.parametrize(("side", "sign"), [("left", 1), ("right", -1)])
def test_a_paused_turn_resumes_by_what_is_left(bench, side, sign):
    bench.send(f"turn {side} 120")
    bench.turned_rad = sign * math.radians(50)
    bench.pose = bench.pose.turned(bench.turned_rad)
    bench.send("stop")
    bench.turned_rad = 0.0
    bench.send("stop")
    bench.send("continue")
    assert bench.target.angle_rad == pytest.approx(sign * math.radians(70))
    bench.turned_rad = sign * math.radians(30)
    bench.send("stop")
    bench.turned_rad = 0.0
    bench.send("continue")
    assert bench.target.angle_rad == pytest.approx(sign * math.radians(40))


def test_stop_with_nothing_to_pause_leaves_the_robot_ready(bench):
    assert bench.send("stop", "s") == ["READY"]
    assert bench.halted
    assert bench.send("go forward") == ["FORWARD"]


def test_movements_while_paused_are_refused_in_words(bench):
    bench.send("go forward")
    bench.send("stop")
    before = bench.state
    for text in ("go forward", "go to 1 1", "turn left", "patrol"):
        assert bench.send(text) == ["INVALID"]
        assert "robot is paused" in bench.messages[0]
    assert bench.state == before


@pytest.mark.parametrize("pause", [False, True])
def test_cancel_drops_the_current_and_recomputes_the_rest_from_the_real_place(bench, pause):
    bench.send("go forward 5", "a")
    bench.send("go forward 1", "b")
    bench.pose = Pose(2, 0.5, 0.0)
    if pause:
        bench.send("stop")
    assert bench.send("cancel", "c") == ["CANCELLED_GOAL", "CANCELLED_GOAL", "FORWARD"]
    assert bench.told == [("CANCELLED_GOAL", "a"), ("CANCELLED_GOAL", "c"), ("FORWARD", "b")]
    assert at(bench.target) == place(3, 0.5)


def test_plain_cancel_is_told_once(bench):
    bench.send("go forward 5")
    assert bench.send("cancel") == ["CANCELLED_GOAL", "READY"]


@pytest.mark.parametrize("pause", [False, True])
def test_cancel_all_drops_everything(bench, pause):
    for text, name in (("go forward 5", "a"), ("turn left", "b"), ("go to 1 1", None)):
        bench.send(text, name)
    if pause:
        bench.send("stop")
    bench.send("cancel all", "c")
    endings = [("CANCELLED_GOAL", "a"), ("CANCELLED_GOAL", "b"), ("CANCELLED_ALL", "c"), ("READY", None)]
    assert bench.told == endings
    assert bench.halted
    assert {1, 2, 3} <= bench.forgotten


@pytest.mark.parametrize("pause", [False, True])
def test_go_back_returns_to_where_the_current_movement_began(bench, pause):
    bench.send("go forward 1")
    bench.arrive()
    bench.send("go forward 4")
    bench.send("turn left")
    bench.pose = Pose(3, 0, 0)
    if pause:
        bench.send("stop")
    assert bench.send("go back", "g")[-1] == "GO_BACK"
    assert bench.messages[-1] == "returning to previous location (1, 0)"
    assert bench.target == Reach(Point(1, 0), 0)
    assert bench.arrive() == ["SUCCESS_GO_BACK", "READY"]
    assert bench.state.pending == ()


def test_go_back_when_idle_returns_to_where_the_last_movement_began(bench):
    assert bench.send("go back") == ["INVALID"]
    bench.pose = Pose(1, 2, 0.5)
    bench.send("go to 4 4")
    bench.arrive()
    bench.send("go back")
    assert bench.target == Reach(Point(1, 2), 0.5)


def strayed(bench):
    bench.send("go to 4 0", "a")
    bench.send("go forward 1", "b")
    bench.pose = Pose(1.5, 0, 0)
    bench.event(Failed())


def test_straying_asks_for_help_and_waits(bench):
    strayed(bench)
    assert bench.told == [("STRAYED", "a"), ("HELP", "a")]
    assert bench.messages[1] == "user input is required: keep going OR go back"
    assert bench.state.mode is Mode.AWAITING
    assert bench.halted
    assert bench.send("continue") == ["INVALID"]
    assert bench.send("stop") == ["HELP"]
    assert bench.state.mode is Mode.AWAITING


def test_keep_going_goes_on_with_the_queue_from_here(bench):
    strayed(bench)
    bench.send("keep going", "k")
    assert bench.told == [("RESTARTING", "k"), ("FORWARD", "b")]
    assert at(bench.target) == place(2.5, 0)


def test_keep_going_with_nothing_left_is_ready(bench):
    bench.send("go to 4 0")
    bench.pose = Pose(1.5, 0, 0)
    bench.event(Failed())
    assert bench.send("keep going") == ["RESTARTING", "READY"]


def test_go_back_after_straying_really_goes_back(bench):
    strayed(bench)
    bench.send("go back", "g")
    assert bench.told == [("CANCELLED_GOAL", "b"), ("GO_BACK", "g")]
    assert bench.target == Reach(Point(0, 0), 0)


def test_a_movement_is_an_answer_of_its_own(bench):
    strayed(bench)
    bench.send("go to 1 1", "n")
    assert bench.told == [("CANCELLED_GOAL", "b"), ("GO_TO", "n")]
    assert at(bench.target) == place(1, 1)


def test_a_failure_near_the_beginning_is_unreachable_and_the_queue_goes_on(bench):
    bench.send("go to 4 0", "a")
    bench.send("go forward 1", "b")
    bench.pose = Pose(0.49, 0, 0)
    bench.event(Failed())
    assert bench.told == [("UNREACHABLE", "a"), ("FORWARD", "b")]
    assert at(bench.target) == place(1.49, 0)


def test_half_a_metre_is_straying(bench):
    bench.send("go to 4 0")
    bench.pose = Pose(0.5, 0, 0)
    assert bench.event(Failed()) == ["STRAYED", "HELP"]


def test_straying_is_measured_from_where_the_movement_began_even_over_a_pause(bench):
    bench.send("go to 4 0")
    bench.pose = Pose(0.4, 0, 0)
    bench.send("stop")
    bench.send("continue")
    bench.pose = Pose(0.6, 0, 0)
    assert bench.event(Failed()) == ["STRAYED", "HELP"]


def test_flow_control_out_of_place_is_refused_and_changes_nothing(bench):
    for text in ("continue", "cancel", "keep going", "stop patrol"):
        assert bench.send(text, "x") == ["INVALID"]
        assert bench.told == [("INVALID", "x")]
    assert bench.state == IDLE
    assert bench.forgotten == {1, 2, 3, 4}


def test_queue_says_what_is_pending(bench):
    assert bench.send("queue", "q") == ["QUEUE"]
    assert bench.messages == ["pending: nothing"]
    bench.send("go forward 2.5")
    bench.send("turn left")
    bench.send("queue")
    assert bench.messages == ["pending: go forward 2.5, turn left 90"]


def test_a_full_queue_refuses(bench):
    for _ in range(QUEUE_MAX + 1):
        assert bench.send("turn left 10") != ["INVALID"]
    assert bench.send("turn left 10") == ["INVALID"]
    assert "full" in bench.messages[0]
    assert bench.send("stop") == ["PAUSED"]


def test_patrol_goes_round_in_growing_polygons(bench):
    assert bench.send("patrol 4 1 0.5", "p") == ["PATROL", "PLAN_LOOP"]
    corners = [at(bench.target)]
    for _ in range(3):
        assert bench.arrive() == []
        corners.append(at(bench.target))
    assert corners == [place(1, 0), place(0, 1), place(-1, 0), place(0, -1)]
    assert bench.arrive() == ["COMPLETED_LOOP", "PLAN_LOOP"]
    assert bench.messages == ["completed loop 1", "planning loop 2"]
    assert at(bench.target) == place(1.5, 0)


def test_patrol_skips_what_it_cannot_reach_and_finishes_when_that_is_everything(bench):
    bench.send("patrol 3 1 1", "p")
    assert bench.event(Failed()) == []
    assert bench.arrive() == []
    assert bench.event(Failed()) == ["COMPLETED_LOOP", "PLAN_LOOP"]
    bench.event(Failed())
    bench.event(Failed())
    bench.event(Failed())
    assert bench.told == [("FINISH_PATROL", "p"), ("READY", None)]
    assert bench.messages[0] == "no more explorable waypoints"


def test_while_patrolling_movements_are_refused_and_flow_control_works(bench):
    bench.send("patrol", "p")
    for text in ("go forward", "turn left", "patrol"):
        assert bench.send(text) == ["INVALID"]
        assert "robot is patrolling" in bench.messages[0]
    assert bench.send("stop") == ["PAUSED"]
    assert bench.send("continue") == ["RESTARTING"]
    assert bench.send("stop patrol", "s") == ["STOP_PATROL", "STOP_PATROL", "READY"]
    assert bench.halted


def test_a_resumed_patrol_goes_on_where_it_was(bench):
    bench.send("patrol 4 1 1")
    bench.arrive()
    bench.send("stop")
    bench.send("continue")
    assert at(bench.target) == place(0, 1)


def test_a_patrol_that_waits_in_the_queue_does_not_refuse_movements(bench):
    bench.send("go forward")
    bench.send("patrol")
    bench.send("go forward")
    assert [goal.command for goal in bench.state.pending] == [decode_command("patrol"), decode_command("go forward")]


def test_pictures_are_taken_in_their_turn(bench):
    bench.send("go forward")
    assert bench.send("take picture", "p") == []
    bench.arrive()
    assert bench.codes == ["SUCCESS_FORWARD"]
    assert Photograph(2) in bench.effects
    assert bench.event(PictureTaken(2, "x.png")) == ["PICTURE", "READY"]
    assert bench.messages[0] == "took picture x.png"


@pytest.mark.parametrize("before", [("patrol",), ("go forward", "stop")])
def test_pictures_are_taken_at_once_where_no_turn_comes(bench, before):
    for text in before:
        bench.send(text)
    state = bench.state
    bench.send("take picture", "p")
    assert bench.effects == (Photograph(bench.entry),)
    assert bench.event(PictureFailed(bench.entry)) == ["UNREACHABLE"]
    assert bench.told == [("UNREACHABLE", "p")]
    assert bench.state == state


def test_a_garbled_entry_changes_nothing(bench):
    bench.send("go forward")
    before = bench.state
    assert bench.event(Garbled(9, "unknown command 'fly'", "f")) == ["INVALID"]
    assert bench.told == [("INVALID", "f")]
    assert bench.state == before
    assert 9 in bench.forgotten


def test_reset_stops_everything_and_is_ready(bench):
    bench.send("go forward")
    bench.send("turn left")
    assert bench.event(Reset()) == ["READY"]
    assert bench.halted
    assert bench.state == IDLE


def test_news_of_a_movement_that_was_stopped_says_nothing(bench):
    bench.send("go forward")
    bench.send("stop")
    before = bench.state
    for event in (Arrived(), Failed(), Estimated()):
        assert bench.event(event) == []
    assert bench.state == before


def test_after_a_restart_the_robot_pauses_on_what_it_was_doing(bench):
    bench.send("turn right 90")
    bench.turned_rad = -math.radians(30)
    assert bench.event(Resumed(admitted=1, unhandled=False)) == ["PAUSED"]
    bench.turned_rad = 0.0
    assert bench.send("go forward") == ["INVALID"]
    bench.send("continue")
    assert bench.target.angle_rad == pytest.approx(-math.radians(60))


def test_what_was_sent_before_the_restart_was_announced_is_kept(bench):
    bench.send("go forward 1")
    bench.event(Resumed(admitted=2, unhandled=True))
    assert bench.send("go forward 2") == []
    assert bench.send("go forward 3") == ["INVALID"]
    bench.send("continue")
    bench.arrive()
    assert at(bench.target) == place(3, 0)


def test_a_restart_while_waiting_for_an_answer_asks_again(bench):
    strayed(bench)
    assert bench.event(Resumed(admitted=2, unhandled=False)) == ["HELP"]
    assert bench.send("keep going") == ["RESTARTING", "FORWARD"]


def test_a_restart_with_only_unhandled_entries_waits_for_continue(bench):
    assert bench.event(Resumed(admitted=1, unhandled=True)) == ["PAUSED"]
    assert bench.send("go forward") == []
    assert bench.send("continue") == ["RESTARTING", "FORWARD"]

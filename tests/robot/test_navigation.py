"""Driving to places: around obstacles, without contact, and with an honest answer when there is no way."""

from __future__ import annotations

import math

import numpy as np
import pytest
from kinematic_body import TYPICAL, WAFFLE_PI, KinematicBody, box, polygon
from pilot import Pilot, offset

from robot.geometry import Point, Pose, Segment, wrap_angle
from robot.mapping import OccupancyGrid
from robot.navigation import Drive, Navigator, Phase, Plan, Reach, Reason, State, build_costmap, plan
from robot.navigation.follower import Twist
from robot.navigation.recovery import Recovery

CORRIDOR = polygon((-1, -1), (8, -1), (8, 1), (3.9, 1), (3.9, 3), (3, 3), (3, 1), (-1, 1))
CLUTTERED = CORRIDOR + box(2, -0.6, 0.3, 0.3) + box(5, 0.7, 0.3, 0.3) + box(6.5, 0, 0.4, 0.4)


def rooms(open_door: bool) -> tuple[Segment, ...]:
    """A corridor with a side room and, beyond a barrier, the place that is wanted. From the corridor the side room's
    inside cannot be seen; a second door may lead from it on to the other side."""
    outline = polygon((-1, -1), (8, -1), (8, 4), (-1, 4))
    barrier = box(4, 0, 0.1, 2)
    ceiling = box(0.25, 1, 2.5, 0.1) + box(5.2, 1, 5.6, 0.1)  # a doorway between x = 1.5 and 2.4
    side = box(-0.5, 2.5, 0.1, 3) + (box(5.5, 3.55, 0.1, 0.9) + box(5.5, 1.6, 0.1, 1.2) if open_door else ())
    return outline + barrier + ceiling + side + box(5.5, 2.5, 0.1, 3) * (not open_door)


@pytest.mark.parametrize(("noisy", "tolerance_m"), [(False, 0.015), (True, 0.025)])
def test_places_are_reached_around_boxes_without_a_touch(noisy: bool, tolerance_m: float) -> None:
    body = KinematicBody(CLUTTERED, noise=TYPICAL, seed=3) if noisy else KinematicBody(CLUTTERED)
    pilot = Pilot(body)
    for goal in (Reach(Point(7.4, 0.3)), Reach(Point(3.45, 2.5), math.pi), Reach(Point(0, 0), 0.0)):
        drive = pilot.pursue(goal)
        assert drive.state is State.ARRIVED
        assert body.pose.point.distance_to(goal.place) < tolerance_m
        if goal.yaw_rad is not None:
            assert abs(wrap_angle(body.pose.yaw_rad - goal.yaw_rad)) < math.radians(1.0)
    assert body.contacts == 0
    # Through the unknown and back: no more than a few percent over the straight way around the boxes.
    assert pilot.driven_m < 1.1 * (7.5 + 4.0 + 2.6 + 2.5 + 3.6)


@pytest.mark.parametrize("seed", range(5))
def test_one_metre_forward_ends_within_two_centimetres_and_one_degree(seed: int) -> None:
    body = KinematicBody(CLUTTERED, noise=TYPICAL, seed=seed)
    assert Pilot(body).pursue(Reach(Point(1, 0), 0.0)).state is State.ARRIVED
    assert offset(body.pose, Pose(1, 0, 0)) < 0.02
    assert abs(body.pose.yaw_rad) < math.radians(1.0)


def test_a_place_behind_is_backed_up_to_when_the_way_is_free() -> None:
    body = KinematicBody(CORRIDOR, Pose(2, 0, 0))
    facings = []
    drive = Pilot(body).pursue(Reach(Point(1, 0), 0.0, reverse=True), watch=lambda _: facings.append(body.pose.yaw_rad))
    assert drive.state is State.ARRIVED
    assert offset(body.pose, Pose(1, 0, 0)) < 0.02
    assert max(abs(yaw_rad) for yaw_rad in facings) < 0.2


def test_backing_up_goes_around_what_stands_behind() -> None:
    body = KinematicBody(CORRIDOR + box(1.2, 0.1, 0.2, 0.2), Pose(2, 0, 0))
    pilot = Pilot(body)
    assert pilot.pursue(Reach(Point(0.5, 0), 0.0, reverse=True)).state is State.ARRIVED
    assert offset(body.pose, Pose(0.5, 0, 0)) < 0.02
    assert body.contacts == 0


def test_a_goal_in_an_obstacle_is_refused_and_one_at_its_edge_is_moved_and_says_so() -> None:
    body = KinematicBody(CORRIDOR + box(2, 0, 0.8, 0.8))
    pilot = Pilot(body)
    pilot.pursue(Reach(Point(0.9, 0)))
    edge = pilot.pursue(Reach(Point(1.5, 0)))
    assert edge.state is State.ARRIVED
    assert edge.moved_to is not None
    assert edge.moved_to.distance_to(Point(1.5, 0)) < 0.3
    assert body.pose.point.distance_to(edge.moved_to) < 0.02
    pilot.pursue(Reach(Point(2, 0.75)))
    refused = pilot.pursue(Reach(Point(8.6, 0)))
    assert (refused.state, refused.linear_mps, refused.angular_radps) == (State.FAILED, 0.0, 0.0)
    assert body.contacts == 0


def test_a_place_outside_the_known_walls_fails_promptly_without_driving() -> None:
    pilot = Pilot(KinematicBody(polygon((-1.5, -1.5), (1.5, -1.5), (1.5, 1.5), (-1.5, 1.5))))
    drive = pilot.pursue(Reach(Point(4, 0)))
    assert (drive.state, drive.reason) == (State.FAILED, Reason.CUT_OFF)
    assert pilot.driven_m < 0.01
    assert pilot.body.time_s < 3.0


def test_a_place_at_the_end_of_the_world_costs_no_more_planning_than_its_known_part() -> None:
    body = KinematicBody(CORRIDOR)
    pilot = Pilot(body)
    start, goal = Point(0, 0), Point(900, -900)
    costmap = build_costmap(pilot.mapper.grid, start, (goal,), 0.22)
    assert costmap.costs.size < 100_000
    found = plan(costmap, start, goal)
    assert isinstance(found, Plan)
    assert found.path[-1] == goal
    drive = pilot.pursue(Reach(goal))
    assert (drive.state, drive.reason) == (State.FAILED, Reason.CUT_OFF)
    assert body.contacts == 0


@pytest.mark.parametrize("start", [Pose(0, -0.77, 0), Pose(-0.78, -0.78, -2.3)])
def test_a_robot_that_stands_too_near_to_a_wall_drives_off_it(start: Pose) -> None:
    body = KinematicBody(CORRIDOR, start)
    assert Pilot(body).pursue(Reach(Point(2, 0))).state is State.ARRIVED
    assert body.contacts == 0


def test_a_side_room_that_turns_out_closed_is_explored_before_giving_up() -> None:
    body = KinematicBody(rooms(open_door=False))
    pilot = Pilot(body)
    visited: list[Point] = []
    drive = pilot.pursue(Reach(Point(6.5, 0)), watch=lambda _: visited.append(body.pose.point))
    assert (drive.state, drive.reason) == (State.FAILED, Reason.CUT_OFF)
    assert any(place.y_m > 1.0 for place in visited)
    assert body.contacts == 0


def test_the_same_way_is_taken_when_the_side_room_leads_on() -> None:
    body = KinematicBody(rooms(open_door=True))
    drive = Pilot(body).pursue(Reach(Point(6.5, 2.5)))
    assert drive.state is State.ARRIVED
    assert body.contacts == 0


def test_what_steps_into_the_way_stops_the_robot_and_is_driven_around() -> None:
    body = KinematicBody(CORRIDOR)
    pilot = Pilot(body)
    placed: list[Pose] = []

    def step_in(drive: Drive) -> bool:
        if not placed and body.pose.x_m > 1.0:
            placed.append(body.pose)
            body.set_walls(CORRIDOR + box(body.pose.x_m + 0.55, 0, 0.3, 0.3))
        return False

    assert pilot.pursue(Reach(Point(5, 0)), watch=step_in).state is State.ARRIVED
    assert placed
    assert body.contacts == 0


def test_a_way_that_shuts_while_driving_ends_in_failure_and_not_in_contact() -> None:
    body = KinematicBody(CORRIDOR)
    pilot = Pilot(body)

    def shut(drive: Drive) -> bool:
        if body.pose.x_m > 2.0:
            body.set_walls(CORRIDOR + box(3.0, 0, 0.1, 2.0))
        return False

    drive = pilot.pursue(Reach(Point(6, 0)), watch=shut)
    assert drive.state is State.FAILED
    assert body.contacts == 0
    assert 2.0 < body.pose.x_m < 2.8


def test_a_robot_that_cannot_move_tries_to_recover_and_then_says_that_it_is_stuck() -> None:
    """Its wheels spin: the pose never changes, whatever is commanded."""
    navigator, grid = Navigator(WAFFLE_PI), OccupancyGrid()
    scan = KinematicBody(CORRIDOR).scan()
    assert scan is not None
    pose = Pose(0, 0, 0)
    grid.update(pose, scan)
    navigator.start(Reach(Point(2, 0)), pose, 0.0)
    drives = [navigator.step(pose, scan, grid, 0.0)]
    while drives[-1].state is State.ACTIVE and len(drives) < 4000:
        drives.append(navigator.step(pose, scan, grid, len(drives) * 0.05))
    assert (drives[-1].state, drives[-1].reason) == (State.FAILED, Reason.STUCK)
    assert Phase.RECOVER in {drive.phase for drive in drives}


def test_recovery_plans_anew_then_spins_then_backs_up_then_waits_and_does_so_twice() -> None:
    recovery, pose, now_s = Recovery(), Pose(0, 0, 0), 0.0
    deeds: list[set[Twist]] = []
    while recovery.start(pose, now_s):
        deeds.append(set())
        begun_s = now_s
        while recovery.is_active:
            deeds[-1].add(recovery.step(pose, now_s))
            now_s += 0.05
        if len(deeds) % 4 == 0:
            assert 2.9 < now_s - begun_s < 3.2
    still, spin, back = Twist(0.0, 0.0), Twist(0.0, 0.8), Twist(-0.08, 0.0)
    assert deeds == [{still}, {spin, still}, {back, still}, {still}] * 2


def test_a_robot_that_has_come_on_since_its_last_trouble_may_recover_as_often_again() -> None:
    recovery = Recovery()
    begun = [recovery.start(Pose(0, 0, 0), 0.0) for _ in range(9)]
    assert begun == [True] * 8 + [False]
    assert recovery.start(Pose(1.2, 0, 0), 0.0)


def test_a_pause_loses_nothing_and_time_spent_paused_is_no_time_stuck() -> None:
    body = KinematicBody(CLUTTERED)
    pilot = Pilot(body)
    pilot.pursue(Reach(Point(5, -0.3), 1.0), watch=lambda _: body.pose.x_m > 2.0)
    pilot.rest(60.0)
    assert pilot.navigator.remaining == Reach(Point(5, -0.3), 1.0)
    assert pilot.go_on().state is State.ARRIVED
    assert offset(body.pose, Pose(5, -0.3, 1)) < 0.02
    assert pilot.navigator.remaining is None


def test_commands_keep_to_the_limits_and_the_path_leads_to_the_goal() -> None:
    body = KinematicBody(CLUTTERED)
    drives: list[Drive] = []
    Pilot(body).pursue(Reach(Point(7.4, 0.3)), watch=lambda d: drives.append(d) or False)
    linear = np.array([d.linear_mps for d in drives])
    assert np.abs(linear).max() <= WAFFLE_PI.linear_max_mps + 1e-9
    assert max(abs(d.angular_radps) for d in drives) <= WAFFLE_PI.angular_max_radps + 1e-9
    assert np.diff(linear).max() <= WAFFLE_PI.linear_acceleration_mps2 * 0.05 + 1e-9
    assert all(d.path[-1] == Point(7.4, 0.3) for d in drives if d.path)


def test_a_plan_in_the_unknown_is_the_straight_line_and_around_a_known_box_it_is_near_the_shortest() -> None:
    start, goal = Point(0, 0), Point(4, 0)
    empty = build_costmap(OccupancyGrid(), start, (goal,), 0.22)
    straight = plan(empty, start, goal)
    assert isinstance(straight, Plan)
    assert straight.path == (start, goal)
    grid = OccupancyGrid()
    walls = polygon((-1, -3), (5, -3), (5, 3), (-1, 3)) + box(2, 0, 0.6, 0.6)
    for place in (start, goal, Point(2, 2), Point(2, -2)):
        scan = KinematicBody(walls, Pose(place.x_m, place.y_m, 0)).scan()
        assert scan is not None
        grid.update(Pose(place.x_m, place.y_m, 0), scan)
    around = plan(build_costmap(grid, start, (goal,), 0.22), start, goal)
    assert isinstance(around, Plan)
    length_m = sum(a.distance_to(b) for a, b in zip(around.path, around.path[1:], strict=False))
    assert 4.1 < length_m < 4.1 * 1.08  # tight around the corners: 2 * hypot(1.7, 0.52) + 0.6
    clearances = [max(abs(p.x_m - 2) - 0.3, abs(p.y_m) - 0.3) for p in around.path]
    assert min(clearances) > 0.2

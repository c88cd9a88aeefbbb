"""Turning in place, and the shield."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from kinematic_body import TYPICAL, WAFFLE_PI, KinematicBody, polygon
from pilot import Pilot

from robot.geometry import ORIGIN, Pose, wrap_angle
from robot.navigation import Drive, Phase, Rotate, State
from robot.navigation.shield import Surroundings, safe_speed

ROOM = polygon((-2, -1.5), (2, -1.5), (2, 1.5), (-2, 1.5))


def turned(pilot: Pilot, goal: Rotate) -> tuple[Drive, float, list[Phase]]:
    """The last drive, how far the body really turned, and the phases in order."""
    phases: list[Phase] = []
    total, last = 0.0, pilot.body.pose.yaw_rad

    def watch(drive: Drive) -> bool:
        nonlocal total, last
        if not phases or phases[-1] is not drive.phase:
            phases.append(drive.phase)
        total += wrap_angle(pilot.body.pose.yaw_rad - last)
        last = pilot.body.pose.yaw_rad
        return False

    drive = pilot.pursue(goal, watch=watch)
    return drive, total + wrap_angle(pilot.body.pose.yaw_rad - last), phases


@pytest.mark.parametrize("angle_deg", [5.0, 90.0, -90.0, 180.0, -270.0, 360.0, 800.0, -725.0])
def test_turns_are_really_turned_in_their_direction_within_a_degree(angle_deg: float) -> None:
    pilot = Pilot(KinematicBody(ROOM, noise=TYPICAL, seed=4))
    drive, total, phases = turned(pilot, Rotate(math.radians(angle_deg)))
    assert drive.state is State.ARRIVED
    assert math.degrees(total) == pytest.approx(angle_deg, abs=1.0)
    assert phases == [Phase.ESTIMATE_ROTATION, Phase.VERIFY_ROTATION]


def test_with_a_final_heading_the_errors_of_many_turns_do_not_add_up() -> None:
    pilot = Pilot(KinematicBody(ROOM, noise=TYPICAL, seed=6))
    for quarter in range(1, 9):
        pilot.pursue(Rotate(math.pi / 2, wrap_angle(quarter * math.pi / 2)))
    assert abs(math.degrees(pilot.body.pose.yaw_rad)) < 1.0


def test_a_final_heading_refines_the_turn_but_never_its_direction() -> None:
    pilot = Pilot(KinematicBody(ROOM, Pose(0, 0, 0.05)))
    _, total, _ = turned(pilot, Rotate(-math.tau, 0.0))
    assert total == pytest.approx(-math.tau - 0.05, abs=0.02)


@pytest.mark.parametrize("angle_deg", [170.0, -170.0, -500.0])
@pytest.mark.parametrize("restart", [False, True])
def test_a_paused_turn_resumes_by_the_right_amount(angle_deg: float, restart: bool) -> None:
    """Whether the same navigator goes on or what remains is started anew, as after a restart."""
    body = KinematicBody(ROOM, noise=TYPICAL, seed=8)
    pilot = Pilot(body)
    halfway = math.radians(abs(angle_deg)) / 2
    pilot.pursue(
        Rotate(math.radians(angle_deg)),
        watch=lambda _: abs(pilot.navigator.remaining.angle_rad) < halfway,  # type: ignore[union-attr]
    )
    pilot.rest(20.0)
    remaining = pilot.navigator.remaining
    assert isinstance(remaining, Rotate)
    if restart:
        coasted = wrap_angle(math.radians(angle_deg) - remaining.angle_rad - pilot.pose.yaw_rad)
        drive = pilot.pursue(Rotate(remaining.angle_rad + coasted))
    else:
        drive = pilot.go_on()
    assert drive.state is State.ARRIVED
    assert abs(math.degrees(wrap_angle(body.pose.yaw_rad - math.radians(angle_deg)))) < 1.0


near = st.floats(-1.0, 1.0)


@given(st.lists(st.tuples(near, near), max_size=8), st.integers(-26, 26), st.floats(-1.8, 1.8))
def test_the_shield_only_slows_and_never_lets_the_robot_drive_into_what_it_sees(
    points: list[tuple[float, float]], centimetres_per_s: int, angular: float
) -> None:
    linear = centimetres_per_s / 100.0
    cloud = np.array([p for p in points if math.hypot(*p) > 0.24]).reshape(-1, 2)
    speed = safe_speed(linear, angular, ORIGIN, Surroundings(0.0, cloud), WAFFLE_PI)
    assert abs(speed) <= abs(linear)
    assert speed * linear >= 0.0
    # Keep the command for one period of the laser, then brake at the body's own limit.
    pose, clearance = ORIGIN, math.inf
    ratio = 0.0 if speed == 0.0 else angular / speed
    for tick in range(100):
        braked = max(abs(speed) - max(0, tick - 20) * 0.01 * WAFFLE_PI.linear_acceleration_mps2, 0.0)
        pose = pose.turned(ratio * math.copysign(braked, speed) * 0.01).ahead(math.copysign(braked, speed) * 0.01)
        if len(cloud):
            clearance = min(clearance, float(np.hypot(*(cloud - (pose.x_m, pose.y_m)).T).min()))
    started = float(np.hypot(*cloud.T).min()) if len(cloud) else math.inf
    assert clearance > min(WAFFLE_PI.radius_m, started) - 0.01

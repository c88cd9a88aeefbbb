"""Mapping and localisation in a known world of straight walls."""

from __future__ import annotations

import math

import numpy as np
import pytest
from kinematic_body import EXACT, HARSH, TYPICAL, KinematicBody, Noise, box, cast_rays, polygon
from pilot import Pilot, offset

from robot.body import Scan
from robot.geometry import Point, Pose, Segment, wrap_angle
from robot.mapping import OccupancyGrid
from robot.mapping.lines import extract_segments
from robot.navigation import Reach, State

# A ring of corridors around a block with a niche, and four boxes in it.
RING = (
    polygon((-1, -1), (11, -1), (11, 7), (-1, 7))
    + polygon((1, 1), (9, 1), (9, 5), (6, 5), (6, 4), (4, 4), (4, 5), (1, 5))
    + box(4, -0.7, 0.4, 0.4)
    + box(10.6, 3, 0.3, 0.6)
    + box(5, 6.5, 0.5, 0.3)
    + box(-0.8, 3, 0.3, 0.3)
)
ROUND = (Point(10, 0), Point(10, 6), Point(0, 6), Point(0, 0))


def scan_from(walls: tuple[Segment, ...], pose: Pose) -> Scan:
    body = KinematicBody(walls, pose)
    scan = body.scan()
    assert scan is not None
    return scan


def wall_points(segments: tuple[Segment, ...], step_m: float = 0.02) -> np.ndarray:
    rows = []
    for s in segments:
        share = np.linspace(0.0, 1.0, max(2, round(s.length_m / step_m)))[:, None]
        rows.append((1 - share) * (s.start.x_m, s.start.y_m) + share * (s.end.x_m, s.end.y_m))
    return np.concatenate(rows)


def share_within(points: np.ndarray, segments: tuple[Segment, ...], distance_m: float) -> float:
    """The share of ``points`` that lie within ``distance_m`` of any of ``segments``."""
    nearest = np.full(len(points), np.inf)
    for s in segments:
        start = np.array([s.start.x_m, s.start.y_m])
        along = np.array([s.end.x_m, s.end.y_m]) - start
        t = np.clip((points - start) @ along / (along @ along), 0.0, 1.0)
        nearest = np.minimum(nearest, np.hypot(*(points - start - t[:, None] * along).T))
    return float((nearest < distance_m).mean())


def seen_part(walls: tuple[Segment, ...], poses: list[Pose]) -> np.ndarray:
    """Points of ``walls`` that some beam from one of ``poses`` met within range."""
    angles = np.arange(360) * (math.tau / 360)
    rows = np.array([[s.start.x_m, s.start.y_m, s.end.x_m, s.end.y_m] for s in walls])
    hits = []
    for pose in poses:
        ranges = cast_rays(rows, pose, angles)
        met = ranges <= 3.4
        bearings = angles[met] + pose.yaw_rad
        hits.append(
            np.column_stack([pose.x_m + ranges[met] * np.cos(bearings), pose.y_m + ranges[met] * np.sin(bearings)])
        )
    return np.concatenate(hits)


@pytest.mark.parametrize("noise", [TYPICAL, HARSH])
def test_a_lap_maps_what_was_seen_and_keeps_the_robot_in_its_place(noise: Noise) -> None:
    pilot = Pilot(KinematicBody(RING, noise=noise, seed=5))
    poses = [pilot.body.pose]
    for place in ROUND:
        assert pilot.pursue(Reach(place), watch=lambda _: poses.append(pilot.body.pose) or False).state is State.ARRIVED
    segments = pilot.mapper.segments()
    assert share_within(seen_part(RING, poses[::20]), segments, 0.05) >= 0.95
    assert share_within(wall_points(segments), RING, 0.05) >= 0.97
    assert len(segments) <= 1.3 * len(RING)
    assert offset(pilot.pose, pilot.body.pose) < 0.05
    assert abs(wrap_angle(pilot.pose.yaw_rad - pilot.body.pose.yaw_rad)) < math.radians(1.0)
    assert offset(pilot.body.odometry().pose, pilot.body.pose) > 0.1  # there was something to correct


def test_walls_keep_still_while_the_robot_stands_and_the_map_keeps_its_id() -> None:
    pilot = Pilot(KinematicBody(RING, noise=TYPICAL, seed=2))
    pilot.pursue(Reach(Point(2, 0)))
    pilot.rest(5.0)
    before = pilot.mapper.message()
    pilot.rest(5.0)
    after = pilot.mapper.message()
    moved = [a for a, b in zip(before.segments, after.segments, strict=True) if a != b]
    assert len(moved) <= len(before.segments) // 4
    assert pilot.mapper.message() == after


def test_the_same_run_twice_gives_the_same_poses_and_map_to_the_last_digit() -> None:
    def run() -> tuple[Pose, object]:
        pilot = Pilot(KinematicBody(RING, noise=TYPICAL, seed=9))
        pilot.pursue(Reach(Point(9.5, 0.2)))
        return pilot.pose, pilot.mapper.message()

    assert run() == run()


def test_one_scan_of_a_room_gives_its_four_walls_with_the_robot_on_their_left() -> None:
    room = polygon((-2, -1.5), (2, -1.5), (2, 1.5), (-2, 1.5))
    segments = extract_segments(scan_from(room, Pose(0.3, 0.2, 0.0)))
    assert len(segments) == 4
    for s in segments:
        assert wrap_angle(s.start.bearing_to(Point(0, 0)) - s.direction_rad) > 0.0


def test_the_grid_grows_in_every_direction_and_knows_free_from_occupied_from_unknown() -> None:
    grid = OccupancyGrid()
    beams = Scan(0.0, np.array([0.0, math.pi / 2]), np.array([2.0, np.inf]), 0.12, 3.5)
    for x_m, y_m in ((0.0, 0.0), (-37.0, 12.0), (60.0, -45.0)):
        grid.update(Pose(x_m, y_m, 0.0), beams)
        assert grid.at(Point(x_m + 2.0, y_m)) > 0.5
        assert grid.at(Point(x_m + 1.0, y_m)) < 0.0
        assert grid.at(Point(x_m, y_m + 3.3)) < 0.0  # free as far as nothing was heard
        assert grid.at(Point(x_m + 2.5, y_m)) == 0.0
    assert grid.at(Point(2.0, 0.0)) > 0.5  # still there after growing
    assert grid.at(Point(1e4, 1e4)) == 0.0
    assert grid.known_cells == np.count_nonzero(grid.log_odds)


def test_a_thing_that_was_taken_away_leaves_the_grid_and_the_map() -> None:
    room = polygon((-2, -1.5), (2, -1.5), (2, 1.5), (-2, 1.5))
    body = KinematicBody(room + box(1.2, 0, 0.3, 0.8), noise=EXACT)
    pilot = Pilot(body)
    pilot.rest(4.0)
    assert share_within(wall_points(box(1.2, 0, 0.3, 0.8)[3:]), pilot.mapper.segments(), 0.05) > 0.9
    body.set_walls(room)
    pilot.rest(8.0)
    assert pilot.mapper.grid.at(Point(1.05, 0.0)) < 0.0
    assert share_within(wall_points(pilot.mapper.segments()), room, 0.05) > 0.99

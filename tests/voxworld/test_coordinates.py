"""The paper's formulas of section 3.3.1 and their inverse."""

from __future__ import annotations

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from robot.geometry import Point, Pose, Segment, wrap_angle
from voxworld.coordinates import (
    Cuboid,
    VirtualPoint,
    to_cuboid,
    to_map,
    to_map_pose,
    to_segment,
    to_virtual,
    to_virtual_rotation,
)

coordinates = st.floats(-100, 100, allow_nan=False)
points = st.builds(Point, coordinates, coordinates)
angles = st.floats(-math.pi, math.pi, allow_nan=False)


@given(points)
def test_a_place_comes_back_from_the_virtual_world(place: Point) -> None:
    assert to_map(to_virtual(place, 0.3)) == place


@given(points, angles)
def test_a_pose_comes_back_from_the_virtual_world(place: Point, yaw_rad: float) -> None:
    back = to_map_pose(to_virtual(place), to_virtual_rotation(yaw_rad))
    assert back.point == place
    assert wrap_angle(back.yaw_rad - yaw_rad) == pytest.approx(0, abs=1e-12)


def test_ahead_is_z_and_left_is_minus_x() -> None:
    assert to_virtual(Point(2.0, 0.0)) == VirtualPoint(0.0, 0.0, 2.0)
    assert to_virtual(Point(0.0, 1.0)) == VirtualPoint(-1.0, 0.0, 0.0)


def test_turning_left_is_a_negative_rotation_about_y() -> None:
    assert to_virtual_rotation(math.pi / 2) == -math.pi / 2


@given(points, points)
def test_a_wall_comes_back_from_its_cuboid(start: Point, end: Point) -> None:
    assume(start.distance_to(end) > 0.01)
    back = to_segment(to_cuboid(Segment(start, end)))
    kept = min(
        max(back.start.distance_to(start), back.end.distance_to(end)),
        max(back.start.distance_to(end), back.end.distance_to(start)),
    )
    # asin near +-90 degrees keeps only half of the digits.
    assert kept < 1e-6 * max(1.0, start.distance_to(end))


@given(points, points)
def test_both_ways_of_naming_a_wall_make_one_cuboid(start: Point, end: Point) -> None:
    assume(start.distance_to(end) > 0.01)
    there, back = to_cuboid(Segment(start, end)), to_cuboid(Segment(end, start))
    assert (there.centre, there.length_m) == (back.centre, back.length_m)
    turned = math.remainder(there.rotation_rad - back.rotation_rad, math.pi)
    assert turned == pytest.approx(0, abs=1e-6)


@given(points, points)
def test_the_cuboid_has_the_length_of_the_wall(start: Point, end: Point) -> None:
    assert to_cuboid(Segment(start, end)).length_m == pytest.approx(start.distance_to(end))


@pytest.mark.parametrize(
    ("end", "rotation_deg"),
    [
        (Point(0.0, -2.0), 0.0),  # to the right: along X
        (Point(0.0, 2.0), 0.0),  # to the left: the same wall
        (Point(2.0, -2.0), -45.0),
        (Point(2.0, 2.0), 45.0),
        (Point(2.0, 0.0), -90.0),  # straight ahead, where the paper's sgn(0) would leave it lying across
    ],
)
def test_rotations_by_the_formula(end: Point, rotation_deg: float) -> None:
    cuboid = to_cuboid(Segment(Point(0.0, 0.0), end))
    assert math.degrees(cuboid.rotation_rad) == pytest.approx(rotation_deg)


def test_a_wall_of_no_length_is_a_cuboid_of_no_length() -> None:
    place = Point(1.0, 2.0)
    assert to_cuboid(Segment(place, place)) == Cuboid(VirtualPoint(-2.0, 0.0, 1.0), 0.0, 0.0)


def test_a_pose_looks_the_way_it_should() -> None:
    pose = to_map_pose(VirtualPoint(-1.0, 0.0, 2.0), -math.pi / 2)
    assert (pose.x_m, pose.y_m) == (2.0, 1.0)
    assert pose.yaw_rad == pytest.approx(Pose(0, 0, math.pi / 2).yaw_rad)

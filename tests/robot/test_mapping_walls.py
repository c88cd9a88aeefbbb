"""Merging line segments, and walls that last."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from robot.body import Scan
from robot.geometry import Point, Pose, Segment
from robot.mapping.grid import OccupancyGrid
from robot.mapping.walls import Wall, WallMap, half_circle, merge, merge_segments

directions = st.floats(-math.pi, math.pi)
coordinates = st.floats(-20.0, 20.0)
lengths = st.floats(0.2, 10.0)


def segment(x_m: float, y_m: float, direction_rad: float, length_m: float) -> Segment:
    middle = Point(x_m, y_m)
    return Segment(middle.moved(-length_m / 2, direction_rad), middle.moved(length_m / 2, direction_rad))


@given(coordinates, coordinates, directions, lengths, lengths, st.floats(-0.1, 0.1), st.booleans())
def test_merging_two_pieces_of_one_line_gives_that_line_at_any_orientation(
    x_m: float, y_m: float, direction: float, first_m: float, second_m: float, tilt: float, reverse: bool
) -> None:
    """Orientations on either side of the half circle's end must not average to the perpendicular."""
    first = Wall.of(segment(x_m, y_m, direction, first_m))
    second = Wall.of(segment(x_m, y_m, direction + tilt + (math.pi if reverse else 0.0), second_m))
    merged = merge(first, second)
    share = second_m / (first_m + second_m)
    assert abs(half_circle(merged.direction_rad - direction - share * tilt)) < 1e-6
    assert merged.length_m == pytest.approx(
        max(first_m * math.cos(share * tilt), second_m * math.cos((1 - share) * tilt)), abs=1e-6
    )


@given(coordinates, coordinates, directions, lengths, lengths, st.floats(0.0, 3.0))
def test_merging_is_weighted_by_length_and_reaches_the_outermost_ends(
    x_m: float, y_m: float, direction: float, first_m: float, second_m: float, shift_m: float
) -> None:
    first = segment(x_m, y_m, direction, first_m)
    far = first.midpoint.moved(shift_m, direction)
    second = segment(far.x_m, far.y_m, direction, second_m)
    merged = merge(Wall.of(first), Wall.of(second))
    assert merged.centre.distance_to(first.midpoint) == pytest.approx(
        shift_m * second_m / (first_m + second_m), abs=1e-6
    )
    ends = [merged.project(p)[0] for p in (first.start, first.end, second.start, second.end)]
    assert merged.length_m == pytest.approx(max(ends) - min(ends), abs=1e-6)


def pieces_of_a_square(seed: int) -> list[Segment]:
    """A 6 m square's sides in overlapping noisy pieces, in random order and directions."""
    rng = random.Random(seed)
    corners = [Point(0, 0), Point(6, 0), Point(6, 6), Point(0, 6)]
    found = []
    for start, end in zip(corners, corners[1:] + corners[:1], strict=True):
        along = start.bearing_to(end)
        for first_m in np.arange(0.0, 5.1, 0.5):
            a, b = start.moved(float(first_m), along), start.moved(float(first_m) + 0.9, along)
            noisy = [Point(p.x_m + rng.gauss(0, 0.008), p.y_m + rng.gauss(0, 0.008)) for p in (a, b)]
            found.append(Segment(*(noisy if rng.random() < 0.5 else noisy[::-1])))
    rng.shuffle(found)
    return found


def test_pieces_of_a_square_merge_into_its_four_sides() -> None:
    merged = merge_segments(pieces_of_a_square(1))
    assert len(merged) == 4
    assert all(s.length_m == pytest.approx(6.0, abs=0.15) for s in merged)


def test_the_two_faces_of_a_wall_stay_apart_and_a_doorway_stays_open() -> None:
    walls = WallMap()
    for s in (segment(0, 0, 0, 4), segment(0, 0.04, math.pi, 4), segment(4.9, 0, 0, 4)):
        walls.add(s)
    assert len(walls) == 3


def test_a_piece_that_closes_a_gap_joins_the_walls_on_both_sides_under_the_older_identity() -> None:
    walls = WallMap()
    walls.add(segment(0, 0, 0, 2))
    walls.add(segment(3, 0, 0, 2))
    walls.add(segment(1.5, 0, 0, 2))
    (wall,) = walls
    assert wall.id == 0
    assert wall.length_m == pytest.approx(5.0)


def test_walls_far_from_the_hash_origin_are_found_again() -> None:
    walls = WallMap()
    for _ in range(3):
        walls.add(segment(-1234.5, 987.6, 2.0, 7.0))
    (wall,) = walls
    assert wall.sightings == 3


def emptied(grid: OccupancyGrid, left_m: float, right_m: float) -> None:
    """Mark the strip around y = 0 from ``left_m`` to ``right_m`` as seen through."""
    xs = np.arange(left_m, right_m, 0.025)
    for x_m in xs:
        beam = Scan(0.0, np.array([math.pi / 2]), np.array([2.0]), 0.1, 3.0)
        for _ in range(4):
            grid.update(Pose(float(x_m), -1.0, 0.0), beam)


def test_a_wall_seen_through_goes_and_one_seen_through_in_the_middle_becomes_two() -> None:
    walls, grid = WallMap(), OccupancyGrid()
    walls.add(segment(0, 0, 0, 4))
    emptied(grid, -0.5, 0.6)
    walls.prune(grid, Point(0, 0), 4.0)
    older, newer = walls
    assert (older.id, newer.id) == (0, 1)
    assert older.length_m == pytest.approx(1.5, abs=0.15)
    assert newer.length_m == pytest.approx(1.4, abs=0.15)
    emptied(grid, -2.1, 2.1)
    walls.prune(grid, Point(0, 0), 4.0)
    assert not len(walls)

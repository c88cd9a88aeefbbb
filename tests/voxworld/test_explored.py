"""Which ground counts as seen."""

from __future__ import annotations

import math

import pytest

from robot.geometry import Point, Segment
from voxworld.explored import CELL_M, RANGE_M, Explored

WALL = (Segment(Point(1.0, -5.0), Point(1.0, 5.0)),)


def covers(explored: Explored, place: Point) -> bool:
    return any(x1 <= place.x_m < x2 and y1 <= place.y_m < y2 for x1, y1, x2, y2 in explored.rectangles_m())


def test_in_the_open_a_disc_of_the_lasers_range_is_seen() -> None:
    explored = Explored().seen_from(Point(0.3, -0.2), ())
    assert explored.area_m2 == pytest.approx(math.pi * RANGE_M**2, rel=0.02)


def test_what_is_behind_a_wall_is_not_seen() -> None:
    explored = Explored().seen_from(Point(0.0, 0.0), WALL)
    assert covers(explored, Point(0.8, 0.5))
    assert not covers(explored, Point(1.3, 0.5))


def test_ground_once_seen_stays_seen() -> None:
    explored = Explored().seen_from(Point(0.0, 0.0), WALL).seen_from(Point(-8.0, 3.0), WALL)
    assert covers(explored, Point(0.5, 0.0))
    assert covers(explored, Point(-8.0, 3.0))


def test_rectangles_cover_every_seen_cell_once() -> None:
    explored = Explored().seen_from(Point(0.0, 0.0), WALL).seen_from(Point(-2.0, 1.0), WALL)
    area_m2 = sum((x2 - x1) * (y2 - y1) for x1, y1, x2, y2 in explored.rectangles_m())
    assert area_m2 == pytest.approx(explored.area_m2)
    assert area_m2 / CELL_M**2 > 1000

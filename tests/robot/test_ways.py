"""What navigation is measured against: shortest ways, and the ideal explorer's."""

from __future__ import annotations

import math
import random

import pytest
import shapely
from shapely import Geometry

from benchmarks._course import Course
from benchmarks._drive import world
from benchmarks._explorer import explored_m
from benchmarks._truth import ROBOT_RADIUS_M, Faces
from benchmarks._ways import Ways
from robot.geometry import Point

START, GOAL = Point(1.0, 2.0), Point(7.0, 2.0)


def shortest_m(*things: Geometry) -> float:
    """From START to GOAL in a room of 8 by 10 m in which there are ``things``."""
    walls = shapely.box(-0.1, -0.1, 8.1, 10.1).difference(shapely.box(0, 0, 8, 10))
    ground = shapely.union_all([walls, *things])
    return Ways(ground, ROBOT_RADIUS_M, ground.envelope).length_m(START, GOAL)


def test_the_shortest_way_is_straight_where_nothing_is_between_and_infinite_where_no_way_is() -> None:
    assert shortest_m() == pytest.approx(6.0)
    assert math.isinf(shortest_m(shapely.box(4, -1, 4.1, 11)))


def test_the_shortest_way_keeps_the_robots_radius_from_a_corner_and_is_never_overstated() -> None:
    """Two tangents to the circle around the thin wall's end, and the arc between them."""
    away_m = math.hypot(3.0, 2.0)
    tangent_m = math.sqrt(away_m**2 - ROBOT_RADIUS_M**2)
    arc_rad = math.tau - 2 * math.atan2(3.0, 2.0) - 2 * math.acos(ROBOT_RADIUS_M / away_m)
    true_m = 2 * tangent_m + arc_rad * ROBOT_RADIUS_M
    found_m = shortest_m(shapely.LineString([(4, -1), (4, 4)]).buffer(1e-6))
    assert true_m * 0.99 < found_m <= true_m + 1e-4


@pytest.mark.parametrize("name", ["figure3", "maze"])
def test_the_ideal_explorer_finds_every_goal_and_none_by_less_than_the_shortest_way(name: str) -> None:
    scene = world(name)
    course, faces = Course(scene, random.Random(7)), Faces.of(scene)
    home = course.anywhere()
    for place in (course.anywhere().point for _ in range(5)):
        shortest = course.ways.length_m(home.point, place)
        explored = explored_m(faces, home.point, place)
        assert shortest * 0.99 - 0.02 <= explored < math.inf

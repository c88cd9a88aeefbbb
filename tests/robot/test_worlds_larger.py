"""The five larger worlds: the start is free, and every marker can be stood in front of and driven to."""

from __future__ import annotations

from pathlib import Path

import pytest
from shapely import MultiPolygon, Point, affinity, box, unary_union
from shapely.geometry.base import BaseGeometry

from robot.geometry import Pose
from robot.pybullet_body import PybulletBody
from robot.turtlebot3 import LIMITS
from voxml.scene import Scene, load_scene

WORLDS = Path(__file__).parents[2] / "corpora" / "worlds"
STAND_OFF_M = 0.35
ROOM_M = LIMITS.radius_m + 0.05  # the circle that the robot turns in, and a cell of its map

NAMES = ["apartment", "corridor", "lab", "maze", "hall"]


def world(name: str) -> Scene:
    return load_scene(WORLDS / f"{name}.yaml")


def upright(x_m: float, y_m: float, yaw_rad: float, length_m: float, width_m: float) -> BaseGeometry:
    outline = box(-length_m / 2, -width_m / 2, length_m / 2, width_m / 2)
    return affinity.translate(affinity.rotate(outline, yaw_rad, origin=(0, 0), use_radians=True), x_m, y_m)


def solid(scene: Scene) -> BaseGeometry:
    walls = [
        upright((w.x1_m + w.x2_m) / 2, (w.y1_m + w.y2_m) / 2, w.direction_rad, w.length_m, w.thickness_m)
        for w in scene.walls
    ]
    return unary_union(walls + [upright(o.x_m, o.y_m, o.yaw_rad, *o.size_m[:2]) for o in scene.objects])


def regions(scene: Scene) -> tuple[BaseGeometry, list[BaseGeometry]]:
    """Where the robot's centre may be: the part that holds the start, and the others that walls enclose."""
    stuff = solid(scene)
    free = stuff.envelope.difference(stuff.buffer(ROOM_M, quad_segs=32))
    parts = list(free.geoms) if isinstance(free, MultiPolygon) else [free]
    start = Point(scene.start.x_m, scene.start.y_m)
    home = [part for part in parts if part.covers(start)]
    assert len(home) == 1, "the start is not free"
    return home[0], [part for part in parts if part is not home[0]]


@pytest.mark.parametrize("name", NAMES)
def test_every_marker_has_a_place_in_front_of_it_that_can_be_driven_to(name: str) -> None:
    scene = world(name)
    home, _ = regions(scene)
    markers = [thing.marker for thing in scene.objects if thing.marker is not None]
    assert len(markers) >= 9
    for marker in markers:
        stand = Pose(marker.x_m, marker.y_m, marker.yaw_rad).ahead(STAND_OFF_M)
        assert home.covers(Point(stand.x_m, stand.y_m)), marker


@pytest.mark.parametrize("name", ["apartment", "lab", "maze"])
def test_some_places_cannot_be_driven_to(name: str) -> None:
    _, closed = regions(world(name))
    assert max(part.area for part in closed) > 0.2


@pytest.mark.parametrize(("name", "area_m2"), [("apartment", 25.0), ("corridor", 80.0)])
def test_doors_let_the_robot_through_into_the_rooms(name: str, area_m2: float) -> None:
    home, _ = regions(world(name))
    assert home.area > area_m2


def test_the_hall_is_forty_metres_square_with_a_hundred_markers() -> None:
    scene = world("hall")
    left, bottom, right, top = solid(scene).bounds
    assert (right - left, top - bottom) == pytest.approx((40.0, 40.0), abs=0.2)
    assert sorted(t.fiducial.id for t in scene.objects if t.fiducial) == list(range(1, 101))


@pytest.mark.parametrize("name", NAMES)
def test_everything_is_tall_enough_for_the_laser(name: str) -> None:
    assert all(thing.size_m[2] > 0.2 for thing in world(name).objects)


@pytest.mark.physics
@pytest.mark.parametrize("name", NAMES)
def test_the_simulator_builds_it_and_the_robot_touches_nothing_where_it_starts(name: str) -> None:
    body = PybulletBody(world(name))
    body.drive(0.0, 0.5)
    body.step(0.5)
    scan = body.scan()
    assert scan is not None
    assert (scan.ranges_m < scan.max_range_m).any()
    assert body.contacts() == ()
    body.close()

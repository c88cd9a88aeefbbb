"""The world model grows out of the robot's messages."""

from __future__ import annotations

import math
from importlib.resources import files

import numpy as np

from grounding import STAND_OFF_M, Entity, StandsFor, World, approach
from grounding.approach import is_free
from robot.geometry import Point, Pose, Segment
from robot.messages import Fiducial, Fiducials, Map, Odom
from voxml.scene import find_scene

FIGURE3 = find_scene("figure3", files("corpora") / "worlds")


def seen(*markers: tuple[str, float, float, float]) -> Fiducials:
    return Fiducials(tuple(Fiducial(name, (x, y, 0.1), (0.0, 0.0, yaw)) for name, x, y, yaw in markers))


def test_a_thing_is_known_when_its_fiducial_is_seen_and_is_where_it_was_seen() -> None:
    world = World.unexplored(FIGURE3)
    assert len(world.entities) == 0
    world = world.with_fiducials(seen(("1", 9.0, 8.0, 1.0)))
    assert [(e.id, e.type, e.attributes, e.pose) for e in world.entities.items] == [
        ("1", "block", ("red",), Pose(9.0, 8.0, 1.0))
    ]


def test_a_fiducial_that_stands_for_nothing_known_is_a_fiducial() -> None:
    world = World().with_fiducials(seen(("77", 1.0, 2.0, 0.0)))
    assert world.entities.items[0].type == "fiducial"


def test_teaching_renames_what_was_seen_and_what_will_be() -> None:
    world = World().with_fiducials(seen(("7", 1.0, 2.0, 0.0))).taught(StandsFor("7", "wastebasket", ("green",)))
    assert world.entities.items[0].type == "wastebasket"
    world = world.with_fiducials(seen(("7", 1.1, 2.0, 0.0)))
    assert (world.entities.items[0].type, world.entities.items[0].pose.x_m) == ("wastebasket", 1.1)


def test_unchanged_fiducials_keep_the_world_as_it_is() -> None:
    world = World().with_fiducials(seen(("7", 1.0, 2.0, 0.0)))
    assert world.with_fiducials(seen(("7", 1.0, 2.0, 0.0))) is world


def test_odometry_and_map_are_taken_over() -> None:
    wall = Segment(Point(0.0, 0.0), Point(1.0, 0.0))
    world = World().with_odom(Odom(1, 1, (1.0, 2.0, 0.0), (0.0, 0.0, 0.5), 0.0, 0.0, 3.0))
    world = world.with_map(Map(1, 1.0, 0.0, Point(0.0, 0.0), (wall,)))
    assert (world.robot, world.walls) == (Pose(1.0, 2.0, 0.5), (wall,))


def test_an_explored_world_has_everything_where_its_markers_are() -> None:
    world = World.explored(FIGURE3)
    assert sorted(e.id for e in world.entities.items) == ["1", "2", "3", "4", "5"]


# ------------------------------------------------------------------ approach
MARKER = Entity("1", "block", Pose(2.0, 0.0, math.pi), fiducial_id="1")


def test_one_stands_before_the_marker_and_faces_it() -> None:
    pose = approach(MARKER, ())
    assert math.isclose(pose.x_m, 2.0 - STAND_OFF_M)
    assert math.isclose(pose.y_m, 0.0, abs_tol=1e-9)
    assert math.isclose(pose.yaw_rad, 0.0, abs_tol=1e-9)


def test_where_a_wall_is_in_the_way_the_nearest_free_place_is_taken() -> None:
    wall = Segment(Point(1.0, 0.1), Point(1.9, 0.1))
    pose = approach(MARKER, (wall,))
    ends = np.array([[1.0, 0.1, 1.9, 0.1]])
    assert is_free(pose.point, ends)
    assert not is_free(Point(2.0 - STAND_OFF_M, 0.0), ends)
    assert pose.point.distance_to(MARKER.point) < 0.6
    assert math.isclose(pose.yaw_rad, pose.point.bearing_to(MARKER.point))


def test_a_marker_is_not_approached_through_a_wall() -> None:
    """A low wall right before the marker leaves only places from the side of it."""
    wall = Segment(Point(1.85, -0.02), Point(1.85, 1.0))
    pose = approach(MARKER, (wall,))
    assert pose.y_m < 0.0

"""What a ray through the screen points at."""

from __future__ import annotations

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from dialogue.events import PointedObject, PointedPlace, PointedRay
from grounding import World
from robot.geometry import Point, Pose, Segment
from voxml.scene import read_scene
from voxworld.cameras import Bounds, View, Viewpoint
from voxworld.nodes import Scene
from voxworld.pointing import dragged, floor_point, pointed_at
from voxworld.scene import scene_of
from voxworld.shared import Shared

BLOCK = """
name: one block
seed: 1
robot: {x: 0, y: 0, yaw_deg: 0}
walls: [[3, -2, 3, 2]]
objects:
  - {id: b, type: block, x: 2.0, y: 0.5, yaw_deg: 30, size: [0.2, 0.3, 0.4],
     fiducial: {id: 1, height: 0.2, face: front}}
"""
SCENE = scene_of(Shared().with_world(World.explored(read_scene(BLOCK))), {})
EYE = (-1.0, 0.0, 2.0)
metres = st.floats(-8, 8, allow_nan=False)


def towards(x_m: float, y_m: float, z_m: float) -> tuple[float, float, float]:
    return x_m - EYE[0], y_m - EYE[1], z_m - EYE[2]


@given(metres, metres, st.floats(0.1, 20), st.floats(0.1, 10))
def test_a_place_on_the_floor_is_found_again(x_m: float, y_m: float, height_m: float, stretch: float) -> None:
    eye = (0.5, -0.5, height_m)
    assume(math.dist(eye, (x_m, y_m, 0.0)) < 50)
    direction = tuple(stretch * (b - a) for a, b in zip(eye, (x_m, y_m, 0.0), strict=True))
    target = pointed_at(eye, direction, Scene())  # type: ignore[arg-type]
    assert isinstance(target, PointedPlace)
    assert target.place.distance_to(Point(x_m, y_m)) < 1e-6


@given(st.floats(-0.09, 0.09), st.floats(-0.14, 0.14), st.floats(0.02, 0.38))
def test_any_part_of_a_thing_is_the_thing(x_m: float, y_m: float, z_m: float) -> None:
    part = Pose(2.0, 0.5, math.radians(30)).to_map(Point(x_m, y_m))
    assert pointed_at(EYE, towards(part.x_m, part.y_m, z_m), SCENE) == PointedObject("1")


def test_beside_a_thing_is_the_floor() -> None:
    target = pointed_at(EYE, towards(1.5, -0.5, 0.0), SCENE)
    assert isinstance(target, PointedPlace)
    assert target.place.distance_to(Point(1.5, -0.5)) < 1e-9


def test_its_label_is_the_thing() -> None:
    assert pointed_at(EYE, towards(2.0, 0.5, 0.5), SCENE) == PointedObject("1")


def test_a_thing_behind_a_wall_is_not_pointed_at() -> None:
    walled = scene_of(Shared().with_world(World(walls=(Segment(Point(1, -2), Point(1, 2)),), entities=_entities())), {})
    low_eye = (0.0, 0.5, 0.3)
    target = pointed_at(low_eye, (1.0, 0.0, 0.0), walled)
    assert isinstance(target, PointedPlace)
    assert target.place.x_m == pytest.approx(1.0, abs=0.05)


def test_the_sky_is_nothing() -> None:
    assert pointed_at(EYE, (0.0, -1.0, 0.3), SCENE) is None


def test_a_drag_is_a_direction_and_a_twitch_is_not() -> None:
    ray = dragged(Point(0, 0), Point(1, 1))
    assert ray == PointedRay(Point(0, 0), pytest.approx(math.pi / 4))  # type: ignore[arg-type]
    assert dragged(Point(0, 0), Point(0.01, 0.0)) is None


def test_the_floor_below_a_point_in_the_air() -> None:
    place = floor_point((0.0, 0.0, 2.0), (1.0, 0.0, 1.0))
    assert place is not None
    assert place.distance_to(Point(2.0, 0.0)) < 1e-9


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(0, 6), st.floats(0, 6), st.floats(0.5, 2.5))
def test_the_birds_eye_view_holds_its_bounds(x_m: float, y_m: float, dx_m: float, dy_m: float, aspect: float) -> None:
    bounds = Bounds(Point(x_m, y_m), Point(x_m + dx_m, y_m + dy_m))
    fov_rad = math.radians(60)
    camera = Viewpoint(View.BIRDS_EYE).camera(Pose(0, 0, 0), bounds, fov_rad, aspect)
    for corner in ((x_m, y_m), (x_m + dx_m, y_m), (x_m, y_m + dy_m), (x_m + dx_m, y_m + dy_m)):
        across, up = _seen(camera.position_m, camera.look_at_m, (*corner, 0.0))
        assert abs(up) <= math.tan(fov_rad / 2) + 1e-9
        assert abs(across) <= math.tan(fov_rad / 2) * aspect + 1e-9


def _seen(eye: tuple[float, ...], focus: tuple[float, ...], place: tuple[float, ...]) -> tuple[float, float]:
    """Across and up at distance 1, for an eye that looks along the map's x, downwards."""
    ahead = [b - a for a, b in zip(eye, focus, strict=True)]
    length = math.hypot(*ahead)
    fx, fz = ahead[0] / length, ahead[2] / length
    dx, dy, dz = (b - a for a, b in zip(eye, place, strict=True))
    depth = dx * fx + dz * fz
    return dy / depth, (-dx * fz + dz * fx) / depth


def _entities() -> object:
    return World.explored(read_scene(BLOCK)).entities

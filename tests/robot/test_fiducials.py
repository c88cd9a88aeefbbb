"""Markers are read where they are, from the pictures that the simulated camera takes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pytest

from robot.body import Image
from robot.fiducial_map import FiducialMap, News
from robot.fiducials import FiducialDetector, Sighting
from robot.geometry import Point, Pose
from robot.pybullet_body import PybulletBody
from robot.simulation.senses import CAMERA
from voxml.scene import Face, FiducialMount, Scene, SceneObject, Start

SIZE_M = 0.10
FOCAL_PX = CAMERA.focal_px


@dataclass(frozen=True)
class View:
    """A marker as the body's camera has it: what is so, and what was read."""

    id: int
    place: Pose  # body frame
    height_m: float
    shorter_side_px: float
    found: tuple[Sighting, ...]


def look(id: int, distance_m: float, oblique_rad: float, bearing_rad: float, height_m: float, seed: int = 0) -> View:
    """A marker ``distance_m`` from the camera, turned ``oblique_rad`` from facing it, ``bearing_rad`` to the left."""
    thing = SceneObject("board", "box", 0, 0, 0, (0.1, 0.3, 0.5), fiducial=FiducialMount(id, height_m, Face.FRONT))
    assert thing.marker is not None
    marker = Pose(thing.marker.x_m, thing.marker.y_m, thing.marker.yaw_rad)
    camera = marker.turned(oblique_rad).ahead(distance_m).turned(math.pi - bearing_rad)
    body = PybulletBody(
        Scene("view", seed, Start(0, 0, 0), (), (thing,), SIZE_M), start=camera.ahead(-CAMERA.mount_m[0])
    )
    image = body.image()
    assert image is not None
    found = FiducialDetector(body.camera, SIZE_M).detect(image)
    place = marker.relative_to(body.truth())
    body.close()
    return View(id, place, height_m, SIZE_M / distance_m * FOCAL_PX * math.cos(oblique_rad), found)


@pytest.fixture(scope="module")
def views() -> tuple[View, ...]:
    random = np.random.default_rng(8)
    return tuple(
        look(
            int(random.integers(1000)),
            random.uniform(0.4, 2.5),
            math.radians(random.uniform(-60, 60)),
            math.radians(random.uniform(-22, 22)),
            random.uniform(0.06, 0.25),
            seed,
        )
        for seed in range(60)
    )


def errors(views: tuple[View, ...]) -> Iterator[tuple[float, float]]:
    """Of each marker read: metres, and degrees."""
    for view in views:
        for sighting in view.found:
            place = (view.place.x_m, view.place.y_m, view.height_m)
            turned = math.remainder(sighting.yaw_rad - view.place.yaw_rad, math.tau)
            yield math.dist(sighting.position_m, place), abs(math.degrees(turned))


@pytest.mark.physics
def test_markers_of_24_pixels_are_found_and_none_is_misread(views: tuple[View, ...]) -> None:
    assert all(sighting.id == view.id for view in views for sighting in view.found)
    large = [view for view in views if view.shorter_side_px >= 24]
    assert len(large) > 20
    assert sum(bool(view.found) for view in large) >= 0.95 * len(large)


@pytest.mark.physics
def test_half_of_them_are_within_three_centimetres_and_three_degrees(views: tuple[View, ...]) -> None:
    metres, degrees = zip(*errors(views), strict=True)
    assert np.median(metres) < 0.02
    assert np.median(degrees) < 3.0
    assert np.quantile(metres, 0.9) < 0.08


@pytest.mark.physics
def test_a_near_marker_is_read_exactly_and_says_so() -> None:
    near, far = look(7, 0.5, 0.5, 0.1, 0.15), look(7, 2.2, 0.5, 0.1, 0.15)
    metres, degrees = next(errors((near,)))
    assert metres < 0.01
    assert degrees < 2.0
    assert near.found[0].position_deviation_m < far.found[0].position_deviation_m
    assert near.found[0].yaw_deviation_rad < far.found[0].yaw_deviation_rad


def test_nothing_is_read_where_there_is_no_marker() -> None:
    noise = np.random.default_rng(1).integers(0, 256, (480, 640, 3)).astype(np.uint8)
    detector = FiducialDetector(CAMERA, SIZE_M)
    for pixels in (noise, np.zeros_like(noise), np.full_like(noise, 255)):
        assert detector.detect(Image(0.0, pixels)) == ()


# ------------------------------------------------------------------ the map
FAR = Sighting(4, (2.0, 0.1, 0.2), math.pi, 0.10, 0.3)
NEAR = replace(FAR, position_m=(0.5, 0.0, 0.15), position_deviation_m=0.004, yaw_deviation_rad=0.02)


def test_a_fiducial_is_news_once_and_stands_in_the_map_frame() -> None:
    markers = FiducialMap()
    news = markers.observe((FAR,), Pose(1.0, 2.0, math.pi / 2))
    assert [item.news for item in news] == [News.FIRST_SEEN]
    assert markers.observe((FAR,), Pose(1.0, 2.0, math.pi / 2)) == ()
    fiducial = markers.message().fiducials[0]
    assert fiducial.id == "4"
    assert fiducial.location_m == pytest.approx((0.9, 4.0, 0.2))
    assert fiducial.orientation_rad == pytest.approx((0, 0, -math.pi / 2))


def test_a_near_sighting_outweighs_far_ones() -> None:
    markers = FiducialMap()
    for _ in range(5):
        markers.observe((FAR,), Pose(0, 0, 0))
    markers.observe((NEAR,), Pose(1.5, 0, 0))
    assert markers.message().fiducials[0].pose.point.distance_to(Point(2.0, 0.0)) < 0.03


def test_fusing_far_sightings_beats_each_of_them() -> None:
    random = np.random.default_rng(3)
    markers = FiducialMap()
    for _ in range(40):
        x_m, y_m = random.normal((2.0, 0.0), 0.05)
        yaw = math.pi + random.normal(0, 0.2)
        markers.observe(
            (replace(FAR, position_m=(x_m, y_m, 0.2), yaw_rad=yaw, position_deviation_m=0.07),), Pose(0, 0, 0)
        )
    fused = markers.message().fiducials[0]
    assert fused.pose.point.distance_to(Point(2.0, 0.0)) < 0.03
    assert abs(math.remainder(fused.orientation_rad[2] - math.pi, math.tau)) < 0.1


def test_one_wild_sighting_moves_nothing_but_three_in_a_row_do() -> None:
    markers = FiducialMap()
    markers.observe((NEAR,), Pose(0, 0, 0))
    moved = replace(NEAR, position_m=(0.5, 1.0, 0.15))
    assert markers.observe((moved,), Pose(0, 0, 0)) == ()
    assert markers.message().fiducials[0].location_m[1] == 0.0
    markers.observe((NEAR,), Pose(0, 0, 0))
    news = [item for _ in range(3) for item in markers.observe((moved,), Pose(0, 0, 0))]
    assert [item.news for item in news] == [News.MOVED]
    assert markers.message().fiducials[0].location_m[1] == 1.0
    markers.clear()
    assert markers.message().fiducials == ()

"""The paper's worlds: every marker is seen from the start, and can be driven to or not, as the files say."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from robot.fiducials import FiducialDetector
from robot.geometry import Pose
from robot.pybullet_body import PybulletBody
from robot.turtlebot3 import LIMITS
from voxml.scene import Scene, load_scene

WORLDS = Path(__file__).parents[2] / "corpora" / "worlds"
CELL_M = 0.01
STAND_OFF_M = 0.35

STARTS = [(0, 0, 0), (-0.25, 0.25, 8), (0.25, 0.25, 8), (0.25, -0.25, 8), (0.2, 0.2, -8), (-0.25, -0.25, -8), (0, 0, 8)]


def world(name: str) -> Scene:
    return load_scene(WORLDS / f"{name}.yaml")


def clearance_m(scene: Scene) -> NDArray[np.float64]:
    """How far each cell's centre is from the nearest wall or object; x is the first index, from -2 m."""
    x, y = np.meshgrid(np.arange(-2, 6.5, CELL_M), np.arange(-4, 4, CELL_M), indexing="ij")
    free = np.ones(x.shape, dtype=bool)
    boxes = [
        ((w.x1_m + w.x2_m) / 2, (w.y1_m + w.y2_m) / 2, w.direction_rad, w.length_m + w.thickness_m, w.thickness_m)
        for w in scene.walls
    ]
    boxes += [(o.x_m, o.y_m, o.yaw_rad, o.size_m[0], o.size_m[1]) for o in scene.objects]
    for centre_x, centre_y, yaw, length, width in boxes:
        dx, dy = x - centre_x, y - centre_y
        along, across = dx * math.cos(yaw) + dy * math.sin(yaw), dy * math.cos(yaw) - dx * math.sin(yaw)
        free &= (abs(along) > length / 2) | (abs(across) > width / 2)
    return np.asarray(ndimage.distance_transform_edt(free)) * CELL_M


def cell(x_m: float, y_m: float) -> tuple[int, int]:
    return round((x_m + 2) / CELL_M), round((y_m + 4) / CELL_M)


@pytest.mark.physics
@pytest.mark.parametrize("name", ["figure3", "figure3_blocked"])
@pytest.mark.parametrize("start", STARTS)
def test_all_five_markers_are_seen_from_the_start(name: str, start: tuple[float, float, float]) -> None:
    scene = world(name)
    x_m, y_m, yaw_deg = start
    body = PybulletBody(scene, start=Pose(x_m, y_m, math.radians(yaw_deg)))
    image = body.image()
    assert image is not None
    found = FiducialDetector(body.camera, scene.marker_size_m).detect(image)
    body.close()
    assert [sighting.id for sighting in found] == [1, 2, 3, 4, 5]
    for sighting in found:
        thing = scene.with_fiducial(sighting.id)
        assert thing is not None
        assert thing.marker is not None
        truth = Pose(thing.marker.x_m, thing.marker.y_m, thing.marker.yaw_rad).relative_to(
            Pose(x_m, y_m, math.radians(yaw_deg))
        )
        assert math.dist(sighting.position_m, (truth.x_m, truth.y_m, thing.marker.z_m)) < 0.30


@pytest.mark.parametrize(("name", "reachable"), [("figure3", {1, 2, 3, 4, 5}), ("figure3_blocked", {1, 2, 3, 4})])
def test_the_places_before_the_markers_are_free_and_the_right_ones_reachable(name: str, reachable: set[int]) -> None:
    scene = world(name)
    clear = clearance_m(scene)
    regions, _ = ndimage.label(clear > LIMITS.radius_m + 0.05)
    home = regions[cell(scene.start.x_m, scene.start.y_m)]
    assert home != 0
    reached = set()
    for thing in scene.objects:
        assert thing.marker is not None
        assert thing.fiducial is not None
        stand = Pose(thing.marker.x_m, thing.marker.y_m, thing.marker.yaw_rad).ahead(STAND_OFF_M)
        assert clear[cell(stand.x_m, stand.y_m)] >= 0.22 + 0.05
        near = clear[cell(stand.x_m, stand.y_m)] > LIMITS.radius_m
        assert near
        if (regions[tuple(slice(c - 5, c + 6) for c in cell(stand.x_m, stand.y_m))] == home).any():
            reached.add(thing.fiducial.id)
    assert reached == reachable


def test_three_are_on_the_right_and_two_on_the_left_staggered_along_the_way() -> None:
    things = world("figure3").objects
    right = [thing.x_m for thing in things if thing.y_m < 0]
    left = [thing.x_m for thing in things if thing.y_m > 0]
    assert (len(right), len(left)) == (3, 2)
    along = sorted(right + left)
    assert right == sorted(right)
    assert left == sorted(left)
    assert len(set(along)) == 5
    assert {thing.type for thing in things} >= {"block", "wastebasket"}
    assert any("red" in thing.attributes and thing.type == "block" for thing in things)

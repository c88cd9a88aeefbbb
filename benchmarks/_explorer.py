"""The ideal explorer: how short a way can be expected to be for one who does not know the map.

A circle as large as the robot with a laser like its own, but it senses without noise, knows exactly where it is and has
no dynamics. It assumes that what it has not seen is free, takes the shortest way by what it has seen, and thinks again
the moment that way turns out to be blocked: the greedy strategy of D* Lite (Koenig and Likhachev, AAAI 2002), here
in continuous space. What it drives beyond the shortest way of one who knows the map is the price of not knowing it.
"""

from __future__ import annotations

import math

import numpy as np
import shapely
import shapely.ops
from numpy.typing import NDArray
from shapely import Geometry

from robot.geometry import Point, Pose

from ._truth import ROBOT_RADIUS_M, Faces, Seen
from ._ways import NO_WAY, Floats, Way, Ways

STEP_M = 0.05  # between looks
CLEAR_M = 0.01  # of what is found out while passing by, so much of the circle is let go
BEYOND_M = 2.0  # it does not know where the world ends
LOOKS_MAX = 20_000


def explored_m(faces: Faces, start: Point, goal: Point) -> float:
    """The length of the ideal explorer's way; inf when it finds none."""
    (left, bottom), (right, top) = faces.starts.min(axis=0), faces.starts.max(axis=0)
    outline = shapely.box(left - BEYOND_M, bottom - BEYOND_M, right + BEYOND_M, top + BEYOND_M)
    seen = Seen(faces)
    here, driven_m, way, known = start, 0.0, NO_WAY, -1
    for _ in range(LOOKS_MAX):
        seen.look(Pose(here.x_m, here.y_m, 0.0))
        count = sum(int(swept.sum()) for swept in seen.swept)
        if count != known:
            known = count
            way = _thought_again(_surfaces(faces, seen), outline, way, here, goal)
        if way.length_m <= STEP_M or math.isinf(way.length_m):
            return driven_m + way.length_m
        way = _rest(way)
        driven_m += STEP_M
        here = Point(*way.corners[0].tolist())
    return math.inf


def _thought_again(surfaces: Geometry, outline: Geometry, way: Way, here: Point, goal: Point) -> Way:
    """The same way while it is clear, else the shortest one by what has been seen."""
    if len(way.corners) and not surfaces.intersects(shapely.linestrings(way.corners).buffer(ROBOT_RADIUS_M - CLEAR_M)):
        return way
    standing = shapely.Point(here.x_m, here.y_m).buffer(STEP_M)  # however near the newest surface is
    return Ways(surfaces, ROBOT_RADIUS_M, outline, standing).shortest(here, goal)


def _surfaces(faces: Faces, seen: Seen) -> Geometry:
    """The stretches of the faces that have been seen."""
    lines = [line for face, swept in enumerate(seen.swept) if swept.any() for line in _stretches(faces, face, swept)]
    return shapely.multilinestrings(shapely.linestrings(np.array(lines).reshape(-1, 2, 2)))


def _stretches(faces: Faces, face: int, swept: NDArray[np.bool_]) -> list[Floats]:
    """Start and end, shape (2, 2), of each run of swept samples."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], swept, [False]]).astype(np.int8)))
    start, along = faces.starts[face], faces.ends[face] - faces.starts[face]
    return [start + np.outer(run / len(swept), along) for run in edges.reshape(-1, 2)]


def _rest(way: Way) -> Way:
    """What is left of a way after one step."""
    line = shapely.linestrings(way.corners)
    left = shapely.ops.substring(line, STEP_M, line.length)
    return Way(np.asarray(left.coords), left.length)

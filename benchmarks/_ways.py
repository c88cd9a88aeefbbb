"""Shortest ways for a round robot among obstacles of any shape: A* over the corners of the grown obstacles.

Computed by shapely; nothing of the robot's own code takes part.
"""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import Geometry

from robot.geometry import Point

Floats = NDArray[np.float64]

_QUARTER_SEGMENTS = 3  # of the chords that stand for a quarter of a circle around a corner
NOWHERE = shapely.Point()
_TOUCH_M = 1e-6  # a way may run along an obstacle's edge


@dataclass(frozen=True, slots=True)
class Way:
    """The corners of a way, shape (corners, 2), and its length; no corners and inf where there is none."""

    corners: Floats
    length_m: float


NO_WAY = Way(np.empty((0, 2)), math.inf)


class Ways:
    """Where a round robot can be and the shortest ways between: the visibility graph of grown obstacles, found lazily.

    Grown corners are drawn as chords of the true arcs, so a way is never longer than the true optimum.
    """

    def __init__(self, solid: Geometry, radius_m: float, outline: Geometry, free: Geometry = NOWHERE) -> None:
        """Ways run on the ground of ``outline``; of the robot's centre it is known that it can be at ``free``."""
        grown = solid.buffer(radius_m, quad_segs=_QUARTER_SEGMENTS).difference(free)
        self._blocked = grown.buffer(-_TOUCH_M)
        shapely.prepare(self._blocked)
        self._corners = _corners(outline.difference(grown), outline)
        self._neighbours: dict[int, tuple[NDArray[np.intp], Floats]] = {}

    def length_m(self, start: Point, end: Point) -> float:
        """Of the shortest way; inf if there is none."""
        return self.shortest(start, end).length_m

    def shortest(self, start: Point, end: Point) -> Way:
        """The shortest way from ``start`` to ``end``."""
        first, last = np.array([start.x_m, start.y_m]), np.array([end.x_m, end.y_m])
        finish = len(self._corners)  # numbers the end; -1 the start
        to_end = dict(zip(*(each.tolist() for each in self._seen_from(last)), strict=True))
        direct = self._seen(first, last[None])
        before, lengths, done = {-1: -1}, {-1: 0.0}, set[int]()
        queue = [(start.distance_to(end), -1)]
        while queue:
            _, here = heapq.heappop(queue)
            if here == finish:
                return Way(self._traced(before, first, last), lengths[finish])
            if here in done:
                continue
            done.add(here)
            numbers, steps_m = self._seen_from(first) if here < 0 else self._neighbours_of(here)
            onward = list(zip(numbers.tolist(), steps_m.tolist(), strict=True))
            if here < 0 and direct.any():
                onward.append((finish, start.distance_to(end)))
            elif here in to_end:
                onward.append((finish, to_end[here]))
            for there, step_m in onward:
                length_m = lengths[here] + step_m
                if length_m < lengths.get(there, math.inf):
                    lengths[there], before[there] = length_m, here
                    rest_m = 0.0 if there == finish else math.dist(self._corners[there], last)
                    heapq.heappush(queue, (length_m + rest_m, there))
        return NO_WAY

    def _traced(self, before: dict[int, int], first: Floats, last: Floats) -> Floats:
        way, here = [last], before[len(self._corners)]
        while here >= 0:
            way.append(self._corners[here])
            here = before[here]
        return np.array([first, *reversed(way)])

    def _neighbours_of(self, corner: int) -> tuple[NDArray[np.intp], Floats]:
        if corner not in self._neighbours:
            self._neighbours[corner] = self._seen_from(self._corners[corner])
        return self._neighbours[corner]

    def _seen_from(self, place: Floats) -> tuple[NDArray[np.intp], Floats]:
        """The numbers of the corners that a straight way reaches, and how far they are."""
        numbers = np.flatnonzero(self._seen(place, self._corners))
        return numbers, np.hypot(*(self._corners[numbers] - place).T)

    def _seen(self, place: Floats, others: Floats) -> NDArray[np.bool_]:
        lines = shapely.linestrings(np.stack([np.broadcast_to(place, others.shape), others], axis=1))
        return ~np.asarray(shapely.intersects(self._blocked, lines))


def reach(solid: Geometry, home: Point, radius_m: float) -> Callable[[Point], float]:
    """How far a place is from the ground that a circle of ``radius_m`` can be brought to from ``home``."""
    free = solid.envelope.difference(solid.buffer(radius_m))
    start = shapely.Point(home.x_m, home.y_m)
    part = next(part for part in shapely.get_parts(free) if part.covers(start))
    shapely.prepare(part)
    return lambda place: float(part.distance(shapely.Point(place.x_m, place.y_m)))


def _corners(free: Geometry, outline: Geometry) -> Floats:
    rings = [ring for part in shapely.get_parts(free) for ring in (part.exterior, *part.interiors)]
    corners = np.array([corner for ring in rings for corner in ring.coords[:-1]]).reshape(-1, 2)
    return np.asarray(corners[shapely.covers(outline, shapely.points(corners))])

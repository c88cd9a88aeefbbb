"""Persistent walls: line segments of many scans merged into few, found through a spatial hash.

Merging is Tavares and Padilha, "A new approach for merging edge line segments" (RecPad 1995): the merged line passes
through the weighted centroid with the weighted orientation, and reaches as far as the projections of all endpoints. The
weight of a fresh segment is its length, that of a wall all the length it was ever seen with, so that a wall known well
hardly moves. Orientations are compared on the half circle, where a line has no sense of direction and nothing can wrap.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter

from robot.geometry import Point, Segment, wrap_angle

from .grid import OccupancyGrid

OFFSET_GATE_M = 0.06
ANGLE_GATE_RAD = math.radians(8.0)
LOOSEST_ANGLE_GATE_RAD = math.radians(25.0)
GAP_GATE_M = 0.2
HASH_CELL_M = 1.0
HASH_PIECE_M = 2.0  # a wall is registered by the boxes around pieces of it, so that a long slanting one fills few cells
HASH_REACH_M = GAP_GATE_M + OFFSET_GATE_M  # two segments that may merge have points that near to each other
GONE_LOG_ODDS = -0.5
GONE_STEP_M = 0.05
SHORTEST_M = 0.1

Cell = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Wall:
    """A weighted line segment: from ``first_m`` to ``last_m`` along ``direction_rad`` from ``centre``.

    The centre is the weighted centroid of all that was merged, which need not be the middle. Free space is on the left.
    """

    centre: Point
    direction_rad: float
    first_m: float
    last_m: float
    weight_m: float
    sightings: int = 1
    id: int | None = None

    @staticmethod
    def of(segment: Segment) -> Wall:
        """A segment as it was seen once."""
        half_m = segment.length_m / 2.0
        return Wall(segment.midpoint, segment.direction_rad, -half_m, half_m, segment.length_m)

    @property
    def start(self) -> Point:
        return self.centre.moved(self.first_m, self.direction_rad)

    @property
    def end(self) -> Point:
        return self.centre.moved(self.last_m, self.direction_rad)

    @property
    def segment(self) -> Segment:
        return Segment(self.start, self.end)

    @property
    def length_m(self) -> float:
        return self.last_m - self.first_m

    def project(self, place: Point) -> tuple[float, float]:
        """``place`` in this wall's frame: metres along it from the centre, and to its left."""
        c, s = math.cos(self.direction_rad), math.sin(self.direction_rad)
        dx, dy = place.x_m - self.centre.x_m, place.y_m - self.centre.y_m
        return c * dx + s * dy, c * dy - s * dx


def half_circle(angle_rad: float) -> float:
    """The same orientation of a line without direction, in [-pi/2, pi/2]."""
    return math.remainder(angle_rad, math.pi)


def merge(first: Wall, second: Wall) -> Wall:
    """The Tavares-Padilha line of both, which keeps the sense of direction of ``first`` and the older identity."""
    weight_m = first.weight_m + second.weight_m
    share = second.weight_m / weight_m
    centre = Point(
        first.centre.x_m + share * (second.centre.x_m - first.centre.x_m),
        first.centre.y_m + share * (second.centre.y_m - first.centre.y_m),
    )
    turned_rad = share * half_circle(second.direction_rad - first.direction_rad)
    ids = [wall.id for wall in (first, second) if wall.id is not None]
    line = Wall(
        centre,
        wrap_angle(first.direction_rad + turned_rad),
        0.0,
        0.0,
        weight_m,
        first.sightings + second.sightings,
        min(ids, default=None),
    )
    along_m = [line.project(place)[0] for place in (first.start, first.end, second.start, second.end)]
    return replace(line, first_m=min(along_m), last_m=max(along_m))


def mismatch_m(first: Wall, second: Wall, sided: bool) -> float | None:
    """How far off one line the two are, or None when they cannot be the same wall.

    ``sided``: opposite directions are the two faces of a wall and stay apart.
    """
    long, short = (first, second) if first.length_m >= second.length_m else (second, first)
    raw_rad = short.direction_rad - long.direction_rad
    turned_rad = wrap_angle(raw_rad) if sided else half_circle(raw_rad)
    # The shorter a segment, the less its direction says.
    if abs(turned_rad) > ANGLE_GATE_RAD:
        gate_rad = math.atan2(OFFSET_GATE_M, max(short.length_m, 1e-3))
        if abs(turned_rad) > min(gate_rad, LOOSEST_ANGLE_GATE_RAD):
            return None
    along_m, off_m = long.project(short.centre)
    c, s = math.cos(raw_rad), math.sin(raw_rad)
    offset_m = max(abs(off_m + s * short.first_m), abs(off_m + s * short.last_m))
    if offset_m > OFFSET_GATE_M:
        return None
    ends_m = along_m + c * short.first_m, along_m + c * short.last_m
    gap_m = max(min(ends_m) - long.last_m, long.first_m - max(ends_m))
    return offset_m if gap_m <= GAP_GATE_M else None


class WallMap:
    """Walls by identity, with a spatial hash: adding one looks only at what is near, however large the map."""

    def __init__(self, sided: bool = True) -> None:
        self._sided = sided
        self._walls: dict[int, Wall] = {}
        self._hash: dict[Cell, dict[int, None]] = {}
        self._next_id = 0

    def __iter__(self) -> Iterator[Wall]:
        """The walls, oldest first."""
        return (self._walls[number] for number in sorted(self._walls))

    def __len__(self) -> int:
        return len(self._walls)

    def add(self, segment: Segment) -> None:
        """Merge a segment seen in the map frame into the walls, and those walls with each other that it joins."""
        wall = Wall.of(segment)
        while True:
            match = self._match(wall)
            if match is None:
                break
            self._remove(match)
            wall = merge(match, wall)
        self._put(wall)

    def prune(self, grid: OccupancyGrid, around: Point, radius_m: float) -> None:
        """Shorten, split or drop the walls near ``around`` where beams went through every cell beside them."""
        window = grid.window_around(around, radius_m)
        likeliest = maximum_filter(grid.cells(window), size=3)
        left_m, bottom_m = window.left * grid.resolution_m, window.bottom * grid.resolution_m
        for wall in tuple(self):
            count = max(2, math.ceil(wall.length_m / GONE_STEP_M) + 1)
            along_m = np.linspace(wall.first_m, wall.last_m, count)
            columns = (wall.centre.x_m + along_m * math.cos(wall.direction_rad) - left_m) / grid.resolution_m
            rows = (wall.centre.y_m + along_m * math.sin(wall.direction_rad) - bottom_m) / grid.resolution_m
            inside = (columns >= 0) & (rows >= 0) & (columns < window.shape[1]) & (rows < window.shape[0])
            gone = np.zeros(count, bool)
            gone[inside] = likeliest[rows[inside].astype(int), columns[inside].astype(int)] < GONE_LOG_ODDS
            if gone.any():
                self._cut(wall, along_m, gone)

    def _cut(self, wall: Wall, along_m: NDArray[np.float64], gone: NDArray[np.bool_]) -> None:
        pieces = _standing(wall, along_m, gone)
        if len(pieces) == 1 and pieces[0].length_m > wall.length_m - SHORTEST_M:
            return  # an end that flickers by a cell is not a change
        self._remove(wall)
        for number, piece in enumerate(sorted(pieces, key=lambda piece: -piece.length_m)):
            self._put(piece if number == 0 else replace(piece, id=None))

    def _match(self, wall: Wall) -> Wall | None:
        near: dict[int, None] = {}
        for cell in _cells(wall, HASH_REACH_M):
            near.update(self._hash.get(cell, {}))
        found = ((mismatch_m(self._walls[number], wall, self._sided), number) for number in near)
        best = min(((offset_m, number) for offset_m, number in found if offset_m is not None), default=None)
        return None if best is None else self._walls[best[1]]

    def _put(self, wall: Wall) -> None:
        if wall.id is None:
            wall = replace(wall, id=self._next_id)
            self._next_id += 1
        assert wall.id is not None
        self._walls[wall.id] = wall
        for cell in _cells(wall, 0.0):
            self._hash.setdefault(cell, {})[wall.id] = None

    def _remove(self, wall: Wall) -> None:
        assert wall.id is not None
        del self._walls[wall.id]
        for cell in _cells(wall, 0.0):
            del self._hash[cell][wall.id]


def merge_segments(segments: Iterable[Segment]) -> tuple[Segment, ...]:
    """Merge a batch of segments without sides, longest first; close to linear in their number at a fixed density."""
    walls = WallMap(sided=False)
    for segment in sorted(segments, key=lambda segment: -segment.length_m):
        walls.add(segment)
    return tuple(wall.segment for wall in walls)


def _cells(wall: Wall, reach_m: float) -> tuple[Cell, ...]:
    """The hash cells within ``reach_m`` of the boxes around the wall's pieces, in order."""
    count = math.ceil(wall.length_m / HASH_PIECE_M) or 1
    c, s = math.cos(wall.direction_rad), math.sin(wall.direction_rad)
    step_m = wall.length_m / count
    found: dict[Cell, None] = {}
    for number in range(count):
        first_m = wall.first_m + number * step_m
        last_m = first_m + step_m
        left, right = _span(wall.centre.x_m + first_m * c, wall.centre.x_m + last_m * c, reach_m)
        bottom, top = _span(wall.centre.y_m + first_m * s, wall.centre.y_m + last_m * s, reach_m)
        found.update(dict.fromkeys((x, y) for x in range(left, right + 1) for y in range(bottom, top + 1)))
    return tuple(found)


def _span(first_m: float, last_m: float, reach_m: float) -> tuple[int, int]:
    """The first and the last cell of a stretch along one axis."""
    low_m, high_m = (first_m, last_m) if first_m < last_m else (last_m, first_m)
    return math.floor((low_m - reach_m) / HASH_CELL_M), math.floor((high_m + reach_m) / HASH_CELL_M)


def _standing(wall: Wall, along_m: NDArray[np.float64], gone: NDArray[np.bool_]) -> list[Wall]:
    """The pieces of ``wall`` between samples that are gone; pieces too short to matter are dropped."""
    edges = np.flatnonzero(np.diff(np.concatenate([[True], gone, [True]]).astype(np.int8)))
    spans = [(float(along_m[a]), float(along_m[b - 1])) for a, b in edges.reshape(-1, 2).tolist()]
    joined: list[tuple[float, float]] = []
    for first_m, last_m in spans:
        if joined and first_m - joined[-1][1] <= GAP_GATE_M:
            joined[-1] = (joined[-1][0], last_m)
        else:
            joined.append((first_m, last_m))
    return [
        replace(wall, first_m=a, last_m=b, weight_m=wall.weight_m * (b - a) / wall.length_m)
        for a, b in joined
        if b - a >= SHORTEST_M
    ]

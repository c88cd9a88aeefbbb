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
HASH_CELL_M = 1.5
HASH_STEP_M = 0.5
# Two segments that may merge have samples within gap + offset + two half steps of each other; less than one cell.
HASH_REACH_M = GAP_GATE_M + OFFSET_GATE_M + HASH_STEP_M
GONE_LOG_ODDS = -0.5
GONE_STEP_M = 0.05
SHORTEST_M = 0.1


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
    turned_rad = short.direction_rad - long.direction_rad
    turned_rad = wrap_angle(turned_rad) if sided else half_circle(turned_rad)
    # The shorter a segment, the less its direction says.
    gate_rad = math.atan2(OFFSET_GATE_M, max(short.length_m, 1e-3))
    if abs(turned_rad) > min(max(ANGLE_GATE_RAD, gate_rad), LOOSEST_ANGLE_GATE_RAD):
        return None
    along_1, off_1 = long.project(short.start)
    along_2, off_2 = long.project(short.end)
    gap_m = max(min(along_1, along_2) - long.last_m, long.first_m - max(along_1, along_2))
    offset_m = max(abs(off_1), abs(off_2))
    return offset_m if gap_m <= GAP_GATE_M and offset_m <= OFFSET_GATE_M else None


class WallMap:
    """Walls by identity, with a spatial hash: adding one looks only at what is near, however large the map."""

    def __init__(self, sided: bool = True) -> None:
        self._sided = sided
        self._walls: dict[int, Wall] = {}
        self._hash: dict[tuple[int, int], dict[int, None]] = {}
        self._next_id = 0
        self.revision = 0

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
        self.revision += 1

    def _remove(self, wall: Wall) -> None:
        assert wall.id is not None
        del self._walls[wall.id]
        for cell in _cells(wall, 0.0):
            del self._hash[cell][wall.id]
        self.revision += 1


def merge_segments(segments: Iterable[Segment]) -> tuple[Segment, ...]:
    """Merge a batch of segments without sides, longest first; close to linear in their number at a fixed density."""
    walls = WallMap(sided=False)
    for segment in sorted(segments, key=lambda segment: -segment.length_m):
        walls.add(segment)
    return tuple(wall.segment for wall in walls)


def _cells(wall: Wall, reach_m: float) -> dict[tuple[int, int], None]:
    """The hash cells within ``reach_m`` of samples along the wall, in order."""
    count = math.ceil(wall.length_m / HASH_STEP_M) + 1
    step_m = wall.length_m / max(count - 1, 1)
    c, s = math.cos(wall.direction_rad), math.sin(wall.direction_rad)
    found: dict[tuple[int, int], None] = {}
    corners = ((-reach_m, -reach_m), (-reach_m, reach_m), (reach_m, -reach_m), (reach_m, reach_m))
    for number in range(count):
        along_m = wall.first_m + number * step_m
        x_m, y_m = wall.centre.x_m + along_m * c, wall.centre.y_m + along_m * s
        for dx_m, dy_m in corners if reach_m else corners[:1]:
            found[math.floor((x_m + dx_m) / HASH_CELL_M), math.floor((y_m + dy_m) / HASH_CELL_M)] = None
    return found


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

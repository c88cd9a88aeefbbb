"""Rooms and openings as the map shows them: free space parted by walls, and by the openings in them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Point, Pose, Segment

from .entities import Entity, Mask
from .openings import Gap, gaps, sides
from .regions import CELL_M, OUTSIDE, Grid, labelled, thickened

DOORWAY, ROOM, HALLWAY = "doorway", "room", "hallway"
ROOMS = frozenset({ROOM, HALLWAY})

_ROOM_MIN_M2 = 2.5
_HALLWAY_ASPECT = 3.0  # as many times as long as it is wide
_BEFORE_WALL_M = 0.4
_BESIDE_M = 0.3  # from an opening to the region on its side
_PLACE_M = (0.0, 0.0, 0.0)  # what is no body has no size

Labels = NDArray[np.intp]


@dataclass(frozen=True)
class Room:
    """A region of the map. ``place`` is a place of type `ROOM` or `HALLWAY`, where there is most space around."""

    label: int
    place: Entity
    low: Point
    high: Point

    @property
    def middle(self) -> Point:
        return Point((self.low.x_m + self.high.x_m) / 2, (self.low.y_m + self.high.y_m) / 2)

    @property
    def sides(self) -> tuple[Point, ...]:
        """Before the middle of its east, north, west and south wall."""
        middle, (half_x_m, half_y_m) = self.middle, self._halves_m()
        aways_m = (half_x_m, half_y_m, half_x_m, half_y_m)
        return tuple(middle.moved(away_m, n * math.pi / 2) for n, away_m in enumerate(aways_m))

    @property
    def ends(self) -> tuple[Point, ...]:
        """Those of its sides that lie along its length."""
        half_x_m, half_y_m = self._halves_m()
        return self.sides[0::2] if half_x_m >= half_y_m else self.sides[1::2]

    def _halves_m(self) -> tuple[float, float]:
        half_x_m, half_y_m = (self.high.x_m - self.low.x_m) / 2, (self.high.y_m - self.low.y_m) / 2
        return max(half_x_m - _BEFORE_WALL_M, 0.0), max(half_y_m - _BEFORE_WALL_M, 0.0)


@dataclass(frozen=True)
class FloorPlan:
    """What `floor_plan` found. ``labels`` are the numbers of regions, cell by cell."""

    grid: Grid
    labels: Labels
    rooms: tuple[Room, ...]
    openings: tuple[Segment, ...]

    def room_at(self, place: Point) -> Room | None:
        """The room that a place lies in; None on a wall, outside, or where the map is open."""
        row, column = self.grid.cells(np.array([[place.x_m, place.y_m]]))[0]
        return next((room for room in self.rooms if room.label == self.labels[row, column]), None)

    def inside(self, room: Room, xy_m: NDArray[np.float64]) -> Mask:
        """Which places lie in a room or against its walls, shape (n,)."""
        rows, columns = self.grid.cells(xy_m).T
        return np.asarray(self._reaching(room)[rows, columns])

    def _reaching(self, room: Room) -> Mask:
        return thickened(thickened(self.labels == room.label))

    @cached_property
    def doorways(self) -> tuple[Entity, ...]:
        """The openings as places; each looks along the way through it."""
        return tuple(
            Entity(f"{DOORWAY} {number}", DOORWAY, _pose(gap), size_m=_PLACE_M)
            for number, gap in enumerate(self.openings, start=1)
        )

    def joined(self, doorway: Entity) -> tuple[Room | None, Room | None]:
        """The rooms before and behind a doorway."""
        gap = self.openings[self.doorways.index(doorway)]
        before, behind = sides(gap, _BESIDE_M)
        return self.room_at(before), self.room_at(behind)

    def doorways_of(self, room: Room) -> tuple[Entity, ...]:
        """Those that lead out of a room."""
        return tuple(doorway for doorway in self.doorways if room in self.joined(doorway))

    def room_of(self, place: Entity) -> Room | None:
        """The room that a place of type `ROOM` or `HALLWAY` is."""
        return next((room for room in self.rooms if room.place.id == place.id), None)


@lru_cache(maxsize=8)
def floor_plan(walls: tuple[Segment, ...]) -> FloorPlan | None:
    """The rooms and openings that these walls make; None without walls.

    Rooms are what is left of free space when the openings are shut. A piece smaller than a room is one with its
    neighbour, unless the gap between them is in a wall: an alcove has an opening, two crates have not.
    """
    if not walls:
        return None
    grid = Grid.around(walls)
    found = gaps(walls)
    shut = _labels(grid, walls, found)
    kept = tuple(found[n] for n in _openings(grid, shut, found))
    labels = _labels(grid, walls, kept)
    rooms = [_room(grid, labels, label, kept) for label in range(1, int(labels.max()) + 1)]
    return FloorPlan(grid, labels, tuple(filter(None, rooms)), tuple(gap.line for gap in kept))


def _labels(grid: Grid, walls: tuple[Segment, ...], found: tuple[Gap, ...]) -> Labels:
    return labelled(~thickened(grid.drawn((*walls, *(gap.line for gap in found)))))


def _openings(grid: Grid, labels: Labels, found: tuple[Gap, ...]) -> list[int]:
    """The gaps that stay openings while pieces are joined, the smallest first."""
    area_m2 = {label: count * CELL_M**2 for label, count in enumerate(np.bincount(labels.ravel()).tolist())}
    area_m2[OUTSIDE] = math.inf
    pieces = {number: _beside(grid, labels, gap.line) for number, gap in enumerate(found)}
    while True:
        loose = [n for n, pair in pieces.items() if not found[n].is_in_wall and _smaller(area_m2, pair) < _ROOM_MIN_M2]
        if not loose:
            return [n for n, (a, b) in pieces.items() if a != b or (a == OUTSIDE and found[n].is_in_wall)]
        opened = min(loose, key=lambda n: (_smaller(area_m2, pieces[n]), max(map(area_m2.__getitem__, pieces[n]))))
        gone, into = sorted(pieces.pop(opened), key=area_m2.__getitem__)
        if gone != into:
            area_m2[into] += area_m2.pop(gone)
            pieces = {n: (into if a == gone else a, into if b == gone else b) for n, (a, b) in pieces.items()}


def _smaller(area_m2: dict[int, float], pair: tuple[int, int]) -> float:
    return min(area_m2[pair[0]], area_m2[pair[1]])


def _beside(grid: Grid, labels: Labels, gap: Segment) -> tuple[int, int]:
    cells = grid.cells(np.array([(p.x_m, p.y_m) for p in sides(gap, _BESIDE_M)]))
    before, behind = (int(labels[row, column]) for row, column in cells)
    return before, behind


def _room(grid: Grid, labels: Labels, label: int, kept: tuple[Gap, ...]) -> Room | None:
    """None for a region that is too small to be one."""
    cells = np.argwhere(labels == label)
    if len(cells) * CELL_M**2 < _ROOM_MIN_M2:
        return None
    centers = grid.centers_m(cells)
    (low_x, low_y), (high_x, high_y) = centers.min(axis=0), centers.max(axis=0)
    long_m, wide_m = sorted((high_x - low_x, high_y - low_y), reverse=True)
    ways = sum(label in _beside(grid, labels, gap.line) for gap in kept)
    kind = HALLWAY if ways >= 2 and long_m >= _HALLWAY_ASPECT * wide_m else ROOM
    x_m, y_m = grid.centers_m(_roomiest(labels == label)[None])[0]
    pose = Pose(float(x_m), float(y_m), 0.0 if high_x - low_x >= high_y - low_y else math.pi / 2)
    place = Entity(f"{kind} {label}", kind, pose, size_m=_PLACE_M)
    return Room(label, place, Point(float(low_x), float(low_y)), Point(float(high_x), float(high_y)))


def _roomiest(cells: Mask) -> Labels:
    """Row and column of the cell farthest from the region's border; of several, the one nearest to their middle."""
    inner = cells
    while True:
        less = ~thickened(~inner)
        if not less.any():
            break
        inner = less
    left = np.argwhere(inner)
    return np.asarray(left[np.argmin(np.linalg.norm(left - left.mean(axis=0), axis=1))])


def _pose(gap: Segment) -> Pose:
    middle = gap.midpoint
    return Pose(middle.x_m, middle.y_m, gap.direction_rad + math.pi / 2)

"""Where to stand in order to be at a thing: in front of its marker, facing it, where the map has room."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Point, Pose, Segment

from .entities import Entity

STAND_OFF_M = 0.35
"""From the marker's face to the robot's turning centre: close enough to be "at" it, far enough to turn."""

_CLEARANCE_M = 0.24  # TurtleBot3 Waffle Pi: 281 x 306 mm, so 0.21 m from the middle to a corner; and a little
_FAN_DEG = (0, 15, -15, 30, -30, 45, -45, 60, -60, 75, -75)
_RINGS_M = (STAND_OFF_M, 0.45, 0.55)


def approach(entity: Entity, walls: tuple[Segment, ...]) -> Pose:
    """The pose at which to stand: along the way the thing faces if the map has room there, else the nearest good place.

    Where no place near it is free by the map, the first choice is returned all the same: the map may be wrong, and the
    robot will find out.
    """
    places = list(_choices(entity.pose))
    ends = wall_ends_m(walls)
    best = next((p for p in places if is_free(p, ends) and sees(p, entity.point, ends)), places[0])
    return Pose(best.x_m, best.y_m, best.bearing_to(entity.point))


def _choices(front: Pose) -> Iterator[Point]:
    """Places before the front, the nearest to the first choice first."""
    first = front.point.moved(STAND_OFF_M, front.yaw_rad)
    fan = [front.point.moved(r_m, front.yaw_rad + math.radians(a)) for r_m in _RINGS_M for a in _FAN_DEG]
    yield from sorted(fan, key=first.distance_to)


def wall_ends_m(walls: tuple[Segment, ...]) -> NDArray[np.float64]:
    """Shape (n, 4): x and y of start and end."""
    rows = [(w.start.x_m, w.start.y_m, w.end.x_m, w.end.y_m) for w in walls]
    return np.array(rows, dtype=np.float64).reshape(-1, 4)


def is_free(place: Point, ends_m: NDArray[np.float64]) -> bool:
    """Whether the robot fits there, by walls of shape (n, 4)."""
    start, along = ends_m[:, :2], ends_m[:, 2:] - ends_m[:, :2]
    here = np.array([place.x_m, place.y_m])
    length2 = np.maximum(np.einsum("ij,ij->i", along, along), 1e-12)
    t = np.clip(np.einsum("ij,ij->i", here - start, along) / length2, 0.0, 1.0)
    gaps = np.linalg.norm(here - (start + t[:, None] * along), axis=1)
    return bool(np.all(gaps >= _CLEARANCE_M))


def sees(place: Point, target: Point, ends_m: NDArray[np.float64]) -> bool:
    """Whether no wall stands between; walls within a hand's breadth of the target are what it hangs on."""
    reach_m = max(place.distance_to(target) - 0.1, 0.0)
    end = place.moved(reach_m, place.bearing_to(target))
    a, b = np.array([place.x_m, place.y_m]), np.array([end.x_m, end.y_m])
    c, d = ends_m[:, :2], ends_m[:, 2:]
    crosses = (_turn(a, b, c) * _turn(a, b, d) < 0) & (_turn(c, d, a) * _turn(c, d, b) < 0)
    return not bool(np.any(crosses))


def _turn(a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64]) -> NDArray[np.float64]:
    """Twice the signed area of the triangle abc: positive when it is counter-clockwise."""
    area2: NDArray[np.float64] = (b[..., 0] - a[..., 0]) * (c[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (
        c[..., 0] - a[..., 0]
    )
    return area2

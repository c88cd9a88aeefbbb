"""What a ray from the eye through the screen points at: a thing, or a place on the floor, in map coordinates."""

from __future__ import annotations

import math
from collections.abc import Iterable

from dialogue.events import PointedObject, PointedPlace, PointedRay
from robot.geometry import Point, Pose

from .motion import Placement, Vector, placement_of
from .nodes import Node, Scene, Thing, Wall

REACH_M = 60.0  # a ray nearer to the horizon than this points at nothing
THING_MARGIN_M = 0.05  # around a thing: fingers are thick
LABEL_MARGIN_M = 0.25  # above it: a label is clicked as what it names
SPREAD_M = 0.05  # one standard deviation of a click
DRAG_MIN_M = 0.10


def pointed_at(origin: Vector, direction: Vector, scene: Scene) -> PointedObject | PointedPlace | None:
    """The nearest thing, wall or floor that the ray meets; None when it goes into the sky.

    ``origin`` and ``direction`` (any length) are in the map frame with z up. A wall stands for the place where it is
    hit.
    """
    floor_m = floor_distance(origin, direction)
    solid_m, solid = _nearest(scene.nodes, origin, direction)
    if isinstance(solid, Thing) and solid_m <= floor_m:
        return PointedObject(solid.entity)
    nearest_m = min(floor_m, solid_m)
    return None if nearest_m > REACH_M else PointedPlace(_along(origin, direction, nearest_m))


def floor_point(origin: Vector, through: Vector) -> Point | None:
    """Where the ray from ``origin`` through another point meets the floor."""
    x, y, z = (b - a for a, b in zip(origin, through, strict=True))
    distance_m = floor_distance(origin, (x, y, z))
    return None if distance_m > REACH_M else _along(origin, (x, y, z), distance_m)


def dragged(start: Point, end: Point) -> PointedRay | None:
    """The direction that a drag over the floor shows; None when it is too short to show one."""
    if start.distance_to(end) < DRAG_MIN_M:
        return None
    return PointedRay(start, start.bearing_to(end))


def floor_distance(origin: Vector, direction: Vector) -> float:
    """How far along the ray the floor is, metres; infinite when it is never met."""
    downwards = -direction[2] / math.hypot(*direction)
    return origin[2] / downwards if downwards > 1e-9 and origin[2] > 0 else math.inf


def _along(origin: Vector, direction: Vector, distance_m: float) -> Point:
    share = distance_m / math.hypot(*direction)
    return Point(origin[0] + share * direction[0], origin[1] + share * direction[1])


def _nearest(nodes: Iterable[Node], origin: Vector, direction: Vector) -> tuple[float, Thing | Wall | None]:
    best_m: float = math.inf
    best: Thing | Wall | None = None
    for node in nodes:
        if not isinstance(node, Thing | Wall):
            continue
        distance_m = _box_distance(placement_of(node), isinstance(node, Thing), origin, direction)
        if distance_m < best_m:
            best_m, best = distance_m, node
    return best_m, best


def _box_distance(box: Placement, padded: bool, origin: Vector, direction: Vector) -> float:
    """How far along the ray the upright box is met (slab method); infinite when it is missed."""
    place = Pose(box.position_m[0], box.position_m[1], box.yaw_rad)
    eye = place.to_local(Point(origin[0], origin[1]))
    way = Pose(0.0, 0.0, box.yaw_rad).to_local(Point(direction[0], direction[1]))
    margin_m, above_m = (THING_MARGIN_M, LABEL_MARGIN_M) if padded else (0.0, 0.0)
    half_x_m, half_y_m = box.size_m[0] / 2 + margin_m, box.size_m[1] / 2 + margin_m
    top_m = box.position_m[2] + box.size_m[2] / 2 + above_m
    slabs = (
        (eye.x_m, way.x_m, -half_x_m, half_x_m),
        (eye.y_m, way.y_m, -half_y_m, half_y_m),
        (origin[2], direction[2], 0.0, top_m),
    )
    enter, leave = 0.0, math.inf
    for at, step, low, high in slabs:
        if abs(step) < 1e-12:
            if not low <= at <= high:
                return math.inf
            continue
        first, second = (low - at) / step, (high - at) / step
        enter, leave = max(enter, min(first, second)), min(leave, max(first, second))
    return enter * math.hypot(*direction) if enter <= leave else math.inf

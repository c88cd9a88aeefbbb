"""From the map to the virtual world and back, by the paper's formulas (Krajovic et al., section 3.3.1).

The virtual world is Unity's: left-handed, X to the right, Y up, Z ahead, and a positive rotation about Y turns Z
towards X. A map point (a, b) lies at X = -b, Z = a. Lengths are metres, angles radians.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from robot.geometry import Point, Pose, Segment, wrap_angle


@dataclass(frozen=True, slots=True)
class VirtualPoint:
    """A place in the virtual world: X right, Y up, Z ahead of where the robot started."""

    x_m: float
    y_m: float
    z_m: float


@dataclass(frozen=True, slots=True)
class Cuboid:
    """A wall's place: the middle of its foot line, its length along its own X, and its rotation about Y."""

    centre: VirtualPoint
    length_m: float
    rotation_rad: float


def to_virtual(place: Point, height_m: float = 0.0) -> VirtualPoint:
    """A map point, ``height_m`` above the floor, in the virtual world."""
    return VirtualPoint(-place.y_m, height_m, place.x_m)


def to_map(place: VirtualPoint) -> Point:
    """The map point below a place of the virtual world: the inverse, by which pointing gets its meaning."""
    return Point(place.z_m, -place.x_m)


def to_virtual_rotation(yaw_rad: float) -> float:
    """The rotation about Y of what looks along its own Z and has this yaw on the map."""
    return wrap_angle(-yaw_rad)


def to_map_yaw(rotation_rad: float) -> float:
    """The inverse of :func:`to_virtual_rotation`."""
    return wrap_angle(-rotation_rad)


def to_map_pose(place: VirtualPoint, rotation_rad: float) -> Pose:
    """Place and heading on the map of something in the virtual world."""
    point = to_map(place)
    return Pose(point.x_m, point.y_m, to_map_yaw(rotation_rad))


def to_cuboid(segment: Segment) -> Cuboid:
    """The cuboid that a wall's segment grows into.

    The paper turns it by ``-asin(|d|.z) * sgn(|d|.x)``. For a wall straight ahead ``|d|.x`` is 0; its sign counts as
    positive there, as Unity's ``Mathf.Sign`` has it, for otherwise such a wall would lie across.
    """
    start, end = to_virtual(segment.start), to_virtual(segment.end)
    dx_m, dz_m = end.x_m - start.x_m, end.z_m - start.z_m
    length_m = math.hypot(dx_m, dz_m)
    centre = VirtualPoint((start.x_m + end.x_m) / 2, 0.0, (start.z_m + end.z_m) / 2)
    if length_m == 0:
        return Cuboid(centre, 0.0, 0.0)
    sign = -1.0 if dx_m < 0 else 1.0
    # Rounding may carry a quotient of hypot past 1.
    return Cuboid(centre, length_m, -math.asin(max(-1.0, min(1.0, dz_m / length_m))) * sign)


def to_segment(cuboid: Cuboid) -> Segment:
    """The segment a cuboid came from; which end is the start is not kept by the paper's formula."""
    half_x_m = cuboid.length_m / 2 * math.cos(cuboid.rotation_rad)
    half_z_m = -cuboid.length_m / 2 * math.sin(cuboid.rotation_rad)
    centre = cuboid.centre
    return Segment(
        to_map(VirtualPoint(centre.x_m - half_x_m, 0.0, centre.z_m - half_z_m)),
        to_map(VirtualPoint(centre.x_m + half_x_m, 0.0, centre.z_m + half_z_m)),
    )

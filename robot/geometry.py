"""Poses, points and segments in the map frame.

The frame is ROS REP-103's ``map``/``odom``: x forward at start, y left, yaw counter-clockwise from x. Lengths are
metres, angles radians unless a name says otherwise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


def wrap_angle(angle_rad: float) -> float:
    """The same direction in (-pi, pi]."""
    wrapped = math.remainder(angle_rad, math.tau)
    return math.pi if wrapped == -math.pi else wrapped


@dataclass(frozen=True, slots=True)
class Point:
    """A place on the floor, map frame."""

    x_m: float
    y_m: float

    def distance_to(self, other: Point) -> float:
        """Euclidean distance in metres."""
        return math.hypot(other.x_m - self.x_m, other.y_m - self.y_m)

    def bearing_to(self, other: Point) -> float:
        """Direction of ``other`` seen from here, radians counter-clockwise from the map's x axis."""
        return math.atan2(other.y_m - self.y_m, other.x_m - self.x_m)

    def moved(self, distance_m: float, direction_rad: float) -> Point:
        """The place ``distance_m`` from here in ``direction_rad``."""
        return Point(self.x_m + distance_m * math.cos(direction_rad), self.y_m + distance_m * math.sin(direction_rad))


@dataclass(frozen=True, slots=True)
class Pose:
    """A place and a heading on the floor, map frame."""

    x_m: float
    y_m: float
    yaw_rad: float

    @property
    def point(self) -> Point:
        return Point(self.x_m, self.y_m)

    def ahead(self, distance_m: float) -> Pose:
        """The pose reached by driving straight; negative distances lie behind."""
        there = self.point.moved(distance_m, self.yaw_rad)
        return Pose(there.x_m, there.y_m, self.yaw_rad)

    def turned(self, angle_rad: float) -> Pose:
        """The pose after turning in place, counter-clockwise positive."""
        return Pose(self.x_m, self.y_m, wrap_angle(self.yaw_rad + angle_rad))

    def at(self, place: Point) -> Pose:
        """The same heading at another place."""
        return Pose(place.x_m, place.y_m, self.yaw_rad)

    def to_map(self, local: Point) -> Point:
        """A point given in this pose's own frame (x ahead, y left), in the map frame."""
        c, s = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        return Point(self.x_m + c * local.x_m - s * local.y_m, self.y_m + s * local.x_m + c * local.y_m)

    def to_local(self, place: Point) -> Point:
        """A map point in this pose's own frame: x ahead, y left."""
        c, s = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        dx, dy = place.x_m - self.x_m, place.y_m - self.y_m
        return Point(c * dx + s * dy, -s * dx + c * dy)

    def compose(self, relative: Pose) -> Pose:
        """``relative``, given in this pose's frame, in the map frame (SE(2) product)."""
        place = self.to_map(relative.point)
        return Pose(place.x_m, place.y_m, wrap_angle(self.yaw_rad + relative.yaw_rad))

    def relative_to(self, origin: Pose) -> Pose:
        """This pose in the frame of ``origin``: the inverse of ``origin.compose``."""
        place = origin.to_local(self.point)
        return Pose(place.x_m, place.y_m, wrap_angle(self.yaw_rad - origin.yaw_rad))


ORIGIN = Pose(0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Segment:
    """A straight piece of wall from ``start`` to ``end``, map frame."""

    start: Point
    end: Point

    @property
    def length_m(self) -> float:
        return self.start.distance_to(self.end)

    @property
    def midpoint(self) -> Point:
        return Point((self.start.x_m + self.end.x_m) / 2.0, (self.start.y_m + self.end.y_m) / 2.0)

    @property
    def direction_rad(self) -> float:
        """Direction from start to end, radians."""
        return self.start.bearing_to(self.end)

"""How things move on the screen: from where they are shown towards where they are, smoothly and never past it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .coordinates import to_map, to_map_yaw
from .nodes import Avatar, Thing, Wall

TIME_CONSTANT_S = 0.12  # after this long, 63 % of the way is done
_CLOSE_M = 0.002
_CLOSE_RAD = 0.002

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Placement:
    """Where something is on the stage: the map frame with z up; ``size_m`` along its own x (ahead), y (left), z (up).

    ``half_turn`` is the angle after which it looks the same again: pi for a wall, which has no front.
    """

    position_m: Vector
    yaw_rad: float
    size_m: Vector = (1.0, 1.0, 1.0)
    half_turn: float = math.tau

    def flat(self) -> Placement:
        """The same on the floor with no height: how a wall begins and ends."""
        x_m, y_m, _ = self.position_m
        return Placement((x_m, y_m, 0.0), self.yaw_rad, (self.size_m[0], self.size_m[1], 0.001), self.half_turn)


def placement_of(node: Wall | Thing | Avatar) -> Placement:
    """A node of the virtual world (left-handed, Y up) on the stage (right-handed, z up)."""
    if isinstance(node, Avatar):
        place = to_map(node.position)
        return Placement((place.x_m, place.y_m, node.position.y_m), to_map_yaw(node.rotation_rad))
    place = to_map(node.centre)
    across_m, height_m, along_m = node.size_m
    return Placement(
        (place.x_m, place.y_m, node.centre.y_m),
        to_map_yaw(node.rotation_rad),
        (along_m, across_m, height_m),
        math.pi if isinstance(node, Wall) else math.tau,
    )


def eased(shown: Placement, goal: Placement, duration_s: float) -> Placement:
    """Where to show it after ``duration_s`` more; exactly the goal once it is too close to tell."""
    share = 1.0 - math.exp(-duration_s / TIME_CONSTANT_S)
    turn_rad = math.remainder(goal.yaw_rad - shown.yaw_rad, goal.half_turn)
    position_m = blend(shown.position_m, goal.position_m, share)
    size_m = blend(shown.size_m, goal.size_m, share)
    left_m = max(math.dist(position_m, goal.position_m), math.dist(size_m, goal.size_m))
    if left_m < _CLOSE_M and abs(turn_rad) * (1.0 - share) < _CLOSE_RAD:
        return goal
    return Placement(position_m, shown.yaw_rad + share * turn_rad, size_m, goal.half_turn)


def blend(start: Vector, end: Vector, share: float) -> Vector:
    """The point that lies ``share`` of the way from start to end."""
    x, y, z = (a + share * (b - a) for a, b in zip(start, end, strict=True))
    return x, y, z


def quaternion(yaw_rad: float) -> tuple[float, float, float, float]:
    """A turn about the vertical as (w, x, y, z)."""
    return math.cos(yaw_rad / 2), 0.0, 0.0, math.sin(yaw_rad / 2)

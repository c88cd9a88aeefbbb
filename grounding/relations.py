"""Spatial relations, each over all things at once: which of them stand so to the robot, or to a landmark.

Left, right, ahead and behind are the robot's own (its heading line divides the world). "Left of the table" is the
viewer's: seen from the robot, looking at the table. "In front of" and "behind" a thing with a marker are the thing's
own, for a marker has a face.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Pose
from voxml.schema import RelationEntry

from .entities import Entity, Mask
from .frames import Frame

COMPASS_RAD = {
    name: math.radians(45.0 * step)
    for step, name in enumerate(("east", "northeast", "north", "northwest", "west", "southwest", "south", "southeast"))
}
"""Headings on the map: x is east (ROS REP-103, so that yaw 0 faces east), y north."""

_HALF_CONE_RAD = math.radians(60.0)  # how far from a side's axis something may lie and still be on that side
_PAST_M = 0.01  # the landmarks themselves are not between themselves
_ASIDE_M = 0.15  # half the robot's width: what lies nearer to its heading line is dead ahead or behind, on no side
_BESIDE_LINE_M = 0.75  # how far from the line between two things something may lie and still be between them

Places = NDArray[np.float64]  # shape (n, 2), map frame


def local_m(pose: Pose, xy_m: Places) -> Places:
    """Places in the frame of ``pose``, shape (n, 2): x ahead, y left."""
    delta = xy_m - np.array([pose.x_m, pose.y_m])
    c, s = math.cos(pose.yaw_rad), math.sin(pose.yaw_rad)
    return np.stack([c * delta[:, 0] + s * delta[:, 1], -s * delta[:, 0] + c * delta[:, 1]], axis=1)


def distances_m(place: tuple[float, float], xy_m: Places) -> NDArray[np.float64]:
    """Shape (n,)."""
    return np.hypot(xy_m[:, 0] - place[0], xy_m[:, 1] - place[1])


# ------------------------------------------------------------------ to the robot
REGIONS: Mapping[str, Callable[[Places], Mask]] = {
    "left": lambda local: local[:, 1] > _ASIDE_M,
    "right": lambda local: local[:, 1] < -_ASIDE_M,
    "ahead": lambda local: local[:, 0] > 0,
    "forward": lambda local: local[:, 0] > 0,
    "front": lambda local: local[:, 0] > 0,
    "behind": lambda local: local[:, 0] < 0,
    "back": lambda local: local[:, 0] < 0,
}
"""Parts of the world as the robot sees them, from places in its own frame."""


# ------------------------------------------------------------------ to a landmark
Holds = Callable[[Pose, Entity, Places], Mask]
"""(robot, landmark, places of shape (n, 2)) -> of which places the relation to the landmark holds, shape (n,)."""


def relation(entry: RelationEntry) -> Holds | None:
    """What a relation's entry says, computed: its constraint on distance, or else the side that its value names.

    None for a relation that cannot be computed on a flat map ("above").
    """
    distance = _DISTANCE.match(entry.constraint or "")
    if distance is not None:
        return _at_distance(distance[1], float(distance[2]))
    if is_outside(entry):
        return lambda robot, landmark, xy_m: ~_touches(robot, landmark, xy_m)
    return _touches if entry.value in _TOUCHING else _SIDES.get(entry.value)


def is_graded(entry: RelationEntry) -> bool:
    """Whether it holds the more the nearer something is."""
    distance = _DISTANCE.match(entry.constraint or "")
    return distance is not None and distance[1] == "<="


def is_outside(entry: RelationEntry) -> bool:
    """Whether it is the contrary of being inside."""
    return entry.constraint == "not(in(x, y))"


def gap_m(landmark: Entity, xy_m: Places) -> NDArray[np.float64]:
    """How far places are from a landmark: from its own place, or from anywhere on a wall; shape (n,)."""
    length_m, width_m, _ = landmark.size_m
    if length_m > 0.0 or width_m == 0.0:
        return distances_m((landmark.pose.x_m, landmark.pose.y_m), xy_m)
    local = local_m(landmark.pose, xy_m)
    return np.asarray(np.hypot(local[:, 0], np.maximum(np.abs(local[:, 1]) - width_m / 2, 0.0)))


def _touches(robot: Pose, landmark: Entity, xy_m: Places) -> Mask:
    """On it, in it or against it, by its footprint."""
    half_m = 0.0 if landmark.size_m[0] == 0.0 else max(landmark.size_m[:2]) / 2
    away_m = gap_m(landmark, xy_m)
    return (away_m > 0) & (away_m <= half_m + _TOUCHING_M)


def _at_distance(comparison: str, distance_m: float) -> Holds:
    def holds(robot: Pose, landmark: Entity, xy_m: Places) -> Mask:
        away_m = gap_m(landmark, xy_m)
        return (away_m > 0) & (away_m <= distance_m) if comparison == "<=" else away_m > distance_m

    return holds


def _on_side(direction_rad: float, frame: Frame) -> Holds:
    """Within a cone around a direction from the landmark, in one of the frames."""

    def holds(robot: Pose, landmark: Entity, xy_m: Places) -> Mask:
        yaw_rad = _FRAME_YAW[frame](robot, landmark.pose) + direction_rad
        local = local_m(Pose(landmark.pose.x_m, landmark.pose.y_m, yaw_rad), xy_m)
        return (local[:, 0] > 0) & (np.abs(np.arctan2(local[:, 1], local[:, 0])) <= _HALF_CONE_RAD)

    return holds


_FRAME_YAW: Mapping[Frame, Callable[[Pose, Pose], float]] = {
    # The robot's own left is seen along its heading.
    Frame.VIEWER: lambda robot, landmark: (
        robot.yaw_rad if robot.point == landmark.point else robot.point.bearing_to(landmark.point)
    ),
    Frame.OWN: lambda robot, landmark: landmark.yaw_rad,
    Frame.MAP: lambda robot, landmark: 0.0,
}
_DISTANCE = re.compile(r"(?:while\()?dist\(x, y\) (<=|>) ([0-9.]+)m")
_SIDES: Mapping[str, Holds] = {
    "projective.left": _on_side(math.pi / 2, Frame.VIEWER),
    "projective.right": _on_side(-math.pi / 2, Frame.VIEWER),
    "projective.front": _on_side(0.0, Frame.OWN),
    "projective.back": _on_side(math.pi, Frame.OWN),
    "projective.across": _on_side(0.0, Frame.OWN),
    "path.past": _on_side(0.0, Frame.VIEWER),
    "path.across": _on_side(0.0, Frame.VIEWER),
    "path.through": _on_side(0.0, Frame.VIEWER),
    **{f"cardinal.{name}": _on_side(yaw_rad, Frame.MAP) for name, yaw_rad in COMPASS_RAD.items()},
}
BETWEEN = "projective.between"
_TOUCHING = frozenset({"RCC8.EC", "RCC8.NTPP"})
_TOUCHING_M = 0.3  # half of a small thing, and what its place is off


def between(first: Pose, second: Pose, xy_m: Places) -> Mask:
    """Beside the line from one landmark to the other, and past neither; shape (n,)."""
    length_m = first.point.distance_to(second.point)
    local = local_m(Pose(first.x_m, first.y_m, first.point.bearing_to(second.point)), xy_m)
    return (local[:, 0] > _PAST_M) & (local[:, 0] < length_m - _PAST_M) & (np.abs(local[:, 1]) <= _BESIDE_LINE_M)


def meeting_key_m(robot: Pose, xy_m: Places) -> NDArray[np.float64]:
    """Shape (n,): smaller is met sooner along the robot's heading; what lies behind comes after all that lies ahead."""
    ahead_m = local_m(robot, xy_m)[:, 0]
    farthest_m = float(ahead_m.max(initial=0.0))
    return np.where(ahead_m >= 0, ahead_m, farthest_m - ahead_m)

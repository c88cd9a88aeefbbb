"""Spatial relations, each over all things at once: which of them stand so to the robot, or to a landmark.

Left, right, ahead and behind are the robot's own (its heading line divides the world). "Left of the table" is the
viewer's: seen from the robot, looking at the table. "In front of" and "behind" a thing with a marker are the thing's
own, for a marker has a face.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Pose

from .entities import Mask

NEAR_M = 1.5
NEXT_TO_M = 1.0
_HALF_CONE_RAD = math.radians(60.0)  # how far from a side's axis something may lie and still be on that side
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
    "left": lambda local: local[:, 1] > 0,
    "right": lambda local: local[:, 1] < 0,
    "ahead": lambda local: local[:, 0] > 0,
    "forward": lambda local: local[:, 0] > 0,
    "front": lambda local: local[:, 0] > 0,
    "behind": lambda local: local[:, 0] < 0,
    "back": lambda local: local[:, 0] < 0,
}
"""Parts of the world as the robot sees them, from places in its own frame."""


# ------------------------------------------------------------------ to a landmark
def _within(distance_m: float) -> Callable[[Pose, Pose, Places], Mask]:
    def holds(robot: Pose, landmark: Pose, xy_m: Places) -> Mask:
        away_m = distances_m((landmark.x_m, landmark.y_m), xy_m)
        return (away_m > 0) & (away_m <= distance_m)

    return holds


def _on_side(direction_rad: float, intrinsic: bool) -> Callable[[Pose, Pose, Places], Mask]:
    """Within a cone around a side of the landmark: its own side, or the side as seen from the robot."""

    def holds(robot: Pose, landmark: Pose, xy_m: Places) -> Mask:
        facing_rad = landmark.yaw_rad if intrinsic else robot.point.bearing_to(landmark.point)
        local = local_m(Pose(landmark.x_m, landmark.y_m, facing_rad + direction_rad), xy_m)
        return (local[:, 0] > 0) & (np.abs(np.arctan2(local[:, 1], local[:, 0])) <= _HALF_CONE_RAD)

    return holds


BINARY: Mapping[str, Callable[[Pose, Pose, Places], Mask]] = {
    "near": _within(NEAR_M),
    "by": _within(NEAR_M),
    "next_to": _within(NEXT_TO_M),
    "beside": _within(NEXT_TO_M),
    "left_of": _on_side(math.pi / 2, intrinsic=False),
    "right_of": _on_side(-math.pi / 2, intrinsic=False),
    "in_front_of": _on_side(0.0, intrinsic=True),
    "behind": _on_side(math.pi, intrinsic=True),
}
"""Relations to one landmark: (robot, landmark, places of shape (n, 2)) -> which hold, shape (n,)."""


def between(first: Pose, second: Pose, xy_m: Places) -> Mask:
    """Beside the line from one landmark to the other, and past neither; shape (n,)."""
    length_m = first.point.distance_to(second.point)
    local = local_m(Pose(first.x_m, first.y_m, first.point.bearing_to(second.point)), xy_m)
    return (local[:, 0] > 0) & (local[:, 0] < length_m) & (np.abs(local[:, 1]) <= _BESIDE_LINE_M)


def meeting_order(robot: Pose, xy_m: Places) -> NDArray[np.intp]:
    """Rows in the order in which the robot would meet them along its heading; those behind it come last."""
    ahead_m = local_m(robot, xy_m)[:, 0]
    behind = ahead_m < 0
    return np.lexsort((np.abs(ahead_m), behind))

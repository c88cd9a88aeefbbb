"""Scan-to-map matching: where the robot stands, given where odometry says it is and the walls it knows.

Point-to-line iterative closest point (Censi, "An ICP variant using a point-to-line metric", ICRA 2008) against the
persistent walls, in Gauss-Newton form with odometry as the prior, so that few echoes pull little. What the walls in
view do not determine, such as the place along a bare corridor, is left as predicted.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Pose, wrap_angle

from .walls import Wall

Floats = NDArray[np.float64]

GATES_M = (0.25, 0.12, 0.08)  # the farthest a point may lie from its wall, in each round
END_SLACK_M = 0.05
OUTLIER_M = 0.03  # where the weight of a residual has fallen to a half
NEAR_M = 5.0
MIN_MATCHED = 8
MIN_MATCHED_SHARE = 0.2
MAX_RMS_M = 0.05
MAX_SHIFT_M = 0.15
MAX_TURN_RAD = math.radians(8.0)
# How far odometry may be off from one scan to the next, and a point from its wall; one standard deviation each.
PREDICTED_M = 0.003
PREDICTED_RAD = math.radians(0.12)
POINT_M = 0.02
INDEPENDENT_POINTS = 60.0  # more points than this say no more: their walls' errors are common to them
# The squared sines of the walls' angles to a direction, summed over the points matched: below this, it is not seen.
MIN_INFORMATION = 2.0


@dataclass(frozen=True, slots=True)
class Lines:
    """Walls as arrays, shape (walls,) or (walls, 2), map frame."""

    centres: Floats
    along: Floats
    normals: Floats  # to the left: the side from which the wall was seen
    first_m: Floats
    last_m: Floats

    @staticmethod
    def of(walls: Iterable[Wall]) -> Lines:
        """The walls given, in their order."""
        rows = np.array(
            [(w.centre.x_m, w.centre.y_m, w.direction_rad, w.first_m, w.last_m) for w in walls], dtype=np.float64
        ).reshape(-1, 5)
        c, s = np.cos(rows[:, 2]), np.sin(rows[:, 2])
        return Lines(rows[:, :2], np.column_stack([c, s]), np.column_stack([-s, c]), rows[:, 3], rows[:, 4])

    def facing(self, pose: Pose) -> Lines:
        """Those near ``pose`` that show it the side they were seen from."""
        offset = np.array([pose.x_m, pose.y_m]) - self.centres
        along_m = (offset * self.along).sum(axis=1)
        beyond_m = np.maximum(along_m - self.last_m, self.first_m - along_m)
        kept = ((offset * self.normals).sum(axis=1) > 0.0) & (beyond_m < NEAR_M)
        return Lines(self.centres[kept], self.along[kept], self.normals[kept], self.first_m[kept], self.last_m[kept])


def match(predicted: Pose, points: Floats, lines: Lines) -> Pose:
    """The pose near ``predicted`` that lays ``points`` (body frame, shape (n, 2)) onto ``lines``.

    Returns ``predicted`` itself when too little of the scan fits the walls or the correction would be a jump.
    """
    lines = lines.facing(predicted)
    if len(points) < MIN_MATCHED or not len(lines.centres):
        return predicted
    pose = predicted
    for gate_m in GATES_M:
        residuals, normals, arms, share = _residuals(pose, points, lines, gate_m)
        if len(residuals) < MIN_MATCHED or share < MIN_MATCHED_SHARE:
            return predicted
        pose = _stepped(pose, predicted, residuals, normals, arms)
    rms_m = math.sqrt(float(np.mean(residuals**2)))
    shift_m = predicted.point.distance_to(pose.point)
    turn_rad = abs(wrap_angle(pose.yaw_rad - predicted.yaw_rad))
    return predicted if rms_m > MAX_RMS_M or shift_m > MAX_SHIFT_M or turn_rad > MAX_TURN_RAD else pose


def _residuals(pose: Pose, points: Floats, lines: Lines, gate_m: float) -> tuple[Floats, Floats, Floats, float]:
    """Of the points matched: signed distance to their wall, its normal, and the lever arm of the robot's yaw.

    The last is the share of all points that was matched.
    """
    c, s = math.cos(pose.yaw_rad), math.sin(pose.yaw_rad)
    rotated = points @ np.array([[c, s], [-s, c]])
    place = np.array([pose.x_m, pose.y_m])
    # Dot products of every point with every wall, without a (points, walls, 2) array in between.
    offsets = rotated @ lines.normals.T + ((place - lines.centres) * lines.normals).sum(axis=1)
    along = rotated @ lines.along.T + ((place - lines.centres) * lines.along).sum(axis=1)
    beyond = (along < lines.first_m - END_SLACK_M) | (along > lines.last_m + END_SLACK_M)
    distances = np.where(beyond, np.inf, np.abs(offsets))
    nearest = distances.argmin(axis=1)
    every = np.arange(len(points))
    kept = distances[every, nearest] < gate_m
    wall = nearest[kept]
    normals = lines.normals[wall]
    arms = normals[:, 1] * rotated[kept, 0] - normals[:, 0] * rotated[kept, 1]
    return offsets[every[kept], wall], normals, arms, float(kept.mean())


def _stepped(pose: Pose, predicted: Pose, residuals: Floats, normals: Floats, arms: Floats) -> Pose:
    """One Gauss-Newton step towards the likeliest pose, in the observable directions only."""
    weights = 1.0 / (1.0 + (residuals / OUTLIER_M) ** 2)
    jacobian = np.column_stack([normals, arms])
    weighted = jacobian * weights[:, None]
    information = jacobian.T @ weighted
    directions = _observable(information)
    certainty = min(1.0, INDEPENDENT_POINTS / len(residuals)) / POINT_M**2
    prior = np.array([PREDICTED_M**-2, PREDICTED_M**-2, PREDICTED_RAD**-2])
    strayed = (pose.x_m - predicted.x_m, pose.y_m - predicted.y_m, wrap_angle(pose.yaw_rad - predicted.yaw_rad))
    gradient = certainty * (weighted.T @ residuals) + prior * np.array(strayed)
    hessian = certainty * information + np.diag(prior)
    step = -directions @ np.linalg.solve(directions.T @ hessian @ directions, directions.T @ gradient)
    return Pose(pose.x_m + float(step[0]), pose.y_m + float(step[1]), wrap_angle(pose.yaw_rad + float(step[2])))


def _observable(information: Floats) -> Floats:
    """An orthonormal basis, shape (3, 1 to 3), of yaw (any wall tells it) and what is seen of the place."""
    lever = max(float(information[2, 2]), 1e-9)
    place = information[:2, :2] - np.outer(information[:2, 2], information[2, :2]) / lever
    strengths, axes = np.linalg.eigh(place)
    seen = axes[:, strengths > MIN_INFORMATION]
    basis = np.zeros((3, seen.shape[1] + 1))
    basis[:2, :-1], basis[2, -1] = seen, 1.0
    return basis

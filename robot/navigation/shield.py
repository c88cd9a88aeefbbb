"""The last word before the wheels: no motion whose stopping distance ends in something that the laser sees."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.body import Limits, Scan
from robot.geometry import Pose
from robot.mapping.lines import echo_points

KEEP_AWAY_M = 0.015  # between the robot's circle and what is seen
REACTION_S = 0.3  # the laser's period and the command's way to the wheels
BRAKE_SHARE = 0.6  # of the body's acceleration
STEP_M = 0.02
CLOSER_M = 0.003  # less than this is noise, not an approach
CREEP_MPS = 0.015
STANDSTILL_MPS = 1e-4

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Surroundings:
    """The echoes of the newest scan in the map frame, shape (echoes, 2): where they were when it was taken."""

    time_s: float
    points: Floats

    @staticmethod
    def seen(scan: Scan, pose: Pose) -> Surroundings:
        """What a scan taken at ``pose`` shows."""
        c, s = math.cos(pose.yaw_rad), math.sin(pose.yaw_rad)
        place = np.array([pose.x_m, pose.y_m])
        return Surroundings(scan.time_s, echo_points(scan) @ np.array([[c, s], [-s, c]]) + place)

    def clearance_m(self, pose: Pose) -> float:
        """From the turning centre to the nearest echo; inf for none."""
        offsets = self.points - (pose.x_m, pose.y_m)
        return float(np.hypot(offsets[:, 0], offsets[:, 1]).min(initial=np.inf))


def safe_speed(
    linear_mps: float, angular_radps: float, pose: Pose, surroundings: Surroundings, limits: Limits
) -> float:
    """``linear_mps``, lowered until the robot can stop on its arc before anything seen; 0 when it cannot move at all.

    Moving away from what is already too near is always allowed. Turning in place keeps within the robot's circle.
    """
    if abs(linear_mps) < STANDSTILL_MPS or not len(surroundings.points):
        return linear_mps
    brake = BRAKE_SHARE * limits.linear_acceleration_mps2
    reach_m = linear_mps**2 / (2.0 * brake) + abs(linear_mps) * REACTION_S + KEEP_AWAY_M + STEP_M
    near = surroundings.points - (pose.x_m, pose.y_m)
    near = near[np.hypot(near[:, 0], near[:, 1]) < reach_m + limits.radius_m + KEEP_AWAY_M]
    if not len(near):
        return linear_mps
    along_m = np.arange(0.0, reach_m + STEP_M, STEP_M)
    arc = _arc(along_m, linear_mps, angular_radps, pose.yaw_rad)
    clearances = np.hypot(arc[:, None, 0] - near[None, :, 0], arc[:, None, 1] - near[None, :, 1]).min(axis=1)
    closing = clearances < min(limits.radius_m + KEEP_AWAY_M, float(clearances[0]) - CLOSER_M)
    if not closing.any():
        return linear_mps
    free_m = max(float(along_m[int(closing.argmax())]) - STEP_M, 0.0)
    # Solves v * reaction + v^2 / (2 brake) = free distance.
    lag = brake * REACTION_S
    speed = math.sqrt(lag**2 + 2.0 * brake * free_m) - lag
    return 0.0 if speed < CREEP_MPS else math.copysign(min(abs(linear_mps), speed), linear_mps)


def _arc(along_m: Floats, linear_mps: float, angular_radps: float, yaw_rad: float) -> Floats:
    """Places on the way, relative to the robot in the map's orientation, shape (places, 2)."""
    turned = along_m * (angular_radps / abs(linear_mps))
    # The chord of an arc points half the turn away from the tangent and is shorter by sinc.
    chord = math.copysign(1.0, linear_mps) * along_m * np.sinc(turned / math.tau)
    bearing = yaw_rad + turned / 2.0
    return np.column_stack([chord * np.cos(bearing), chord * np.sin(bearing)])

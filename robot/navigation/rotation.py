"""Turning in place: first at speed to an estimate, then slowly until the heading verifiably stands."""

from __future__ import annotations

import math

from robot.body import Limits
from robot.geometry import wrap_angle

from .goals import Phase, Rotate, sense

SPEED_SHARE = 0.7  # of the body's limit: the rest is for correction
BRAKE_SHARE = 0.4  # of the body's angular acceleration
ESTIMATED_RAD = math.radians(3.0)
TRIMMED_RAD = math.radians(0.12)  # where trimming ends
VERIFIED_RAD = math.radians(0.5)  # where it would begin again: farther off than the heading's estimate jitters
SETTLE_S = 0.3  # longer than one period of the laser, so that a corrected heading has come in
VERIFY_GAIN = 2.0  # radians a second per radian
VERIFY_MIN_RADPS = 0.04
VERIFY_MAX_RADPS = 0.3


class Rotation:
    """One turn in place. It counts the heading's changes, so it may be left for a while and taken up again."""

    def __init__(self, goal: Rotate, yaw_rad: float, limits: Limits) -> None:
        self._goal = goal
        self._limits = limits
        self._yaw_rad = yaw_rad
        self._settled_s = 0.0
        self._trimming = True
        self.phase = Phase.ESTIMATE_ROTATION
        self.remaining_rad = goal.angle_rad
        if goal.final_yaw_rad is not None:
            self.remaining_rad += wrap_angle(goal.final_yaw_rad - yaw_rad - goal.angle_rad)

    @property
    def remaining(self) -> Rotate:
        """The goal that would finish this turn from the heading last seen."""
        return Rotate(self.remaining_rad, self._goal.final_yaw_rad)

    @property
    def is_done(self) -> bool:
        return self._settled_s >= SETTLE_S

    def step(self, yaw_rad: float, period_s: float) -> float:
        """The angular velocity to command now, radians a second."""
        self.remaining_rad -= wrap_angle(yaw_rad - self._yaw_rad)
        self._yaw_rad = yaw_rad
        if self.phase is Phase.ESTIMATE_ROTATION and abs(self.remaining_rad) > ESTIMATED_RAD:
            return turn_speed(self.remaining_rad, self._limits)
        self.phase = Phase.VERIFY_ROTATION
        self._trimming = abs(self.remaining_rad) > (TRIMMED_RAD if self._trimming else VERIFIED_RAD)
        if not self._trimming:
            self._settled_s += period_s
            return 0.0
        self._settled_s = 0.0
        speed = min(max(VERIFY_GAIN * abs(self.remaining_rad), VERIFY_MIN_RADPS), VERIFY_MAX_RADPS)
        return speed * sense(self.remaining_rad)


def turn_speed(remaining_rad: float, limits: Limits) -> float:
    """The fastest angular velocity from which the rest of a turn is enough to stop."""
    brake = BRAKE_SHARE * limits.angular_acceleration_radps2
    speed = min(SPEED_SHARE * limits.angular_max_radps, math.sqrt(2.0 * brake * abs(remaining_rad)))
    return speed * sense(remaining_rad)

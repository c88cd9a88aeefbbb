"""The navigator: one goal at a time, one step a control period, always within the body's limits and out of harm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from robot.body import Limits, Scan
from robot.geometry import Pose
from robot.mapping.grid import OccupancyGrid

from .goals import Drive, Goal, Reach, State
from .reach import Reaching, View
from .rotation import Rotation
from .shield import Surroundings, safe_speed

LONGEST_PERIOD_S = 0.25  # between steps; a longer gap was a pause, in which the wheels stood still
NOTHING_SEEN = Surroundings(-1.0, np.empty((0, 2)))


class Navigator:
    """Turns a goal into velocities.

    To pause, stop calling :meth:`step` and command zero; to go on, call it again, or start :attr:`remaining` anew. It
    reads no clock: time comes in with each call.
    """

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._task: Reaching | Rotation | None = None
        self._surroundings = NOTHING_SEEN
        self._last_s = 0.0
        self._spent_s = 0.0
        self._speed_mps = 0.0

    def start(self, goal: Goal, pose: Pose, time_s: float) -> None:
        """Take up a goal from ``pose`` (map frame) and drop the one before."""
        self._last_s, self._spent_s, self._speed_mps = time_s, 0.0, 0.0
        if isinstance(goal, Reach):
            self._task = Reaching(goal, self._limits)
        else:
            self._task = Rotation(goal, pose.yaw_rad, self._limits)

    @property
    def remaining(self) -> Goal | None:
        """What is left to do of the goal, as of the last step; None when nothing is under way."""
        if self._task is None:
            return None
        return self._task.goal if isinstance(self._task, Reaching) else self._task.remaining

    def step(self, pose: Pose, scan: Scan | None, grid: OccupancyGrid, time_s: float) -> Drive:
        """The velocities for the coming control period.

        ``scan`` is the newest there is: a scan not seen before must have been taken at ``pose``, and may be given again
        (or left out) until the next one.

        Raises:
            RuntimeError: no goal is under way.
        """
        if self._task is None:
            raise RuntimeError("no goal: call start() first")
        if scan is not None and scan.time_s != self._surroundings.time_s:
            self._surroundings = Surroundings.seen(scan, pose)
        period_s = min(time_s - self._last_s, LONGEST_PERIOD_S)
        if time_s - self._last_s > LONGEST_PERIOD_S:
            self._speed_mps = 0.0
        self._last_s = time_s
        self._spent_s += period_s
        if isinstance(self._task, Rotation):
            drive = _rotate(self._task, pose, period_s)
        else:
            view = View(pose, self._surroundings, grid, self._spent_s, period_s, self._speed_mps)
            drive = self._guarded(self._task.step(view), pose, period_s)
        if drive.state is not State.ACTIVE:
            self._task = None
        self._speed_mps = drive.linear_mps
        return drive

    def _guarded(self, drive: Drive, pose: Pose, period_s: float) -> Drive:
        """The same drive, within the acceleration limit and no faster than the laser's view lets the robot stop."""
        if drive.state is not State.ACTIVE:
            return drive
        gain = self._limits.linear_acceleration_mps2 * period_s
        linear = min(max(drive.linear_mps, self._speed_mps - gain), self._speed_mps + gain)
        angular = min(max(drive.angular_radps, -self._limits.angular_max_radps), self._limits.angular_max_radps)
        linear = safe_speed(linear, angular, pose, self._surroundings, self._limits)
        return replace(drive, linear_mps=linear, angular_radps=angular)


def _rotate(task: Rotation, pose: Pose, period_s: float) -> Drive:
    angular = task.step(pose.yaw_rad, period_s)
    state = State.ARRIVED if task.is_done else State.ACTIVE
    return Drive(0.0, 0.0 if task.is_done else angular, state, task.phase)

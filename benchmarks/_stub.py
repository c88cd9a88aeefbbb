"""A robot with a body without physics, as a process of its own: ``python -m benchmarks._stub URL``."""

from __future__ import annotations

import argparse
import math
import sys
import threading
import time
from collections.abc import Callable, Sequence

import numpy as np

from robot import turtlebot3 as tb3
from robot.body import CameraModel, Image, Limits, Odometry, Scan
from robot.bridge import Bridge
from robot.control import Robot, read_boot
from robot.geometry import ORIGIN, Pose
from robot.pacing import parse_speed, run
from robot.process import stop_on_signals

ROOM_HALF_M = 3.0  # a square room about the origin
SCAN_PERIOD_S = 0.2
ANGLES_RAD = np.arange(360) * (math.tau / 360)


class StubBody:
    """Exact kinematics at once, and a laser that sees a square room; nothing can be touched.

    ``heed`` is called with every command to the wheels, and ``step`` takes no longer than it must.
    """

    def __init__(self, start: Pose, heed: Callable[[float, float], None]) -> None:
        self._pose = start
        self._heed = heed
        self._speed = (0.0, 0.0)
        self._time_s = 0.0
        self._scanned_s = -math.inf

    @property
    def limits(self) -> Limits:
        return tb3.LIMITS

    @property
    def camera(self) -> CameraModel:
        return CameraModel(640, 480, 530.0, (319.5, 239.5), (0.0, 0.0, 0.1))

    @property
    def time_s(self) -> float:
        return self._time_s

    def drive(self, linear_mps: float, angular_radps: float) -> None:
        self._speed = (linear_mps, angular_radps)
        self._heed(linear_mps, angular_radps)

    def step(self, duration_s: float) -> None:
        linear_mps, angular_radps = self._speed
        half_turn = Pose(0.0, 0.0, angular_radps * duration_s / 2)
        self._pose = self._pose.compose(half_turn).compose(Pose(linear_mps * duration_s, 0.0, 0.0)).compose(half_turn)
        self._time_s += duration_s

    def odometry(self) -> Odometry:
        return Odometry(self._time_s, self._pose, *self._speed)

    def scan(self) -> Scan | None:
        if self._time_s - self._scanned_s < SCAN_PERIOD_S - 1e-9:
            return None
        self._scanned_s = self._time_s
        bearings = ANGLES_RAD + self._pose.yaw_rad
        with np.errstate(divide="ignore"):
            ahead = (np.sign(np.cos(bearings)) * ROOM_HALF_M - self._pose.x_m) / np.cos(bearings)
            aside = (np.sign(np.sin(bearings)) * ROOM_HALF_M - self._pose.y_m) / np.sin(bearings)
        ranges = np.minimum(ahead, aside)
        laser = tb3.LASER
        seen = (ranges >= laser.min_range_m) & (ranges <= laser.max_range_m)
        return Scan(self._time_s, ANGLES_RAD, np.where(seen, ranges, np.inf), laser.min_range_m, laser.max_range_m)

    def image(self) -> Image | None:
        return None

    def close(self) -> None:
        """Nothing to let go of."""


class Watch:
    """Notes when the wheels come to a stand, and how punctual the control periods are, by the machine's own clock."""

    def __init__(self, report_stops: bool) -> None:
        self._report_stops = report_stops
        self._rolling = False

    def heed(self, linear_mps: float, angular_radps: float) -> None:
        rolls = linear_mps != 0.0 or angular_radps != 0.0
        if self._rolling and not rolls and self._report_stops:
            print(time.monotonic(), flush=True)
        self._rolling = rolls


def main(arguments: Sequence[str] | None = None) -> None:
    """Run until a signal comes."""
    parser = argparse.ArgumentParser()
    parser.add_argument("url")
    parser.add_argument("--namespace", default="")
    parser.add_argument("--speed", default="1")
    parser.add_argument("--stops", action="store_true", help="print the time whenever the wheels come to a stand")
    read = parser.parse_args(arguments)
    stopping = threading.Event()
    stop_on_signals(stopping)
    bridge = Bridge(read.url, read.namespace)
    boot = bridge.open()
    record = read_boot(boot)
    body = StubBody(ORIGIN if record is None else record.pose, Watch(read.stops).heed)
    run(Robot(body, bridge, boot=boot), parse_speed(read.speed), stopping)
    bridge.close()


if __name__ == "__main__":
    main(sys.argv[1:])

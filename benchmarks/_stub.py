"""A robot whose wheels are watched, as a process of its own: ``python -m benchmarks._stub URL``."""

from __future__ import annotations

import argparse
import json
import math
import sys
import threading
import time
from collections.abc import Sequence
from importlib.resources import files
from typing import cast

import numpy as np

from robot import turtlebot3 as tb3
from robot.body import Body, CameraModel, Image, Limits, Odometry, Scan
from robot.bridge import Bridge
from robot.control import PERIOD_S, Robot, read_boot
from robot.geometry import ORIGIN, Pose
from robot.pacing import parse_speed, run
from robot.process import stop_on_signals
from robot.sightings import Markers
from voxml.scene import find_scene

ROOM_HALF_M = 3.0  # a square room about the origin
SCAN_PERIOD_S = 0.2
ANGLES_RAD = np.arange(360, dtype=np.float64) * (math.tau / 360)


class StubBody:
    """Exact kinematics, obeyed at once, and a laser that sees a square room; nothing can be touched."""

    def __init__(self, start: Pose) -> None:
        self._pose = start
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
        along, across = np.cos(bearings), np.sin(bearings)
        with np.errstate(divide="ignore", invalid="ignore"):
            ahead = (np.sign(along) * ROOM_HALF_M - self._pose.x_m) / along
            aside = (np.sign(across) * ROOM_HALF_M - self._pose.y_m) / across
        ranges = np.fmin(ahead, aside)
        laser = tb3.LASER
        ranges[(ranges < laser.min_range_m) | (ranges > laser.max_range_m)] = np.inf
        return Scan(self._time_s, ANGLES_RAD, ranges, laser.min_range_m, laser.max_range_m)

    def image(self) -> Image | None:
        return None

    def close(self) -> None:
        """Nothing to let go of."""


class Watched:
    """A body that notes, by the machine's own clock, when its wheels come to a stand and when each period begins."""

    def __init__(self, body: Body, tell_stops: bool) -> None:
        self._body = body
        self._tell_stops = tell_stops
        self._rolling = False
        self.began_s: list[float] = []

    def __getattr__(self, name: str) -> object:
        return getattr(self._body, name)

    def drive(self, linear_mps: float, angular_radps: float) -> None:
        self._body.drive(linear_mps, angular_radps)
        rolls = linear_mps != 0.0 or angular_radps != 0.0
        if self._tell_stops and self._rolling and not rolls:
            print(time.monotonic(), flush=True)
        self._rolling = rolls

    def step(self, duration_s: float) -> None:
        self.began_s.append(time.monotonic())
        self._body.step(duration_s)


def lateness_s(began_s: Sequence[float], since_s: float) -> list[float]:
    """How late each period began of those after ``since_s``, in seconds.

    The n-th is due n periods after the first; of all such schedules, the one in which none is early counts.
    """
    off = [each - n * PERIOD_S for n, each in enumerate(each for each in began_s if each > since_s)]
    return [each - min(off) for each in off]


def main(arguments: Sequence[str] | None = None) -> None:
    """Run until a signal comes; then print the lateness of the periods if they were asked for."""
    parser = argparse.ArgumentParser()
    parser.add_argument("url")
    parser.add_argument("--namespace", default="")
    parser.add_argument("--speed", default="1")
    parser.add_argument("--world", help="drive the simulated robot in this world instead of a body without physics")
    parser.add_argument("--stops", action="store_true", help="print the time whenever the wheels come to a stand")
    parser.add_argument("--lateness", type=float, help="count the periods from this time on; print them at the end")
    read = parser.parse_args(arguments)
    stopping = threading.Event()
    stop_on_signals(stopping)
    bridge = Bridge(read.url, read.namespace)
    boot = bridge.open()
    record = read_boot(boot)
    start = ORIGIN if record is None else record.pose
    bare, markers = (StubBody(start), None) if read.world is None else _simulated(read.world)
    body = Watched(bare, read.stops)
    run(Robot(cast(Body, body), bridge, boot=boot, markers=markers), parse_speed(read.speed), stopping)
    bridge.close()
    if read.lateness is not None:
        print(json.dumps({"late_s": lateness_s(body.began_s, read.lateness), "cpu_s": time.process_time()}))


def _simulated(world: str) -> tuple[Body, Markers]:
    from robot.pybullet_body import PybulletBody

    scene = find_scene(world, files("corpora").joinpath("worlds"))
    body = PybulletBody(scene)
    return body, Markers(body.camera, scene.marker_size_m)


if __name__ == "__main__":
    main(sys.argv[1:])

"""A robot driven for measuring: the whole control loop over a simulated body whose truth can be read."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.resources import files

from robot.control import Robot
from robot.geometry import Point, Pose
from robot.messages import FeedbackCode, GoTo, encode_command
from robot.port import MemoryPort
from robot.pybullet_body import PybulletBody
from robot.sightings import Markers
from voxml.scene import Scene, find_scene

WORLDS = ("figure3", "apartment", "corridor", "lab", "maze", "hall")
WITH_CAMERA = ("hall",)  # where the laser is often out of reach of everything and markers tell the robot where it is
_BLIND_HZ = 0.0  # one picture at the start and no more: where markers play no part, nothing is drawn


@dataclass(frozen=True, slots=True)
class Trip:
    """What became of a command: its feedback codes, how far the robot truly drove, and the simulated time it took."""

    codes: tuple[FeedbackCode, ...]
    driven_m: float
    seconds: float


class Driver:
    """One robot in one world, commanded as over the wire and watched from outside."""

    def __init__(self, scene: Scene, start: Pose | None, seed: int | None, camera: bool) -> None:
        self.body = (
            PybulletBody(scene, start=start, seed=seed)
            if camera
            else PybulletBody(scene, start=start, seed=seed, camera_rate_hz=_BLIND_HZ)
        )
        self.port = MemoryPort()
        markers = Markers(self.body.camera, scene.marker_size_m) if camera else None
        self.robot = Robot(self.body, self.port, markers=markers)
        self.driven_m = 0.0
        self.robot.settle(1.0)
        self.robot.attend()

    def send(self, text: str, limit_s: float, watch: Callable[[Pose], None] | None = None) -> Trip:
        """Command, and wait until the robot is idle or ``limit_s`` of its time have passed; then it is halted.

        ``watch`` is shown the true pose after every control period.
        """
        self.port.feedback.clear()
        before_m, began_s = self.driven_m, self.body.time_s
        self.port.send(text)
        self.robot.attend()
        while self.robot.busy and self.body.time_s - began_s < limit_s:
            here = self.body.truth()
            self.robot.tick()
            there = self.body.truth()
            self.driven_m += here.point.distance_to(there.point)
            if watch is not None:
                watch(there)
        seconds = self.body.time_s - began_s
        self.robot.attend()
        trip = Trip(tuple(each.code for each in self.port.feedback), self.driven_m - before_m, seconds)
        self.port.send("cancel all")
        self.robot.attend()
        self.robot.settle(0.3)
        return trip

    def go_to(self, place: Point, limit_s: float) -> Trip:
        return self.send(encode_command(GoTo(place.x_m, place.y_m)), limit_s)


@contextmanager
def driver(
    scene: Scene, *, start: Pose | None = None, seed: int | None = None, camera: bool = False
) -> Iterator[Driver]:
    """A robot that has looked around; without ``camera`` it takes no pictures and knows of no markers."""
    made = Driver(scene, start, seed, camera)
    try:
        yield made
    finally:
        made.body.close()


def world(name: str) -> Scene:
    """One of the worlds that come with Kirby."""
    return find_scene(name, files("corpora").joinpath("worlds"))


def progress(text: str) -> None:
    """Say on the error stream how far a long measurement has come."""
    print(text, file=sys.stderr, flush=True)

"""The people at the world: each browser with a name, a camera of its own, and its own corner of the panel."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field

import numpy as np
import viser
from numpy.typing import NDArray

from dialogue.events import CameraMove
from robot.geometry import Pose

from .cameras import Bounds, Camera, Viewpoint
from .motion import TIME_CONSTANT_S, Vector, blend

NAME_KEY = "kirby-name"
NAME_MAX = 24
ECHO_S = 1.0  # what a browser says so soon after it was told to move may be older
BY_HAND_M = 0.25
_CLOSE_M = 0.01


@dataclass(eq=False)
class Person:
    """One browser. ``by_hand`` is true while the person has turned the camera with the mouse and no view was chosen."""

    client: viser.ClientHandle
    name: str
    viewpoint: Viewpoint = field(default_factory=Viewpoint)
    by_hand: bool = False
    goal: Camera | None = None
    shown: Camera | None = None
    _set_s: float = 0.0

    def move(self, move: CameraMove) -> None:
        """Change the viewpoint; the camera glides there in the frames that follow."""
        self.viewpoint = self.viewpoint.moved(move)
        if self.by_hand:
            self.by_hand = False
            self.shown = Camera(_vector(self.client.camera.position), _vector(self.client.camera.look_at))

    def aim(self, robot: Pose | None, bounds: Bounds) -> None:
        """Set the goal from the viewpoint."""
        if self.by_hand:
            return
        camera = self.client.camera
        aspect = camera.image_width / max(1, camera.image_height) if camera.image_height else 1.5
        self.goal = self.viewpoint.camera(robot or Pose(0.0, 0.0, 0.0), bounds, camera.fov or 1.0, aspect)

    def glide(self, duration_s: float) -> bool:
        """One frame towards the goal; whether another is wanted."""
        goal = self.goal
        if goal is None or self.shown == goal:
            return False
        start = self.shown
        share = 1.0 - math.exp(-duration_s / TIME_CONSTANT_S)
        if start is None or _apart_m(start, goal) < _CLOSE_M:
            self.shown = goal
        else:
            self.shown = Camera(
                blend(start.position_m, goal.position_m, share), blend(start.look_at_m, goal.look_at_m, share)
            )
        self._set_s = time.monotonic()
        with self.client.atomic():
            self.client.camera.position = self.shown.position_m
            self.client.camera.look_at = self.shown.look_at_m
        self.client.flush()
        return self.shown != goal

    def noticed(self, camera: viser.CameraHandle) -> None:
        """The browser says where its camera is: somebody may have taken it into their own hands."""
        if self.goal is None or self.shown != self.goal or time.monotonic() - self._set_s < ECHO_S:
            return
        off_m = max(
            math.dist(camera.position, self.goal.position_m),
            math.dist(camera.look_at, self.goal.look_at_m),
        )
        if off_m > BY_HAND_M:
            self.by_hand = True
            self.goal = self.shown = None


def fit_name(text: str, taken: set[str]) -> str:
    """A name of one line that nobody else has."""
    wanted = " ".join(text.split())[:NAME_MAX].strip() or "Guest"
    name, number = wanted, 2
    while name in taken:
        name, number = f"{wanted} {number}", number + 1
    return name


def _apart_m(first: Camera, second: Camera) -> float:
    return max(math.dist(first.position_m, second.position_m), math.dist(first.look_at_m, second.look_at_m))


def _vector(values: NDArray[np.float64]) -> Vector:
    x, y, z = (float(value) for value in values)
    return x, y, z

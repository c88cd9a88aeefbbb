"""A TurtleBot3 Waffle Pi simulated in pybullet: a `robot.body.Body` with physics, senses and their noise."""

from __future__ import annotations

import math

import numpy as np

from voxml.scene import Scene

from . import turtlebot3 as tb3
from .body import CameraModel, Image, Limits, Odometry, Scan
from .geometry import Pose
from .simulation.chassis import Chassis
from .simulation.engine import STEP_RATE_HZ, connect, pybullet
from .simulation.senses import CAMERA, Camera, Laser, Noise, Odometer
from .simulation.stage import build_stage

_ODOMETER_STEPS = 4  # encoders are read at 60 Hz


class PybulletBody:
    """The robot in a scene of its own; several may live in one process.

    The map's frame is the scene's: odometry begins at the robot's start pose, so that its coordinates are the world
    file's as far as it has not drifted. All noise comes from generators seeded by ``seed`` (default: the scene's), one
    for each sense: the same calls give the same run, to the last bit, and a sense that is not read changes no other.
    Scans and pictures are taken when they are asked for, at most at their rates, the first at time 0.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        start: Pose | None = None,
        seed: int | None = None,
        noise: Noise | None = None,
        camera_rate_hz: float = 2.0,
    ) -> None:
        """Build the world and stand the robot in it.

        Args:
            scene: walls, objects, start pose and seed.
            start: where the robot stands instead of the scene's start, map frame.
            seed: of all noise, instead of the scene's.
            noise: how far the senses err; realistic where not given.
            camera_rate_hz: pictures per simulated second at most.
        """
        start = start or Pose(scene.start.x_m, scene.start.y_m, scene.start.yaw_rad)
        noise = noise or Noise()
        for_odometer, for_laser, for_camera = np.random.default_rng(scene.seed if seed is None else seed).spawn(3)
        self._client = connect()
        self._names = build_stage(scene, self._client)
        self._chassis = Chassis(start, self._client)
        self._odometer = Odometer(start, noise, for_odometer)
        self._laser = Laser(noise, for_laser, self._client)
        self._camera = Camera(noise, for_camera, self._client)
        self._scan_due = _Due(tb3.LASER.rate_hz)
        self._image_due = _Due(camera_rate_hz)
        self._touched: dict[str, None] = {}
        self._steps = 0
        self._asked_s = 0.0

    @property
    def limits(self) -> Limits:
        return tb3.LIMITS

    @property
    def camera(self) -> CameraModel:
        return CAMERA

    @property
    def time_s(self) -> float:
        return self._steps / STEP_RATE_HZ

    def drive(self, linear_mps: float, angular_radps: float) -> None:
        """Set the wheels' target; it holds until the next call and is clipped to the limits.

        Raises:
            ValueError: a value is not a finite number.
        """
        self._chassis.drive(linear_mps, angular_radps)

    def step(self, duration_s: float) -> None:
        """Let time pass, in whole steps of 1/240 s; what is left over is added to the next call's."""
        self._asked_s += duration_s
        while self._steps < round(self._asked_s * STEP_RATE_HZ):
            self._step_once()

    def _step_once(self) -> None:
        self._chassis.advance()
        pybullet.stepSimulation(physicsClientId=self._client)
        self._steps += 1
        self._feel()
        if self._steps % _ODOMETER_STEPS == 0:
            self._odometer.update(self.time_s, self._chassis.wheels())

    def _feel(self) -> None:
        for body in self._chassis.touched():
            if body in self._names:
                self._touched.setdefault(self._names[body])

    def odometry(self) -> Odometry:
        """Where the wheels say it is, counted up to the last whole 1/60 s."""
        return self._odometer.odometry

    def scan(self) -> Scan | None:
        """A scan, if 1/5 s has passed since the last."""
        return self._laser.scan(self.time_s, self.truth()) if self._scan_due.now(self.time_s) else None

    def image(self) -> Image | None:
        """A picture, if one is due."""
        return self._camera.image(self.time_s, self.truth()) if self._image_due.now(self.time_s) else None

    def truth(self) -> Pose:
        """Where the robot truly is, map frame: for tests and measurements only."""
        return self._chassis.pose()

    def contacts(self) -> tuple[str, ...]:
        """What it has touched since the start, first touch first: objects by id, walls as ``wall 0`` and so on."""
        return tuple(self._touched)

    def close(self) -> None:
        """Leave the engine; the body cannot be used afterwards. Closing twice does no harm."""
        if self._client >= 0:
            pybullet.disconnect(physicsClientId=self._client)
            self._client = -1


class _Due:
    """Tells when a periodic sense may be read again: on a fixed grid of times, so that late reading adds no drift."""

    def __init__(self, rate_hz: float) -> None:
        self._rate_hz = rate_hz
        self._next = 0

    def now(self, time_s: float) -> bool:
        turn = math.floor(time_s * self._rate_hz + 1e-9)
        if turn < self._next:
            return False
        self._next = turn + 1
        return True

"""What the simulated robot senses, noise included: its wheels' encoders, the laser scanner, the camera."""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from robot import turtlebot3 as tb3
from robot.body import Image, Odometry, Scan
from robot.geometry import Pose

from .engine import pybullet


@dataclass(frozen=True, slots=True)
class Noise:
    """How far the senses err; each figure is one standard deviation, and 0 turns it off.

    ``wheel_scale`` is each wheel's own constant error of radius, drawn once a run (the manual's 66 mm is to the
    millimetre, but wear and load differ by tenths of a percent); ``wheel_slip`` grows with the root of the way rolled:
    metres for one metre. Together they turn the heading by about 0.4 degrees in each metre driven.
    """

    range_m: float = tb3.LASER.noise_m
    image_levels: float = 3.0
    wheel_scale: float = 0.001
    wheel_slip: float = 0.0007


_BEAMS_RAD = np.arange(tb3.LASER.beams) * (math.tau / tb3.LASER.beams)

# TinyRenderer samples the picture plane at the left and lower edges of the pixels, not in their middle.
CAMERA = tb3.pinhole((tb3.CAMERA_SIZE_PX[0] / 2, tb3.CAMERA_SIZE_PX[1] / 2 - 1))
CAMERA_SETTINGS = {
    "width": CAMERA.width_px,
    "height": CAMERA.height_px,
    "projectionMatrix": pybullet.computeProjectionMatrixFOV(
        fov=math.degrees(2 * math.atan(CAMERA.height_px / 2 / CAMERA.focal_px)),
        aspect=CAMERA.width_px / CAMERA.height_px,
        nearVal=0.03,
        farVal=60.0,
    ),
    "shadow": 0,
    "lightDirection": [-1, 0.4, 2],
    "lightAmbientCoeff": 0.65,
    "lightDiffuseCoeff": 0.35,
    "lightSpecularCoeff": 0,
    "renderer": pybullet.ER_TINY_RENDERER,
    "flags": pybullet.ER_NO_SEGMENTATION_MASK,
}

_FLOOR = np.full((CAMERA.height_px, CAMERA.width_px, 3), (117, 107, 97), dtype=np.uint8)

NO_NOISE = Noise(0.0, 0.0, 0.0, 0.0)


class Odometer:
    """Dead reckoning from the two wheels' encoders; it drifts."""

    def __init__(self, start: Pose, noise: Noise, random: np.random.Generator) -> None:
        self._pose = start
        self._slip = noise.wheel_slip
        self._radii = tb3.WHEEL_RADIUS_M * (1 + noise.wheel_scale * random.standard_normal(2))
        self._random = random
        self._angles = (0.0, 0.0)
        self.odometry = Odometry(0.0, start, 0.0, 0.0)

    def update(self, time_s: float, wheels: tuple[tuple[float, float], tuple[float, float]]) -> None:
        """Count what the wheels have turned since the last update; exact for any arc."""
        (left_rad, left_radps), (right_rad, right_radps) = wheels
        left_m = self._travelled(0, left_rad)
        right_m = self._travelled(1, right_rad)
        self._angles = (left_rad, right_rad)
        half_turn_rad = (right_m - left_m) / tb3.WHEEL_SEPARATION_M / 2
        chord_m = (left_m + right_m) / 2 * (math.sin(half_turn_rad) / half_turn_rad if half_turn_rad else 1.0)
        self._pose = self._pose.turned(half_turn_rad).ahead(chord_m).turned(half_turn_rad)
        left_mps, right_mps = left_radps * tb3.WHEEL_RADIUS_M, right_radps * tb3.WHEEL_RADIUS_M
        speeds = (left_mps + right_mps) / 2, (right_mps - left_mps) / tb3.WHEEL_SEPARATION_M
        self.odometry = Odometry(time_s, self._pose, *speeds)

    def _travelled(self, wheel: int, angle_rad: float) -> float:
        rolled_m = float(self._radii[wheel]) * (angle_rad - self._angles[wheel])
        return rolled_m + self._slip * math.sqrt(abs(rolled_m)) * float(self._random.standard_normal())


class Laser:
    """The LDS-01. One turn takes 0.2 s on the robot; here all its beams are cast at the same moment."""

    def __init__(self, noise: Noise, random: np.random.Generator, client: int) -> None:
        self._noise_m = noise.range_m
        self._random = random
        self._client = client

    def scan(self, time_s: float, pose: Pose) -> Scan:
        """A scan from the true pose, its echoes given in the body's frame: seen from the turning centre."""
        laser = tb3.LASER
        hits = pybullet.rayTestBatch(*laser_rays(pose), physicsClientId=self._client)
        echoes_m = laser.max_range_m * np.array([hit[2] for hit in hits])
        heard = echoes_m < laser.max_range_m
        echoes_m = np.clip(
            echoes_m + self._noise_m * self._random.standard_normal(laser.beams), laser.min_range_m, None
        )
        heard &= echoes_m <= laser.max_range_m
        x_m, y_m = laser.mount_m[0] + echoes_m * np.cos(_BEAMS_RAD), echoes_m * np.sin(_BEAMS_RAD)
        angles_rad = np.where(heard, np.arctan2(y_m, x_m) % math.tau, _BEAMS_RAD)
        ranges_m = np.where(heard, np.hypot(x_m, y_m), np.inf)
        return Scan(time_s, angles_rad, ranges_m, laser.min_range_m, laser.max_range_m)


def laser_rays(pose: Pose) -> tuple[list[tuple[float, float, float]], list[list[float]]]:
    """Start and end of every beam when the robot is at ``pose``: lists, which pybullet reads faster than arrays."""
    mount_x_m, _, height_m = tb3.LASER.mount_m
    origin = pose.ahead(mount_x_m)
    directions = _BEAMS_RAD + origin.yaw_rad
    ends = np.empty((len(directions), 3))
    ends[:, 0] = origin.x_m + tb3.LASER.max_range_m * np.cos(directions)
    ends[:, 1] = origin.y_m + tb3.LASER.max_range_m * np.sin(directions)
    ends[:, 2] = height_m
    return [(origin.x_m, origin.y_m, height_m)] * len(directions), ends.tolist()


class Camera:
    """The Raspberry Pi camera, drawn by pybullet's TinyRenderer."""

    def __init__(self, noise: Noise, random: np.random.Generator, client: int) -> None:
        self._random = random
        self._client = client
        self._grain = _grain(noise.image_levels, random)

    def image(self, time_s: float, pose: Pose) -> Image:
        """A picture from the true pose."""
        drawn = pybullet.getCameraImage(viewMatrix=camera_view(pose), physicsClientId=self._client, **CAMERA_SETTINGS)
        size = CAMERA.height_px, CAMERA.width_px
        pixels = np.asarray(cv2.cvtColor(drawn[2].reshape(*size, 4), cv2.COLOR_RGBA2RGB), dtype=np.uint8)
        _paint_floor(pixels, drawn[3].reshape(size))
        return Image(time_s, self._with_grain(pixels))

    def _with_grain(self, pixels: NDArray[np.uint8]) -> NDArray[np.uint8]:
        if self._grain is None:
            return pixels
        start = int(self._random.integers(len(self._grain) - pixels.size))
        grain = self._grain[start : start + pixels.size].reshape(pixels.shape)
        return np.asarray(cv2.add(pixels, grain, dtype=cv2.CV_8U), dtype=np.uint8)


def camera_view(pose: Pose) -> tuple[float, ...]:
    """pybullet's view matrix of the camera when the robot is at ``pose``."""
    x_m, _, z_m = CAMERA.mount_m
    eye, ahead = pose.ahead(x_m), pose.ahead(x_m + 1)
    view = pybullet.computeViewMatrix([eye.x_m, eye.y_m, z_m], [ahead.x_m, ahead.y_m, z_m], [0, 0, 1])
    return tuple(view)


def _paint_floor(pixels: NDArray[np.uint8], depth: NDArray[np.float32]) -> None:
    """Give the floor its colour: it is whatever is not hidden below the level camera's horizon.

    Drawing it as a surface takes TinyRenderer twice as long as all the rest of the picture.
    """
    horizon = math.ceil(CAMERA.centre_px[1])
    cv2.copyTo(_FLOOR[horizon:], (depth[horizon:] > 1.0 - 1e-6).view(np.uint8), pixels[horizon:])


def _grain(levels: float, random: np.random.Generator) -> NDArray[np.int16] | None:
    """Noise for two pictures, drawn once: each picture gets its own stretch of it, at a fiftieth of the time."""
    if levels == 0:
        return None
    return np.rint(random.normal(0.0, levels, 2 * CAMERA.width_px * CAMERA.height_px * 3)).astype(np.int16)

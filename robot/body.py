"""What a robot must offer to be driven by Kirby: a body with wheels, a laser scanner, a camera, odometry and a clock.

pybullet's TurtleBot3 is the first body (`robot.turtlebot3`); a real robot, or a kinematic stub in a test, is another.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .geometry import Pose


@dataclass(frozen=True, slots=True)
class Limits:
    """What the body can do and how much room it takes."""

    linear_max_mps: float
    angular_max_radps: float
    linear_acceleration_mps2: float
    angular_acceleration_radps2: float
    radius_m: float  # of the smallest circle around the turning centre that holds the whole footprint


@dataclass(frozen=True, slots=True)
class Scan:
    """One turn of the laser: ``ranges_m[i]`` is the range at ``angles_rad[i]`` in the body's frame (x ahead, y left).

    Both arrays have shape (beams,). ``inf`` stands for no echo within ``max_range_m``, and ``nan`` never occurs.
    """

    time_s: float
    angles_rad: NDArray[np.float64]
    ranges_m: NDArray[np.float64]
    min_range_m: float
    max_range_m: float


@dataclass(frozen=True, slots=True)
class CameraModel:
    """A pinhole: focal length and principal point in pixels (pixel centres at whole numbers), and where it is mounted.

    ``mount_m`` is the optical centre in the body's frame (x ahead, y left, z up from the floor); the camera looks along
    the body's x axis.
    """

    width_px: int
    height_px: int
    focal_px: float
    centre_px: tuple[float, float]
    mount_m: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Image:
    """A colour picture, shape (height, width, 3), uint8, RGB."""

    time_s: float
    pixels: NDArray[np.uint8]


@dataclass(frozen=True, slots=True)
class Odometry:
    """Dead reckoning since start in the odometry frame, with its noise: ``pose`` drifts."""

    time_s: float
    pose: Pose
    linear_mps: float
    angular_radps: float


class Body(Protocol):
    """A body in the world. Time is the body's own clock, in seconds since it started, and passes only in ``step``."""

    @property
    def limits(self) -> Limits: ...

    @property
    def camera(self) -> CameraModel: ...

    @property
    def time_s(self) -> float: ...

    def drive(self, linear_mps: float, angular_radps: float) -> None:
        """Set the wheels' target; holds until the next call. Values beyond the limits are clipped."""

    def step(self, duration_s: float) -> None:
        """Let ``duration_s`` pass (simulated; pacing against the wall clock is the caller's)."""

    def odometry(self) -> Odometry: ...

    def scan(self) -> Scan | None:
        """The newest scan if one was finished since the last call."""

    def image(self) -> Image | None:
        """The newest camera image if one was taken since the last call."""

    def close(self) -> None: ...

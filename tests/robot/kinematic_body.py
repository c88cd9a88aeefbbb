"""A body in a world of straight walls, for fast tests: exact unicycle kinematics, ray-cast scans, optional noise."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.body import CameraModel, Image, Limits, Odometry, Scan
from robot.geometry import ORIGIN, Point, Pose, Segment, wrap_angle

WAFFLE_PI = Limits(0.26, 1.82, 1.0, 4.0, 0.22)
BEAMS = 360
MIN_RANGE_M, MAX_RANGE_M = 0.12, 3.5
SCAN_PERIOD_S = 0.2
TICK_S = 0.01


def polygon(*corners: tuple[float, float]) -> tuple[Segment, ...]:
    """The closed outline through ``corners``."""
    points = [Point(x, y) for x, y in corners]
    return tuple(Segment(a, b) for a, b in zip(points, points[1:] + points[:1], strict=True))


def box(x_m: float, y_m: float, width_m: float, height_m: float) -> tuple[Segment, ...]:
    """The outline of an upright rectangle about its centre."""
    w, h = width_m / 2.0, height_m / 2.0
    return polygon((x_m - w, y_m - h), (x_m + w, y_m - h), (x_m + w, y_m + h), (x_m - w, y_m + h))


@dataclass(frozen=True, slots=True)
class Noise:
    """Standard deviations; the scales are of one constant error drawn at the start, as of a wrong wheel radius."""

    range_m: float = 0.0
    linear_scale: float = 0.0
    angular_scale: float = 0.0
    linear_per_sqrt_m: float = 0.0
    angular_per_sqrt_rad: float = 0.0
    heading_per_sqrt_m: float = 0.0


EXACT = Noise()
TYPICAL = Noise(0.01, 0.002, 0.004, 0.001, 0.002, 0.004)
HARSH = Noise(0.015, 0.01, 0.02, 0.005, 0.01, 0.01)


class KinematicBody:
    """A `robot.body.Body` without physics. ``pose`` is the truth; ``contacts`` counts ticks spent touching a wall."""

    def __init__(
        self,
        walls: tuple[Segment, ...],
        start: Pose = ORIGIN,
        noise: Noise = EXACT,
        seed: int = 0,
        limits: Limits = WAFFLE_PI,
    ) -> None:
        self.pose = start
        self.contacts = 0
        self._limits = limits
        self._noise = noise
        self._random = np.random.default_rng(seed)
        self._scale = 1.0 + self._random.normal(0.0, (noise.linear_scale, noise.angular_scale))
        self._ticks = 0
        self._target = (0.0, 0.0)
        self._speed = (0.0, 0.0)
        self._odometry = start
        self._scan: Scan | None = None
        self.set_walls(walls)

    def set_walls(self, walls: tuple[Segment, ...]) -> None:
        """Replace the world, as when a door shuts."""
        self._walls = np.array([[s.start.x_m, s.start.y_m, s.end.x_m, s.end.y_m] for s in walls])

    @property
    def limits(self) -> Limits:
        return self._limits

    @property
    def camera(self) -> CameraModel:
        return CameraModel(640, 480, 530.0, (319.5, 239.5), (0.0, 0.0, 0.1))

    @property
    def time_s(self) -> float:
        return self._ticks * TICK_S

    def drive(self, linear_mps: float, angular_radps: float) -> None:
        v, w = self._limits.linear_max_mps, self._limits.angular_max_radps
        self._target = (min(max(linear_mps, -v), v), min(max(angular_radps, -w), w))

    def step(self, duration_s: float) -> None:
        for _ in range(round(duration_s / TICK_S)):
            self._tick()

    def odometry(self) -> Odometry:
        return Odometry(self.time_s, self._odometry, *self._speed)

    def scan(self) -> Scan | None:
        """The newest scan, once: every fifth of a second, the first at once."""
        if self._scan is None and self._ticks == 0:
            self._scan = self._measure()
        scan, self._scan = self._scan, None
        return scan

    def image(self) -> Image | None:
        return None

    def close(self) -> None:
        """Nothing to let go of."""

    def clearance_m(self) -> float:
        """Distance from the turning centre to the nearest wall."""
        start, along = self._walls[:, :2], self._walls[:, 2:] - self._walls[:, :2]
        to_robot = np.array([self.pose.x_m, self.pose.y_m]) - start
        t = np.clip((to_robot * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-12), 0.0, 1.0)
        return float(np.hypot(*(to_robot - t[:, None] * along).T).min())

    def _tick(self) -> None:
        accelerations = (self._limits.linear_acceleration_mps2, self._limits.angular_acceleration_radps2)
        v, w = (
            now + min(max(target - now, -a * TICK_S), a * TICK_S)
            for now, target, a in zip(self._speed, self._target, accelerations, strict=True)
        )
        self._speed = (v, w)
        self._ticks += 1
        self.pose = _moved(self.pose, v * TICK_S, w * TICK_S)
        self._odometry = _moved(self._odometry, *self._noisy(v * TICK_S, w * TICK_S))
        self.contacts += self.clearance_m() < self._limits.radius_m * 0.95
        if self._ticks % round(SCAN_PERIOD_S / TICK_S) == 0:
            self._scan = self._measure()

    def _noisy(self, distance_m: float, turn_rad: float) -> tuple[float, float]:
        a, b, c = self._random.normal(0.0, 1.0, 3)
        distance = distance_m * self._scale[0] + a * self._noise.linear_per_sqrt_m * math.sqrt(abs(distance_m))
        turn = turn_rad * self._scale[1] + b * self._noise.angular_per_sqrt_rad * math.sqrt(abs(turn_rad))
        turn += c * self._noise.heading_per_sqrt_m * math.sqrt(abs(distance_m))
        return float(distance), float(turn)

    def _measure(self) -> Scan:
        angles: NDArray[np.float64] = np.arange(BEAMS, dtype=np.float64) * (math.tau / BEAMS)
        ranges = cast_rays(self._walls, self.pose, angles)
        ranges += self._random.normal(0.0, 1.0, BEAMS) * self._noise.range_m
        seen = (ranges >= MIN_RANGE_M) & (ranges <= MAX_RANGE_M)
        return Scan(self.time_s, angles, np.where(seen, ranges, np.inf), MIN_RANGE_M, MAX_RANGE_M)


def cast_rays(walls: NDArray[np.float64], pose: Pose, angles_rad: NDArray[np.float64]) -> NDArray[np.float64]:
    """Range to the nearest of ``walls`` (rows x1, y1, x2, y2) along each angle of the body's frame; inf for none."""
    bearings = angles_rad + pose.yaw_rad
    dx, dy = np.cos(bearings)[:, None], np.sin(bearings)[:, None]
    ax, ay = walls[:, 0] - pose.x_m, walls[:, 1] - pose.y_m
    ex, ey = walls[:, 2] - walls[:, 0], walls[:, 3] - walls[:, 1]
    cross = dx * ey - dy * ex
    with np.errstate(divide="ignore", invalid="ignore"):
        along_ray = (ax * ey - ay * ex) / cross
        along_wall = (ax * dy - ay * dx) / cross
    met = (along_ray > 0.0) & (along_wall >= 0.0) & (along_wall <= 1.0)
    nearest: NDArray[np.float64] = np.where(met, along_ray, np.inf).min(axis=1, initial=np.inf)
    return nearest


def _moved(pose: Pose, distance_m: float, turn_rad: float) -> Pose:
    there = pose.point.moved(distance_m, pose.yaw_rad + turn_rad / 2.0)
    return Pose(there.x_m, there.y_m, wrap_angle(pose.yaw_rad + turn_rad))

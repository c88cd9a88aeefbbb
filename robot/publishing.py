"""What of the robot's senses is worth publishing now: changes, and signs of life."""

from __future__ import annotations

import datetime
import math
from collections.abc import Callable
from dataclasses import replace

import psutil

from .body import Odometry, Scan
from .geometry import Pose
from .mapping import Mapper
from .messages import Fiducials, Lidar, Odom, Status
from .port import News

HEARTBEAT_S = 1.0
LIDAR_SLICES = 36


class Publisher:
    """Remembers what was published. ``clock`` is the wall's, in seconds: signs of life are for people who wait."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._readings = 0
        self._published = 0
        self._said: tuple[float, ...] = ()
        self._said_s = self._status_s = -math.inf
        self._map_id: int | None = None
        self._scan_s: float | None = None
        self._fiducials: Fiducials | None = None
        self._process = psutil.Process()

    def add(self, news: News, pose: Pose, odometry: Odometry) -> News:
        """``news`` with the odometry, if it changed (to the millimetre) or is due."""
        self._readings += 1
        values = (pose.x_m, pose.y_m, pose.yaw_rad, odometry.linear_mps, odometry.angular_radps)
        rounded = tuple(round(value, 3) for value in values)
        now_s = self._clock()
        if rounded == self._said and now_s - self._said_s < HEARTBEAT_S:
            return news
        self._published += 1
        self._said, self._said_s = rounded, now_s
        odom = Odom(
            self._published,
            self._readings,
            (pose.x_m, pose.y_m, 0.0),
            (0.0, 0.0, pose.yaw_rad),
            odometry.linear_mps,
            odometry.angular_radps,
            odometry.time_s,
        )
        return replace(news, odom=odom)

    def add_seen(self, news: News, scan: Scan | None, mapper: Mapper, fiducials: Fiducials | None) -> News:
        """``news`` with the scan if it is new, the map if it changed with it, and the fiducials if they changed."""
        if scan is not None and scan.time_s != self._scan_s:
            self._scan_s = scan.time_s
            news = replace(news, lidar=slices(scan))
            walls = mapper.message()
            if walls.id != self._map_id:
                self._map_id = walls.id
                news = replace(news, map=walls)
        if fiducials is not None and fiducials != self._fiducials:
            self._fiducials = fiducials
            news = replace(news, fiducials=fiducials)
        return news

    def add_status(self, news: News, status: str, errors: tuple[str, ...]) -> News:
        """``news`` with the status, if it is due."""
        now_s = self._clock()
        if now_s - self._status_s < HEARTBEAT_S:
            return news
        self._status_s = now_s
        stamp = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
        return replace(news, status=Status(stamp, status, f"{self._process.cpu_percent():.0f}%", errors))

    def repeat(self) -> None:
        """Everything is to be published again: somebody has cleared it."""
        self._said, self._said_s, self._status_s = (), -math.inf, -math.inf
        self._map_id, self._scan_s, self._fiducials = None, None, None


def slices(scan: Scan) -> Lidar:
    """The nearest range in each of 36 equal slices, the first centred straight ahead, counter-clockwise."""
    width_rad = math.tau / LIDAR_SLICES
    nearest = [scan.max_range_m] * LIDAR_SLICES
    for angle_rad, range_m in zip(scan.angles_rad.tolist(), scan.ranges_m.tolist(), strict=True):
        slice_ = round(angle_rad / width_rad) % LIDAR_SLICES
        nearest[slice_] = min(nearest[slice_], range_m)
    return Lidar(scan.max_range_m, scan.min_range_m, math.tau, tuple(nearest))

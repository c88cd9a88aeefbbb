"""Where the robot is, how its wheels err, and where the lines and markers are that tell it: one joint estimate.

An extended Kalman filter over all of them (R. Smith, M. Self, P. Cheeseman, "Estimating uncertain spatial relationships
in robotics", 1990). Estimated apart, a wall first seen while the heading is off is entered as if the heading were right
and pulls the robot towards that error from then on; together, both are put right when an old wall is seen again.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from robot.body import Scan
from robot.geometry import ORIGIN, Pose, wrap_angle

from .gaussian import Gaussian
from .line_landmarks import LineLandmarks, contested
from .point_landmarks import PointLandmarks, SightedPoint
from .sighted_lines import sight_lines

# Odometry's error grows with the root of the way, or of the angle turned; one standard deviation each for a metre and
# for a radian. They are those of two wheels that slip 0.7 mm in a metre, each on its own.
AHEAD_M = 0.0006
ASIDE_M = 0.0002
HEADING_RAD = 0.0034
TURNED_RAD = 0.0013
TURNED_M = 0.00023
# Wheels are never quite of the same size nor of the size in the manual, nor as far apart; one standard deviation each.
HEADING_DRIFT_RAD_PER_M = 0.005
LENGTH_SCALE = 0.005
ANGLE_SCALE = 0.01
# A scan from where the last one was taken has much the same errors again: a few of them, then only new views count.
FIRST_VIEWS = 5
NEW_VIEW_M = 0.04
NEW_VIEW_RAD = math.radians(3.0)
# What a robot that has lost itself, by a push or a threshold, may be off by.
LOST_M = 0.1
LOST_RAD = math.radians(5.0)
# Each time its wheels' errors are believed to have so many times the variance, at most so many; less again over the
# views to come, by this share each. Other wheels than those above are allowed for in this way.
DISTRUST, DISTRUST_MAX, REGAINED = 4.0, 64.0, 0.001

Floats = NDArray[np.float64]


class PoseFilter:
    """Feed it odometry, scans and markers in the order of their times. Poses are in the map frame.

    The first columns of the joint estimate are x, y, yaw, the heading's drift a metre, and by what share the wheels'
    lengths and angles are too short.
    """

    def __init__(self, start: Pose) -> None:
        """``start`` is known for certain: it is what ties the map frame down."""
        wheels = (HEADING_DRIFT_RAD_PER_M**2, LENGTH_SCALE**2, ANGLE_SCALE**2)
        self._state = Gaussian(
            np.array([start.x_m, start.y_m, start.yaw_rad, 0.0, 0.0, 0.0]), np.array([0.0, 0.0, 0.0, *wheels])
        )
        self._lines = LineLandmarks(self._state)
        self._points = PointLandmarks(self._state)
        self._expected = start  # the pose before it is corrected by what is seen from it
        self._since_view = ORIGIN
        self._views = 0
        self._distrust = 1.0

    @property
    def pose(self) -> Pose:
        """After the last odometry that was fed."""
        x_m, y_m, yaw_rad = self._state.mean[:3].tolist()
        return Pose(x_m, y_m, wrap_angle(yaw_rad))

    def ahead(self, counted: Pose) -> Pose:
        """The pose after odometry will have counted ``counted`` (relative to the last that was fed)."""
        drift, longer, wider = self._state.mean[3:6].tolist()
        half_rad = drift * counted.x_m / 2
        scaled = Pose((1 + longer) * counted.x_m, (1 + longer) * counted.y_m, (1 + wider) * counted.yaw_rad)
        return self.pose.turned(half_rad).compose(scaled).turned(half_rad)

    def move(self, counted: Pose) -> None:
        """Take in what odometry has counted since the last time, as a pose relative to the one then."""
        before, after = self.pose, self.ahead(counted)
        east_m, north_m = after.x_m - before.x_m, after.y_m - before.y_m
        slopes = np.eye(6)
        slopes[:2, 2] = self._expected.y_m - after.y_m, after.x_m - self._expected.x_m
        slopes[:3, 3] = -north_m * counted.x_m / 2, east_m * counted.x_m / 2, counted.x_m
        slopes[:2, 4] = east_m, north_m
        slopes[2, 5] = counted.yaw_rad
        mean = np.array([after.x_m, after.y_m, after.yaw_rad, *self._state.mean[3:6]])
        self._state.advance(mean, slopes, self._distrust * _slip(counted, after.yaw_rad))
        self._expected = after
        self._since_view = self._since_view.compose(counted)

    def see(self, scan: Scan) -> None:
        """Take in a scan from where the robot is now."""
        if not self._is_new_view():
            return
        self._views += 1
        self._since_view = ORIGIN
        self._distrust += REGAINED * (1.0 - self._distrust)
        lines = sight_lines(scan)
        nearest = self._lines.compare(lines, self._expected)
        if contested(nearest):
            self._doubt()
            nearest = self._lines.compare(lines, self._expected)
        self._lines.correct(lines, nearest, self._expected)
        self._lines.drop_pierced(scan, self.pose)

    def see_points(self, sighted: Iterable[SightedPoint], since: Pose, eye: Pose) -> None:
        """Take in markers seen after odometry had counted ``since`` more, by a camera at ``eye`` (body frame)."""
        for point in sighted:
            self._points.see(point, since, eye, self._expected)

    def settle(self, pose: Pose) -> None:
        """The robot is at ``pose`` for certain: it was put there."""
        self._state.settle(np.array([pose.x_m, pose.y_m, pose.yaw_rad]))
        self._expected = pose
        self._views = 0

    def _is_new_view(self) -> bool:
        way_m, turned_rad = math.hypot(self._since_view.x_m, self._since_view.y_m), abs(self._since_view.yaw_rad)
        return self._views < FIRST_VIEWS or way_m >= NEW_VIEW_M or turned_rad >= NEW_VIEW_RAD

    def _doubt(self) -> None:
        """Nothing is where it should be, so the robot is not where it thinks."""
        self._distrust = min(DISTRUST * self._distrust, DISTRUST_MAX)
        noise = np.zeros((6, 6))
        np.fill_diagonal(noise[:3, :3], (LOST_M**2, LOST_M**2, LOST_RAD**2))
        self._state.advance(self._state.mean[:6].copy(), np.eye(6), noise)


def _slip(counted: Pose, yaw_rad: float) -> Floats:
    """The covariance, shape (6, 6), of what odometry may have miscounted; the wheels' own errors do not change."""
    way_m, turned_rad = math.hypot(counted.x_m, counted.y_m), abs(counted.yaw_rad)
    along_m2 = AHEAD_M**2 * way_m + TURNED_M**2 * turned_rad
    across_m2 = ASIDE_M**2 * way_m + TURNED_M**2 * turned_rad
    ahead = np.array([math.cos(yaw_rad), math.sin(yaw_rad)])
    noise = np.zeros((6, 6))
    noise[:2, :2] = across_m2 * np.eye(2) + (along_m2 - across_m2) * np.outer(ahead, ahead)
    noise[2, 2] = HEADING_RAD**2 * way_m + TURNED_RAD**2 * turned_rad
    return noise

"""Where the robot is, how its wheels err, and where the lines and markers are that tell it: one joint estimate.

An extended Kalman filter over all of them (R. Smith, M. Self, P. Cheeseman, "Estimating uncertain spatial relationships
in robotics", 1990). Estimated apart, a wall first seen while the heading is off is entered as if the heading were right
and pulls the robot towards that error from then on; together, both are put right when an old wall is seen again.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from robot.body import Scan
from robot.geometry import ORIGIN, Pose, wrap_angle

from .gaussian import Gaussian
from .line_landmarks import LineLandmarks, contested, recognised
from .point_landmarks import PointLandmarks, SightedPoint
from .sighted_lines import SightedLine, sight_lines

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
# Loads and floors change: what is known of that wears off with the root of the way, or of the angle turned.
HEADING_DRIFT_WORN, LENGTH_WORN, ANGLE_WORN = 0.0002, 0.0001, 0.0003
# Seen from the same place all has much the same errors again: a few such views count, then only those from elsewhere.
FIRST_VIEWS = 5
NEW_VIEW_M = 0.04
NEW_VIEW_RAD = math.radians(3.0)
# What a robot that has lost itself, by a push or a threshold, may be off by.
LOST_M = 0.1
LOST_RAD = math.radians(5.0)
LOST_ROUNDS = 3
LOST_VIEWS = 10  # in a row; then it is taken for the world that has changed, and entered
# Each time its wheels' errors are believed to have so many times the variance, at most so many; less again over the
# views to come, by this share each. Other wheels than those above are allowed for in this way.
DISTRUST, DISTRUST_MAX, REGAINED = 4.0, 64.0, 0.001

Floats = NDArray[np.float64]


class Views:
    """Tells a view from a new place from more of the same."""

    def __init__(self) -> None:
        self._since = ORIGIN  # the last view, by odometry
        self._taken = 0

    @property
    def is_new(self) -> bool:
        return self.is_new_after(ORIGIN)

    def is_new_after(self, counted: Pose) -> bool:
        """Whether a view would be new after odometry had counted so much more."""
        since = self._since.compose(counted)
        moved_m, turned_rad = math.hypot(since.x_m, since.y_m), abs(since.yaw_rad)
        return self._taken < FIRST_VIEWS or moved_m >= NEW_VIEW_M or turned_rad >= NEW_VIEW_RAD

    def take(self, after: Pose = ORIGIN) -> None:
        self._taken += 1
        self._since = ORIGIN.relative_to(after)

    def move(self, counted: Pose) -> None:
        self._since = self._since.compose(counted)


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
        self._scanned, self._pictured = Views(), Views()
        self._lost_views = 0
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
        self._scanned.move(counted)
        self._pictured.move(counted)

    def see(self, scan: Scan) -> None:
        """Take in a scan from where the robot is now."""
        lines = sight_lines(scan)
        nearest = self._lines.compare(lines, self._expected)
        lost = contested(nearest) and self._lost_views < LOST_VIEWS
        self._lost_views = self._lost_views + 1 if lost else 0
        if lost:
            self._find_again(lines)
            return
        if not self._scanned.is_new:
            return
        self._scanned.take()
        self._distrust += REGAINED * (1.0 - self._distrust)
        same = recognised(nearest)
        self._lines.correct(same, self._expected)
        self._lines.enter(lines, nearest, self._expected)
        if same:  # who recognises nothing is blind or elsewhere, and looks through everything
            self._lines.drop_pierced(scan, self.pose)

    def _find_again(self, lines: Sequence[SightedLine]) -> None:
        """Compare anew with a pose that is unsure, and again from the better one, as slopes hold only near by."""
        for _ in range(LOST_ROUNDS):
            self._doubt()
            self._lines.correct(recognised(self._lines.compare(lines, self._expected)), self._expected)
            self._expected = self.pose
        self._distrust = min(DISTRUST * self._distrust, DISTRUST_MAX)

    def see_points(self, sighted: Sequence[SightedPoint], since: Pose, eye: Pose) -> None:
        """Take in markers seen after odometry had counted ``since`` more, by a camera at ``eye`` (body frame)."""
        lost = self._points.contested(sighted, since, eye, self._expected)
        if not sighted or not (lost or self._pictured.is_new_after(since)):
            return
        for _ in range(LOST_ROUNDS if lost else 0):
            self._doubt()
            self._points.see(sighted, since, eye, self._expected)
            self._expected = self.pose
        self._pictured.take(since)
        self._points.see(sighted, since, eye, self._expected)

    def settle(self, pose: Pose) -> None:
        """From now on the robot is taken to be at ``pose`` for certain."""
        self._state.settle(np.array([pose.x_m, pose.y_m, pose.yaw_rad]))
        self._expected = pose
        self._scanned, self._pictured = Views(), Views()

    def _doubt(self) -> None:
        """Nothing is where it should be, so the robot is not where it thinks; what it sees from here counts anew."""
        self._scanned, self._pictured = Views(), Views()
        noise = np.zeros((6, 6))
        np.fill_diagonal(noise[:3, :3], (LOST_M**2, LOST_M**2, LOST_RAD**2))
        self._state.advance(self._state.mean[:6].copy(), np.eye(6), noise)


def _slip(counted: Pose, yaw_rad: float) -> Floats:
    """The covariance, shape (6, 6), of what odometry may have miscounted, and of how the wheels may have changed."""
    way_m, turned_rad = math.hypot(counted.x_m, counted.y_m), abs(counted.yaw_rad)
    along_m2 = AHEAD_M**2 * way_m + TURNED_M**2 * turned_rad
    across_m2 = ASIDE_M**2 * way_m + TURNED_M**2 * turned_rad
    ahead = np.array([math.cos(yaw_rad), math.sin(yaw_rad)])
    noise = np.zeros((6, 6))
    noise[:2, :2] = across_m2 * np.eye(2) + (along_m2 - across_m2) * np.outer(ahead, ahead)
    noise[2, 2] = HEADING_RAD**2 * way_m + TURNED_RAD**2 * turned_rad
    noise[3, 3], noise[4, 4] = HEADING_DRIFT_WORN**2 * way_m, LENGTH_WORN**2 * way_m
    noise[5, 5] = ANGLE_WORN**2 * turned_rad
    return noise

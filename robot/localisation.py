"""Where the robot believes it is: odometry between scans, scans matched against the map (one robot, one floor)."""

from __future__ import annotations

import math
from collections import deque

from .body import Odometry, Scan
from .geometry import Pose, wrap_angle
from .mapping import Mapper

HISTORY = 100  # readings; seconds of them, so that any scan or image in hand can be placed
# Odometry errs by a small share of the way between two scans. A correction beyond that casts doubt on the estimate, and
# a scan entered at a wrong pose would spoil the map that is to put it right: it is not mapped.
DOUBT_M = 0.05
DOUBT_RAD = math.radians(3.0)


# Over so much way the heading's drift is averaged, and as if so much way without drift had gone before.
DRIFT_AVERAGED_M = 30.0
DRIFT_UNPROVEN_M = 3.0


class HeadingDrift:
    """How far odometry's heading runs off with each metre: wheels are never quite of the same size.

    It is learnt from what the map had to correct, and taken off what odometry says next; it is as much as 0.3 degrees a
    metre for radii that differ by one part in seven hundred.
    """

    def __init__(self) -> None:
        self._way_m = DRIFT_UNPROVEN_M
        self._turned_rad = 0.0

    def corrected(self, moved: Pose) -> Pose:
        """What the robot has really moved by when odometry says ``moved``."""
        return moved.turned(self._rate * moved.x_m)

    def learn(self, moved: Pose, correction_rad: float) -> None:
        """Take in that after ``moved`` by odometry the heading had to be turned by ``correction_rad`` still."""
        drifted_rad = (self._rate * moved.x_m + correction_rad) * math.copysign(1.0, moved.x_m)
        kept = math.exp(-abs(moved.x_m) / DRIFT_AVERAGED_M)
        self._turned_rad = kept * self._turned_rad + drifted_rad
        self._way_m = kept * self._way_m + abs(moved.x_m)

    @property
    def _rate(self) -> float:
        """Radians a metre."""
        return self._turned_rad / self._way_m


class Localiser:
    """Call :meth:`move` with every odometry reading and :meth:`see` with every scan. Poses are in the map frame."""

    def __init__(self, mapper: Mapper, odometry: Odometry, start: Pose | None = None) -> None:
        """``start`` is where the robot stands now; by default the odometry's own pose: then both frames are one."""
        self._mapper = mapper
        self._track: deque[Odometry] = deque([odometry], maxlen=HISTORY)
        self._known = start or odometry.pose
        self._known_odometry = odometry.pose
        self._drift = HeadingDrift()

    @property
    def pose(self) -> Pose:
        """Now: the last corrected pose, and what odometry has counted since."""
        return self._place(self._track[-1].pose)

    def pose_at(self, time_s: float) -> Pose:
        """At a time within the last seconds, by the body's clock; readings are interpolated."""
        return self._place(self._odometry_at(time_s))

    def move(self, odometry: Odometry) -> None:
        if odometry.time_s > self._track[-1].time_s:
            self._track.append(odometry)

    def see(self, scan: Scan) -> None:
        """Correct the pose by the map, and the map by the scan unless the pose is in doubt."""
        then = self._odometry_at(scan.time_s)
        predicted = self._place(then)
        corrected = self._mapper.correct(predicted, scan)
        self._drift.learn(then.relative_to(self._known_odometry), wrap_angle(corrected.yaw_rad - predicted.yaw_rad))
        self._known, self._known_odometry = corrected, then
        shift_m = predicted.point.distance_to(corrected.point)
        if shift_m <= DOUBT_M and abs(wrap_angle(corrected.yaw_rad - predicted.yaw_rad)) <= DOUBT_RAD:
            self._mapper.update(corrected, scan)

    def _place(self, odometry: Pose) -> Pose:
        return self._known.compose(self._drift.corrected(odometry.relative_to(self._known_odometry)))

    def _odometry_at(self, time_s: float) -> Pose:
        later = self._track[-1]
        for earlier in reversed(self._track):
            if earlier.time_s <= time_s:
                return _between(earlier, later, time_s)
            later = earlier
        return later.pose


def _between(earlier: Odometry, later: Odometry, time_s: float) -> Pose:
    span_s = later.time_s - earlier.time_s
    if span_s <= 0.0:
        return earlier.pose
    share = min((time_s - earlier.time_s) / span_s, 1.0)
    a, b = earlier.pose, later.pose
    yaw_rad = wrap_angle(a.yaw_rad + share * wrap_angle(b.yaw_rad - a.yaw_rad))
    return Pose(a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m), yaw_rad)

"""Where the robot believes it is: odometry between scans, corrected by what is seen (one robot, one floor)."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable

from .body import Odometry, Scan
from .fiducials import Sighting
from .geometry import Point, Pose, wrap_angle
from .mapping import Mapper, PoseFilter, SightedPoint

HISTORY = 100  # readings; seconds of them, so that any scan or image in hand can be placed
# Odometry errs by a small share of the way between two scans. A correction beyond that casts doubt on the estimate, and
# a scan entered at a wrong pose would spoil the map: it is not mapped.
DOUBT_M = 0.05
DOUBT_RAD = math.radians(3.0)
UNWRAPPED_RAD = 1.0  # without a scan for longer than this, a turn could be taken for one the other way


class Localiser:
    """Call :meth:`move` with every odometry reading, :meth:`see` with every scan, and :meth:`see_markers` with markers.

    Poses are in the map frame.
    """

    def __init__(self, mapper: Mapper, odometry: Odometry, start: Pose | None = None) -> None:
        """``start`` is where the robot stands now; by default the odometry's own pose: then both frames are one."""
        self._mapper = mapper
        self._track: deque[Odometry] = deque([odometry], maxlen=HISTORY)
        self._filter = PoseFilter(start or odometry.pose)
        self._fed = odometry.pose

    @property
    def pose(self) -> Pose:
        """Now: the last corrected pose, and what odometry has counted since."""
        return self._place(self._track[-1].pose)

    def pose_at(self, time_s: float) -> Pose:
        """At a time within the last seconds, by the body's clock; readings are interpolated."""
        return self._place(self._odometry_at(time_s))

    def move(self, odometry: Odometry) -> None:
        if odometry.time_s <= self._track[-1].time_s:
            return
        self._track.append(odometry)
        if abs(wrap_angle(odometry.pose.yaw_rad - self._fed.yaw_rad)) > UNWRAPPED_RAD:
            self._feed(odometry.pose)

    def see(self, scan: Scan) -> None:
        """Correct the pose by what is known, and map the scan unless the pose is in doubt."""
        self._feed(self._odometry_at(scan.time_s))
        expected = self._filter.pose
        self._filter.see(scan)
        shift = self._filter.pose.relative_to(expected)
        if math.hypot(shift.x_m, shift.y_m) <= DOUBT_M and abs(shift.yaw_rad) <= DOUBT_RAD:
            self._mapper.update(self._filter.pose, scan)

    def _feed(self, odometry: Pose) -> None:
        self._filter.move(odometry.relative_to(self._fed))
        self._fed = odometry

    def see_markers(self, time_s: float, sightings: Iterable[Sighting], eye: Pose) -> None:
        """Correct the pose by the markers in an image; ``eye`` is the camera in the body's frame."""
        if time_s < self._track[0].time_s:
            return  # nobody knows any more where that was
        points = [SightedPoint(each.id, Point(*each.position_m[:2]), each.position_deviation_m) for each in sightings]
        self._filter.see_points(points, self._odometry_at(time_s).relative_to(self._fed), eye)

    def survey(self, views: Iterable[tuple[Pose, Scan]]) -> None:
        """Learn the map from scans whose poses are known, before the first drive.

        The robot itself stays where it is, and that counts as certain, as at the start.
        """
        here = self._filter.pose
        for pose, scan in views:
            self._filter.settle(pose)
            self._filter.see(scan)
            self._mapper.update(pose, scan)
        self._filter.settle(here)

    def _place(self, odometry: Pose) -> Pose:
        return self._filter.ahead(odometry.relative_to(self._fed))

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

"""Lines that the robot knows: where they run is part of the joint estimate, how far they reach is kept beside it.

A line is its offset from a fixed anchor and its direction, two quantities of the joint distribution; each of its ends
is one more once it was seen. Lines have a side, that from which they were seen: the two faces of a wall are two lines.

Slopes are taken at first estimates (G. Huang, A. Mourikis, S. Roumeliotis, "Analysis and improvement of the consistency
of extended Kalman filter based SLAM", ICRA 2008): at the pose as it was predicted, at a line as it was entered. At the
newest estimates they let the filter believe that it sees its own heading; after 200 m it was five to seven times surer
than it was right.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from robot.body import Scan
from robot.geometry import Point, Pose, wrap_angle

from .gaussian import POSE, Block, Gaussian, Measurement
from .sighted_lines import SightedEnd, SightedLine

Floats = NDArray[np.float64]

# Which of the known lines may be the one that is seen: as far off in direction, across, and beyond its ends.
NEAR_RAD = math.radians(20.0)
NEAR_M = 0.5
BEYOND_M = 0.2
# Squared Mahalanobis distances, of two figures: up to the first (exceeded once in 3,000) it is that line; beyond the
# second it is another; in between it had better be left alone.
SAME = 16.0
ANOTHER = 40.0
CONTESTED_LINES = 3
# The same of an end, of one figure (exceeded once in 370); so often in a row elsewhere, and it is not there.
END_SAME = 9.0
TIMES_ELSEWHERE = 3
# A line is given up after so many views in a row in which most beams that should have ended on it went on for so much
# farther.
PIERCED_VIEWS = 5
PIERCED_M = 0.15
PIERCED_BEAMS = 3
PIERCED_SHARE = 0.8
PIERCED_SINE = 0.3  # flatter beams prove nothing


@dataclass(slots=True, eq=False)
class _End:
    """Where a surface ends: how far along its line's first direction from its anchor."""

    block: Block
    elsewhere: int = 0


@dataclass(slots=True, eq=False)
class _Line:
    """``anchor`` and ``direction_rad`` are as first estimated; the reach is along the line from the anchor."""

    block: Block  # offset from the anchor along the first normal, and direction
    anchor: tuple[float, float]
    direction_rad: float
    first_m: float
    last_m: float
    ends: list[_End | None] = field(default_factory=lambda: [None, None])
    pierced: int = 0


@dataclass(frozen=True, slots=True)
class Match:
    """A known line and one that is seen, whose middle lies ``along_m`` from the known one's anchor."""

    line: _Line
    seen: SightedLine
    measured: Measurement
    distance: float
    along_m: float


@dataclass(frozen=True, slots=True)
class _Table:
    """The known lines as they are estimated now, shape (lines,) or (lines, 2)."""

    points: Floats  # on each line, beside its anchor
    along: Floats
    normals: Floats
    directions_rad: Floats
    first_m: Floats
    last_m: Floats


def recognised(nearest: Sequence[Match | None]) -> list[Match]:
    """Those that are the known line."""
    return [match for match in nearest if match is not None and match.distance <= SAME]


def contested(nearest: Sequence[Match | None]) -> bool:
    """Whether most of the lines that are seen where lines are known are none of these."""
    near = sum(match is not None for match in nearest)
    return near >= CONTESTED_LINES and len(recognised(nearest)) < near / 2


class LineLandmarks:
    """The lines met so far, as part of the joint estimate ``state``, whose first columns are the robot's pose."""

    def __init__(self, state: Gaussian) -> None:
        self._state = state
        self._lines: list[_Line] = []

    def compare(self, sighted: Sequence[SightedLine], expected: Pose) -> list[Match | None]:
        """Of each line that is seen the known one that it is most likely to be; None where none is near.

        ``expected`` is the pose before any correction: the first estimate of it.
        """
        table = self._table()
        return [self._nearest_to(line, expected, table) for line in sighted]

    def correct(self, same: Sequence[Match], expected: Pose) -> None:
        """Correct the joint estimate by lines that were recognised."""
        ends = [each for match in same for each in self._measured_ends(match, expected)]
        self._state.correct([*(match.measured for match in same), *ends])
        for match in same:
            self._extend(match, expected)

    def enter(self, sighted: Sequence[SightedLine], nearest: Sequence[Match | None], expected: Pose) -> None:
        """Enter the lines that are none of those known."""
        for line, known in zip(sighted, nearest, strict=True):
            if known is None or known.distance > ANOTHER:
                self._enter(line, expected)

    def drop_pierced(self, scan: Scan, pose: Pose) -> None:
        """Give up lines that ``scan``, taken at ``pose``, has looked through once too often."""
        if not self._lines:
            return
        crossed, pierced = _crossings(self._table(), scan, pose)
        for line, beams, through in zip(tuple(self._lines), crossed.tolist(), pierced.tolist(), strict=True):
            if beams < PIERCED_BEAMS:
                continue
            line.pierced = line.pierced + 1 if through >= PIERCED_SHARE * beams else 0
            if line.pierced >= PIERCED_VIEWS:
                self._lines.remove(line)
                self._state.forget(line.block)
                for end in line.ends:
                    if end is not None:
                        self._state.forget(end.block)

    @property
    def _pose(self) -> Pose:
        return Pose(*self._state.mean[POSE].tolist())

    def _table(self) -> _Table:
        firsts = np.array([line.block.first for line in self._lines], dtype=np.intp)
        fixed = np.array([(*line.anchor, line.direction_rad, line.first_m, line.last_m) for line in self._lines])
        fixed = fixed.reshape(-1, 5)
        offsets_m, directions_rad = self._state.mean[firsts], self._state.mean[firsts + 1]
        shifts_m = offsets_m[:, None] * np.column_stack([-np.sin(fixed[:, 2]), np.cos(fixed[:, 2])])
        c, s = np.cos(directions_rad), np.sin(directions_rad)
        return _Table(
            fixed[:, :2] + shifts_m,
            np.column_stack([c, s]),
            np.column_stack([-s, c]),
            directions_rad,
            fixed[:, 3],
            fixed[:, 4],
        )

    def _nearest_to(self, seen: SightedLine, expected: Pose, table: _Table) -> Match | None:
        here = self._pose
        place = here.to_map(Point(*seen.centre_m))
        middle = np.array([place.x_m, place.y_m])
        turned_rad = _wrapped(here.yaw_rad + seen.direction_rad - table.directions_rad)
        from_lines = middle - table.points
        across_m = (from_lines * table.normals).sum(axis=1)
        along_m = (from_lines * table.along).sum(axis=1)
        near = (np.abs(turned_rad) <= NEAR_RAD) & (np.abs(across_m) <= NEAR_M)
        near &= (along_m + seen.last_m >= table.first_m - BEYOND_M) & (
            along_m + seen.first_m <= table.last_m + BEYOND_M
        )
        arm = middle - (expected.x_m, expected.y_m)
        matches = [
            self._match(seen, self._lines[n], arm, middle, -np.array([across_m[n], turned_rad[n]]), float(along_m[n]))
            for n in np.flatnonzero(near).tolist()
        ]
        return min(matches, key=lambda match: match.distance, default=None)

    def _match(
        self, seen: SightedLine, line: _Line, arm: Floats, middle: Floats, residual: Floats, along_m: float
    ) -> Match:
        c, s = math.cos(line.direction_rad), math.sin(line.direction_rad)
        lever_m = c * arm[0] + s * arm[1]  # the offset's change with the yaw: normal times the arm turned left
        from_anchor_m = c * (middle[0] - line.anchor[0]) + s * (middle[1] - line.anchor[1])
        slopes = np.array([[-s, c, lever_m, -1.0, -from_anchor_m], [0.0, 0.0, 1.0, 0.0, -1.0]])
        noise = np.diag([seen.offset_variance_m2, seen.direction_variance_rad2])
        measured = Measurement([*POSE, *line.block.columns], slopes, residual, noise)
        return Match(line, seen, measured, self._state.distance(measured), along_m)

    def _measured_ends(self, match: Match, expected: Pose) -> Iterator[Measurement]:
        """The ends that are known and seen where they are known to be; one that is not is given up in time."""
        for side, seen in enumerate(match.seen.ends):
            known = match.line.ends[side]
            if seen is None or known is None:
                continue
            along_m, slopes = self._end(match, seen, expected)
            residual = np.array([self._state.mean[known.block.first] - along_m])
            measured = Measurement(
                [*POSE, known.block.first], np.array([[*slopes, -1.0]]), residual, np.array([[seen.variance_m2]])
            )
            if self._state.distance(measured) <= END_SAME:
                known.elsewhere = 0
                yield measured
            else:
                known.elsewhere += 1

    def _end(self, match: Match, seen: SightedEnd, expected: Pose) -> tuple[float, tuple[float, float, float]]:
        """How far an end is along its line, and how that changes with the pose."""
        line = match.line
        place = self._pose.to_map(Point(*match.seen.centre_m).moved(seen.along_m, match.seen.direction_rad))
        c, s = math.cos(line.direction_rad), math.sin(line.direction_rad)
        along_m = c * (place.x_m - line.anchor[0]) + s * (place.y_m - line.anchor[1])
        lever_m = s * (place.x_m - expected.x_m) - c * (place.y_m - expected.y_m)
        return along_m, (c, s, lever_m)

    def _extend(self, match: Match, expected: Pose) -> None:
        """A line reaches as far as it was ever seen; and an end of it that is seen for the first time is entered."""
        line = match.line
        line.first_m = min(line.first_m, match.along_m + match.seen.first_m)
        line.last_m = max(line.last_m, match.along_m + match.seen.last_m)
        for side, seen in enumerate(match.seen.ends):
            known = line.ends[side]
            if known is not None and known.elsewhere >= TIMES_ELSEWHERE:
                self._state.forget(known.block)
                line.ends[side] = None
            elif known is None and seen is not None:
                along_m, slopes = self._end(match, seen, expected)
                noise = np.array([[seen.variance_m2]])
                line.ends[side] = _End(self._state.grow(POSE, np.array([slopes]), np.array([along_m]), noise))

    def _enter(self, seen: SightedLine, expected: Pose) -> None:
        here = self._pose
        anchor = here.to_map(Point(*seen.centre_m))
        direction_rad = wrap_angle(here.yaw_rad + seen.direction_rad)
        c, s = math.cos(direction_rad), math.sin(direction_rad)
        lever_m = c * (anchor.x_m - expected.x_m) + s * (anchor.y_m - expected.y_m)
        slopes = np.array([[-s, c, lever_m], [0.0, 0.0, 1.0]])
        noise = np.diag([seen.offset_variance_m2, seen.direction_variance_rad2])
        block = self._state.grow(POSE, slopes, np.array([0.0, direction_rad]), noise)
        self._lines.append(_Line(block, (anchor.x_m, anchor.y_m), direction_rad, seen.first_m, seen.last_m))


def _crossings(table: _Table, scan: Scan, pose: Pose) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """For each line, how many beams cross it, and how many of these go on well beyond it."""
    bearings_rad = pose.yaw_rad + scan.angles_rad
    beams = np.column_stack([np.cos(bearings_rad), np.sin(bearings_rad)])
    here = np.array([pose.x_m, pose.y_m]) - table.points
    away_m = (here * table.normals).sum(axis=1)[:, None]
    steepness = -table.normals @ beams.T
    crosses = (away_m > 0.0) & (steepness > PIERCED_SINE)
    reach_m = away_m / np.where(crosses, steepness, 1.0)
    along_m = (here * table.along).sum(axis=1)[:, None] + reach_m * (table.along @ beams.T)
    crosses &= (along_m > table.first_m[:, None]) & (along_m < table.last_m[:, None])
    crosses &= reach_m + PIERCED_M < scan.max_range_m
    pierced = crosses & (scan.ranges_m > reach_m + PIERCED_M)
    return crosses.sum(axis=1), pierced.sum(axis=1)


def _wrapped(angles_rad: Floats) -> Floats:
    return np.remainder(angles_rad + math.pi, math.tau) - math.pi

"""The map of one robot: scans and their poses in, a grid and walls out."""

from __future__ import annotations

import math

from robot.body import Scan
from robot.geometry import Point, Pose, Segment, wrap_angle
from robot.messages import Map

from .grid import OccupancyGrid
from .lines import extract_segments
from .walls import WallMap

CONFIRMED_SIGHTINGS = 3
# From one place the same noise is seen again and again: walls learn only from new viewpoints, or once in a while.
LEARN_EVERY_M = 0.1
LEARN_EVERY_RAD = math.radians(6.0)
LEARN_EVERY_S = 0.5
PRUNE_EVERY_S = 1.0
SETTLED_M = 0.01  # a published wall moves only by more than this


class Mapper:
    """What was seen through and what was met, and the walls among it, in the map frame."""

    def __init__(self, resolution_m: float = 0.05) -> None:
        self.grid = OccupancyGrid(resolution_m)
        self._walls = WallMap()
        self._learnt: tuple[Pose, float] | None = None
        self._pruned_s = -math.inf
        self._published: dict[int, Segment] = {}
        self._message_id = 0

    def update(self, pose: Pose, scan: Scan) -> None:
        """Enter a scan taken at ``pose`` (map frame) into the grid and the walls."""
        self.grid.update(pose, scan)
        if self._is_new_view(pose, scan.time_s):
            self._learnt = (pose, scan.time_s)
            for segment in extract_segments(scan):
                self._walls.add(Segment(pose.to_map(segment.start), pose.to_map(segment.end)))
        if scan.time_s - self._pruned_s >= PRUNE_EVERY_S:
            self._pruned_s = scan.time_s
            self._walls.prune(self.grid, pose.point, scan.max_range_m)

    def segments(self) -> tuple[Segment, ...]:
        """The walls seen often enough to be believed, in the order they were met, free space on their left."""
        published: dict[int, Segment] = {}
        for wall in self._walls:
            if wall.sightings >= CONFIRMED_SIGHTINGS and wall.id is not None:
                published[wall.id] = _settled(self._published.get(wall.id), wall.segment)
        if published != self._published:
            self._message_id += 1
        self._published = published
        return tuple(published.values())

    def message(self) -> Map:
        """The walls for the wire; the id changes when, and only when, they do."""
        segments = self.segments()
        points = [point for segment in segments for point in (segment.start, segment.end)]
        left, right = _span([point.x_m for point in points])
        bottom, top = _span([point.y_m for point in points])
        return Map(self._message_id, right - left, top - bottom, Point(left, bottom), segments)

    def _is_new_view(self, pose: Pose, time_s: float) -> bool:
        if self._learnt is None:
            return True
        last, last_s = self._learnt
        return (
            last.point.distance_to(pose.point) >= LEARN_EVERY_M
            or abs(wrap_angle(pose.yaw_rad - last.yaw_rad)) >= LEARN_EVERY_RAD
            or time_s - last_s >= LEARN_EVERY_S
        )


def _settled(old: Segment | None, new: Segment) -> Segment:
    if old is None:
        return new
    still = old.start.distance_to(new.start) < SETTLED_M and old.end.distance_to(new.end) < SETTLED_M
    return old if still else new


def _span(values: list[float]) -> tuple[float, float]:
    return (min(values), max(values)) if values else (0.0, 0.0)

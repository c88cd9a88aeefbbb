"""Where the markers are: sightings fused into one pose for each, in the map frame."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from enum import Enum

from .fiducials import Sighting
from .geometry import Point, Pose, wrap_angle
from .messages import Fiducial, Fiducials

# Where the robot believes it is is itself in doubt: no single sighting counts for more than this, and none for less.
_POSITION_DOUBT_M = 0.02
_YAW_DOUBT_RAD = math.radians(1.5)
# So many standard deviations from where it was, and so far, is elsewhere; so many times in a row is moved.
_ELSEWHERE_DEVIATIONS = 4.0
_ELSEWHERE_M = 0.25
_ELSEWHERE_RAD = math.radians(45)
_TIMES_ELSEWHERE = 3
_WEIGHT_SIGHTINGS = 50  # what was seen longer ago than about so many sightings fades


class News(Enum):
    """What became known of a fiducial."""

    FIRST_SEEN = "first seen"
    MOVED = "moved"


@dataclass(frozen=True, slots=True)
class FiducialNews:
    """A fiducial that was seen for the first time, or again at another place."""

    news: News
    fiducial: Fiducial


@dataclass(frozen=True, slots=True)
class _Track:
    """A fused pose: weighted means, the yaw as a complex number; and how often in a row it was seen elsewhere."""

    place: tuple[float, float, float]
    facing: complex
    place_weight: float
    facing_weight: float
    elsewhere: int = 0

    @property
    def yaw_rad(self) -> float:
        return wrap_angle(cmath.phase(self.facing))


class FiducialMap:
    """Every marker seen so far, in the map frame; near and frontal sightings count most."""

    def __init__(self) -> None:
        self._tracks: dict[int, _Track] = {}

    def observe(self, sightings: tuple[Sighting, ...], robot: Pose) -> tuple[FiducialNews, ...]:
        """Take in what one image showed, taken from where the robot was (map frame); tells what is new."""
        news = []
        for sighting in sightings:
            seen = _seen(sighting, robot)
            track = self._tracks.get(sighting.id)
            if track is None:
                self._tracks[sighting.id] = seen
                news.append(FiducialNews(News.FIRST_SEEN, _fiducial(sighting.id, seen)))
            elif not _is_elsewhere(track, seen):
                self._tracks[sighting.id] = _fused(track, seen)
            elif track.elsewhere + 1 < _TIMES_ELSEWHERE:
                self._tracks[sighting.id] = _doubted(track)
            else:
                self._tracks[sighting.id] = seen
                news.append(FiducialNews(News.MOVED, _fiducial(sighting.id, seen)))
        return tuple(news)

    def message(self) -> Fiducials:
        """All of them as the ``Fiducials`` key has it, in order of id."""
        return Fiducials(tuple(_fiducial(key, self._tracks[key]) for key in sorted(self._tracks)))

    def clear(self) -> None:
        """Forget all of them, as a reset of the bridge asks."""
        self._tracks.clear()


def _seen(sighting: Sighting, robot: Pose) -> _Track:
    x_m, y_m, z_m = sighting.position_m
    place = robot.to_map(Point(x_m, y_m))
    return _Track(
        (place.x_m, place.y_m, z_m),
        cmath.rect(1.0, robot.yaw_rad + sighting.yaw_rad),
        1 / (sighting.position_deviation_m**2 + _POSITION_DOUBT_M**2),
        1 / (sighting.yaw_deviation_rad**2 + _YAW_DOUBT_RAD**2),
    )


def _is_elsewhere(track: _Track, seen: _Track) -> bool:
    allowed_m = max(_ELSEWHERE_M, _ELSEWHERE_DEVIATIONS * math.sqrt(1 / seen.place_weight))
    turned_rad = abs(wrap_angle(seen.yaw_rad - track.yaw_rad))
    allowed_rad = max(_ELSEWHERE_RAD, _ELSEWHERE_DEVIATIONS * math.sqrt(1 / seen.facing_weight))
    return math.dist(track.place, seen.place) > allowed_m or turned_rad > allowed_rad


def _fused(track: _Track, seen: _Track) -> _Track:
    old_place = min(track.place_weight, _WEIGHT_SIGHTINGS * seen.place_weight)
    old_facing = min(track.facing_weight, _WEIGHT_SIGHTINGS * seen.facing_weight)
    place_weight, facing_weight = old_place + seen.place_weight, old_facing + seen.facing_weight
    x_m, y_m, z_m = (
        (old_place * before + seen.place_weight * now) / place_weight
        for before, now in zip(track.place, seen.place, strict=True)
    )
    facing = (old_facing * track.facing + seen.facing_weight * seen.facing) / facing_weight
    return _Track((x_m, y_m, z_m), facing, place_weight, facing_weight)


def _doubted(track: _Track) -> _Track:
    return _Track(track.place, track.facing, track.place_weight, track.facing_weight, track.elsewhere + 1)


def _fiducial(id: int, track: _Track) -> Fiducial:
    return Fiducial(str(id), track.place, (0.0, 0.0, track.yaw_rad))

"""People who point at things, and an observer who knows exactly how they do it: the best that anyone could make of it.

Somebody points at any place on the body of a thing, and the hand is off by the spread, normally distributed. Three
ways to see a hand: over the floor only, as a bearing; with its elevation, from the eye; and as the place that a tracker
says lies where the thing stands, off across the floor by the spread times how far away that is.
"""

from __future__ import annotations

import math
import random
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from grounding import Entities, Entity
from robot.geometry import Point

from ._furnished import footprint_m

SPREAD_DEG = 5.0
EYE_M = 1.4
_SPREAD_RAD = math.radians(SPREAD_DEG)
_CUTS = (-0.8, -0.4, 0.0, 0.4, 0.8)  # the observer sums over 125 places of a body

Seen = tuple[float, ...]
Offsets = NDArray[np.float64]  # shape (n, 3): east, north and up from the eye to places of bodies
Values = NDArray[np.float64]


class Hand(Protocol):
    """One way to see a hand that points."""

    def show(self, chance: random.Random, offset_m: tuple[float, float, float]) -> Seen:
        """What is seen of somebody who aims at a place."""
        ...

    def form(self, origin: Point, seen: Seen) -> str:
        """The same as it stands in a form."""
        ...

    def likelihood(self, seen: Seen, offsets_m: Offsets) -> Values:
        """Density of what was seen, for each place that may have been aimed at; shape (n,), up to a common factor."""
        ...


class Bearing:
    """Over the floor only."""

    def show(self, chance: random.Random, offset_m: tuple[float, float, float]) -> Seen:
        return (math.atan2(offset_m[1], offset_m[0]) + chance.gauss(0.0, _SPREAD_RAD),)

    def form(self, origin: Point, seen: Seen) -> str:
        return f"pointed(ray({_place(origin)},{math.degrees(seen[0]):.4f}deg),{SPREAD_DEG}deg)"

    def likelihood(self, seen: Seen, offsets_m: Offsets) -> Values:
        off_rad = _wrapped(np.arctan2(offsets_m[:, 1], offsets_m[:, 0]) - seen[0])
        return np.asarray(np.exp(-0.5 * np.square(off_rad / _SPREAD_RAD)))


class Elevated:
    """A ray from the eye, with its bearing and elevation; off sideways and upwards alike."""

    def show(self, chance: random.Random, offset_m: tuple[float, float, float]) -> Seen:
        elevation_rad = math.atan2(offset_m[2], math.hypot(offset_m[0], offset_m[1]))
        aside_rad = chance.gauss(0.0, _SPREAD_RAD) / math.cos(elevation_rad)
        bearing_rad = math.atan2(offset_m[1], offset_m[0]) + aside_rad
        return bearing_rad, elevation_rad + chance.gauss(0.0, _SPREAD_RAD)

    def form(self, origin: Point, seen: Seen) -> str:
        bearing_deg, elevation_deg = map(math.degrees, seen)
        return f"pointed(ray({_place(origin)},{bearing_deg:.4f}deg,{elevation_deg:.4f}deg,{EYE_M}m),{SPREAD_DEG}deg)"

    def likelihood(self, seen: Seen, offsets_m: Offsets) -> Values:
        elevations_rad = np.arctan2(offsets_m[:, 2], np.hypot(offsets_m[:, 0], offsets_m[:, 1]))
        aside = _wrapped(np.arctan2(offsets_m[:, 1], offsets_m[:, 0]) - seen[0]) * np.cos(elevations_rad)
        off2 = np.square(aside) + np.square(elevations_rad - seen[1])
        return np.asarray(np.exp(-0.5 * off2 / _SPREAD_RAD**2) * np.cos(elevations_rad))


class Place:
    """A place on the floor."""

    def show(self, chance: random.Random, offset_m: tuple[float, float, float]) -> Seen:
        spread_m = math.hypot(offset_m[0], offset_m[1]) * _SPREAD_RAD
        return offset_m[0] + chance.gauss(0.0, spread_m), offset_m[1] + chance.gauss(0.0, spread_m)

    def form(self, origin: Point, seen: Seen) -> str:
        place = Point(origin.x_m + seen[0], origin.y_m + seen[1])
        spread_m = math.hypot(*seen) * _SPREAD_RAD
        return f"pointed(point({_place(place)}),{spread_m:.4f}m)"

    def likelihood(self, seen: Seen, offsets_m: Offsets) -> Values:
        spread_m = np.hypot(offsets_m[:, 0], offsets_m[:, 1]) * _SPREAD_RAD
        off_m = np.hypot(offsets_m[:, 0] - seen[0], offsets_m[:, 1] - seen[1])
        return np.asarray(np.exp(-0.5 * np.square(off_m / spread_m)) / np.square(spread_m))


HANDS: dict[str, Hand] = {"bearing": Bearing(), "ray": Elevated(), "place": Place()}


def aim(chance: random.Random, origin: Point, thing: Entity) -> tuple[float, float, float]:
    """From the eye to any place on the body."""
    return _offset_m(origin, thing, chance.uniform(-1, 1), chance.uniform(-1, 1), chance.uniform(-1, 1))


def ideal(hand: Hand, seen: Seen, origin: Point, things: Entities, rows: tuple[int, ...]) -> Values:
    """How probable each of ``rows`` is for who knows all of the above; shape (len(rows),)."""
    grid = [(x, y, z) for x in _CUTS for y in _CUTS for z in _CUTS]
    places = [_offset_m(origin, things.items[row], *cut) for row in rows for cut in grid]
    density = hand.likelihood(seen, np.array(places)).reshape(len(rows), len(grid)).mean(axis=1)
    return np.asarray(density / density.sum()) if density.sum() > 0 else np.full(len(rows), 1.0 / len(rows))


def _offset_m(origin: Point, thing: Entity, x: float, y: float, z: float) -> tuple[float, float, float]:
    """To a place of a body whose sides are at -1 and 1."""
    width_m, depth_m = footprint_m(thing)
    east_m = thing.pose.x_m + x * width_m / 2 - origin.x_m
    north_m = thing.pose.y_m + y * depth_m / 2 - origin.y_m
    return east_m, north_m, (1 + z) * thing.size_m[2] / 2 - EYE_M


def _place(place: Point) -> str:
    return f"{place.x_m:.4f}m,{place.y_m:.4f}m"


def _wrapped(angles_rad: Values) -> Values:
    return np.asarray((angles_rad + math.pi) % (2 * math.pi) - math.pi)

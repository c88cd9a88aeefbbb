"""Which things a pointing may have meant: a place, a thing or a ray, blurred by its spread.

In a form, a pointing is ``pointed(TARGET[,SPREAD])``: ``pointed(point(2m,3m),0.1m)``, ``pointed("3")`` for the thing of
that id, ``pointed(ray(0m,0m,45deg),5deg)`` over the floor, and ``pointed(ray(0m,0m,45deg,-20deg,1.4m),5deg)`` from
1.4 m above it, 20 degrees downwards. A spread is one standard deviation.

What was meant is told by Bayes' rule: each thing that the words fit is as likely beforehand; the pointing is normally
distributed about its middle, by the spread and by how large the thing looks from where one points.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from grammar.forms import Name, Quantity, Term, Unit
from robot.geometry import Point

from .entities import Entities, Rows

_SPREAD_MIN_M = 0.25  # nobody points at the very middle of a thing
_SPREAD_MIN_RAD = math.radians(3.0)
_DOWN_MIN_RAD = math.radians(5.0)  # a flatter ray comes down anywhere
_REACH_SIGMAS = 4.0  # beyond this many standard deviations a thing was not meant
_SURE = 0.85
"""A thing at least this probable is meant, else Kirby asks: at most 1 % go wrong (`benchmarks.pointing`)."""

_ASKED_MASS = 0.99  # what is asked about covers this much of the probability
_TO_EDGE = 1 / math.sqrt(3.0)  # standard deviation of a place on a thing, its middle to its edge being 1

Values = NDArray[np.float64]  # shape (n,)


@dataclass(frozen=True, slots=True)
class Ray:
    """A pointing ray from ``origin``; without an elevation only its bearing is known."""

    origin: Point
    direction_rad: float
    elevation_rad: float | None = None
    height_m: float = 0.0


def point_form(place: Point) -> Term:
    """``point(2m,3m)``."""
    return Term("point", (Quantity(place.x_m, Unit.METRE), Quantity(place.y_m, Unit.METRE)))


def read_point(form: object) -> Point | None:
    """The place in ``point(2m,3m)``; None for any other form."""
    match form:
        case Term(pred="point", args=(Quantity(value=x_m), Quantity(value=y_m))):
            return Point(x_m, y_m)
        case _:
            return None


def pointed_ray(pointing: Term) -> Ray | None:
    """The ray of a pointing; None if it was at a place or a thing."""
    match pointing.args[0]:
        case Term("ray", (Quantity(value=x_m), Quantity(value=y_m), Quantity(value=angle_deg), *upwards)):
            origin, direction_rad = Point(x_m, y_m), math.radians(angle_deg)
        case _:
            return None
    match upwards:
        case (Quantity(value=elevation_deg), Quantity(value=height_m)):
            return Ray(origin, direction_rad, math.radians(elevation_deg), height_m)
        case _:
            return Ray(origin, direction_rad)


def pointed_place(pointing: Term) -> Point | None:
    """The place on the floor that was pointed at; None if it was a thing, or a ray that does not come down."""
    ray = pointed_ray(pointing)
    if ray is None:
        return read_point(pointing.args[0])
    if ray.elevation_rad is None or ray.elevation_rad > -_DOWN_MIN_RAD:
        return None
    return ray.origin.moved(ray.height_m / math.tan(-ray.elevation_rad), ray.direction_rad)


def likely_rows(pointings: Sequence[Term], entities: Entities, rows: Rows) -> Rows:
    """Those of ``rows`` that the pointings, all at one thing, may have meant: one if it is clear, else several."""
    rows, probable = posterior(pointings, entities, rows)
    if not len(rows) or probable[0] >= _SURE:
        return rows[:1]
    before = np.cumsum(probable) - probable
    return rows[before < _ASKED_MASS]


def posterior(pointings: Sequence[Term], entities: Entities, rows: Rows) -> tuple[Rows, Values]:
    """The things within reach of all the pointings, the likeliest first; and how probable each of them is."""
    fits = np.zeros(len(rows))
    for pointing in pointings:
        fits += _log_likelihood(pointing, entities, rows)
    rows, fits = rows[np.isfinite(fits)], fits[np.isfinite(fits)]
    order = np.argsort(-fits, kind="stable")
    likelihood = np.exp(fits[order] - fits.max(initial=-np.inf))
    return rows[order], likelihood / likelihood.sum()


def _log_likelihood(pointing: Term, entities: Entities, rows: Rows) -> Values:
    """Up to a constant; minus infinity out of reach."""
    target, ray = pointing.args[0], pointed_ray(pointing)
    if isinstance(target, Name):
        return np.where(rows == entities.index.get(target.text, -1), 0.0, -np.inf)
    sigmas, spread = _off_ray(ray, pointing, entities, rows) if ray else _off_place(pointing, entities, rows)
    return np.where(sigmas <= _REACH_SIGMAS, -0.5 * np.square(sigmas) - np.log(spread), -np.inf)


def _off_place(pointing: Term, entities: Entities, rows: Rows) -> tuple[Values, Values]:
    """How far each thing is from the place, in its own standard deviations; and how widely it is spread (any unit)."""
    place = read_point(pointing.args[0])
    assert place is not None
    away_m = np.linalg.norm(entities.middle_m[rows] - (place.x_m, place.y_m), axis=1)
    spread_m = np.hypot(max(_spread(pointing), _SPREAD_MIN_M), _half_width_m(entities, rows) * _TO_EDGE)
    return away_m / spread_m, np.square(spread_m)


def _off_ray(ray: Ray, pointing: Term, entities: Entities, rows: Rows) -> tuple[Values, Values]:
    """The same by angles, seen from where the ray begins."""
    spread_rad = max(math.radians(_spread(pointing)), _SPREAD_MIN_RAD)
    to_thing = entities.middle_m[rows] - (ray.origin.x_m, ray.origin.y_m)
    away_m = np.maximum(np.hypot(to_thing[:, 0], to_thing[:, 1]), 1e-3)
    aside_rad = np.abs(_wrapped(np.arctan2(to_thing[:, 1], to_thing[:, 0]) - ray.direction_rad))
    ahead = aside_rad < math.pi / 2
    if ray.elevation_rad is None:
        spread = np.hypot(spread_rad, _half_width_m(entities, rows) * _TO_EDGE / away_m)
        return np.where(ahead, aside_rad / spread, np.inf), spread
    half_height_m = entities.size_m[rows, 2] / 2
    down_m = ray.height_m - half_height_m
    reach_m = np.hypot(away_m, down_m)
    across = aside_rad * math.cos(ray.elevation_rad)
    upwards = ray.elevation_rad + np.arctan2(down_m, away_m)
    half_width_m = _half_width_m(entities, rows)
    # Of a thing seen from above, its length along the line of sight is also above and below its middle.
    tall_m = np.hypot(half_height_m * away_m, half_width_m * down_m) / reach_m
    spread_across = np.hypot(spread_rad, half_width_m * _TO_EDGE / reach_m)
    spread_up = np.hypot(spread_rad, tall_m * _TO_EDGE / reach_m)
    sigmas = np.hypot(across / spread_across, upwards / spread_up)
    return np.where(ahead, sigmas, np.inf), spread_across * spread_up


def _spread(pointing: Term) -> float:
    return pointing.args[1].value if len(pointing.args) > 1 and isinstance(pointing.args[1], Quantity) else 0.0


def _half_width_m(entities: Entities, rows: Rows) -> Values:
    """As it looks from a side: the mean of length and width, halved."""
    half: Values = entities.size_m[rows, :2].mean(axis=1) / 2
    return half


def _wrapped(angles_rad: Values) -> Values:
    return (angles_rad + math.pi) % (2 * math.pi) - math.pi

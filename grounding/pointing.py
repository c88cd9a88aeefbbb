"""Which things a pointing may have meant: a place, a thing or a ray, blurred by its spread.

In a form, a pointing is ``pointed(TARGET[,SPREAD])``: ``pointed(point(2m,3m),0.1m)``, ``pointed("3")`` for the thing of
that id, ``pointed(ray(0m,0m,45deg),5deg)``. A spread is one standard deviation.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from grammar.forms import Name, Quantity, Term, Unit
from robot.geometry import Point, Pose

from .entities import Entities, Rows
from .relations import distances_m, local_m

_SPREAD_MIN_M = 0.25  # nobody points at the very middle of a thing
_SPREAD_MIN_RAD = math.radians(3.0)
_REACH_SIGMAS = 4.0  # beyond this many standard deviations a thing was not meant
_RIVAL = 0.35  # a second thing this likely, the likeliest being 1, makes a question


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


def pointed_place(pointing: Term) -> Point | None:
    """The place on the floor that was pointed at; None if it was a thing or a direction."""
    return read_point(pointing.args[0])


def pointed_ray(pointing: Term) -> tuple[Point, float] | None:
    """Where a pointing ray begins and its direction (radians); None if it was a place or a thing."""
    match pointing.args[0]:
        case Term(pred="ray", args=(Quantity(value=x_m), Quantity(value=y_m), Quantity(value=angle_deg))):
            return Point(x_m, y_m), math.radians(angle_deg)
        case _:
            return None


def likely_rows(pointing: Term, entities: Entities, rows: Rows) -> Rows:
    """Those of ``rows`` that the pointing may have meant: one if it is clear, several if they are about as likely."""
    target = pointing.args[0]
    if isinstance(target, Name):
        row = entities.index.get(target.text, -1)
        return np.extract(rows == row, rows)
    sigmas = _sigmas_away(pointing, entities.xy_m[rows])
    near = sigmas <= _REACH_SIGMAS
    rows, sigmas = np.extract(near, rows), np.extract(near, sigmas)
    if not len(rows):
        return rows
    likelihood = np.exp(-0.5 * np.square(sigmas - sigmas.min()))
    return np.extract(likelihood >= _RIVAL, rows)


def _sigmas_away(pointing: Term, xy_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far each place is from what was pointed at, in standard deviations; infinite behind a ray's origin."""
    spread = pointing.args[1].value if len(pointing.args) > 1 and isinstance(pointing.args[1], Quantity) else 0.0
    ray = pointed_ray(pointing)
    if ray is None:
        place = pointed_place(pointing)
        assert place is not None
        return distances_m((place.x_m, place.y_m), xy_m) / math.hypot(spread, _SPREAD_MIN_M)
    origin, direction_rad = ray
    local = local_m(Pose(origin.x_m, origin.y_m, direction_rad), xy_m)
    angles = np.abs(np.arctan2(local[:, 1], local[:, 0])) / math.hypot(math.radians(spread), _SPREAD_MIN_RAD)
    return np.where(local[:, 0] > 0, angles, np.inf)

"""Speech with pointing: demonstratives take what was pointed at, in the order in which both came."""

from __future__ import annotations

import math
from dataclasses import replace

from grammar.forms import Form, Name, Quantity, Term, Unit
from grounding.pointing import point_form

from .events import PointedObject, PointedPlace, PointedRay, Pointing

WINDOW_S = 5.0
"""How far apart a pointing and its word may be."""

REMEMBERED = 8
"""Pointings kept; nobody points at more things in one breath."""

_PLACES = frozenset({"there", "here"})
_DEMONSTRATIVES = frozenset({"this", "that", "these", "those"})


def pointing_form(pointing: Pointing) -> Term:
    """A pointing as it stands in a form: ``pointed(point(2m,3m),0.1m)`` (see `grounding.pointing`)."""
    match pointing.target:
        case PointedObject(id):
            return Term("pointed", (Name(id),))
        case PointedPlace(place):
            return _with_spread(point_form(place), pointing.spread_m, Unit.METRE)
        case PointedRay() as ray:
            return _with_spread(_ray_form(ray), math.degrees(pointing.spread_rad), Unit.DEGREE)


def _ray_form(ray: PointedRay) -> Term:
    flat = (*point_form(ray.origin).args, Quantity(math.degrees(ray.direction_rad), Unit.DEGREE))
    if ray.elevation_rad is None:
        return Term("ray", flat)
    upwards = Quantity(math.degrees(ray.elevation_rad), Unit.DEGREE), Quantity(ray.height_m, Unit.METRE)
    return Term("ray", (*flat, *upwards))


def _with_spread(target: Term, spread: float, unit: Unit) -> Term:
    return Term("pointed", (target, Quantity(spread, unit)) if spread > 0 else (target,))


def recent(pointings: tuple[Pointing, ...], time_s: float) -> tuple[Pointing, ...]:
    """Those that are near enough in time to belong to what is said at ``time_s``."""
    return tuple(p for p in pointings if abs(time_s - p.time_s) <= WINDOW_S)[-REMEMBERED:]


def demonstratives(form: Form) -> int:
    """How many places in a form want a pointing."""
    if not isinstance(form, Term):
        return 0
    return int(_wants_pointing(form)) + sum(demonstratives(arg) for arg in form.args)


def fuse(form: Form, pointings: tuple[Pointing, ...]) -> tuple[Form, tuple[Pointing, ...]]:
    """The form with its demonstratives filled in from the left, and the pointings that are left over.

    "Here" without a pointing is where the robot is, so it takes one only when there is one for each demonstrative.
    """
    if not isinstance(form, Term) or not pointings:
        return form, pointings
    args: list[Form] = []
    if _wants_pointing(form):
        filled = replace(form, args=(*form.args, pointing_form(pointings[0])))
        return filled, pointings[1:]
    for arg in form.args:
        fused, pointings = fuse(arg, pointings)
        args.append(fused)
    return replace(form, args=tuple(args)), pointings


def _wants_pointing(form: Term) -> bool:
    filled = any(isinstance(arg, Term) and arg.pred == "pointed" for arg in form.args)
    return not filled and (form.pred in _DEMONSTRATIVES or (form.pred in _PLACES and not form.args))


def replaced(form: Form, hole: Form, filling: Form) -> Form:
    """The form with every occurrence of ``hole`` replaced."""
    if form == hole:
        return filling
    if not isinstance(form, Term):
        return form
    return replace(form, args=tuple(replaced(arg, hole, filling) for arg in form.args))

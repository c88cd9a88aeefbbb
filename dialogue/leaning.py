"""Words that lean on the talk so far, replaced by what they stand for: "back there", "that one", "there", routines."""

from __future__ import annotations

from dataclasses import replace

from grammar.forms import Form, Name, Term
from grounding.pointing import point_form

from .session import Session

_HERE_M = 0.6  # "there" is not where the robot is
_THERE = Term("there")
_SAME_SPOT = Term("the", (Term("same", (Term("spot"),)),))


def leaned(form: Form, session: Session) -> Form:
    """The form with what can only be known from the talk filled in, where the talk tells."""
    if not isinstance(form, Term):
        return form
    if form == Term("back_there"):
        return point_form(session.history[-1].start.point) if session.history else form
    if form in (_THERE, _SAME_SPOT):
        return _spoken_of(session) or form
    if form.pred in ("that", "those") and session.world.focus and not _points(form):
        inner, *rest = form.args or (Term("one"),)
        return Term("the", (Term("same", (inner,)), *rest))
    if form.pred == "perform" and len(form.args) == 1 and isinstance(form.args[0], Name):
        name = form.args[0].text.lower()
        return next((routine.form for routine in session.routines if routine.name == name), form)
    return replace(form, args=tuple(leaned(arg, session) for arg in form.args))


def _spoken_of(session: Session) -> Form | None:
    """The place or thing last spoken of, unless the robot is there, or on its way there."""
    thing = session.world.entities.get(session.world.focus[0]) if session.world.focus else None
    place = session.place or (None if thing is None else thing.point)
    if place is None or place.distance_to(session.start.point) <= _HERE_M:
        return None
    return Term("entity", (Name(thing.id),)) if session.place is None and thing is not None else point_form(place)


def _points(form: Term) -> bool:
    return any(isinstance(arg, Term) and (arg.pred in ("pointed", "way") or _points(arg)) for arg in form.args)

"""Words that lean on the talk so far, replaced by what they stand for: "back there", "that one", "there", routines."""

from __future__ import annotations

from dataclasses import replace

from grammar.forms import Form, Name, Term
from grounding.pointing import point_form

from .ellipsis import opposite_way
from .session import Past, Routine, Session
from .table import Activity

_HERE_M = 0.6  # "there" is not where the robot is
_THERE = Term("there")
_GO_BACK = Term("go_back")
_OTHER_WAY = Term("other", (Term("way"),))
_SAME_SPOT = Term("the", (Term("same", (Term("spot"),)),))


def leaned_in_turn(forms: tuple[Form, ...], session: Session) -> tuple[Form, ...]:
    """The forms of one utterance, each after those before it: to go back behind the first is to go where it began."""
    first = tuple(leaned(form, session) for form in forms[:1])
    begun = replace(session, history=(*session.history, Past(first, (), session.start)))
    return (*first, *(leaned(form, begun) for form in forms[1:]))


def leaned(form: Form, session: Session) -> Form:
    """The form with what can only be known from the talk filled in, where the talk tells."""
    if not isinstance(form, Term):
        return form
    if form == Term("back_there"):
        return form if session.last is None else point_form(session.last.start.point)
    if form == Term("go_back"):
        return _returned(session)
    if form == _OTHER_WAY:
        return (session.last and opposite_way(session.last.form)) or form
    if form in (_THERE, _SAME_SPOT):
        return _spoken_of(session) or form
    if form.pred in ("that", "those") and session.world.focus and not _points(form):
        inner, *rest = form.args or (Term("one"),)
        return Term("the", (Term("same", (inner,)), *rest))
    if (routine := _performed(form, session)) is not None:
        return leaned(routine.form, replace(session, routines=()))
    if form.pred == "seq":
        return replace(form, args=leaned_in_turn(form.args, session))
    return replace(form, args=tuple(leaned(arg, session) for arg in form.args))


def unfolded(form: Form, session: Session) -> Form:
    """The form with the routines that are known in the place of their names."""
    if not isinstance(form, Term):
        return form
    if (routine := _performed(form, session)) is not None:
        return routine.form
    return replace(form, args=tuple(unfolded(arg, session) for arg in form.args))


def _performed(form: Term, session: Session) -> Routine | None:
    return session.routine(form.args[0].text) if form.pred == "perform" and isinstance(form.args[0], Name) else None


def _returned(session: Session) -> Form:
    """ "Go back": where what was told last began. The robot's own command knows that of its last movement alone."""
    last = session.last
    if last is None or session.activity not in (Activity.RESTING, Activity.MOVING):
        return _GO_BACK
    to_its_start = Term("go", (Term("to", (point_form(last.start.point),)),))
    if not last.commands:  # it comes before this in the same breath
        return to_its_start
    current = next((task.id for task in session.pending), None)
    if len(last.ids) < 2 or current == last.ids[0]:
        return _GO_BACK
    return Term("seq", (Term("cancel", (Term("all"),)), to_its_start)) if session.moving else to_its_start


def _spoken_of(session: Session) -> Form | None:
    """The place or thing last spoken of, unless the robot is there, or on its way there."""
    thing = session.world.get(session.world.focus[0]) if session.world.focus else None
    place = session.place or (None if thing is None else thing.point)
    if place is None or place.distance_to(session.start.point) <= _HERE_M:
        return None
    return Term("entity", (Name(thing.id),)) if session.place is None and thing is not None else point_form(place)


def _points(form: Term) -> bool:
    return any(isinstance(arg, Term) and (arg.pred in ("pointed", "way") or _points(arg)) for arg in form.args)

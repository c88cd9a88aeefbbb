"""What was left for later: done when what it waits for has happened, or let go when that cannot happen any more."""

from __future__ import annotations

from dataclasses import replace

from grammar.forms import Form, Quantity, Term
from robot.messages import Control

from .conditions import ELAPSED, holds
from .events import Tone
from .instructions import carry_out, instruct
from .plans import Deferred, Stops
from .session import Agenda
from .table import Activity, State
from .turn import Turn
from .wording import unmet

_FREE = frozenset({State.IDLE, State.EXECUTING, State.PATROLLING})
"""While Kirby asks, or the robot is paused or strayed or was told to stop, nothing begins by itself."""

_ENDING = frozenset(
    Term("event", (Term("control", (Term(c.value.replace(" ", "_")),)),)) for c in (Control.CANCEL, Control.STOP_PATROL)
)


def go_on(turn: Turn, time_s: float) -> None:
    """Look whether what is left can be done now."""
    agenda = turn.session.agenda
    stopping = any(task.command is Control.STOP for task in turn.session.tasks)
    if agenda is None or turn.session.state not in _FREE or stopping:
        return
    deferred = agenda.deferred
    if deferred.condition.pred == ELAPSED:
        _wait(turn, agenda, time_s)
    elif _is_met(turn, deferred):
        _begin(turn, deferred)
    elif deferred.moving and not turn.session.moving and turn.session.activity is Activity.RESTING:
        turn.update(agenda=None)
        turn.say(unmet(deferred.condition), Tone.NEWS)


def _is_met(turn: Turn, deferred: Deferred) -> bool:
    try:
        return holds(deferred.condition, turn.session.world, turn.lexicon, deferred.known)
    except Stops:
        return False  # it could be told when it was planned; what it leans on is gone


def _wait(turn: Turn, agenda: Agenda, time_s: float) -> None:
    """Time counts from when everything that was sent has ended."""
    if turn.session.moving:
        return
    (duration,) = agenda.deferred.condition.args
    assert isinstance(duration, Quantity)
    if agenda.since_s is None:
        turn.update(agenda=replace(agenda, since_s=time_s))
    elif time_s - agenda.since_s >= duration.value:
        _begin(turn, agenda.deferred)


def _begin(turn: Turn, deferred: Deferred) -> None:
    """The rest, from where the robot really is; there is nothing to end that has ended."""
    turn.update(agenda=None)
    rest: tuple[Form, ...] = deferred.rest
    if turn.session.moving:
        turn.update(ideal=None)
    elif rest and rest[0] in _ENDING:
        rest = rest[1:]
    if rest:
        carry_out(turn, tuple(instruct(form) for form in rest))

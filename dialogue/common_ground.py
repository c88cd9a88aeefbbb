"""What leans on the talk so far: fragments, and corrections of what was said wrong."""

from __future__ import annotations

import math
from dataclasses import replace

from grammar.acts import DialogueAct
from grammar.forms import Form, Quantity, Term, Unit
from robot.geometry import Pose, wrap_angle
from robot.messages import GoForward, ideal_end
from robot.messages import Turn as TurnCommand

from .ellipsis import alone, completed
from .events import Tone
from .instructions import STOP, cancel_all, instruct, obey
from .planning import plan
from .plans import OPERATORS, Plan
from .session import Past, Question
from .table import Trigger
from .turn import Turn
from .wording import phrase

_LATERAL_M = 0.1  # as far beside its line as a straight way may end and still be driven straight


def said_fragment(turn: Turn, act: DialogueAct, time_s: float) -> None:
    """Do what a fragment amounts to after what was done before; by itself it is confirmed first."""
    last = _last(turn)
    form = None if last is None else completed(act.form, _whole(last), turn.lexicon)
    if form is not None:
        obey(turn, (replace(act, form=form),), time_s)
        return
    form = alone(act.form, turn.lexicon)
    if form is None:
        turn.say(f"What do you want me to do: {phrase(act.form)}?", Tone.REFUSAL)
    else:
        question = Question(f"Shall I {phrase(form)}?", (instruct(form),))
        turn.ask(Trigger.ASK_CONFIRMATION, question)


def said_instead(turn: Turn, act: DialogueAct, time_s: float) -> None:
    """Stop what is wrong, and do the right thing. With nothing to lean on, stop."""
    last = _last(turn)
    form: Form | None = act.form
    if not isinstance(form, Term) or (form.pred not in turn.lexicon.programs and form.pred not in OPERATORS):
        form = None if last is None else completed(act.form, _whole(last), turn.lexicon)
    if form is None:
        obey(turn, (instruct(STOP),), time_s)
        return
    turn.settle()
    if turn.session.moving:
        cancel_all(turn)
    if last is None:
        obey(turn, (replace(act, form=form),), time_s)
        return
    before = len(turn.session.history)
    obey(turn, (replace(act, form=_from_here(turn, form, last)),), time_s)
    history = turn.session.history
    if history and (len(history) > before or history[-1] is not last):
        turn.update(history=(*history[:-1], replace(history[-1], forms=(form,), start=last.start)))


def _last(turn: Turn) -> Past | None:
    return turn.session.history[-1] if turn.session.history else None


def _whole(past: Past) -> Form:
    return past.forms[0] if len(past.forms) == 1 else Term("seq", past.forms)


def _from_here(turn: Turn, form: Form, last: Past) -> Form:
    """ "No, right", half way through a turn to the left: the turn that ends where the right one would have ended."""
    here = turn.session.world.robot
    made = plan((form,), turn.session.world.with_robot(last.start), turn.lexicon)
    if not isinstance(made, Plan) or made.then is not None or len(made.commands) != 1 or not _same_kind(made, last):
        return form
    (command,) = made.commands
    end = ideal_end(last.start, command)
    if isinstance(command, TurnCommand):
        return _turn_to(end, here)
    local = here.to_local(end.point)
    if isinstance(command, GoForward) and abs(local.y_m) <= _LATERAL_M:
        return Term("go", (Term("forward" if local.x_m >= 0 else "back"), _metres(abs(local.x_m))))
    return form


def _same_kind(made: Plan, last: Past) -> bool:
    return len(last.commands) == 1 and type(last.commands[0]) is type(made.commands[0])


def _turn_to(end: Pose, here: Pose) -> Form:
    angle_deg = round(math.degrees(wrap_angle(end.yaw_rad - here.yaw_rad)), 1)
    return Term("turn", (Term("left" if angle_deg >= 0 else "right"), Quantity(abs(angle_deg), Unit.DEGREE)))


def _metres(distance_m: float) -> Quantity:
    return Quantity(round(distance_m, 2), Unit.METRE)

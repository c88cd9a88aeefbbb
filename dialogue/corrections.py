"""Corrections: "no, left", "no, the other one", "I meant three meters"."""

from __future__ import annotations

import math
from dataclasses import replace

from grammar.acts import DialogueAct
from grammar.forms import Form, Quantity, Term, Unit
from robot.geometry import Pose, wrap_angle
from robot.messages import CancelCommand, GoForward, ideal_end
from robot.messages import Turn as TurnCommand
from voxml.vocabulary import Lexicon

from .ellipsis import completed
from .instructions import cancel_all, instruct, obey
from .planning import plan
from .plans import OPERATORS, Plan
from .session import Past
from .stopping import STOP
from .turn import Turn

_LATERAL_M = 0.1  # as far beside its line as a straight way may end and still be driven straight


def corrected(form: Form, wrong: Form | None, lexicon: Lexicon) -> Form | None:
    """What is to be done instead of ``wrong``; None where the correction says too little: then the robot stops."""
    if isinstance(form, Term) and (form.pred in lexicon.programs or form.pred in OPERATORS):
        return form
    return None if wrong is None else completed(form, wrong, lexicon)


def said_instead(turn: Turn, act: DialogueAct, time_s: float) -> None:
    """Stop what is wrong, and do the right thing and what was to come after it. With nothing to lean on, stop."""
    if _answered_otherwise(turn, act, time_s):
        return
    history = turn.session.history
    for index in _correctable(turn):
        form = corrected(act.form, history[index].form, turn.lexicon)
        if form is not None and act.repaired is not None:
            turn.ask_whether((act,), act.repaired)
            return
        if form is not None:
            _do_instead(turn, replace(act, form=form), index, time_s)
            return
    form = corrected(act.form, None, turn.lexicon) if not history else None
    obey(turn, (instruct(STOP) if form is None else replace(act, form=form),), time_s)


def _answered_otherwise(turn: Turn, act: DialogueAct, time_s: float) -> bool:
    """Do instead of what Kirby asked about what was meant; False where that has nothing to do with it."""
    question = turn.session.question
    if question is None or not question.acts:
        return False
    *before, asked = question.acts
    form = corrected(act.form, asked.form, turn.lexicon)
    if form is not None:
        obey(turn, (*before, replace(act, form=form)), time_s)
    return form is not None


def _correctable(turn: Turn) -> list[int]:
    """What was told last, and before it what is still to be done, by its place in the history, the latest first."""
    history = turn.session.history
    before = (index for index in range(len(history) - 1) if _left(turn, history[index]))
    return sorted((*before, *range(len(history))[-1:]), reverse=True)


def _left(turn: Turn, past: Past) -> tuple[str, ...]:
    """The ids of what has not ended of an instruction."""
    return tuple(task.id for task in turn.session.pending if task.id in past.ids)


def _do_instead(turn: Turn, act: DialogueAct, index: int, time_s: float) -> None:
    wrong, *after = turn.session.history[index:]
    later = tuple(instruct(form) for past in after for form in past.forms)
    turn.settle()
    begun = _drop(turn, (wrong, *after))
    right = replace(act, form=_from_here(turn, act.form, wrong)) if begun else act
    earlier = turn.session.history[:index]
    turn.update(history=earlier)
    obey(turn, (right, *later), time_s)
    made = turn.session.history[len(earlier) :]
    if len(made) == 1:
        start = wrong.start if begun else made[0].start
        forms = (act.form, *made[0].forms[1:])
        turn.update(history=(*earlier, replace(made[0], forms=forms, start=start)))


def _drop(turn: Turn, wrong: tuple[Past, ...]) -> bool:
    """Cancel what is left of these, and nothing else; whether the first of them has begun."""
    left = tuple(name for past in wrong for name in _left(turn, past))
    pending = turn.session.pending
    if left and pending[0].id not in left:
        # The last first, so that none of them begins in between.
        turn.dispatch(tuple(CancelCommand(name) for name in reversed(left)))
        turn.update(ideal=wrong[0].start, agenda=None)
        return False
    if pending:
        cancel_all(turn)
    return True


def _from_here(turn: Turn, form: Form, wrong: Past) -> Form:
    """ "No, right", half way through a turn to the left: the turn that ends where the right one would have ended."""
    here = turn.session.world.robot
    made = plan((form,), turn.session.world.with_robot(wrong.start), turn.lexicon)
    if not isinstance(made, Plan) or made.then is not None or len(made.commands) != 1 or not _same_kind(made, wrong):
        return form
    (command,) = made.commands
    end = ideal_end(wrong.start, command)
    if isinstance(command, TurnCommand):
        return _turn_to(end, here)
    local = here.to_local(end.point)
    if isinstance(command, GoForward) and abs(local.y_m) <= _LATERAL_M:
        return Term("go", (Term("forward" if local.x_m >= 0 else "back"), _metres(abs(local.x_m))))
    return form


def _same_kind(made: Plan, wrong: Past) -> bool:
    return len(wrong.commands) == 1 and type(wrong.commands[0]) is type(made.commands[0])


def _turn_to(end: Pose, here: Pose) -> Form:
    angle_deg = round(math.degrees(wrap_angle(end.yaw_rad - here.yaw_rad)), 1)
    return Term("turn", (Term("left" if angle_deg >= 0 else "right"), Quantity(abs(angle_deg), Unit.DEGREE)))


def _metres(distance_m: float) -> Quantity:
    return Quantity(round(distance_m, 2), Unit.METRE)

"""Answers to Kirby's questions: by words, by name or ordinal, by pointing, by thumbs."""

from __future__ import annotations

from dataclasses import replace

from grammar.acts import DialogueAct, Function
from grammar.forms import Form, Name, Quantity, Term
from grounding import Entity, Grounded, resolve
from grounding.descriptions import describe
from grounding.pointing import likely_rows

from .events import Pointing, Tone
from .fusion import fuse, pointing_form, recent, replaced
from .instructions import ask_kirby, confirm, instruct, obey
from .session import Question
from .table import Activity, State
from .turn import Turn

ASKED_MAX = 3
"""After so many times a question is let go: questions never loop."""

_SIDES = (Term("left"), Term("right"))


def yes(turn: Turn, time_s: float) -> None:
    """A yes or a thumbs up: to what is asked, or to going on."""
    question = turn.session.question
    if turn.session.state is State.AWAITING_CONFIRMATION and question is not None:
        confirm(turn, question, time_s)
    elif question is not None:
        ask_again(turn)
    elif turn.session.activity is Activity.STRAYED:
        obey(turn, (instruct(Term("keep_going")),), time_s)
    elif turn.session.activity in (Activity.PAUSED, Activity.LEFT_OVER):
        obey(turn, (instruct(Term("continue")),), time_s)
    elif recent(turn.session.pointings, time_s):
        obey(turn, (instruct(Term("go", (Term("to", (Term("there"),)),))),), time_s)
    else:
        turn.say("Okay.")


def no(turn: Turn, time_s: float) -> None:
    """A no or a thumbs down: to what is asked, or to what is being done."""
    if turn.session.question is not None:
        turn.settle()
        turn.say("Okay, I won't.")
    elif turn.session.activity is Activity.STRAYED:
        obey(turn, (instruct(Term("go_back")),), time_s)
    elif turn.session.moving:
        obey(turn, (instruct(Term("cancel")),), time_s)
    else:
        turn.say("Okay.")


def answer(turn: Turn, form: Form, time_s: float) -> bool:
    """Take a form as the answer to the open question; False if it is none."""
    question = turn.session.question
    if question is None or question.hole is None:
        return False
    filling = _filling(turn, question, form, time_s)
    if filling is None:
        return False
    _fill(turn, question, filling, time_s)
    return True


def pointed(turn: Turn, pointing: Pointing) -> bool:
    """Take a pointing as the answer to the open question; False if it is none."""
    question = turn.session.question
    if question is None or question.hole is None:
        return False
    shown = pointing_form(pointing)
    if turn.session.state is State.AWAITING_PLACE:
        filling, _ = fuse(question.hole, (pointing,))
        _fill(turn, question, filling, pointing.time_s)
        return True
    if turn.session.state is not State.AWAITING_REFERENT:
        return False
    among = turn.session.world.only(question.candidates).entities
    described = describe(question.hole)
    before = () if described is None else described.pointings
    rows = likely_rows((*before, shown), among, among.all_rows)
    if len(rows) != 1:
        ask_again(turn)
    else:
        _fill(turn, question, _entity(among.items[rows[0]]), pointing.time_s)
    return True


def ask_again(turn: Turn) -> None:
    """Repeat the open question, or let it go when it was asked often enough."""
    question = turn.session.question
    assert question is not None
    if question.asked >= ASKED_MAX:
        turn.settle()
        turn.say("Never mind, then.")
        return
    turn.update(question=replace(question, asked=question.asked + 1))
    turn.say(question.text, Tone.QUESTION)


def _filling(turn: Turn, question: Question, form: Form, time_s: float) -> Form | None:
    """What takes the hole's place, or None if ``form`` answers nothing."""
    match turn.session.state:
        case State.AWAITING_SIDE if form in _SIDES and isinstance(question.hole, Term):
            return replace(question.hole, args=(form, *question.hole.args))
        case State.AWAITING_PLACE:
            target = form.args[0] if isinstance(form, Term) and form.pred == "to" and form.args else form
            fused, _ = fuse(target, recent(turn.session.pointings, time_s)[-1:])
            outcome = resolve(fused, turn.session.world, turn.lexicon)
            return fused if isinstance(outcome, Grounded) else None
        case State.AWAITING_REFERENT:
            chosen = _chosen(turn, question, form, time_s)
            return None if chosen is None else _entity(chosen)
        case _:
            return None


def _chosen(turn: Turn, question: Question, form: Form, time_s: float) -> Entity | None:
    """The candidate that a description, a name or a number picks out."""
    among = turn.session.world.with_robot(turn.session.start).only(question.candidates)
    if isinstance(form, Quantity):
        index = int(form.value) - 1
        return among.entities.items[index] if 0 <= index < len(among.entities) else None
    fused, _ = fuse(form, recent(turn.session.pointings, time_s)[-1:])
    outcome = resolve(fused, among, turn.lexicon)
    return outcome.one if isinstance(outcome, Grounded) and isinstance(outcome.one, Entity) else None


def _entity(entity: Entity) -> Term:
    return Term("entity", (Name(entity.id),))


def _fill(turn: Turn, question: Question, filling: Form, time_s: float) -> None:
    assert question.hole is not None
    hole = question.hole
    acts: tuple[DialogueAct, ...] = tuple(replace(act, form=replaced(act.form, hole, filling)) for act in question.acts)
    turn.settle()
    if acts[0].function is Function.QUESTION:
        ask_kirby(turn, acts[0], time_s)
    else:
        obey(turn, acts, time_s)

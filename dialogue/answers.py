"""Answers to Kirby's questions: by words, by name or ordinal, by pointing, by thumbs."""

from __future__ import annotations

from dataclasses import replace

from grammar.acts import DialogueAct, Function
from grammar.forms import Form, Name, Quantity, Term
from grounding import Entity, Grounded, resolve
from grounding.descriptions import describe
from grounding.ordering import ORDINALS
from grounding.pointing import likely_rows
from robot.geometry import Point, Pose

from .corrections import said_instead
from .events import Pointing, Tone
from .fusion import fuse, pointing_form, recent, replaced
from .instructions import ask_kirby, instruct, obey
from .session import Question
from .table import Activity, State
from .turn import Turn

ASKED_MAX = 3
"""After so many times a question is let go: questions never loop."""

_SIDES = (Term("left"), Term("right"))
_GO_THERE = instruct(Term("go", (Term("to", (Term("there"),)),)))
_NEITHER, _ANY = Term("neither"), Term("any")
_ALL = frozenset({Term("both"), Term("all"), Term("both_of_them"), Term("all_of_them")})
_GOING_ON = {
    Activity.STRAYED: Term("keep_going"),
    Activity.PAUSED: Term("continue"),
    Activity.LEFT_OVER: Term("continue"),
}
_TURNING_BACK = {Activity.STRAYED: Term("go_back"), Activity.LEFT_OVER: Term("cancel", (Term("all"),))}
_OPTIONS = {
    State.AWAITING_CHOICE: (Term("keep_going"), Term("go_back")),
    State.AWAITING_RECOVERY: (Term("continue"), Term("cancel"), Term("go_back")),
}
"""What the robot itself offers, in the order in which Kirby says it."""


def yes(turn: Turn, time_s: float, repaired: str | None = None) -> None:
    """A yes: to what is asked, or to going on. One that may have been something else is no answer."""
    question = turn.session.question
    form = _GOING_ON.get(turn.session.activity)
    if question is not None and (turn.session.state is not State.AWAITING_CONFIRMATION or repaired is not None):
        ask_again(turn)
    elif question is not None:
        _confirmed(turn, question, time_s)
    elif form is not None:
        obey(turn, (replace(instruct(form), repaired=repaired),), time_s)
    elif recent(turn.session.pointings, time_s):
        obey(turn, (replace(_GO_THERE, repaired=repaired),), time_s)
    else:
        turn.say("Okay.")


def _confirmed(turn: Turn, question: Question, time_s: float) -> None:
    """Do what was asked about, and before it what gets the rest out of its way."""
    turn.settle()
    if question.commands:
        turn.dispatch(question.commands)
        turn.update(ideal=None)
    if question.acts[0].function is Function.CORRECT:
        said_instead(turn, question.acts[0], time_s)
    else:
        obey(turn, question.acts, time_s)


def thumb_up(turn: Turn, time_s: float) -> None:
    """A yes; after pointing somewhere, with nothing asked of Kirby's own, the order to go there."""
    if turn.session.question is None and recent(turn.session.pointings, time_s):
        obey(turn, (_GO_THERE,), time_s)
    else:
        yes(turn, time_s)


def no(turn: Turn, time_s: float, repaired: str | None = None) -> None:
    """A no or a thumbs down: to what is asked, or to what is being done."""
    form = _TURNING_BACK.get(turn.session.activity)
    if turn.session.question is not None:
        turn.settle()
        turn.say("Okay, I won't.")
    elif form is not None:
        obey(turn, (replace(instruct(form), repaired=repaired),), time_s)
    elif turn.session.moving:
        obey(turn, (replace(instruct(Term("cancel")), repaired=repaired),), time_s)
    else:
        turn.say("Okay.")


def answer(turn: Turn, form: Form, time_s: float, repaired: str | None = None) -> bool:
    """Take a form as the answer to what is asked; False if it is none. A repaired one is confirmed."""
    question, options = turn.session.question, _OPTIONS.get(turn.session.state, ())
    if form == _NEITHER and question is not None:
        no(turn, time_s)
        return True
    if question is None:
        option = option_meant(form, options)
        if option is not None:
            obey(turn, (replace(instruct(option), repaired=repaired),), time_s)
        return option is not None
    filling = None if question.hole is None else _filling(turn, question, form, time_s)
    if filling is not None:
        _fill(turn, question, filling, time_s, repaired)
    return filling is not None


def option_meant(form: Form, options: tuple[Term, ...]) -> Term | None:
    """The option that is named, or counted: by a number, as the first, the second or the last, or as any of them."""
    match form:
        case Term() if form in options:
            return form
        case Quantity(value=value):
            index = int(value) - 1
        case Term("the", (Term(rank, (Term("one", ()),)),)) if rank in ORDINALS:
            index = ORDINALS[rank] - 1
        case Term("the", (Term("last", (Term("one", ()),)),)):
            index = len(options) - 1
        case Term("any", ()):
            index = 0
        case _:
            return None
    return options[index] if 0 <= index < len(options) else None


def pointed(turn: Turn, pointing: Pointing) -> bool:
    """Take a pointing as the answer to the open question; False if it is none."""
    question = turn.session.question
    if question is None or question.hole is None:
        return False
    match turn.session.state:
        case State.AWAITING_PLACE:
            filling, _ = fuse(question.hole, (pointing,))
            _fill(turn, question, filling, pointing.time_s)
        case State.AWAITING_REFERENT:
            among = turn.session.world.only(question.candidates).entities
            described = describe(question.hole)
            before = () if described is None else described.pointings
            rows = likely_rows((*before, pointing_form(pointing)), among, among.all_rows)
            if len(rows) != 1:
                ask_again(turn)
            else:
                _fill(turn, question, _entity(among.items[rows[0]]), pointing.time_s)
        case State.AWAITING_SIDE if (side := _pointed_side(turn, pointing)) is not None:
            answer(turn, side, pointing.time_s)
        case _:
            return False
    return True


def _pointed_side(turn: Turn, pointing: Pointing) -> Term | None:
    """The side of the robot that was pointed at."""
    outcome = resolve(Term("there", (pointing_form(pointing),)), turn.session.world, turn.lexicon)
    match outcome.one if isinstance(outcome, Grounded) else None:
        case Entity(pose=Pose(point=place)) | (Point() as place):
            return _SIDES[0] if turn.session.start.to_local(place).y_m > 0 else _SIDES[1]
        case _:
            return None


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
        case State.AWAITING_SIDE if isinstance(question.hole, Term):
            side = option_meant(form, _SIDES)
            return None if side is None else replace(question.hole, args=(side, *question.hole.args))
        case State.AWAITING_PLACE:
            target = form.args[0] if isinstance(form, Term) and form.pred == "to" and form.args else form
            fused, _ = fuse(target, recent(turn.session.pointings, time_s)[-1:])
            outcome = resolve(fused, turn.session.world, turn.lexicon)
            return fused if isinstance(outcome, Grounded) else None
        case State.AWAITING_REFERENT:
            return _chosen(turn, question, form, time_s)
        case _:
            return None


def _chosen(turn: Turn, question: Question, form: Form, time_s: float) -> Form | None:
    """The candidate that a description, a name or a number picks out; any of them; or all."""
    among = turn.session.world.with_robot(turn.session.start).only(question.candidates)
    things = tuple(_entity(thing) for thing in among.entities.items)
    if isinstance(form, Quantity) or form == _ANY:
        return option_meant(form, things)
    if form in _ALL:
        return Term("and", things)
    if form in _SIDES:
        form = Term("the", (Term("one", ()), Term("on", (form,))))
    fused, _ = fuse(form, recent(turn.session.pointings, time_s)[-1:])
    outcome = resolve(fused, among, turn.lexicon)
    return _entity(outcome.one) if isinstance(outcome, Grounded) and isinstance(outcome.one, Entity) else None


def _entity(entity: Entity) -> Term:
    return Term("entity", (Name(entity.id),))


def _fill(turn: Turn, question: Question, filling: Form, time_s: float, repaired: str | None = None) -> None:
    """Go on with what was asked about, now that it is known."""
    assert question.hole is not None
    hole = question.hole
    acts: tuple[DialogueAct, ...] = tuple(
        replace(act, form=replaced(act.form, hole, filling), repaired=repaired) for act in question.acts
    )
    turn.settle()
    if acts[0].function is Function.QUESTION:
        ask_kirby(turn, acts[0], time_s)
    else:
        obey(turn, acts, time_s)

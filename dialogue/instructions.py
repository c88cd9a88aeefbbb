"""Instructions: fused with pointing, planned, and sent; or a question, an offer or a refusal in their place."""

from __future__ import annotations

from dataclasses import dataclass, replace

from grammar.acts import DialogueAct, Function
from grammar.forms import Form, Term
from grounding import Ambiguous, Reason, Unresolved
from robot.messages import CancelCommand, Command, Control, Patrol

from .events import Tone
from .fusion import demonstratives, fuse, recent
from .leaning import leaned, leaned_in_turn
from .performing import perform, reply
from .planning import plan
from .plans import Plan, Refusal, Refused
from .session import HISTORY_MAX, Agenda, Past, Question
from .table import Activity, Trigger
from .teaching import teach, teaches
from .turn import Turn
from .wording import command_words, refused, unresolved

_PASSING = frozenset({Control.STOP, Control.CONTINUE, Control.KEEP_GOING, Control.QUEUE, Control.TAKE_PICTURE})
"""Commands that leave what is being done as it is, or take it up again; a stop at rest ends what waits to begin."""

_CLEARING = frozenset({Control.CANCEL, Control.CANCEL_ALL, Control.GO_BACK, Control.STOP_PATROL})
"""Commands that get out of the way what would keep the robot from a new movement."""


def obey(turn: Turn, acts: tuple[DialogueAct, ...], time_s: float) -> None:
    """Carry out instructions, or say why not. A repaired reading is confirmed before anything moves."""
    turn.settle()
    repaired = [act.repaired for act in acts if act.repaired is not None]
    if repaired:
        turn.ask_whether(acts, repaired[0])
        return
    fused = _fused(turn, acts, time_s)
    if len(fused) == 1 and teaches(fused[0].form):
        teach(turn, fused[0])
        return
    forms = leaned_in_turn(tuple(act.form for act in fused), turn.session)
    carry_out(turn, tuple(replace(act, form=form) for act, form in zip(fused, forms, strict=True)))


def _fused(turn: Turn, acts: tuple[DialogueAct, ...], time_s: float) -> tuple[DialogueAct, ...]:
    """Demonstratives take the newest pointings, one each; what was used is used up."""
    pointings = recent(turn.session.pointings, time_s)
    wanted = sum(demonstratives(act.form) for act in acts)
    if not wanted or not pointings:
        return acts
    pointings = pointings[-wanted:]
    fused = []
    for act in acts:
        form, pointings = fuse(act.form, pointings)
        fused.append(replace(act, form=form))
    turn.update(pointings=())
    return tuple(fused)


def ask_kirby(turn: Turn, act: DialogueAct, time_s: float) -> None:
    """Answer a question of the person's. Kirby's own stays open meanwhile."""
    (asked,) = _fused(turn, (act,), time_s)
    reply(turn, replace(asked, form=leaned(asked.form, turn.session)))


def tell_kirby(turn: Turn, act: DialogueAct, time_s: float) -> None:
    """Remember what is so from now on."""
    (told,) = _fused(turn, (act,), time_s)
    teach(turn, told)


def carry_out(turn: Turn, acts: tuple[DialogueAct, ...]) -> None:
    """Plan acts whose demonstratives are filled in, and send the plan, or ask, or refuse."""
    world = turn.session.world.with_robot(turn.session.start)
    outcome = plan(tuple(act.form for act in acts), world, turn.lexicon)
    match outcome:
        case Plan():
            _send(turn, outcome, acts)
        case Ambiguous(form, candidates):
            turn.ask_which(acts, form, candidates)
        case Unresolved(Reason.NEEDS_POINTING, Term(pred="here") as here):
            come = instruct(Term("go", (Term("to", (here,)),)))
            turn.ask(Trigger.ASK_PLACE, Question(unresolved(outcome), (come,), here))
        case Unresolved(Reason.NEEDS_POINTING, form):
            turn.ask(Trigger.ASK_PLACE, Question(unresolved(outcome), acts, form))
        case Unresolved():
            turn.say(unresolved(outcome), Tone.REFUSAL)
        case Refused(Refusal.NO_SIDE, form):
            turn.ask(Trigger.ASK_SIDE, Question(refused(outcome), acts, form))
        case Refused():
            turn.say(refused(outcome), Tone.REFUSAL)


def _send(turn: Turn, made: Plan, acts: tuple[DialogueAct, ...]) -> None:
    """Send a plan, unless the robot would refuse it where it is: then offer what would have to be done first."""
    turn.highlight(tuple(entity.id for entity in made.entities), made.places)
    movements = any(map(_moves, made.commands))
    if movements and not _CLEARING & set(made.commands) and (offer := _in_the_way(turn)) is not None:
        order = " and ".join(command_words(command) for command in made.commands)
        question = Question(f"{offer.text} and {order}?", acts, commands=(offer.command,))
        turn.ask(Trigger.ASK_CONFIRMATION, question)
        return
    if not set(made.commands) <= _PASSING or (Control.STOP in made.commands and not turn.session.moving):
        turn.update(agenda=None)
    if made.then is not None:
        turn.update(agenda=Agenda(made.then))
    for event in made.events:
        perform(turn, event)
    if made.commands:
        _speak_of(turn, made)
        start = turn.session.start
        ids = turn.dispatch(made.commands)
        if movements or Control.TAKE_PICTURE in made.commands:
            past = Past(tuple(act.form for act in acts), made.commands, start, ids)
            turn.update(history=(*turn.session.history, past)[-HISTORY_MAX:])
    elif not made.events:
        turn.say(
            "Okay."
            if made.then is not None or all(forbids(act.form) for act in acts)
            else "There is nothing to do for that."
        )


def _moves(command: Command) -> bool:
    return not isinstance(command, Control | CancelCommand)


def _speak_of(turn: Turn, made: Plan) -> None:
    """What a plan is about is what "it" and "there" mean from now on."""
    ids = tuple(entity.id for entity in reversed(made.entities))
    place = made.places[-1] if made.places else None if made.entities else turn.session.place
    turn.update(world=turn.session.world.speaking_of(ids), place=place)


def cancel_all(turn: Turn) -> None:
    """Drop everything at once, so that something else can be done from wherever the robot then is."""
    turn.dispatch((Control.CANCEL_ALL,))
    turn.update(ideal=None, agenda=None)


@dataclass(frozen=True, slots=True)
class _Offer:
    """What keeps the robot from new movements, as words that offer to drop it, and the command that does."""

    text: str
    command: Command


def _in_the_way(turn: Turn) -> _Offer | None:
    """What the robot would refuse new movements for. Told to stop and do something else, it drops what it stopped."""
    if turn.sent & _CLEARING:
        return None
    current = next((task.command for task in turn.session.pending), None)
    if turn.session.activity is Activity.PATROLLING or isinstance(current, Patrol):
        return _Offer("I am patrolling. Shall I stop the patrol", Control.STOP_PATROL)
    if turn.session.activity in (Activity.PAUSED, Activity.LEFT_OVER):
        on = f" on '{command_words(current)}'" if current else ""
        return _Offer(f"I am paused{on}. Shall I drop it", Control.CANCEL_ALL)
    if Control.STOP in turn.sent and turn.session.moving:
        cancel_all(turn)
    return None


def forbids(form: Form) -> bool:
    """Whether an instruction is to leave something undone."""
    return isinstance(form, Term) and form.pred == "not"


def instruct(form: Form) -> DialogueAct:
    """An instruction that was not said in words."""
    return DialogueAct(Function.INSTRUCT, form, (0, 0))

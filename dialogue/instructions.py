"""Instructions: fused with pointing, planned, and sent; or a question, an offer or a refusal in their place."""

from __future__ import annotations

from dataclasses import replace

from grammar.acts import DialogueAct, Function
from grammar.forms import Form, Term
from grounding import Ambiguous, Reason, Unresolved
from robot.messages import Command, Control

from .events import Tone
from .fusion import demonstratives, fuse, recent
from .leaning import leaned
from .performing import perform, reply
from .planning import plan
from .plans import Plan, Refusal, Refused
from .session import HISTORY_MAX, Agenda, Past, Question
from .table import Activity, Trigger
from .teaching import teach, teaches
from .turn import Turn
from .wording import command_words, listed, name_entities, refused, unresolved

STOP = Term("stop")
_PASSING = frozenset({Control.STOP, Control.CONTINUE, Control.KEEP_GOING, Control.QUEUE, Control.TAKE_PICTURE})
"""Commands that leave what is being done as it is, or take it up again."""

_CLEARING = frozenset({Control.CANCEL, Control.CANCEL_ALL, Control.GO_BACK, Control.STOP_PATROL})
"""Commands that get out of the way what would keep the robot from a new movement."""


def stops(form: Form) -> bool:
    """Whether an instruction begins with stopping."""
    match form:
        case Term(pred="stop", args=()):
            return True
        case Term(pred="seq", args=(first, *_)):
            return stops(first)
        case _:
            return False


def obey(turn: Turn, acts: tuple[DialogueAct, ...], time_s: float) -> None:
    """Carry out instructions, or say why not. A repaired reading is confirmed before anything moves."""
    turn.settle()
    repaired = [act.repaired for act in acts if act.repaired is not None]
    if repaired:
        sure = tuple(replace(act, repaired=None) for act in acts)
        turn.ask(Trigger.ASK_CONFIRMATION, Question(f"Did you mean: {repaired[0]}?", sure))
        return
    fused = _fused(turn, acts, time_s)
    if len(fused) == 1 and isinstance(fused[0].form, Term) and teaches(fused[0].form):
        teach(turn, fused[0].form)
        return
    carry_out(turn, tuple(replace(act, form=leaned(act.form, turn.session)) for act in fused))


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
    assert isinstance(told.form, Term)
    teach(turn, told.form)


def carry_out(turn: Turn, acts: tuple[DialogueAct, ...]) -> None:
    """Plan acts whose demonstratives are filled in, and send the plan, or ask, or refuse."""
    world = turn.session.world.with_robot(turn.session.start)
    outcome = plan(tuple(act.form for act in acts), world, turn.lexicon)
    match outcome:
        case Plan():
            _send(turn, outcome, tuple(act.form for act in acts))
        case Ambiguous(form, candidates):
            ids = tuple(entity.id for entity in candidates)
            text = f"Which one: {listed(name_entities(candidates, world))}?"
            turn.highlight(ids, ())
            turn.ask(Trigger.ASK_REFERENT, Question(text, acts, form, ids))
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


def _send(turn: Turn, made: Plan, forms: tuple[Form, ...]) -> None:
    """Send a plan, unless the robot would refuse it where it is: then offer what would have to be done first."""
    if not set(made.commands) <= _PASSING:
        turn.update(agenda=None)
    if made.then is not None:
        turn.update(agenda=Agenda(made.then))
    for event in made.events:
        perform(turn, event)
    if not made.commands:
        if made.then is not None:
            turn.say("Okay.")
        return
    moving = [c for c in made.commands if not isinstance(c, Control)]
    turn.highlight(tuple(entity.id for entity in made.entities), made.places)
    turn.update(
        world=turn.session.world.speaking_of(tuple(entity.id for entity in reversed(made.entities))),
        place=made.places[-1] if made.places else None if made.entities else turn.session.place,
    )
    first = _in_the_way(turn) if moving and not _CLEARING & set(made.commands) else None
    past = (*turn.session.history, Past(forms, made.commands, turn.session.start))[-HISTORY_MAX:] if moving else None
    if past is not None:
        turn.update(history=past)
    if first is None:
        turn.dispatch(made.commands)
        return
    offer, command = first
    order = " and ".join(command_words(c) for c in made.commands)
    turn.ask(Trigger.ASK_CONFIRMATION, Question(f"{offer} and {order}?", commands=(command, *made.commands)))


def cancel_all(turn: Turn) -> None:
    """Drop everything at once, so that something else can be done from wherever the robot then is."""
    turn.dispatch((Control.CANCEL_ALL,))
    turn.update(ideal=None, agenda=None)


def _in_the_way(turn: Turn) -> tuple[str, Command] | None:
    """What keeps the robot from new movements, as an offer to drop it, and the command that does."""
    if turn.cleared:
        return None
    if turn.session.activity is Activity.PATROLLING:
        return "I am patrolling. Shall I stop the patrol", Control.STOP_PATROL
    if turn.session.activity in (Activity.PAUSED, Activity.LEFT_OVER):
        current = next((task for task in turn.session.tasks if task.moves), None)
        on = f" on '{command_words(current.command)}'" if current else ""
        return f"I am paused{on}. Shall I drop it", Control.CANCEL_ALL
    return None


def confirm(turn: Turn, question: Question, time_s: float) -> None:
    """The answer was yes."""
    turn.settle()
    if question.commands:
        turn.dispatch(question.commands)
    else:
        obey(turn, question.acts, time_s)


def instruct(form: Form) -> DialogueAct:
    """An instruction that was not said in words."""
    return DialogueAct(Function.INSTRUCT, form, (0, 0))

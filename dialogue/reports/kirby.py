"""Kirby itself: what it does, did, is about to do and why, and what it made of what was said."""

from __future__ import annotations

from dialogue.planning import plan
from dialogue.plans import Plan, Refusal, Refused
from dialogue.table import Activity, State
from dialogue.wording import command_words, phrase, place_words, refused, unresolved
from grammar.forms import Term
from grounding import Ambiguous, Unresolved
from robot.messages import Command, GoTo, ideal_end

from .asked import Asked, Report, capital, uncapital
from .places import NEAR_M

ABLE = (
    "I can go forward and back, turn, go to things and places and find them, face them, patrol, take pictures, and "
    "tell you what I have seen. Say 'stop' at any time"
)
WHO = "I am Kirby, a mobile robot that you can talk to"


def can(asked: Asked) -> Report:
    """What Kirby is able to do; of one thing, whether it could be done here and now."""
    action = asked.args[0]
    if action == Term("what"):
        return Report(ABLE)
    outcome = plan((action,), asked.world.with_robot(asked.session.start), asked.lexicon)
    match outcome:
        case Plan() | Ambiguous() | Refused(Refusal.NO_SIDE):
            return Report("Yes")
        case Unresolved():
            return Report(f"No: {uncapital(unresolved(outcome)).rstrip('.')}")
        case Refused():
            return Report(f"No: {uncapital(refused(outcome)).rstrip('.')}")


def doing(asked: Asked) -> Report:
    """What Kirby is at."""
    session = asked.session
    tasks = [f"'{command_words(task.command)}'" for task in session.pending]
    match session.activity:
        case Activity.PAUSED | Activity.LEFT_OVER:
            return Report(f"I am paused on {tasks[0]}" if tasks else "I am paused")
        case Activity.STRAYED:
            return Report("I am off my way, and ask whether to keep going or to go back")
        case Activity.PATROLLING:
            return Report("I am patrolling")
    if not tasks:
        return Report("Nothing: I am waiting for commands")
    return Report(f"I am doing {', then '.join(tasks)}")


def going(asked: Asked) -> Report:
    """Where the movement under way ends."""
    session = asked.session
    if not session.moving:
        return Report("Nowhere: I am not on my way")
    end, first = session.world.robot, True
    for task in session.pending:
        if isinstance(task.command, GoTo) or first:
            end, first = ideal_end(end, task.command), False
    near = tuple(e for e in session.world.entities.items if e.point.distance_to(end.point) <= NEAR_M)
    near = tuple(sorted(near, key=lambda e: e.point.distance_to(end.point)))[:1]
    return Report(f"To {place_words(end.point)}" + (f", by {asked.names(near)[0]}" if near else ""), near)


def done(asked: Asked) -> Report:
    """What was done last."""
    past = asked.session.last
    return Report("Nothing yet" if past is None else f"You told me to {_orders(past.commands)}")


def todo(asked: Asked) -> Report:
    """What is still to be done: what was sent and has not ended, and what waits for something to happen."""
    session = asked.session
    left = [command_words(task.command) for task in session.pending]
    if session.agenda is not None:
        left += [
            phrase(form) for form in session.agenda.deferred.rest if isinstance(form, Term) and form.pred != "event"
        ]
    return Report(capital(", then ".join(left)) if left else "Nothing")


def understood(asked: Asked) -> Report:
    """What Kirby made of what was said last, and what came of it."""
    heard, last = asked.session.heard, asked.session.last
    if not heard:
        return Report("I understood nothing")
    said = ", then ".join(phrase(form) for form in heard)
    came = f". That came to: {_orders(last.commands)}" if last is not None and last.forms == heard else ""
    return Report(f"I understood: {said}{came}")


def why(asked: Asked) -> Report:
    """Why Kirby asks, refused, failed, or moves."""
    session = asked.session
    if session.question is not None:
        return Report(_ASKS[session.state] if not session.question.commands else "Because I can't do both at once")
    if session.reason:
        return Report(capital(session.reason.rstrip(".")))
    last = session.last
    return Report("I have done nothing yet" if last is None else f"Because you told me to {_orders(last.commands)}")


def _orders(commands: tuple[Command, ...]) -> str:
    return " and ".join(map(command_words, commands))


_ASKS = {
    State.AWAITING_REFERENT: "Because what you said fits each of them",
    State.AWAITING_PLACE: "Because I did not see where you pointed",
    State.AWAITING_SIDE: "Because you did not say which way",
    State.AWAITING_CONFIRMATION: "Because I am not sure that I understood you",
}

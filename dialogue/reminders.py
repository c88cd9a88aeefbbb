"""A question that waits too long is asked again, then with what one can say, and then let go."""

from __future__ import annotations

from dataclasses import replace

from .events import Tone
from .session import Waiting
from .table import State
from .turn import Turn

REMIND_AFTER_S = (20.0, 40.0, 80.0)
"""After so long without a word: the question again, how to answer it, and an end to it."""

_CHOICES = {
    State.AWAITING_CHOICE: "Shall I keep going?",
    State.AWAITING_RECOVERY: "Continue, cancel or go back?",
}
_HOW = {
    State.AWAITING_REFERENT: "say which one, or point at it",
    State.AWAITING_PLACE: "point at the place",
    State.AWAITING_SIDE: "say left or right",
    State.AWAITING_CONFIRMATION: "say yes or no",
    State.AWAITING_CHOICE: "say keep going or go back",
    State.AWAITING_RECOVERY: "say continue, cancel or go back",
}


def remind(turn: Turn, time_s: float) -> None:
    """Time has passed; see whether a question was left standing."""
    question = turn.session.question
    text = question.text if question is not None else _CHOICES.get(turn.session.state)
    waiting = turn.session.waiting
    if text is None:
        turn.update(waiting=None)
    elif waiting is None or waiting.text != text:
        turn.update(waiting=Waiting(text, time_s))
    elif waiting.reminded < len(REMIND_AFTER_S) and time_s - waiting.since_s >= REMIND_AFTER_S[waiting.reminded]:
        turn.update(waiting=replace(waiting, reminded=waiting.reminded + 1))
        _remind(turn, text, waiting.reminded)


def _remind(turn: Turn, text: str, reminded: int) -> None:
    """What the robot itself asks stays open: it cannot go on without an answer."""
    if reminded == 0:
        turn.say(text, Tone.QUESTION)
    elif reminded == 1:
        turn.say(f"{text} Please {_HOW[turn.session.state]}.", Tone.QUESTION)
    elif turn.session.question is not None:
        turn.settle()
        turn.update(waiting=None)
        turn.say("Never mind, then.")

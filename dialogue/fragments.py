"""Fragments: what leans on the talk so far ("ten more", "the other way", "again"), made whole and done."""

from __future__ import annotations

from dataclasses import replace

from grammar.acts import DialogueAct
from grammar.forms import Name, Term

from .ellipsis import alone, completed
from .events import Tone
from .instructions import instruct, obey
from .session import Question
from .table import Trigger
from .turn import Turn
from .wording import phrase


def said_fragment(turn: Turn, act: DialogueAct, time_s: float) -> None:
    """Do what a fragment amounts to after what was done before; by itself it is confirmed first."""
    last = turn.session.last
    form = None if last is None else completed(act.form, last.form, turn.lexicon)
    if form is not None:
        obey(turn, (replace(act, form=form),), time_s)
        return
    form = _named(turn, act.form) if isinstance(act.form, Name) else alone(act.form, turn.lexicon)
    if form is None:
        turn.say(f"What do you want me to do: {phrase(act.form)}?", Tone.REFUSAL)
    else:
        turn.ask(Trigger.ASK_CONFIRMATION, Question(f"Shall I {phrase(form)}?", (instruct(form),)))


def _named(turn: Turn, name: Name) -> Term:
    """A routine is to be done, whatever else has a name to be gone to."""
    return Term("perform", (name,)) if turn.session.routine(name.text) else Term("go", (Term("to", (name,)),))

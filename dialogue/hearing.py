"""What people say: an utterance's acts, each to where it is answered or obeyed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from grammar.acts import DialogueAct, Function, NotUnderstood
from grammar.forms import Name, Term

from .answers import answer, ask_again, no, yes
from .corrections import said_instead
from .events import Tone, Utterance
from .fragments import said_fragment
from .instructions import ask_kirby, forbids, instruct, obey, tell_kirby
from .stopping import STOP, stop_first
from .teaching import quoted, teaches
from .turn import Turn
from .wording import not_understood

_CONFIDENT = 0.6
"""What a recogniser is less sure of than this is confirmed before anything moves."""
_LEANING = frozenset({Function.FRAGMENT, Function.CORRECT})
_CALLING_OFF = frozenset({Term("cancel"), Term("cancel_all"), Term("cancel", (Term("all"),))})
"""While nothing moves they can only mean what Kirby asks: "never mind"."""


def hear(turn: Turn, event: Utterance) -> None:
    """Take in an utterance. Whatever else was said, and however unsure the reading, stopping comes first."""
    acts = _read(turn, event.text)
    if isinstance(acts, NotUnderstood):
        turn.update(heard=())
        turn.say(not_understood(event.text, acts), Tone.REFUSAL)
        if turn.session.question is not None:
            ask_again(turn)
        return
    if told := tuple(act.form for act in acts if act.function is not Function.QUESTION):
        turn.update(heard=told)
    if event.confidence < _CONFIDENT:
        acts = tuple(replace(act, repaired=act.repaired or event.text) for act in acts)
    acts = stop_first(acts, event.text, turn.lexicon, turn.session.moving)
    if acts[0].form == STOP and acts[0].function is Function.INSTRUCT:
        obey(turn, acts[:1], event.time_s)
        acts = acts[1:]
    _do_acts(turn, acts, event.time_s)


def _read(turn: Turn, text: str) -> tuple[DialogueAct, ...] | NotUnderstood:
    """What was said; where that makes no sense as it stands, with the names that were taught read as names.

    To forget or to do a routine of that name makes more sense than anything else.
    """
    acts = turn.parse(text)
    if (named := quoted(text, turn)) != text:
        again = turn.parse(named)
        if _is_sure(again) and (not _is_sure(acts) or _is_of_routine(again)):
            return again
    return acts


def _is_of_routine(acts: tuple[DialogueAct, ...] | NotUnderstood) -> bool:
    if isinstance(acts, NotUnderstood) or len(acts) > 1:
        return False
    (form,) = (act.form for act in acts)
    return isinstance(form, Term) and form.pred in ("forget", "perform") and isinstance(form.args[0], Name)


def _is_sure(acts: tuple[DialogueAct, ...] | NotUnderstood) -> bool:
    return not isinstance(acts, NotUnderstood) and all(act.repaired is None for act in acts)


def _do_acts(turn: Turn, acts: tuple[DialogueAct, ...], time_s: float) -> None:
    """Instructions are planned together; what leans on them comes after those before it."""
    instructions: tuple[DialogueAct, ...] = ()
    for act in acts:
        if act.function is Function.INSTRUCT:
            instructions = (*instructions, act)
            continue
        if act.function in _LEANING and instructions:
            _obey(turn, instructions, time_s)
            instructions = ()
        _respond(turn, act, time_s)
    if instructions:
        _obey(turn, instructions, time_s)


def _obey(turn: Turn, instructions: tuple[DialogueAct, ...], time_s: float) -> None:
    """What calls off comes first and by itself, whatever becomes of the rest."""
    sure = all(act.repaired is None for act in instructions)
    if sure and turn.session.moving and all(forbids(act.form) for act in instructions):
        obey(turn, (instruct(STOP),), time_s)
    while sure and instructions and instructions[0].form in _CALLING_OFF:
        if turn.session.question is not None and not turn.session.moving:
            no(turn, time_s)
        else:
            obey(turn, instructions[:1], time_s)
        instructions = instructions[1:]
    if instructions:
        obey(turn, instructions, time_s)


def _respond(turn: Turn, act: DialogueAct, time_s: float) -> None:
    """An act that orders nothing by itself."""
    respond = _RESPONSES.get(act.function)
    if respond is not None:
        respond(turn, act, time_s)
    elif answer(turn, act.form, time_s, act.repaired):
        pass
    elif act.function is Function.CORRECT:
        said_instead(turn, act, time_s)
    elif turn.session.question is not None:
        ask_again(turn)
    elif act.function is Function.FRAGMENT:
        said_fragment(turn, act, time_s)
    else:
        turn.say("I understand the words, but not what you want me to do.", Tone.REFUSAL)


def _inform(turn: Turn, act: DialogueAct, time_s: float) -> None:
    if not teaches(act.form):
        turn.say("Okay.")
    elif act.repaired is not None:
        turn.ask_whether((act,), act.repaired)
    else:
        tell_kirby(turn, act, time_s)


_RESPONSES: Mapping[Function, Callable[[Turn, DialogueAct, float], None]] = {
    Function.CONFIRM: lambda turn, act, time_s: yes(turn, time_s, act.repaired),
    Function.DENY: lambda turn, act, time_s: no(turn, time_s, act.repaired),
    Function.GREET: lambda turn, act, time_s: turn.say("Hello."),
    Function.THANK: lambda turn, act, time_s: turn.say("You're welcome."),
    Function.BYE: lambda turn, act, time_s: turn.say("Goodbye."),
    Function.ACKNOWLEDGE: lambda turn, act, time_s: None,
    Function.QUESTION: ask_kirby,
    Function.INFORM: _inform,
}
"""What is answered in the same way whatever was said before."""

"""What Kirby makes of one utterance by itself: the record behind ``kirby parse`` and the corpora's single cases."""

from __future__ import annotations

from typing import Any

from grammar.acts import DialogueAct, Function, NotUnderstood
from grammar.forms import Form, Term
from grounding import Ambiguous, Unresolved, World
from robot.messages import encode_command
from voxml.vocabulary import Lexicon

from .corrections import corrected
from .planning import plan
from .plans import Plan, Refusal, Refused
from .stopping import STOP, stop_first
from .turn import Parser
from .wording import not_understood, refused, unresolved, which_one

_NOWHERE = World()


def understand(text: str, world: World | None, lexicon: Lexicon, parse: Parser) -> dict[str, Any]:
    """Status, act, form and commands, with nothing said before.

    Without a world the robot stands at the map's origin and faces east, and nothing is known around it.
    ``{"utterance", "status": "ok"|"ambiguous"|"not_understood"|"needs_world", "act", "form", "commands"}``; what was
    not understood also has ``span``, ``expected`` and ``nearest``, and what cannot be done its ``reason`` in words.
    A repaired reading would be confirmed first: it is ambiguous.
    """
    acts = parse(text)
    if isinstance(acts, NotUnderstood):
        return _record(
            text, "not_understood", "unknown", None, None, reason=not_understood(text, acts),
            span=list(acts.span), expected=list(acts.expected), nearest=acts.nearest,
        )  # fmt: skip
    form = str(acts[0].form) if len(acts) == 1 else str(Term("seq", tuple(act.form for act in acts)))
    obeyed = stop_first(acts, text, lexicon)
    instructions = tuple(act for act in obeyed if act.function in (Function.INSTRUCT, Function.CORRECT))
    act = (instructions or acts)[0].function.value
    repaired = next((each.repaired for each in acts if each.repaired is not None), None)
    if repaired is not None:
        return _record(text, "ambiguous", act, form, None, reason=f"Did you mean: {repaired}?")
    return _planned(text, act, form, instructions, world, lexicon)


def _planned(
    text: str, act: str, form: str, instructions: tuple[DialogueAct, ...], world: World | None, lexicon: Lexicon
) -> dict[str, Any]:
    forms = tuple(_to_be_done(each, lexicon) for each in instructions)
    outcome = plan(forms, world, lexicon)
    match outcome:
        case Plan(commands):
            return _record(text, "ok", act, form, [encode_command(command) for command in commands])
        case Ambiguous() | Unresolved() if world is None:
            return _record(text, "needs_world", act, form, None)
        case Ambiguous(_, candidates):
            reason = which_one(candidates, world or _NOWHERE)
            return _record(text, "ambiguous", act, form, None, reason=reason)
        case Unresolved():
            return _record(text, "needs_world", act, form, None, reason=unresolved(outcome))
        case Refused(Refusal.CONDITION) if world is None:
            return _record(text, "needs_world", act, form, None)
        case Refused(Refusal.NO_SIDE):
            return _record(text, "ambiguous", act, form, None, reason=refused(outcome))
        case Refused():
            return _record(text, "ok", act, form, [], reason=refused(outcome))


def _to_be_done(act: DialogueAct, lexicon: Lexicon) -> Form:
    """An instruction's form; of a correction what it comes to with nothing said before."""
    return act.form if act.function is Function.INSTRUCT else corrected(act.form, None, lexicon) or STOP


def _record(
    text: str, status: str, act: str, form: str | None, commands: list[str] | None, **more: Any
) -> dict[str, Any]:
    return {"utterance": text, "status": status, "act": act, "form": form, "commands": commands, **more}

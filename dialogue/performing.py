"""What the dialogue does itself, without the robot: it tells, counts, greets, shows."""

from __future__ import annotations

from grammar.acts import DialogueAct, Function
from grammar.forms import Form, Name, Term
from grounding import Ambiguous, Entity, Grounded, Unresolved, resolve

from .events import CameraMove, Tone
from .reports import Report, report
from .session import Question
from .table import Trigger
from .turn import Turn
from .wording import listed, name_entities, phrase, unresolved

_REPORTS = frozenset({"describe", "count", "list", "measure", "report", "introduce"})
_CAMERA = {
    Term("next"): CameraMove.SWITCH_RIGHT,
    Term("left"): CameraMove.ROTATE_LEFT,
    Term("right"): CameraMove.ROTATE_RIGHT,
    **{Term("your", (Term(noun),)): CameraMove.ROBOT_VIEW for noun in ("view", "camera")},
    **{Term("the", (Term(noun),)): CameraMove.BIRDS_EYE for noun in ("overview", "map")},
}


def reply(turn: Turn, act: DialogueAct) -> None:
    """Answer a question, or ask for the pointing that it takes."""
    outcome = report(act.form, turn.session, turn.lexicon)
    if isinstance(outcome, Unresolved):
        turn.ask(Trigger.ASK_PLACE, Question(unresolved(outcome), (act,), outcome.form))
        return
    _tell(turn, outcome)


def _tell(turn: Turn, told: Report) -> None:
    turn.say(f"{told.text}.")
    _speak_of(turn, told.entities)


def _speak_of(turn: Turn, things: tuple[Entity, ...]) -> None:
    ids = tuple(thing.id for thing in things)
    turn.highlight(ids, ())
    turn.update(world=turn.session.world.speaking_of(ids), place=None if ids else turn.session.place)


def perform(turn: Turn, event: Term) -> None:
    """Do ``dialogue(act,...)``."""
    act, *args = event.args
    assert isinstance(act, Term)
    if act.pred in _REPORTS:
        reply(turn, DialogueAct(Function.QUESTION, Term(act.pred, tuple(args)), (0, 0)))
        return
    match act.pred, args:
        case "say", [Name(text=text), *_]:
            turn.say(text)
        case "perform", [Name(text=text)]:
            turn.say(f"I don't know {text}.", Tone.REFUSAL)
        case "greet", _:
            turn.say("Hello.")
        case "pace", _:
            turn.say("I have only one speed.", Tone.REFUSAL)
        case "show" | "pan", [Term() as view, *_] if view in _CAMERA:
            turn.move_camera(_CAMERA[view])
        case "show" | "highlight", [target, *_]:
            _show(turn, target)
        case _:
            turn.say(f"I can't {phrase(act)} from here.", Tone.REFUSAL)


def _show(turn: Turn, target: Form) -> None:
    match resolve(target, turn.session.world, turn.lexicon):
        case Grounded(referents):
            things = tuple(each for each in referents if isinstance(each, Entity))
        case Ambiguous(_, candidates):
            things = candidates
        case Unresolved() as failure:
            turn.say(unresolved(failure), Tone.REFUSAL)
            return
    names = name_entities(things, turn.session.world)
    turn.say(f"{listed(names, 'and').capitalize()}." if names else "There.")
    _speak_of(turn, things)

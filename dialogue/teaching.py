"""What Kirby is taught: what a fiducial stands for, what a thing or a place is called, and named routines."""

from __future__ import annotations

import re
from dataclasses import replace

from grammar.acts import DialogueAct
from grammar.forms import Form, Name, Term
from grounding import Ambiguous, Entity, Grounded, Reason, StandsFor, Unresolved, World, resolve
from grounding.descriptions import describe, number_of

from .events import Tone
from .leaning import unfolded
from .session import Question, Routine
from .table import Trigger
from .turn import Turn
from .wording import name_entities, phrase, unresolved

_HERE = frozenset({"spot", "place", "here"})
ROUTINES_MAX = 50


def teaches(form: Form) -> bool:
    """Whether a form tells something to be remembered."""
    return isinstance(form, Term) and (form.pred, len(form.args)) in _LESSONS


def teach(turn: Turn, act: DialogueAct) -> None:
    """Remember what ``learn("the loop",A)``, ``forget("the loop")``, ``name(X,N)`` or ``is(X,Y)`` tells, or ask."""
    form = act.form
    assert isinstance(form, Term)
    first, *rest = form.args
    match form.pred, first, rest:
        case "learn", Name(text=name), [body]:
            _learn(turn, name, body)
        case "forget", Name(text=name), []:
            _forget(turn, name)
        case "learn", Name(text=name), [] if turn.session.last is not None:
            _learn(turn, name, turn.session.last.form)
        case "learn", Name(text=name), []:
            turn.say(f"Tell me the steps as well: learn {name}: go forward, turn right.", Tone.REFUSAL)
        case "name" | "is", _, [meaning]:
            _call(turn, act, first, meaning)
        case _:
            turn.say(f"I can't remember that: {phrase(form)}.", Tone.REFUSAL)


# ------------------------------------------------------------------ routines
def _learn(turn: Turn, name: str, body: Form) -> None:
    """Routines within a routine are filled in as they are now, so that none can lead back to itself."""
    known = turn.session.routine(name)
    others = tuple(routine for routine in turn.session.routines if routine != known)
    filled = unfolded(body, replace(turn.session, routines=others))
    routines = (*others, Routine(name, filled))[-ROUTINES_MAX:]
    turn.update(routines=routines)
    turn.say(f"I know {name} now.")


def _forget(turn: Turn, name: str) -> None:
    routine = turn.session.routine(name)
    if routine is None:
        turn.say(f"I don't know {name}.", Tone.REFUSAL)
        return
    turn.update(routines=tuple(known for known in turn.session.routines if known != routine))
    turn.say(f"I have forgotten {name}.")


def quoted(text: str, turn: Turn) -> str:
    """What was said, with the names that were taught in quotes, so that they are read as names."""
    names = {routine.name.lower() for routine in turn.session.routines}
    names |= {name.lower() for thing in turn.session.world.entities.items for name in thing.names}
    for name in sorted(names, key=len, reverse=True):
        text = re.sub(rf'(?<!["\w])({re.escape(name)})(?!["\w])', r'"\1"', text, flags=re.IGNORECASE)
    return text


# ------------------------------------------------------------------ things and places
def _call(turn: Turn, act: DialogueAct, what: Form, meaning: Form) -> None:
    if _is_here(what):
        _name_place(turn, meaning)
        return
    if (fiducial_id := _unseen_number(what, turn.session.world)) is not None:
        _stand_for(turn, StandsFor(fiducial_id, "fiducial"), meaning, f"fiducial {fiducial_id}")
        return
    outcome = resolve(what, turn.session.world, turn.lexicon)
    match outcome:
        case Grounded((Entity(fiducial_id=str() as marker) as thing,)):
            before = StandsFor(marker, thing.type, thing.attributes, thing.names, thing.size_m)
            (called,) = name_entities((thing,), turn.session.world)
            _stand_for(turn, before, meaning, called if isinstance(meaning, Name) else f"fiducial {marker}")
        case Ambiguous(form, candidates):
            turn.ask_which((act,), form, candidates)
        case Unresolved(Reason.NEEDS_POINTING, form):
            turn.ask(Trigger.ASK_PLACE, Question("Which one? Please point at it.", (act,), form))
        case Unresolved():
            turn.say(unresolved(outcome), Tone.REFUSAL)
        case _:
            turn.say("Only what has a fiducial can be called something.", Tone.REFUSAL)


def _is_here(what: Form) -> bool:
    description = describe(what)
    return what == Term("here") or (description is not None and description.noun in _HERE and not description.pointings)


def _unseen_number(what: Form, world: World) -> str | None:
    """The number of a fiducial that is known by its number alone."""
    description = describe(what)
    if description is None or description.noun != "fiducial":
        return None
    number = next(filter(None, map(number_of, description.modifiers)), None)
    return None if number is None or number in world.entities.rows_by_fiducial else number


def _stand_for(turn: Turn, before: StandsFor, meaning: Form, called: str) -> None:
    after = _meaning(before, meaning)
    if after is None:
        turn.say(f"I don't know what that is: {phrase(meaning)}.", Tone.REFUSAL)
        return
    turn.update(world=turn.session.world.taught(after))
    turn.say(f"{called[:1].upper()}{called[1:]} is {phrase(meaning)} from now on.")


def _meaning(before: StandsFor, meaning: Form) -> StandsFor | None:
    if isinstance(meaning, Name):
        names = (meaning.text, *(name for name in before.names if name != meaning.text))
        return replace(before, names=names)
    description = describe(meaning)
    if description is None or description.modifiers:
        return None
    return replace(before, type=description.noun, attributes=description.adjectives)


def _name_place(turn: Turn, meaning: Form) -> None:
    """The place where the robot stands is something to go back to, like a thing of no size."""
    description = describe(meaning)
    text = meaning.text if isinstance(meaning, Name) else None
    noun = description.noun if description is not None else "spot"
    world = turn.session.world
    place_id = f"place {(text or phrase(meaning)).lower()}"
    place = Entity(place_id, noun, world.robot, (), (text,) if text else (), (0.0, 0.0, 0.0))
    turn.update(world=world.with_place(place))
    turn.say(f"This place is {phrase(meaning)} from now on.")


_LESSONS = frozenset({("learn", 1), ("learn", 2), ("forget", 1), ("name", 2), ("is", 2)})

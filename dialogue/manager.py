"""The dialogue manager: a pure step from an event to outputs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from grammar.acts import DialogueAct, Function, NotUnderstood
from grammar.forms import Name, Term
from grounding import StandsFor
from voxml.vocabulary import Lexicon

from .agenda import go_on
from .answers import answer, ask_again, no, pointed, yes
from .common_ground import said_fragment, said_instead
from .events import (
    CameraMove,
    Event,
    Gesture,
    GestureKind,
    Highlight,
    MoveCamera,
    Naming,
    Output,
    PointedObject,
    PointedPlace,
    Pointing,
    RobotFeedback,
    Tick,
    Tone,
    Utterance,
    WorldUpdate,
)
from .fusion import REMEMBERED
from .instructions import STOP, ask_kirby, instruct, obey, stops, tell_kirby
from .news import hear_robot
from .reminders import remind
from .session import Session
from .teaching import quoted, teaches
from .turn import Parser, Turn
from .wording import not_understood

_CAMERA = {
    GestureKind.PUSH_LEFT: CameraMove.SWITCH_LEFT,
    GestureKind.PUSH_RIGHT: CameraMove.SWITCH_RIGHT,
    GestureKind.SERVO_LEFT: CameraMove.ROTATE_LEFT,
    GestureKind.SERVO_RIGHT: CameraMove.ROTATE_RIGHT,
    GestureKind.SERVO_BACK: CameraMove.BACK,
}
_CONFIDENT = 0.6
"""What a recogniser is less sure of than this is confirmed before anything moves."""


class DialogueManager:
    """One conversation. `handle` reads no clock and touches nothing outside: the same events give the same outputs."""

    def __init__(self, lexicon: Lexicon, parse: Parser, session: Session | None = None) -> None:
        self._lexicon = lexicon
        self._parse = parse
        self.session = session if session is not None else Session()

    def handle(self, event: Event) -> tuple[Output, ...]:
        """Take in an event; what is to be done about it, in order."""
        turn = Turn(self.session, self._lexicon, self._parse)
        match event:
            case Utterance():
                _hear(turn, event)
            case Pointing():
                _see_pointing(turn, event)
            case Gesture():
                _see_gesture(turn, event)
            case Naming():
                _see_name(turn, event)
            case RobotFeedback():
                hear_robot(turn, event)
            case WorldUpdate():
                _perceive(turn, event)
            case Tick():
                remind(turn, event.time_s)
        if isinstance(event, Utterance | Pointing | Gesture):
            turn.update(waiting=None)
        go_on(turn, event.time_s)
        self.session = turn.session
        return tuple(turn.outputs)


# ------------------------------------------------------------------ words
def _hear(turn: Turn, event: Utterance) -> None:
    acts = _read(turn, event.text)
    if isinstance(acts, NotUnderstood):
        turn.say(not_understood(event.text, acts), Tone.REFUSAL)
        if turn.session.question is not None:
            ask_again(turn)
        return
    if any(stops(act.form) for act in acts if act.function is Function.INSTRUCT):
        # Whatever else was said, and however unsure the reading, stopping comes first.
        acts = _without_stop(acts)
        obey(turn, (instruct(STOP),), event.time_s)
    elif event.confidence < _CONFIDENT:
        acts = tuple(_unsure(act, event.text) for act in acts)
    _do_acts(turn, acts, event.time_s)


def _read(turn: Turn, text: str) -> tuple[DialogueAct, ...] | NotUnderstood:
    """What was said; where that is not understood, with the names that were taught read as names."""
    acts = turn.parse(text)
    if isinstance(acts, NotUnderstood) and (named := quoted(text, turn)) != text:
        again = turn.parse(named)
        return acts if isinstance(again, NotUnderstood) else again
    return acts


def _unsure(act: DialogueAct, text: str) -> DialogueAct:
    return act if act.repaired is not None else DialogueAct(act.function, act.form, act.span, text)


def _without_stop(acts: tuple[DialogueAct, ...]) -> tuple[DialogueAct, ...]:
    """What else was said."""
    rest = []
    for act in acts:
        form = act.form
        if isinstance(form, Term) and form.pred == "seq" and stops(form):
            rest.append(DialogueAct(act.function, Term("seq", form.args[1:]), act.span, act.repaired))
        elif act.function is not Function.INSTRUCT or not stops(form):
            rest.append(act)
    return tuple(rest)


def _do_acts(turn: Turn, acts: tuple[DialogueAct, ...], time_s: float) -> None:
    instructions = tuple(act for act in acts if act.function is Function.INSTRUCT)
    for act in acts:
        if act.function is not Function.INSTRUCT:
            _respond(turn, act, time_s)
    if instructions:
        obey(turn, instructions, time_s)


def _respond(turn: Turn, act: DialogueAct, time_s: float) -> None:
    """An act that orders nothing by itself."""
    respond = _RESPONSES.get(act.function)
    if respond is not None:
        respond(turn, act, time_s)
    elif answer(turn, act.form, time_s):
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
    if teaches(act.form):
        tell_kirby(turn, act, time_s)
    else:
        turn.say("Okay.")


_RESPONSES: Mapping[Function, Callable[[Turn, DialogueAct, float], None]] = {
    Function.CONFIRM: lambda turn, act, time_s: yes(turn, time_s),
    Function.DENY: lambda turn, act, time_s: no(turn, time_s),
    Function.GREET: lambda turn, act, time_s: turn.say("Hello."),
    Function.THANK: lambda turn, act, time_s: turn.say("You're welcome."),
    Function.BYE: lambda turn, act, time_s: turn.say("Goodbye."),
    Function.ACKNOWLEDGE: lambda turn, act, time_s: None,
    Function.QUESTION: ask_kirby,
    Function.INFORM: _inform,
}
"""What is answered in the same way whatever was said before."""


# ------------------------------------------------------------------ hands
def _see_pointing(turn: Turn, event: Pointing) -> None:
    match event.target:
        case PointedObject(id):
            turn.outputs.append(Highlight((id,)))
        case PointedPlace(place):
            turn.outputs.append(Highlight((), (place,)))
    if not pointed(turn, event):
        turn.update(pointings=(*turn.session.pointings, event)[-REMEMBERED:])


def _see_gesture(turn: Turn, event: Gesture) -> None:
    match event.kind:
        case GestureKind.OPEN_PALM:
            obey(turn, (instruct(STOP),), event.time_s)
        case GestureKind.THUMBS_UP:
            yes(turn, event.time_s)
        case GestureKind.THUMBS_DOWN:
            no(turn, event.time_s)
        case GestureKind.BECKON:
            obey(turn, (instruct(Term("come_here")),), event.time_s)
        case GestureKind() as kind if kind in _CAMERA:
            turn.outputs.append(MoveCamera(_CAMERA[kind]))
        case str() as name if any(routine.name == name.lower() for routine in turn.session.routines):
            obey(turn, (instruct(Term("perform", (Name(name),))),), event.time_s)
        case _:
            turn.say("I don't know that gesture.", Tone.REFUSAL)


def _see_name(turn: Turn, event: Naming) -> None:
    """A name that was written is taken as it stands; what the thing is, it stays."""
    world = turn.session.world
    thing = world.entities.get(event.id)
    if thing is None or thing.fiducial_id is None:
        turn.say("I don't see what you named.", Tone.REFUSAL)
        return
    known = next((m for m in world.catalogue if m.fiducial_id == thing.fiducial_id), None)
    meaning = known or StandsFor(thing.fiducial_id, thing.type)
    others = tuple(name for name in meaning.names if name != event.name)
    turn.update(world=world.taught(replace(meaning, names=(event.name, *others))))
    turn.say(f"I call it {event.name} from now on.")


# ------------------------------------------------------------------ senses
def _perceive(turn: Turn, event: WorldUpdate) -> None:
    world = turn.session.world
    if event.odom is not None:
        world = world.with_odom(event.odom)
        turn.update(located=True)
    if event.map is not None:
        world = world.with_map(event.map)
    if event.fiducials is not None:
        world = world.with_fiducials(event.fiducials)
    turn.update(world=world)

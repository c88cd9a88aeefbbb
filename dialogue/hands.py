"""What people do with their hands: pointing, the gestures of the default set and learned ones, names written down."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from grammar.forms import Name, Term
from grounding import StandsFor

from .answers import answer, no, pointed, thumb_up
from .events import (
    CameraMove,
    Gesture,
    GestureKind,
    Highlight,
    Naming,
    PointedObject,
    PointedPlace,
    Pointing,
    Tone,
)
from .fusion import REMEMBERED
from .instructions import instruct, obey
from .stopping import STOP
from .turn import Turn

_CAMERA: Mapping[GestureKind | str, CameraMove] = {
    GestureKind.PUSH_LEFT: CameraMove.SWITCH_LEFT,
    GestureKind.PUSH_RIGHT: CameraMove.SWITCH_RIGHT,
    GestureKind.SERVO_LEFT: CameraMove.ROTATE_LEFT,
    GestureKind.SERVO_RIGHT: CameraMove.ROTATE_RIGHT,
    GestureKind.SERVO_BACK: CameraMove.BACK,
}
_SIDES: Mapping[GestureKind | str, Term] = {
    GestureKind.SERVO_LEFT: Term("left"),
    GestureKind.SERVO_RIGHT: Term("right"),
}
"""What a servo, "an iterated push or nudge" (the paper, section 3.3.2), pushes the robot to."""


def see_pointing(turn: Turn, event: Pointing) -> None:
    """Show what was pointed at; it answers an open question, or waits for its word."""
    match event.target:
        case PointedObject(id):
            turn.outputs.append(Highlight((id,)))
        case PointedPlace(place):
            turn.outputs.append(Highlight((), (place,)))
    if not pointed(turn, event):
        turn.update(pointings=(*turn.session.pointings, event)[-REMEMBERED:])


def see_gesture(turn: Turn, event: Gesture) -> None:
    """Gestures drive by themselves, answer, or move the camera."""
    routine = turn.session.routine(event.kind) if isinstance(event.kind, str) else None
    match event.kind:
        case GestureKind.OPEN_PALM:
            obey(turn, (instruct(STOP),), event.time_s)
        case GestureKind.THUMBS_UP:
            thumb_up(turn, event.time_s)
        case GestureKind.THUMBS_DOWN:
            no(turn, event.time_s)
        case GestureKind.CLAW:
            obey(turn, (instruct(Term("pick_up", (Term("this"),))),), event.time_s)
        case GestureKind.BECKON:
            obey(turn, (instruct(Term("come_here")),), event.time_s)
        case kind if kind in _SIDES and not (event.at_view or turn.session.holds_camera):
            _nudge(turn, _SIDES[kind], event.time_s)
        case kind if kind in _CAMERA:
            turn.move_camera(_CAMERA[kind])
        case _ if routine is not None:
            obey(turn, (instruct(Term("perform", (Name(routine.name),))),), event.time_s)
        case _:
            turn.say("I don't know that gesture.", Tone.REFUSAL)


def _nudge(turn: Turn, side: Term, time_s: float) -> None:
    """Left or right where that was asked; otherwise a little turn to that side."""
    if not answer(turn, side, time_s):
        obey(turn, (instruct(Term("turn", (side, Term("little")))),), time_s)


def see_name(turn: Turn, event: Naming) -> None:
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

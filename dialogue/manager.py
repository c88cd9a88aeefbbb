"""The dialogue manager: a pure step from an event to outputs."""

from __future__ import annotations

from voxml.vocabulary import Lexicon

from .agenda import go_on
from .events import (
    Event,
    Gesture,
    Naming,
    Output,
    Pointing,
    RobotFeedback,
    Tick,
    Utterance,
    WorldUpdate,
)
from .hands import see_gesture, see_name, see_pointing
from .hearing import hear
from .news import hear_robot
from .reminders import remind
from .session import Session
from .turn import Parser, Turn


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
                hear(turn, event)
            case Pointing():
                see_pointing(turn, event)
            case Gesture():
                see_gesture(turn, event)
            case Naming():
                see_name(turn, event)
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

"""A conversation to test with. What is said is written as forms, so that no grammar is needed."""

from __future__ import annotations

from dialogue import DialogueManager, Session, State
from dialogue.events import (
    Dispatch,
    Event,
    Gesture,
    GestureKind,
    Output,
    PointedPlace,
    Pointing,
    RobotFeedback,
    Say,
    Utterance,
)
from grammar.acts import DialogueAct, Function, NotUnderstood
from grammar.forms import Term, parse_form
from grounding import Entities, Entity, World
from robot.geometry import ORIGIN, Point, Pose
from robot.messages import FeedbackCode, encode_command, feedback
from voxml.vocabulary import load_lexicon

BLOCKS = World(
    ORIGIN,
    Entities(
        (
            Entity("1", "block", Pose(2.0, -1.0, 3.14159), ("red",), fiducial_id="1"),
            Entity("2", "block", Pose(3.0, 1.0, 3.14159), ("blue",), fiducial_id="2"),
        )
    ),
)


def parse(text: str) -> tuple[DialogueAct, ...] | NotUnderstood:
    """``yes``, ``no``, ``?form`` answers, ``~form`` is a repaired reading, ``blorp`` is nothing, a form instructs."""
    span = (0, len(text))
    match text[0], text:
        case _, "yes":
            return (DialogueAct(Function.CONFIRM, Term("yes"), span),)
        case _, "no":
            return (DialogueAct(Function.DENY, Term("no"), span),)
        case _, "blorp":
            return NotUnderstood(span, ("go", "turn"), None)
        case "?", _:
            return (DialogueAct(Function.ANSWER, parse_form(text[1:]), span),)
        case "~", _:
            return (DialogueAct(Function.INSTRUCT, parse_form(text[1:]), span, text[1:]),)
    return tuple(DialogueAct(Function.INSTRUCT, parse_form(part), span) for part in text.split(" & "))


class Talk:
    """A conversation with a time of its own."""

    def __init__(self, world: World = BLOCKS) -> None:
        self.manager = DialogueManager(load_lexicon(), parse, Session(world=world))
        self.time_s = 0.0

    def handle(self, event: Event) -> tuple[Output, ...]:
        self.time_s += 1.0
        return self.manager.handle(event)

    def say(self, text: str, confidence: float = 1.0) -> list[str]:
        """The commands that are sent."""
        return sent(self.handle(Utterance(text, self.time_s, confidence)))

    def point(self, x_m: float, y_m: float) -> list[str]:
        return sent(self.handle(Pointing(PointedPlace(Point(x_m, y_m)), self.time_s)))

    def gesture(self, kind: GestureKind | str) -> list[str]:
        return sent(self.handle(Gesture(kind, self.time_s)))

    def robot(self, code: FeedbackCode, id: str | None = None, at: Point | None = None) -> list[str]:
        """What Kirby says of it."""
        outputs = self.handle(RobotFeedback(feedback(code, at=at, id=id), self.time_s))
        return [output.text for output in outputs if isinstance(output, Say)]

    @property
    def state(self) -> State:
        return self.manager.session.state


def sent(outputs: tuple[Output, ...]) -> list[str]:
    return [encode_command(c) for output in outputs if isinstance(output, Dispatch) for c in output.commands]

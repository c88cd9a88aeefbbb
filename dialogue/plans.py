"""What planning comes to: commands and what is left for later, or why not."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from grammar.forms import Form, Term
from grounding import Ambiguous, Entity, Unresolved
from robot.geometry import Point
from robot.messages import Command

COMMANDS_MAX = 100
"""In one utterance; more is more likely misunderstood than meant."""


OPERATORS = frozenset({"seq", "repeat", "until", "if", "when"})
"""Forms over programs that are instructions like them."""


class Refusal(Enum):
    """Why something that was understood cannot be done."""

    UNKNOWN_PROGRAM = "unknown program"
    WRONG_ARGUMENT = "wrong argument"
    NO_SIDE = "no side"  # an angle without left or right
    NOT_AFFORDED = "not afforded"  # a thing with which one cannot do so
    NO_PART = "no part"  # the robot lacks what it takes: a hand, an arm
    NOT_ABLE = "not able"  # the robot has no such command
    CONDITION = "condition"  # an end or a condition that Kirby cannot tell
    BEYOND_LIMITS = "beyond limits"
    TOO_LONG = "too long"


@dataclass(frozen=True, slots=True)
class Refused:
    """``form`` is the part that cannot be done; for ``NO_PART`` what the robot lacks, for what: ``hand(open(it))``."""

    reason: Refusal
    form: Form


@dataclass(frozen=True, slots=True)
class Deferred:
    """What is left to be done once ``condition`` holds.

    ``moving`` says that what is being done goes on until then, so that there is nothing to wait for once it has ended.
    ``known`` are the things known before, by id: "until you see a block" means another one.
    """

    condition: Term
    rest: tuple[Form, ...]
    moving: bool
    known: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Plan:
    """What to send, what it is about (the things and places meant, in the order of their mention), and what is left.

    ``events`` are what the dialogue does itself.
    """

    commands: tuple[Command, ...]
    entities: tuple[Entity, ...] = ()
    places: tuple[Point, ...] = ()
    then: Deferred | None = None
    events: tuple[Term, ...] = ()


Planning = Plan | Ambiguous | Unresolved | Refused


class Stops(Exception):  # noqa: N818 - a result that ends planning early, never seen outside the room
    """Planning ends with this outcome."""

    def __init__(self, outcome: Ambiguous | Unresolved | Refused) -> None:
        self.outcome = outcome

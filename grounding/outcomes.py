"""What becomes of a description when it meets the world. Failing to denote is a value, not an error."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from grammar.forms import Form
from robot.geometry import Point

from .entities import Entity


@dataclass(frozen=True, slots=True)
class Heading:
    """A direction on the map, counter-clockwise from its x axis (east)."""

    yaw_rad: float


Referent = Entity | Point | Heading


@dataclass(frozen=True, slots=True)
class Grounded:
    """What is meant: one thing, place or heading; or several things for a plural, nearest first."""

    referents: tuple[Referent, ...]

    @property
    def one(self) -> Referent:
        """The first of them: the only one for anything singular."""
        return self.referents[0]


@dataclass(frozen=True, slots=True)
class Ambiguous:
    """``form`` (a part of what was resolved) fits several things, in the order in which the robot would meet them."""

    form: Form
    candidates: tuple[Entity, ...]


class Reason(Enum):
    """Why nothing is meant."""

    NOTHING_FITS = "nothing fits"  # among what has been seen so far
    TOO_FEW = "too few"  # "the third block" of two
    NEEDS_POINTING = "needs pointing"  # a demonstrative, and nobody pointed
    POINTED_ELSEWHERE = "pointed elsewhere"  # word and hand disagree, or there is nothing where the hand points
    NO_ANTECEDENT = "no antecedent"  # "it", and nothing was spoken of
    NOT_A_PLACE = "not a place"  # a description used where it means nothing


@dataclass(frozen=True, slots=True)
class Unresolved:
    """``form`` is the part that means nothing here. ``count`` is how many fit where more were asked for."""

    reason: Reason
    form: Form
    count: int = 0


Resolution = Grounded | Ambiguous | Unresolved

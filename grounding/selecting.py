"""Things by noun, adjectives and modifiers: rows of the world's things narrowed down step by step."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from grammar.forms import Term
from voxml.vocabulary import Lexicon

from .descriptions import Description, number_of
from .entities import FIDUCIAL, NO_ROWS, Entity, Mask, Rows
from .outcomes import Ambiguous, Grounded, Reason, Resolution, Unresolved
from .relations import BETWEEN, REGIONS, between, local_m, relation
from .world import World

ONE = "one"
_ANYTHING = frozenset({ONE, "object", "obstacle"})
ROBOT_ID = "robot"


class Failure(Exception):  # noqa: N818 - a result that ends an evaluation early, never seen outside the room
    """A part of a description means nothing."""

    def __init__(self, outcome: Ambiguous | Unresolved) -> None:
        self.outcome = outcome


def noun_rows(description: Description, world: World) -> Rows:
    """The things that the noun and its adjectives fit. "Fiducial" fits everything that carries one."""
    entities, noun = world.entities, description.noun
    if noun in _ANYTHING:
        rows = entities.all_rows
    elif noun == FIDUCIAL:
        rows = entities.fiducial_rows
    else:
        rows = entities.rows_by_type.get(noun, NO_ROWS)
    for adjective in description.adjectives:
        if adjective in REGIONS and adjective not in entities.rows_by_attribute:
            rows = _in_region(adjective, rows, world)
        else:
            rows = _common(rows, entities.rows_by_attribute.get(adjective, NO_ROWS), len(entities))
    return rows


def _common(rows: Rows, others: Rows, count: int) -> Rows:
    """Those of ``rows`` that are among the others, by a mask over all ``count``: no sorting."""
    among = np.zeros(count, dtype=np.bool_)
    among[others] = True
    return rows[among[rows]]


def modified(modifier: Term, rows: Rows, world: World, lexicon: Lexicon, meaning: Callable[[Term], Resolution]) -> Rows:
    """Those of ``rows`` of which a modifier holds; ``meaning`` resolves its landmark.

    Raises:
        Failure: the landmark denotes nothing, or the modifier means nothing here.
    """
    number = number_of(modifier)
    if number is not None:
        return np.extract(rows == world.entities.rows_by_fiducial.get(number, -1), rows)
    region = _region(modifier)
    if region is not None:
        return _in_region(region, rows, world)
    if modifier.pred in ("there", "here", "seen"):
        return rows  # whatever can be meant was seen, and pointing is looked at by itself
    xy_m = world.entities.xy_m[rows]
    entry = lexicon.relations.get(modifier.pred)
    if entry is not None and entry.value == BETWEEN and modifier.args:
        pairs = _pairs(modifier, world, meaning)
        return _where_any([between(a.pose, b.pose, xy_m) for a, b in pairs], rows)
    holds = None if entry is None else relation(entry)
    if holds is None or len(modifier.args) != 1 or not isinstance(modifier.args[0], Term):
        raise Failure(Unresolved(Reason.NOT_A_PLACE, modifier))
    landmarks = _landmarks(modifier.args[0], world, meaning)
    return _where_any([holds(world.robot, landmark, xy_m) for landmark in landmarks], rows)


def _in_region(region: str, rows: Rows, world: World) -> Rows:
    return np.extract(REGIONS[region](local_m(world.robot, world.entities.xy_m[rows])), rows)


def _region(modifier: Term) -> str | None:
    """The part of the robot's view in ``on(right)``, ``on(your(right))`` or ``ahead``."""
    if not modifier.args:
        return modifier.pred if modifier.pred in REGIONS else None
    if modifier.pred not in ("on", "to", "at", "in") or len(modifier.args) != 1:
        return None
    part = modifier.args[0]
    while isinstance(part, Term) and len(part.args) == 1:
        part = part.args[0]
    return part.pred if isinstance(part, Term) and not part.args and part.pred in REGIONS else None


def _landmarks(form: Term, world: World, meaning: Callable[[Term], Resolution]) -> tuple[Entity, ...]:
    """Everything that a landmark's noun phrase may mean: the whole description tells which, so none is asked about."""
    if form == Term("you"):
        return (Entity(ROBOT_ID, ROBOT_ID, world.robot),)
    match meaning(form):
        case Grounded(referents):
            return tuple(r for r in referents if isinstance(r, Entity))
        case Ambiguous(_, candidates):
            return candidates
        case Unresolved() as failure:
            raise Failure(failure)


def _pairs(modifier: Term, world: World, meaning: Callable[[Term], Resolution]) -> list[tuple[Entity, Entity]]:
    """Two landmarks of two noun phrases, or of one plural."""
    groups = [_landmarks(arg, world, meaning) for arg in modifier.args if isinstance(arg, Term)]
    firsts, seconds = groups[0], groups[-1]
    return [(a, b) for a in firsts for b in seconds if a.id != b.id]


def _where_any(masks: list[Mask], rows: Rows) -> Rows:
    return np.extract(np.logical_or.reduce(masks), rows) if masks else NO_ROWS

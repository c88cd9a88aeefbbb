"""Modifiers: which things stand so to the robot or to a landmark, which do not, and which do so most clearly."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from grammar.forms import Form, Term
from voxml.schema import RelationEntry
from voxml.vocabulary import Lexicon

from .descriptions import PLURAL, describe, number_of
from .entities import NO_ROWS, Entity, Mask, Rows
from .map_places import WALL, long_walls, whole_wall
from .outcomes import Ambiguous, Grounded, Reason, Resolution, Unresolved
from .relations import BETWEEN, REGIONS, Places, between, gap_m, is_graded, is_outside, relation
from .selecting import common, in_region
from .world import World

ROBOT_ID = "robot"
_IN_ROOM = frozenset({"RCC8.NTPP", "part"})  # "in the room", "of the room"
_CLEARLY = 0.4  # what is nearer than so much of the second nearest is meant by "near" without a question


class Failure(Exception):  # noqa: N818 - a result that ends an evaluation early, never seen outside the room
    """A part of a description means nothing."""

    def __init__(self, outcome: Ambiguous | Unresolved) -> None:
        self.outcome = outcome


@dataclass(frozen=True, slots=True)
class Setting:
    """``world`` holds what is looked for; ``meaning`` resolves landmarks in the world that holds everything."""

    world: World
    lexicon: Lexicon
    meaning: Callable[[Term], Resolution]

    def landmarks(self, form: Term) -> tuple[Entity, ...]:
        """Everything that a landmark's noun phrase may mean: the whole description tells which, so none is asked about.

        Raises:
            Failure: it means nothing.
        """
        if form == Term("you"):
            return (Entity(ROBOT_ID, ROBOT_ID, self.world.robot),)
        if form == Term("the", (Term(WALL),)) and WALL not in self.world.entities.rows_by_type:
            return long_walls(self.world.walls)
        match self.meaning(form):
            case Grounded(referents):
                return self._whole(tuple(r for r in referents if isinstance(r, Entity)))
            case Ambiguous(_, candidates):
                return self._whole(candidates)
            case Unresolved() as failure:
                raise Failure(failure)

    def _whole(self, things: tuple[Entity, ...]) -> tuple[Entity, ...]:
        walls = self.world.walls
        return tuple(whole_wall(thing, walls) if thing.type == WALL and walls else thing for thing in things)


def modified(modifier: Term, rows: Rows, setting: Setting) -> Rows:
    """Those of ``rows`` of which a modifier holds.

    Raises:
        Failure: the landmark denotes nothing, or the modifier means nothing here.
    """
    world = setting.world
    number = number_of(modifier)
    if number is not None:
        return np.extract(rows == world.entities.rows_by_fiducial.get(number, -1), rows)
    region = _region(modifier)
    if region is not None:
        return in_region(region, rows, world)
    if modifier.pred in ("there", "here", "seen"):
        return rows  # whatever can be meant was seen, and pointing is looked at by itself
    if modifier.pred == "not" and len(modifier.args) == 1:
        return np.setdiff1d(rows, _denied(modifier.args[0], rows, setting))
    if modifier.pred == "of" and (of_them := _of_them(modifier, rows, setting)) is not None:
        return of_them
    masks = _holding(modifier, world.entities.xy_m[rows], setting)
    return np.extract(np.logical_or.reduce(masks), rows) if masks else NO_ROWS


def _of_them(modifier: Term, rows: Rows, setting: Setting) -> Rows | None:
    """ "One of the blocks": those that the plural names; None for the parts of one thing."""
    form = modifier.args[0] if len(modifier.args) == 1 else None
    described = describe(form) if form is not None else None
    if described is None or not isinstance(form, Term) or not (described.plural or described.determiner in PLURAL):
        return None
    return _named(form, rows, setting)


def clearest(modifier: Term, rows: Rows, setting: Setting) -> Rows:
    """Of rows that a graded relation holds of, the one of which it holds by far the most; all where it is not clear."""
    entry = setting.lexicon.relations.get(modifier.pred)
    if entry is None or not is_graded(entry) or len(modifier.args) != 1 or len(rows) < 2:
        return rows
    (form,) = modifier.args
    landmarks = setting.landmarks(form) if isinstance(form, Term) else ()
    xy_m = setting.world.entities.xy_m[rows]
    gaps_m = np.array([gap_m(each, xy_m) for each in landmarks])
    away_m = np.where(gaps_m > 0, gaps_m, np.inf).min(axis=0)  # nothing is near itself
    order = np.argsort(away_m, kind="stable")
    return rows[order[:1]] if away_m[order[0]] < _CLEARLY * away_m[order[1]] else rows


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


def _denied(form: Form, rows: Rows, setting: Setting) -> Rows:
    """Of what is not meant: a color, a relation, or the things that a noun phrase names."""
    entities = setting.world.entities
    if not isinstance(form, Term):
        raise Failure(Unresolved(Reason.NOT_A_PLACE, form))
    if not form.args and form.pred in setting.lexicon.attributes:
        return common(rows, entities.rows_by_attribute.get(form.pred, NO_ROWS), len(entities))
    if describe(form) is None:
        return modified(form, rows, setting)
    return _named(form, rows, setting)


def _named(form: Term, rows: Rows, setting: Setting) -> Rows:
    """The things that a noun phrase names."""
    entities = setting.world.entities
    named = [entities.index[thing.id] for thing in setting.landmarks(form) if thing.id in entities.index]
    return common(rows, np.array(named, dtype=np.intp), len(entities))


def _holding(modifier: Term, xy_m: Places, setting: Setting) -> list[Mask]:
    """Where a relation to each landmark, or pair of landmarks, holds."""
    entry = setting.lexicon.relations.get(modifier.pred)
    forms = tuple(arg for arg in modifier.args if isinstance(arg, Term))
    if entry is None or not forms or len(forms) < len(modifier.args):
        raise Failure(Unresolved(Reason.NOT_A_PLACE, modifier))
    groups = [setting.landmarks(form) for form in forms]
    if entry.value == BETWEEN:
        return [between(a.pose, b.pose, xy_m) for a in groups[0] for b in groups[-1] if a.id != b.id]
    masks = [_mask(entry, landmark, xy_m, setting.world) for landmark in groups[0]]
    if len(forms) > 1 or any(mask is None for mask in masks):
        raise Failure(Unresolved(Reason.NOT_A_PLACE, modifier))
    return [mask for mask in masks if mask is not None]


def _mask(entry: RelationEntry, landmark: Entity, xy_m: Places, world: World) -> Mask | None:
    """None for a relation that says nothing of such a landmark."""
    room, plan = world.room_of(landmark), world.floor_plan
    if room is not None and plan is not None and (entry.value in _IN_ROOM or is_outside(entry)):
        return plan.inside(room, xy_m) ^ is_outside(entry)
    holds = relation(entry)
    return None if holds is None else holds(world.robot, landmark, xy_m)

"""Logical forms meet the world: what a noun phrase, a place or a heading denotes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from grammar.forms import Form, Name, Term
from robot.geometry import Point
from voxml.vocabulary import Lexicon

from .descriptions import (
    INDEFINITE,
    LAST,
    ORDINALS,
    PLURAL,
    Description,
    attachments,
    describe,
    number_of,
)
from .entities import FIDUCIAL, NO_ROWS, Entity, Mask, Rows
from .outcomes import Ambiguous, Grounded, Heading, Reason, Resolution, Unresolved
from .pointing import likely_rows, pointed_place, pointed_ray, read_point
from .relations import (
    BETWEEN,
    COMPASS_RAD,
    REGIONS,
    between,
    distances_m,
    local_m,
    meeting_key_m,
    relation,
)
from .world import World

_ANYTHING = frozenset({"one", "object", "obstacle"})


class _Fails(Exception):  # noqa: N818 - a result that ends the evaluation early, never seen outside
    def __init__(self, outcome: Ambiguous | Unresolved) -> None:
        self.outcome = outcome


def resolve(form: Form, world: World, lexicon: Lexicon) -> Resolution:
    """What ``form`` means in ``world``, for the robot where it stands there.

    ``form`` is a noun phrase (-> entities), ``point(x,y)``, ``here``, ``there`` (-> a place), ``entity("id")``, a
    quoted name, or a heading. Demonstratives need the ``pointed(...)`` that fusion puts into them. Of the
    attachments of a chain of modifiers those that denote something are kept; only if two different things remain is it
    ambiguous.
    """
    direct = _direct(form, world)
    if direct is not None:
        return direct
    description = describe(form)
    if description is None:
        return Unresolved(Reason.NOT_A_PLACE, form)
    return _described(description, world, lexicon)


def _direct(form: Form, world: World) -> Resolution | None:
    """Forms that need no search."""
    place = read_point(form)
    if place is not None:
        return Grounded((place,))
    match form:
        case Name(text=name):
            rows = world.entities.rows_by_name.get(name.lower(), NO_ROWS)
            return _denoted(form, rows, world)
        case Term(pred="entity", args=(Name(text=id),)):
            entity = world.entities.get(id)
            return Unresolved(Reason.NOTHING_FITS, form) if entity is None else Grounded((entity,))
        case Term(pred="here", args=()):
            return Grounded((world.robot.point,))
        case Term(pred="there" | "here", args=(Term() as pointing,)):
            return _pointed_at(form, pointing, world)
        case Term(pred="there"):
            return Unresolved(Reason.NEEDS_POINTING, form)
        case Term(pred="it"):
            return Unresolved(Reason.NO_ANTECEDENT, form)
        case Term(pred="this" | "that", args=(Term(pred="way"), *rest)):
            return _pointed_way(form, rest, world)
        case Term(pred=heading, args=()) if heading in COMPASS_RAD:
            return Grounded((Heading(COMPASS_RAD[heading]),))
        case _:
            return None


def _pointed_at(form: Form, pointing: Term, world: World) -> Resolution:
    place = pointed_place(pointing)
    if place is not None:
        return Grounded((place,))
    rows = likely_rows(pointing, world.entities, world.entities.all_rows)
    return _denoted(form, rows, world, Reason.POINTED_ELSEWHERE)


def _pointed_way(form: Form, rest: list[Form], world: World) -> Resolution:
    """The direction of a ray, or from the robot to the place or thing that was pointed at."""
    if not rest or not isinstance(rest[0], Term):
        return Unresolved(Reason.NEEDS_POINTING, form)
    ray = pointed_ray(rest[0])
    if ray is not None:
        return Grounded((Heading(ray[1]),))
    target = _pointed_at(form, rest[0], world)
    if not isinstance(target, Grounded):
        return target
    place = target.one.point if isinstance(target.one, Entity) else target.one
    assert isinstance(place, Point)
    return Grounded((Heading(world.robot.point.bearing_to(place)),))


# ------------------------------------------------------------------ descriptions
def _described(description: Description, world: World, lexicon: Lexicon) -> Resolution:
    """Tries the attachments; the readings that denote are kept, and among them those that denote one thing."""
    outcomes: list[Resolution] = []
    for chain in attachments(description.modifiers):
        try:
            outcomes.append(_reading(description, chain, world, lexicon))
        except _Fails as failure:
            outcomes.append(failure.outcome)
    grounded = {o.referents: o for o in outcomes if isinstance(o, Grounded)}
    if len(grounded) == 1:
        return next(iter(grounded.values()))
    if grounded:
        entities = {e.id: e for referents in grounded for e in referents if isinstance(e, Entity)}
        return Ambiguous(description.form, tuple(entities.values()))
    ambiguous = next((outcome for outcome in outcomes if isinstance(outcome, Ambiguous)), None)
    return ambiguous or outcomes[0]


def _reading(description: Description, chain: tuple[Term, ...], world: World, lexicon: Lexicon) -> Resolution:
    rows = _noun_rows(description, world)
    for modifier in chain:
        rows = _modified(modifier, rows, world, lexicon)
    if description.ordering is not None:
        rows = _ordered(description, rows, world)
    if description.pointing is not None:
        rows = likely_rows(description.pointing, world.entities, rows)
        return _denoted(description.form, rows, world, Reason.POINTED_ELSEWHERE)
    if description.determiner in PLURAL:
        return _plural(description, rows, world)
    if description.determiner in INDEFINITE and len(rows):
        rows = rows[[np.argmin(_away_m(world, rows))]]
    return _denoted(description.form, rows, world)


def _denoted(form: Form, rows: Rows, world: World, otherwise: Reason = Reason.NOTHING_FITS) -> Resolution:
    """One thing is meant, or a question arises, or nothing fits."""
    if not len(rows):
        return Unresolved(otherwise, form)
    order = np.argsort(meeting_key_m(world.robot, world.entities.xy_m[rows]), kind="stable")
    entities = tuple(world.entities.items[row] for row in rows[order])
    return Grounded(entities) if len(entities) == 1 else Ambiguous(form, entities)


def _plural(description: Description, rows: Rows, world: World) -> Resolution:
    if not len(rows):
        return Unresolved(Reason.NOTHING_FITS, description.form)
    if description.determiner == "both" and len(rows) != 2:
        reason = Reason.TOO_FEW if len(rows) < 2 else Reason.NOTHING_FITS
        return Unresolved(reason, description.form, len(rows))
    nearest_first = rows[np.argsort(_away_m(world, rows), kind="stable")]
    return Grounded(tuple(world.entities.items[row] for row in nearest_first))


def _away_m(world: World, rows: Rows) -> NDArray[np.float64]:
    return distances_m((world.robot.x_m, world.robot.y_m), world.entities.xy_m[rows])


def _noun_rows(description: Description, world: World) -> Rows:
    entities, noun = world.entities, description.noun
    if noun in _ANYTHING:
        rows = entities.all_rows
    elif noun == FIDUCIAL:
        rows = entities.fiducial_rows
    else:
        rows = entities.rows_by_type.get(noun, NO_ROWS)
    for attribute in description.adjectives:
        rows = np.intersect1d(rows, entities.rows_by_attribute.get(attribute, NO_ROWS), assume_unique=True)
    return rows


def _ordered(description: Description, rows: Rows, world: World) -> Rows:
    """The one that an ordinal or superlative picks out of ``rows``; none where there is nothing to pick from."""
    if not len(rows):
        return rows
    ordering = description.ordering
    if ordering in ("nearest", "closest"):
        return rows[[np.argmin(_away_m(world, rows))]]
    if ordering in ("farthest", "furthest"):
        return rows[[np.argmax(_away_m(world, rows))]]
    key_m = meeting_key_m(world.robot, world.entities.xy_m[rows])
    if ordering == LAST:
        # The last one ahead: what lies behind was passed already, unless there is nothing else.
        ahead = local_m(world.robot, world.entities.xy_m[rows])[:, 0] >= 0
        return rows[[np.argmax(np.where(ahead, key_m, -1.0) if ahead.any() else key_m)]]
    rank = ORDINALS.get(ordering or "", 1)
    if rank > len(rows):
        raise _Fails(Unresolved(Reason.TOO_FEW, description.form, len(rows)))
    return rows[np.argpartition(key_m, rank - 1)[[rank - 1]]]


def _modified(modifier: Term, rows: Rows, world: World, lexicon: Lexicon) -> Rows:
    """Those of ``rows`` of which a modifier holds.

    Raises:
        _Fails: its landmark denotes nothing, or the modifier means nothing here.
    """
    number = number_of(modifier)
    if number is not None:
        return np.extract(rows == world.entities.rows_by_fiducial.get(number, -1), rows)
    xy_m = world.entities.xy_m[rows]
    region = _region(modifier)
    if region is not None:
        return np.extract(REGIONS[region](local_m(world.robot, xy_m)), rows)
    entry = lexicon.relations.get(modifier.pred)
    if entry is not None and entry.value == BETWEEN and len(modifier.args) == 2:
        firsts, seconds = (_landmarks(arg, world, lexicon) for arg in modifier.args)
        pairs = [(a, b) for a in firsts for b in seconds if a.id != b.id]
        return _where_any([between(a.pose, b.pose, xy_m) for a, b in pairs], rows)
    holds = None if entry is None else relation(entry)
    if holds is None or len(modifier.args) != 1:
        raise _Fails(Unresolved(Reason.NOT_A_PLACE, modifier))
    landmarks = _landmarks(modifier.args[0], world, lexicon)
    return _where_any([holds(world.robot, landmark.pose, xy_m) for landmark in landmarks], rows)


def _region(modifier: Term) -> str | None:
    """The part of the robot's view in ``on(right)``, ``on(the(right))`` or ``ahead``."""
    if not modifier.args:
        return modifier.pred if modifier.pred in REGIONS else None
    if modifier.pred not in ("on", "to", "at", "in", "from") or len(modifier.args) != 1:
        return None
    part = modifier.args[0]
    while isinstance(part, Term) and len(part.args) == 1:
        part = part.args[0]
    return part.pred if isinstance(part, Term) and not part.args and part.pred in REGIONS else None


def _landmarks(form: Form, world: World, lexicon: Lexicon) -> tuple[Entity, ...]:
    """Everything a landmark's noun phrase may mean: the whole description tells which, so none is asked about."""
    match resolve(form, world, lexicon):
        case Grounded(referents):
            return tuple(r for r in referents if isinstance(r, Entity))
        case Ambiguous(_, candidates):
            return candidates
        case Unresolved() as failure:
            raise _Fails(failure)


def _where_any(masks: list[Mask], rows: Rows) -> Rows:
    return np.extract(np.logical_or.reduce(masks), rows) if masks else NO_ROWS

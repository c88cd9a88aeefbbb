"""Logical forms meet the world: what a noun phrase, a place or a heading denotes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from grammar.forms import Form, Name, Term
from robot.geometry import Point
from voxml.vocabulary import Lexicon

from .descriptions import DEFINITE, EXCLUDING, INDEFINITE, PLURAL, Description, attachments, describe
from .entities import NO_ROWS, Entity, Rows
from .modifying import Failure, Setting, clearest, modified
from .ordering import Choice, counted_from, measured_from, pick
from .outcomes import Ambiguous, Grounded, Heading, Reason, Resolution, Unresolved
from .parts import part_place, whole_of
from .pointing import likely_rows, pointed_place, pointed_ray, read_point
from .relations import COMPASS_RAD, distances_m, meeting_key_m
from .searching import searched
from .selecting import ONE, noun_rows
from .world import World


def resolve(form: Form, world: World, lexicon: Lexicon) -> Resolution:
    """What ``form`` means in ``world``, for the robot where it stands there.

    ``form`` is a noun phrase (-> entities), ``point(x,y)``, ``here``, ``there`` (-> a place), ``entity("id")``, a
    quoted name, or a heading. Demonstratives need the ``pointed(...)`` that fusion puts into them. Of the
    attachments of a chain of modifiers those that denote something are kept; only if two different things remain is it
    ambiguous.
    """
    direct = _direct(form, world, lexicon)
    if direct is not None:
        return direct
    description = describe(form)
    if description is None:
        return Unresolved(Reason.NOT_A_PLACE, form)
    whole = whole_of(description)
    return _described(description, world, lexicon) if whole is None else _part(description, whole, world, lexicon)


def _direct(form: Form, world: World, lexicon: Lexicon) -> Resolution | None:
    """Forms that need no search."""
    place = read_point(form)
    if place is not None:
        return Grounded((place,))
    match form:
        case Name(text=name):
            return _denoted(form, world.entities.rows_by_name.get(name.lower(), NO_ROWS), world)
        case Term(pred="entity", args=(Name(text=id),)):
            entity = world.get(id)
            return Unresolved(Reason.NOTHING_FITS, form) if entity is None else Grounded((entity,))
        case Term(pred="this" | "that", args=(Term(pred="way"), *rest)):
            return _pointed_way(form, rest, world)
        case Term(pred="there" | "here", args=(Term() as pointing,)):
            return _pointed_at(form, pointing, world)
        case Term(args=()):
            return _word(form, world)
        case Term("and", parts):
            return _every(tuple(resolve(part, world, lexicon) for part in parts))
        case Term("or", parts):
            return _either(form, tuple(resolve(part, world, lexicon) for part in parts))
        case _:
            return None


def _every(parts: tuple[Resolution, ...]) -> Resolution:
    """What all of them mean, in the order in which it was said; or the first that fails."""
    failure = next((part for part in parts if not isinstance(part, Grounded)), None)
    return failure or Grounded(
        tuple(dict.fromkeys(r for part in parts if isinstance(part, Grounded) for r in part.referents))
    )


def _either(form: Form, parts: tuple[Resolution, ...]) -> Resolution:
    """The only one that means something; a question where several do."""
    found = {r: None for part in parts if isinstance(part, Grounded) for r in part.referents}
    found |= {thing: None for part in parts if isinstance(part, Ambiguous) for thing in part.candidates}
    entities = tuple(each for each in found if isinstance(each, Entity))
    return Ambiguous(form, entities) if len(entities) > 1 else Grounded(tuple(found)) if found else parts[0]


def _word(form: Term, world: World) -> Resolution | None:
    """A place, a heading or a pronoun of one word."""
    if form.pred in COMPASS_RAD:
        return Grounded((Heading(COMPASS_RAD[form.pred]),))
    match form.pred:
        case "here" | "you":
            return Grounded((world.robot.point,))
        case "there" | "this" | "that" | "these" | "those":
            return Unresolved(Reason.NEEDS_POINTING, form)
        case "it" | "them":
            spoken_of = tuple(filter(None, map(world.get, world.focus[:1])))
            return Grounded(spoken_of) if spoken_of else Unresolved(Reason.NO_ANTECEDENT, form)
        case _:
            return None


def _pointed_at(form: Form, pointing: Term, world: World) -> Resolution:
    place = pointed_place(pointing)
    if place is not None:
        return Grounded((place,))
    rows = likely_rows((pointing,), world.entities, world.entities.all_rows)
    return _denoted(form, rows, world, Reason.POINTED_ELSEWHERE)


def _pointed_way(form: Form, rest: list[Form], world: World) -> Resolution:
    """The direction of a ray, or from the robot to the place or thing that was pointed at."""
    if not rest or not isinstance(rest[0], Term):
        return Unresolved(Reason.NEEDS_POINTING, form)
    ray = pointed_ray(rest[0])
    if ray is not None:
        return Grounded((Heading(ray.direction_rad),))
    target = _pointed_at(form, rest[0], world)
    if not isinstance(target, Grounded):
        return target
    place = target.one.point if isinstance(target.one, Entity) else target.one
    assert isinstance(place, Point)
    return Grounded((Heading(world.robot.point.bearing_to(place)),))


def _part(description: Description, whole: Form, world: World, lexicon: Lexicon) -> Resolution:
    """ "The far end of the hallway" is a place."""
    outcome = resolve(whole, world, lexicon)
    if not isinstance(outcome, Grounded) or not isinstance(outcome.one, Entity):
        return outcome
    place = part_place(description, outcome.one, world)
    return Unresolved(Reason.NOT_A_PLACE, description.form) if place is None else Grounded((place,))


# ------------------------------------------------------------------ descriptions
def _described(description: Description, world: World, lexicon: Lexicon) -> Resolution:
    """Tries the attachments; the readings that denote are kept, and among them those that denote one thing."""
    outcomes: list[Resolution] = []
    for chain in attachments(description.modifiers):
        try:
            outcomes.append(_reading(description, chain, world, lexicon))
        except Failure as failure:
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
    description, within = searched(replace(description, modifiers=chain), world)
    rows = noun_rows(description, within)
    setting = Setting(within, lexicon, lambda form: resolve(form, world, lexicon))
    choice, restricting = _choice(description, setting)
    for modifier in restricting:
        rows = modified(modifier, rows, setting)
    if description.determiner in EXCLUDING and world.focus:
        rows = np.extract(rows != within.entities.index.get(world.focus[0], -1), rows)
    if description.noun == ONE and not description.pointings:
        rows = _of_the_kind_spoken_of(rows, within)
    if choice is not None:
        assert isinstance(description.form, Term)
        picked = pick(description.form, choice, rows, within)
        if isinstance(picked, Unresolved):
            return picked
        rows = picked
    elif description.determiner in DEFINITE and not description.plural:
        for modifier in restricting:
            rows = clearest(modifier, rows, setting)
    return _determined(description, rows, within)


def _choice(description: Description, setting: Setting) -> tuple[Choice | None, tuple[Term, ...]]:
    """What the ordering asks for, with what it counts or measures from; and the modifiers that it leaves."""
    ordering, left, origin, landmarks = description.ordering, list[Term](), None, tuple[Entity, ...]()
    if ordering is None:
        return None, description.modifiers
    for modifier in description.modifiers:
        landmark = measured_from(ordering, modifier)
        if counted_from(modifier) is not None:
            origin = counted_from(modifier)
        elif landmark is not None:
            landmarks += setting.landmarks(landmark)
        else:
            left.append(modifier)
    return Choice(ordering, origin, landmarks, description.count), tuple(left)


def _of_the_kind_spoken_of(rows: Rows, world: World) -> Rows:
    """ "The blue one", after a block was spoken of, is a block where one fits."""
    spoken_of = world.entities.get(world.focus[0]) if world.focus else None
    if spoken_of is None or len(rows) < 2:
        return rows
    of_kind = np.intersect1d(rows, world.entities.rows_by_type[spoken_of.type], assume_unique=True)
    return of_kind if len(of_kind) else rows


def _determined(description: Description, rows: Rows, world: World) -> Resolution:
    """What is meant of the things that fit, by the determiner."""
    if description.pointings:
        rows = likely_rows(description.pointings, world.entities, rows)
        return _denoted(description.form, rows, world, Reason.POINTED_ELSEWHERE)
    if description.plural or description.determiner in PLURAL:
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
    if description.count is not None and description.count > len(rows):
        return Unresolved(Reason.TOO_FEW, description.form, len(rows))
    if description.determiner == "most":
        rows = rows[np.argsort(_away_m(world, rows), kind="stable")][: len(rows) // 2 + 1]
    nearest_first = rows[np.argsort(_away_m(world, rows), kind="stable")]
    if description.count is not None and description.count < len(rows):
        if description.determiner in DEFINITE:
            return _denoted(description.form, rows, world)
        nearest_first = nearest_first[: description.count]
    return Grounded(tuple(world.entities.items[row] for row in nearest_first))


def _away_m(world: World, rows: Rows) -> NDArray[np.float64]:
    return distances_m((world.robot.x_m, world.robot.y_m), world.entities.xy_m[rows])

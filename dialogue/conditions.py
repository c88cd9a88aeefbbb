"""Conditions of ends and beginnings: "until you see a block", "when you get to the door", "if you are facing north"."""

from __future__ import annotations

import math

from grammar.forms import Form, Quantity, Term
from grounding import Ambiguous, Entity, Grounded, Heading, Unresolved, World, resolve
from grounding.descriptions import INDEFINITE
from grounding.places import wall_ahead_m
from robot.geometry import Point, wrap_angle
from voxml.vocabulary import Lexicon

from .plans import Refusal, Refused, Stops

_NEAR_M = {"reach": 0.6, "at": 0.6, "next_to": 1.0, "near": 1.5, "by": 1.5}
_FACING_RAD = math.radians(5.0)
_SEEING = frozenset({"see", "perceive", "find"})
_PRONOUNS = frozenset({"something", "anything", "someone", "anyone"})
ELAPSED = "elapsed"
"""``elapsed(5s)``: so long after all that was sent has ended. Only time tells, so it is not looked at here."""


def holds(condition: Term, world: World, lexicon: Lexicon, known: tuple[str, ...] = ()) -> bool:
    """Whether a condition holds in the world as it is. Of something indefinite only what is not ``known`` yet is seen.

    Raises:
        Stops: it is a condition that Kirby cannot tell.
    """
    match condition:
        case Term("not", (Term() as inner,)):
            return not holds(inner, world, lexicon, known)
        case Term("say"):
            return False  # it will be heard when it is said
        case Term(pred, (*_, seen)) if pred in _SEEING:
            return _is_seen(seen, world, lexicon, known)
        case Term("exists" | "known", (seen,)):
            return _is_seen(seen, world, lexicon, ())
        case Term("face", (target,)):
            return _is_faced(target, world, lexicon)
        case Term("within", (Quantity(value=near_m), target)):
            return _is_near(target, near_m, world, lexicon)
        case Term(pred, (Term("you"), target) | (target,)) if pred in _NEAR_M:
            return _is_near(target, _NEAR_M[pred], world, lexicon)
        case _:
            raise Stops(Refused(Refusal.CONDITION, condition))


def _is_seen(form: Form, world: World, lexicon: Lexicon, known: tuple[str, ...]) -> bool:
    indefinite = isinstance(form, Term) and (form.pred in INDEFINITE or form.pred in _PRONOUNS)
    if indefinite and known:
        before = frozenset(known)
        world = world.only(tuple(e.id for e in world.entities.items if e.id not in before))
    if isinstance(form, Term) and form.pred in _PRONOUNS:
        return len(world.entities) > 0
    return not isinstance(resolve(form, world, lexicon), Unresolved)


def _is_faced(form: Form, world: World, lexicon: Lexicon) -> bool:
    outcome = resolve(form, world, lexicon)
    if not isinstance(outcome, Grounded):
        return False
    match outcome.one:
        case Heading(yaw_rad):
            wanted_rad = yaw_rad
        case Entity() as thing:
            wanted_rad = world.robot.point.bearing_to(thing.point)
        case Point() as place:
            wanted_rad = world.robot.point.bearing_to(place)
    return abs(wrap_angle(wanted_rad - world.robot.yaw_rad)) <= _FACING_RAD


def _is_near(form: Form, near_m: float, world: World, lexicon: Lexicon) -> bool:
    if form == Term("the", (Term("wall"),)):
        ahead_m = wall_ahead_m(world.robot, world.walls)
        return ahead_m is not None and ahead_m <= near_m
    match resolve(form, world, lexicon):
        case Grounded(referents):
            candidates = referents
        case Ambiguous(_, things):
            candidates = things
        case Unresolved():
            return False
    places = [each.point if isinstance(each, Entity) else each for each in candidates]
    return any(isinstance(p, Point) and world.robot.point.distance_to(p) <= near_m for p in places)

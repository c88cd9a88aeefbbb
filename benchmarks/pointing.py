"""Pointing with five degrees of spread among 5 to 30 things; and chains of modifiers of which one reading denotes."""

from __future__ import annotations

import math
import random

from grammar.forms import parse_form
from grounding import Ambiguous, Entities, Entity, Grounded, World, resolve
from robot.geometry import Point, Pose
from voxml.vocabulary import Lexicon, load_lexicon

SCENES = 2_000
CHAINS = 300
SPREAD_DEG = 5.0
_TYPES = ("block", "box", "cone", "chair", "table", "bottle")


def run() -> dict[str, object]:
    """Shares, in percent: right, asked, and wrong without asking; and chains settled without a question."""
    lexicon, chance = load_lexicon(), random.Random(7)
    right = asked = wrong = 0
    for _ in range(SCENES):
        meant, outcome = _pointed(chance, lexicon)
        right += isinstance(outcome, Grounded) and outcome.one == meant
        asked += not isinstance(outcome, Grounded)
        among = isinstance(outcome, Ambiguous) and meant in outcome.candidates
        right += among  # the question names it
        wrong += isinstance(outcome, Grounded) and outcome.one != meant
    settled = sum(_chain(chance, lexicon) for _ in range(CHAINS))
    return {
        "scenes": SCENES,
        "right_or_named_in_the_question_percent": 100.0 * right / SCENES,
        "asked_percent": 100.0 * asked / SCENES,
        "wrong_without_asking_percent": 100.0 * wrong / SCENES,
        "chains": CHAINS,
        "settled_without_a_question_percent": 100.0 * settled / CHAINS,
    }


def _pointed(chance: random.Random, lexicon: Lexicon) -> tuple[Entity, object]:
    """Someone stands at the edge and points at a thing, off by the spread, and says what it is."""
    count = chance.randint(5, 30)
    things = tuple(
        Entity(str(n), chance.choice(_TYPES), Pose(chance.uniform(0, 6), chance.uniform(-4, 4), 0.0))
        for n in range(count)
    )
    meant, origin = chance.choice(things), Point(-1.0, 0.0)
    angle_deg = math.degrees(origin.bearing_to(meant.point)) + chance.gauss(0.0, SPREAD_DEG)
    ray = f"pointed(ray({origin.x_m}m,{origin.y_m}m,{angle_deg:.4f}deg),{SPREAD_DEG}deg)"
    return meant, resolve(parse_form(f"that({meant.type},{ray})"), World(entities=Entities(things)), lexicon)


def _chain(chance: random.Random, lexicon: Lexicon) -> bool:
    """ "The box near the table by the door": of two tables with a box, one is by the door; or the box itself is."""
    side = chance.choice((-1.0, 1.0))
    x_m, y_m = chance.uniform(2, 4), chance.uniform(3, 5) * side
    box = Entity("box", "box", Pose(x_m, y_m, 0.0))
    things = [
        box,
        Entity("table", "table", Pose(x_m + 1.0, y_m, 0.0)),
        Entity("door", "door", Pose(x_m + 2.0, y_m, 0.0)),
        Entity("other box", "box", Pose(x_m, -y_m, 0.0)),
        Entity("other table", "table", Pose(x_m + 1.0, -y_m, 0.0)),
    ]
    chance.shuffle(things)
    third = f",on({'left' if side > 0 else 'right'})" if chance.random() < 0.5 else ""
    form = parse_form(f"the(box,near(the(table)),by(the(door)){third})")
    outcome = resolve(form, World(entities=Entities(tuple(things))), lexicon)
    return isinstance(outcome, Grounded) and outcome.one == box

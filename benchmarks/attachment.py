"""Descriptions of two and three modifiers of which one reading alone denotes: settled without a question."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass

from grammar.forms import parse_form
from grounding import Entities, Entity, Grounded, World, resolve
from robot.geometry import Pose
from voxml.vocabulary import Lexicon, load_lexicon

SCENES = 300
SEED = 11


@dataclass(frozen=True, slots=True)
class _Case:
    """The first thing is the one that is meant."""

    form: str
    things: tuple[Entity, ...]


def run() -> dict[str, object]:
    """Shares in percent by the shape of the description."""
    lexicon, chance = load_lexicon(), random.Random(SEED)
    settled = {template.__name__.lstrip("_"): [0, 0] for template in _TEMPLATES}
    for number in range(SCENES):
        template = _TEMPLATES[number % len(_TEMPLATES)]
        counts = settled[template.__name__.lstrip("_")]
        counts[0] += _settled(template(chance), chance, lexicon)
        counts[1] += 1
    total = sum(right for right, _ in settled.values())
    shares = {f"{name}_percent": 100.0 * right / count for name, (right, count) in settled.items()}
    return {"scenes": SCENES, "settled_without_a_question_percent": 100.0 * total / SCENES, **shares}


def _settled(case: _Case, chance: random.Random, lexicon: Lexicon) -> bool:
    meant = case.things[0].id
    things = chance.sample(case.things, len(case.things))
    outcome = resolve(parse_form(case.form), World(entities=Entities(tuple(things))), lexicon)
    return isinstance(outcome, Grounded) and [e.id for e in outcome.referents if isinstance(e, Entity)] == [meant]


def _thing(id: str, type: str, x_m: float, y_m: float, *attributes: str) -> Entity:
    return Entity(id, type, Pose(x_m, y_m, 0.0), attributes)


# ------------------------------------------------------------------ two modifiers
def _landmark_of_the_landmark(chance: random.Random) -> _Case:
    """The box near the table by the door: two boxes have a table, and one of those is by the door."""
    x_m, y_m, side = chance.uniform(2, 4), chance.uniform(3, 5), chance.choice((-1, 1))
    return _Case(
        "the(box,near(the(table)),by(the(door)))",
        (
            _thing("meant", "box", x_m, side * y_m),
            _thing("table", "table", x_m + 1.0, side * y_m),
            _thing("door", "door", x_m + 2.0, side * y_m),
            _thing("other box", "box", x_m, -side * y_m),
            _thing("other table", "table", x_m + 1.0, -side * y_m),
        ),
    )


def _both_of_the_head(chance: random.Random) -> _Case:
    """The box near the table by the door: the box is by the door, and the table is not."""
    x_m, y_m, side = chance.uniform(2, 4), chance.uniform(3, 5), chance.choice((-1, 1))
    return _Case(
        "the(box,near(the(table)),by(the(door)))",
        (
            _thing("meant", "box", x_m, side * y_m),
            _thing("table", "table", x_m - 1.2, side * y_m),
            _thing("door", "door", x_m + 1.2, side * y_m),
            _thing("other box", "box", x_m, -side * y_m),
            _thing("other table", "table", x_m + 1.0, -side * y_m),
        ),
    )


def _side_of_the_landmark(chance: random.Random) -> _Case:
    """The cone next to the chair on the left: the chair is on the left, the cone dead ahead."""
    x_m, y_m = chance.uniform(2, 4), chance.uniform(0.5, 0.8)
    side = chance.choice((("left", 1), ("right", -1)))
    return _Case(
        f"the(cone,next_to(the(chair)),on({side[0]}))",
        (
            _thing("meant", "cone", x_m, 0.0),
            _thing("chair", "chair", x_m, side[1] * y_m),
            _thing("other cone", "cone", x_m + 3.0, -side[1] * 2.0),
            _thing("other chair", "chair", x_m + 3.5, -side[1] * 2.0),
        ),
    )


def _viewed_side(chance: random.Random) -> _Case:
    """The block left of the crate near the shelf: of two crates with a block on their left, one is near the shelf."""
    x_m, y_m = chance.uniform(4, 5), chance.uniform(1.6, 2.0)
    return _Case(
        "the(block,left_of(the(crate)),near(the(shelf)))",
        (
            _thing("meant", "block", x_m, y_m + 1.0),
            _thing("crate", "crate", x_m, y_m),
            _thing("shelf", "shelf", x_m + 1.0, y_m - 0.6),
            _thing("other block", "block", x_m, -y_m + 1.0),
            _thing("other crate", "crate", x_m, -y_m),
        ),
    )


# ------------------------------------------------------------------ three modifiers
def _chain_of_three(chance: random.Random) -> _Case:
    """The box near the table by the door next to the window."""
    y_m, side = chance.uniform(3, 5), chance.choice((-1, 1))
    row = (("box", 0.0), ("table", 1.2), ("door", 2.4), ("window", 3.2))
    return _Case(
        "the(box,near(the(table)),by(the(door)),next_to(the(window)))",
        (
            *(_thing(f"{n} {kind}", kind, 1.0 + x_m, side * y_m) for n, (kind, x_m) in enumerate(row)),
            *(_thing(f"other {kind}", kind, 1.0 + x_m, -side * y_m) for kind, x_m in row[:3]),
        ),
    )


def _side_last(chance: random.Random) -> _Case:
    """The box near the table by the door on the left."""
    y_m = chance.uniform(3, 5)
    side = chance.choice((("left", 1), ("right", -1)))
    row = (("box", 0.0), ("table", 1.2), ("door", 2.4))
    return _Case(
        f"the(box,near(the(table)),by(the(door)),on({side[0]}))",
        (
            *(_thing(f"{n} {kind}", kind, 1.0 + x_m, side[1] * y_m) for n, (kind, x_m) in enumerate(row)),
            *(_thing(f"other {kind}", kind, 1.0 + x_m, -side[1] * y_m) for kind, x_m in row),
        ),
    )


def _colours_and_compass(chance: random.Random) -> _Case:
    """The red block near the box north of the cone on the right."""
    x_m, y_m = chance.uniform(2, 4), chance.uniform(2, 3)
    return _Case(
        "the(red(block),near(the(box)),north_of(the(cone)),on(right))",
        (
            _thing("meant", "block", x_m + 1.0, -y_m, "red"),
            _thing("blue block", "block", x_m + 1.0, -y_m + 0.3, "blue"),
            _thing("box", "box", x_m, -y_m),
            _thing("cone", "cone", x_m, -y_m - 2.5),
            _thing("left block", "block", x_m + 1.0, y_m, "red"),
            _thing("left box", "box", x_m, y_m),
        ),
    )


_TEMPLATES: tuple[Callable[[random.Random], _Case], ...] = (
    _landmark_of_the_landmark,
    _both_of_the_head,
    _side_of_the_landmark,
    _viewed_side,
    _chain_of_three,
    _side_last,
    _colours_and_compass,
)

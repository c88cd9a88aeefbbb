"""Descriptions in generated layouts, beside an oracle of their own; and the time by the number of things."""

from __future__ import annotations

import math
import random
import statistics
import time
from dataclasses import dataclass

from grammar.forms import parse_form
from grounding import Ambiguous, Entities, Entity, Grounded, Unresolved, World, resolve
from robot.geometry import Pose
from voxml.vocabulary import Lexicon, load_lexicon

LAYOUTS = 2_000
SIZES = (100, 1_000, 10_000, 100_000)
REPEATS = 21
_TYPES = ("block", "box", "cone", "chair")
_COLOURS = ("red", "blue", "green", "yellow")


@dataclass(frozen=True, slots=True)
class _Thing:
    """What the oracle knows of a thing; it shares no code with the resolver."""

    id: str
    type: str
    colour: str
    x_m: float
    y_m: float


def run() -> dict[str, object]:
    """Shares of descriptions settled as the oracle settles them, and times by the number of things."""
    lexicon = load_lexicon()
    return {**_layouts(lexicon), **_growth(lexicon)}


# ------------------------------------------------------------------ right or wrong
def _layouts(lexicon: Lexicon) -> dict[str, object]:
    """A description fits one thing, several or none: it is to be resolved, asked about, or refused."""
    chance = random.Random(5)
    right = {"one": 0, "several": 0, "none": 0}
    total = dict(right)
    for _ in range(LAYOUTS):
        things = _scattered(chance, chance.randint(5, 30))
        pose = Pose(chance.uniform(-1, 1), chance.uniform(-1, 1), chance.uniform(-math.pi, math.pi))
        form, fitting = _description(chance, things, pose)
        outcome = resolve(parse_form(form), _world(things, pose), lexicon)
        kind = "one" if len(fitting) == 1 else "several" if fitting else "none"
        total[kind] += 1
        match outcome:
            case Grounded((Entity(id=found),)):
                right[kind] += fitting == {found}
            case Ambiguous(_, candidates):
                right[kind] += len(fitting) > 1 and fitting == {each.id for each in candidates}
            case Unresolved():
                right[kind] += not fitting
    shares = {f"{kind}_right_percent": 100.0 * right[kind] / total[kind] for kind in total}
    return {"layouts": LAYOUTS, **{f"fits_{kind}": count for kind, count in total.items()}, **shares}


def _scattered(chance: random.Random, count: int) -> list[_Thing]:
    return [
        _Thing(str(n), chance.choice(_TYPES), chance.choice(_COLOURS), chance.uniform(-5, 5), chance.uniform(-5, 5))
        for n in range(count)
    ]


def _world(things: list[_Thing], pose: Pose) -> World:
    items = tuple(Entity(t.id, t.type, Pose(t.x_m, t.y_m, 0.0), (t.colour,)) for t in things)
    return World(pose, Entities(items))


def _description(chance: random.Random, things: list[_Thing], pose: Pose) -> tuple[str, set[str]]:
    """A description at random, and what it fits, by plain geometry."""
    kind, colour, side = chance.choice(_TYPES), chance.choice(_COLOURS), chance.choice(("left", "right"))
    landmark = chance.choice(_TYPES), chance.choice(_COLOURS)
    of_kind = [t for t in things if t.type == kind]
    coloured = [t for t in of_kind if t.colour == colour]
    match chance.randrange(6):
        case 0:
            return f"the({colour}({kind}))", {t.id for t in coloured}
        case 1:
            return f"the({kind},on({side}))", {t.id for t in of_kind if _lies(t, pose, side)}
        case 2:
            return f"the({colour}({kind}),on({side}))", {t.id for t in coloured if _lies(t, pose, side)}
        case 3:
            nearest = min(of_kind, key=lambda t: math.dist((t.x_m, t.y_m), (pose.x_m, pose.y_m)), default=None)
            return f"the(nearest({kind}))", set() if nearest is None else {nearest.id}
        case 4:
            marks = [t for t in things if (t.type, t.colour) == landmark]
            near = {t.id for t in of_kind for m in marks if t is not m and _apart_m(t, m) <= 1.5}
            return f"the({kind},near(the({landmark[1]}({landmark[0]}))))", near
        case _:
            return f"the(first({kind},on({side})))", _first([t for t in of_kind if _lies(t, pose, side)], pose)


def _apart_m(a: _Thing, b: _Thing) -> float:
    return math.dist((a.x_m, a.y_m), (b.x_m, b.y_m))


def _local(thing: _Thing, pose: Pose) -> complex:
    """Ahead and to the left, as a complex number."""
    return complex(thing.x_m - pose.x_m, thing.y_m - pose.y_m) * complex(
        math.cos(pose.yaw_rad), -math.sin(pose.yaw_rad)
    )


def _lies(thing: _Thing, pose: Pose, side: str) -> bool:
    left_m = _local(thing, pose).imag
    return left_m > 0.15 if side == "left" else left_m < -0.15


def _first(things: list[_Thing], pose: Pose) -> set[str]:
    """The first that is met along the way the robot faces; if none lies ahead, the first of those passed."""
    along = {thing.id: _local(thing, pose).real for thing in things}
    ahead = {name: x_m for name, x_m in along.items() if x_m >= 0} or {name: -x_m for name, x_m in along.items()}
    return {min(ahead, key=lambda name: ahead[name])} if ahead else set()


# ------------------------------------------------------------------ growth
def _growth(lexicon: Lexicon) -> dict[str, object]:
    """Milliseconds at the median, beside a plain scan in Python of the same things for the same description."""
    chance = random.Random(6)
    form = parse_form("the(nearest(red(block),on(left)))")
    figures: dict[str, object] = {}
    for size in SIZES:
        things = _scattered(chance, size)
        world = _world(things, Pose(0.0, 0.0, 0.0))
        resolve(form, world, lexicon)  # the columns are made once, when they are first used
        figures[f"ms_of_{size}"] = _median_ms(lambda world=world: resolve(form, world, lexicon))
        figures[f"scan_ms_of_{size}"] = _median_ms(lambda things=things: _scan(things))
    return figures


def _scan(things: list[_Thing]) -> _Thing | None:
    fitting = [t for t in things if t.type == "block" and t.colour == "red" and t.y_m > 0.15]
    return min(fitting, key=lambda t: math.hypot(t.x_m, t.y_m), default=None)


def _median_ms(work: object) -> float:
    assert callable(work)
    times = []
    for _ in range(REPEATS):
        begin = time.perf_counter()
        work()
        times.append(1000.0 * (time.perf_counter() - begin))
    return statistics.median(times)

"""Descriptions in generated layouts, beside an oracle of their own; and the time by the number of things."""

from __future__ import annotations

import random
import statistics
import time
from collections import Counter
from collections.abc import Callable
from functools import partial

from grammar.forms import parse_form
from grounding import Ambiguous, Entities, Entity, Grounded, Resolution, Unresolved, World, resolve
from robot.geometry import Pose
from voxml.vocabulary import Lexicon, load_lexicon

from ._layouts import Described, Thing, described, layout, scattered

LAYOUTS = 2_000
DESCRIPTIONS = 5  # of each layout
SIZES = (100, 1_000, 10_000, 100_000)
REPEATS = 21


def run() -> dict[str, object]:
    """Shares of descriptions settled as the oracle settles them, and times by the number of things."""
    lexicon = load_lexicon()
    return {**_layouts(lexicon), **_growth(lexicon)}


# ------------------------------------------------------------------ right or wrong
def _layouts(lexicon: Lexicon) -> dict[str, object]:
    """A description fits one thing, several or none: it is to be resolved, asked about, or refused."""
    chance = random.Random(5)
    right, total, guessed = Counter[str](), Counter[str](), 0
    for _ in range(LAYOUTS):
        around = layout(chance)
        world = _world(around.things, Pose(around.robot.real, around.robot.imag, around.yaw_rad))
        for _ in range(DESCRIPTIONS):
            wanted = described(chance, around)
            outcome = resolve(parse_form(wanted.form), world, lexicon)
            kind = _kind(wanted)
            total[kind] += 1
            right[kind] += _agrees(outcome, wanted)
            guessed += kind == "several" and isinstance(outcome, Grounded)
    shares = {f"fits_{kind}_right_percent": 100.0 * right[kind] / count for kind, count in sorted(total.items())}
    counts = {f"fits_{kind}": count for kind, count in sorted(total.items())}
    return {"layouts": LAYOUTS, "descriptions": total.total(), **counts, **shares, "guessed_of_several": guessed}


def _kind(wanted: Described) -> str:
    if not wanted.fits:
        return "none"
    return "all" if wanted.many else "one" if len(wanted.fits) == 1 else "several"


def _agrees(outcome: Resolution, wanted: Described) -> bool:
    match outcome:
        case Grounded(referents):
            found = {each.id for each in referents if isinstance(each, Entity)}
            return wanted.fits == found and (wanted.many or len(found) == 1)
        case Ambiguous(_, candidates):
            return not wanted.many and len(wanted.fits) > 1 and wanted.fits == {each.id for each in candidates}
        case Unresolved():
            return not wanted.fits


def _world(things: tuple[Thing, ...], pose: Pose) -> World:
    return World(pose, Entities(tuple(_entity(thing) for thing in things)))


def _entity(thing: Thing) -> Entity:
    pose = Pose(thing.place.real, thing.place.imag, 0.0)
    return Entity(thing.id, thing.type, pose, (thing.colour,), size_m=(0.2, 0.2, thing.height_m))


# ------------------------------------------------------------------ growth
def _growth(lexicon: Lexicon) -> dict[str, object]:
    """Milliseconds at the median, beside a plain scan in Python of the same things for the same description."""
    chance = random.Random(6)
    form = parse_form("the(nearest(red(block),on(left)))")
    figures: dict[str, object] = {}
    for size in SIZES:
        things = tuple(scattered(chance, size))
        world = _world(things, Pose(0.0, 0.0, 0.0))
        resolve(form, world, lexicon)  # the columns are made once, when they are first used
        figures[f"ms_of_{size}"] = _median_ms(partial(resolve, form, world, lexicon))
        figures[f"scan_ms_of_{size}"] = _median_ms(partial(_scan, things))
    return figures


def _scan(things: tuple[Thing, ...]) -> Thing | None:
    fitting = [t for t in things if t.type == "block" and t.colour == "red" and t.place.imag > 0.15]
    return min(fitting, key=lambda t: abs(t.place), default=None)


def _median_ms(work: Callable[[], object]) -> float:
    times = []
    for _ in range(REPEATS):
        begin = time.perf_counter()
        work()
        times.append(1000.0 * (time.perf_counter() - begin))
    return statistics.median(times)

"""Pointing with five degrees of spread at things in furnished rooms, beside the best that could be made of it."""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from grammar.forms import parse_form
from grounding import Ambiguous, Entity, Grounded, Resolution, World, resolve
from robot.geometry import Point
from voxml.vocabulary import Lexicon, load_lexicon

from ._furnished import furnished, standing_place
from ._hands import HANDS, SPREAD_DEG, Hand, Seen, aim, ideal

SCENES = 2_000
SEED = 7
"""The resolver's threshold was chosen with other seeds: 101 to 103."""

_WRONG_MAX = 0.01  # what is allowed to be wrong without asking
_OTHERS_MAX = 3  # of its kind; more are counted with these


@dataclass(frozen=True, slots=True)
class _Scene:
    """Somebody stands in a room and points at a thing."""

    world: World
    origin: Point
    meant: Entity
    hand: Hand
    lexicon: Lexicon

    def shown(self, chance: random.Random) -> Seen:
        return self.hand.show(chance, aim(chance, self.origin, self.meant))

    def resolved(self, *seen: Seen) -> Resolution:
        """With the noun; pointing again adds to what was seen before."""
        pointings = ",".join(self.hand.form(self.origin, each) for each in seen)
        return resolve(parse_form(f"that({self.meant.type},{pointings})"), self.world, self.lexicon)

    def rows(self) -> tuple[int, ...]:
        """Of the things that the noun fits."""
        return tuple(row for row, thing in enumerate(self.world.entities.items) if thing.type == self.meant.type)


@dataclass(frozen=True, slots=True)
class _Outcome:
    """What came of a pointing.

    After a question: whether the meant thing was named in it, so that a truthful ordinal picks it; and what a second
    pointing made of it. ``probable`` is how sure the observer who knows all would be.
    """

    others: int
    outright: bool
    wrong: bool
    named: bool
    pointed_right: bool
    pointed_wrong: bool
    ideal_right: bool
    probable: float


def run(scenes: int = SCENES, seed: int = SEED) -> dict[str, object]:
    """Shares in percent, by what is seen of the hand; and what the scenes are like."""
    lexicon = load_lexicon()
    report: dict[str, object] = {"scenes": scenes, "spread_deg": SPREAD_DEG}
    for name, hand in HANDS.items():
        chance = random.Random(seed)
        outcomes = [_outcome(_scene(chance, hand, lexicon), chance) for _ in range(scenes)]
        shares = _shares(outcomes) | _by_others(outcomes)
        report |= {f"{name}_{what}_percent": share for what, share in shares.items()}
    return report


def _scene(chance: random.Random, hand: Hand, lexicon: Lexicon) -> _Scene:
    things = furnished(chance)
    return _Scene(World(entities=things), standing_place(things, chance), chance.choice(things.items), hand, lexicon)


def _outcome(scene: _Scene, chance: random.Random) -> _Outcome:
    seen, things, rows = scene.shown(chance), scene.world.entities, scene.rows()
    probable = ideal(scene.hand, seen, scene.origin, things, rows)
    first = scene.resolved(seen)
    again = scene.resolved(seen, scene.shown(chance)) if isinstance(first, Ambiguous) else None
    return _Outcome(
        others=len(rows) - 1,
        outright=_means(first, scene.meant),
        wrong=isinstance(first, Grounded) and not _means(first, scene.meant),
        named=isinstance(first, Ambiguous) and scene.meant in first.candidates,
        pointed_right=again is not None and _means(again, scene.meant),
        pointed_wrong=isinstance(again, Grounded) and not _means(again, scene.meant),
        ideal_right=things.items[rows[int(np.argmax(probable))]] == scene.meant,
        probable=float(probable.max()),
    )


def _means(outcome: Resolution, thing: Entity) -> bool:
    return isinstance(outcome, Grounded) and outcome.one == thing


def _shares(outcomes: Sequence[_Outcome]) -> dict[str, float]:
    return {
        "right_without_asking": _percent(o.outright for o in outcomes),
        "wrong_without_asking": _percent(o.wrong for o in outcomes),
        "right_after_an_ordinal": _percent(o.outright or o.named for o in outcomes),
        "right_after_pointing_again": _percent(o.outright or o.pointed_right for o in outcomes),
        "wrong_after_pointing_again": _percent(o.wrong or o.pointed_wrong for o in outcomes),
        "best_possible_without_asking": _best_percent(outcomes),
        "best_possible_guessing_always": _percent(o.ideal_right for o in outcomes),
    }


def _best_percent(outcomes: Sequence[_Outcome]) -> float:
    """How many the observer would get right who acts in the surest cases, up to where one in a hundred goes wrong."""
    right = wrong = 0
    for outcome in sorted(outcomes, key=lambda o: -o.probable):
        wrong += not outcome.ideal_right
        if wrong > _WRONG_MAX * len(outcomes):
            break
        right += outcome.ideal_right
    return 100.0 * right / len(outcomes)


def _by_others(outcomes: Sequence[_Outcome]) -> dict[str, float]:
    """The same by how many others of its kind there are: 0, 1, 2, or 3 and more; and how common that is."""
    groups: dict[int, list[_Outcome]] = {}
    for outcome in outcomes:
        groups.setdefault(min(outcome.others, _OTHERS_MAX), []).append(outcome)
    shares: dict[str, float] = {}
    for others, group in sorted(groups.items()):
        name = f"with_{others}{'_or_more' if others == _OTHERS_MAX else ''}_others"
        shares[name] = 100.0 * len(group) / len(outcomes)
        shares[f"{name}_right_without_asking"] = _percent(o.outright for o in group)
        shares[f"{name}_best_possible_guessing_always"] = _percent(o.ideal_right for o in group)
    return shares


def _percent(hits: Iterable[bool]) -> float:
    listed = list(hits)
    return 100.0 * sum(listed) / len(listed)

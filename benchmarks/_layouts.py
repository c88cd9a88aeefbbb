"""Things scattered at random, descriptions of them at random, and what these fit by plain geometry.

The oracle shares no code with the resolver: places are complex numbers here, and every relation is written out again.
"""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product

TYPES = ("block", "box", "cone", "chair")
COLOURS = ("red", "blue", "green", "yellow")
_SIDES = ("left", "right")
_ORDINALS = ("first", "second", "third")
_ASIDE_M, _NEAR_M, _NEXT_M, _BESIDE_M, _CONE_RAD = 0.15, 1.5, 1.0, 0.75, math.radians(60)
_CLEARLY = 0.4


@dataclass(frozen=True, slots=True)
class Thing:
    """``place`` is on the map, x east and y north."""

    id: str
    type: str
    colour: str
    place: complex
    height_m: float


@dataclass(frozen=True, slots=True)
class Layout:
    """The robot stands at ``robot`` and looks along ``yaw_rad``."""

    things: tuple[Thing, ...]
    robot: complex
    yaw_rad: float

    def local(self, thing: Thing) -> complex:
        """Ahead, and to the left."""
        return (thing.place - self.robot) * cmath.exp(-1j * self.yaw_rad)

    def on(self, side: str, things: Sequence[Thing]) -> list[Thing]:
        """Those on a side of the robot's heading line."""
        sign = 1 if side == "left" else -1
        return [t for t in things if sign * self.local(t).imag > _ASIDE_M]

    def met(self, things: Sequence[Thing]) -> list[Thing]:
        """As the robot would meet them: what lies behind comes last, the nearest of it first."""
        return sorted(things, key=lambda t: ((x := self.local(t).real) < 0, abs(x)))

    def away(self, things: Sequence[Thing]) -> list[Thing]:
        """The nearest first."""
        return sorted(things, key=lambda t: abs(t.place - self.robot))

    def from_left(self, things: Sequence[Thing]) -> list[Thing]:
        """By bearing, the leftmost first."""
        return sorted(things, key=lambda t: -cmath.phase(self.local(t)))


@dataclass(frozen=True, slots=True)
class Described:
    """A form, and the ids that it fits. ``many`` says that it asks for all of them."""

    form: str
    fits: frozenset[str]
    many: bool = False


def layout(chance: random.Random) -> Layout:
    """5 to 30 things on 10 by 10 m, and the robot near the middle."""
    things = tuple(scattered(chance, chance.randint(5, 30)))
    return Layout(things, complex(chance.uniform(-1, 1), chance.uniform(-1, 1)), chance.uniform(-math.pi, math.pi))


def scattered(chance: random.Random, count: int) -> list[Thing]:
    """So many things at random."""
    return [
        Thing(
            str(n),
            chance.choice(TYPES),
            chance.choice(COLOURS),
            complex(chance.uniform(-5, 5), chance.uniform(-5, 5)),
            chance.uniform(0.1, 1.0),
        )
        for n in range(count)
    ]


def described(chance: random.Random, around: Layout) -> Described:
    """One of the templates, with words at random."""
    return chance.choice(_TEMPLATES)(_Words(chance, around))


class _Words:
    """The words that a template draws, and the things of the kind drawn first."""

    def __init__(self, chance: random.Random, around: Layout) -> None:
        self.around, self.chance = around, chance
        self.kind, self.colour, self.side = chance.choice(TYPES), chance.choice(COLOURS), chance.choice(_SIDES)
        self.of_kind = [t for t in around.things if t.type == self.kind]
        self.coloured = [t for t in self.of_kind if t.colour == self.colour]

    def landmark(self) -> tuple[str, list[Thing]]:
        """A noun phrase for another thing, and everything it fits."""
        kind, colour = self.chance.choice(TYPES), self.chance.choice(COLOURS)
        fits = [t for t in self.around.things if (t.type, t.colour) == (kind, colour)]
        return f"the({colour}({kind}))", fits


def _ids(things: Sequence[Thing]) -> frozenset[str]:
    return frozenset(t.id for t in things)


def _nth(things: Sequence[Thing], rank: int) -> frozenset[str]:
    return _ids(things[rank : rank + 1])


# ------------------------------------------------------------------ nouns, adjectives, sides
def _by_colour(words: _Words) -> Described:
    return Described(f"the({words.colour}({words.kind}))", _ids(words.coloured))


def _on_side(words: _Words) -> Described:
    return Described(f"the({words.kind},on({words.side}))", _ids(words.around.on(words.side, words.of_kind)))


def _by_colour_on_side(words: _Words) -> Described:
    fits = words.around.on(words.side, words.coloured)
    return Described(f"the({words.colour}({words.kind}),on({words.side}))", _ids(fits))


# ------------------------------------------------------------------ ordinals and superlatives
def _ordinal(words: _Words) -> Described:
    rank = words.chance.randrange(len(_ORDINALS))
    fits = words.around.met(words.around.on(words.side, words.of_kind))
    return Described(f"the({_ORDINALS[rank]}({words.kind},on({words.side})))", _nth(fits, rank))


def _last(words: _Words) -> Described:
    """The last one ahead; where none is ahead, the last of all."""
    fits = words.around.met(words.around.on(words.side, words.of_kind))
    ahead = [t for t in fits if words.around.local(t).real >= 0] or fits
    return Described(f"the(last({words.kind},on({words.side})))", _ids(ahead[-1:]))


def _from_side(words: _Words) -> Described:
    rank = words.chance.randrange(len(_ORDINALS))
    row = words.around.from_left(words.of_kind)[:: 1 if words.side == "left" else -1]
    return Described(f"the({_ORDINALS[rank]}({words.kind},from({words.side})))", _nth(row, rank))


def _superlative(words: _Words) -> Described:
    around, fits = words.around, words.of_kind
    first_of = {
        "nearest": around.away(fits),
        "farthest": around.away(fits)[::-1],
        "leftmost": around.from_left(fits),
        "rightmost": around.from_left(fits)[::-1],
        "tallest": sorted(fits, key=lambda t: -t.height_m),
        "shortest": sorted(fits, key=lambda t: t.height_m),
    }
    word = words.chance.choice(tuple(first_of))
    return Described(f"the({word}({words.kind}))", _ids(first_of[word][:1]))


# ------------------------------------------------------------------ relations
def _near(words: _Words) -> Described:
    """One that is nearer than four tenths of the second nearest is meant alone."""
    form, marks = words.landmark()
    word, limit_m = words.chance.choice((("near", _NEAR_M), ("next_to", _NEXT_M)))

    def gap_m(thing: Thing) -> float:
        return min(abs(thing.place - m.place) for m in marks if m is not thing)

    fits = sorted(_close(words.of_kind, marks, limit_m), key=gap_m) if marks else []
    if len(fits) > 1 and gap_m(fits[0]) < _CLEARLY * gap_m(fits[1]):
        fits = fits[:1]
    return Described(f"the({words.kind},{word}({form}))", _ids(fits))


def _close(things: Sequence[Thing], marks: Sequence[Thing], limit_m: float) -> list[Thing]:
    return [t for t in things if any(t is not m and abs(t.place - m.place) <= limit_m for m in marks)]


def _compass(words: _Words) -> Described:
    form, marks = words.landmark()
    name, way = words.chance.choice((("east", 1), ("north", 1j), ("west", -1), ("south", -1j)))
    fits = [t for t in words.of_kind if any(_within(t.place - m.place, way) for m in marks)]
    return Described(f"the({words.kind},{name}_of({form}))", _ids(fits))


def _viewed(words: _Words) -> Described:
    """On a side of a landmark, as the robot sees it."""
    form, marks = words.landmark()
    turn = 1j if words.side == "left" else -1j
    fits = [
        t
        for t in words.of_kind
        if any(_within(t.place - m.place, (m.place - words.around.robot) * turn) for m in marks)
    ]
    return Described(f"the({words.kind},{words.side}_of({form}))", _ids(fits))


def _within(offset: complex, way: complex) -> bool:
    return offset != 0 and abs(cmath.phase(offset / way)) <= _CONE_RAD


def _between(words: _Words) -> Described:
    (first, firsts), (second, seconds) = words.landmark(), words.landmark()
    pairs = [(a, b) for a, b in product(firsts, seconds) if a is not b]
    fits = [t for t in words.of_kind if any(_lies_between(t, a, b) for a, b in pairs)]
    return Described(f"the({words.kind},between({first},{second}))", _ids(fits))


def _lies_between(thing: Thing, first: Thing, second: Thing) -> bool:
    line = second.place - first.place
    along = (thing.place - first.place) / line * abs(line)
    return 0.01 < along.real < abs(line) - 0.01 and abs(along.imag) <= _BESIDE_M


# ------------------------------------------------------------------ negation
def _not_colour(words: _Words) -> Described:
    fits = [t for t in words.of_kind if t.colour != words.colour]
    return Described(f"the({words.kind},not({words.colour}))", _ids(fits))


def _not_near(words: _Words) -> Described:
    form, marks = words.landmark()
    if not marks:
        return Described(f"the({words.kind},not(near({form})))", frozenset())
    near = _close(words.of_kind, marks, _NEAR_M)
    return Described(f"the({words.kind},not(near({form})))", _ids(words.of_kind) - _ids(near))


def _all_but(words: _Words) -> Described:
    form = f"all({words.kind},not(the({words.colour}({words.kind}))))"
    fits = [t for t in words.of_kind if t.colour != words.colour] if words.coloured else []
    return Described(form, _ids(fits), many=True)


# ------------------------------------------------------------------ quantifiers
def _all(words: _Words) -> Described:
    fits = words.around.on(words.side, words.of_kind)
    word = words.chance.choice(("all", "every", "each"))
    return Described(f"{word}({words.kind},on({words.side}))", _ids(fits), many=True)


def _both(words: _Words) -> Described:
    fits = words.coloured if len(words.coloured) == 2 else []
    return Described(f"both({words.colour}({words.kind}))", _ids(fits), many=True)


def _some(words: _Words) -> Described:
    """Whichever fits: the nearest."""
    word = words.chance.choice(("a", "any", "some"))
    return Described(f"{word}({words.colour}({words.kind}))", _ids(words.around.away(words.coloured)[:1]))


def _first_few(words: _Words) -> Described:
    row = words.around.met(words.of_kind)
    fits = row[:2] if len(row) >= 2 else []
    return Described(f"the(first(count(2,plural({words.kind}))))", _ids(fits), many=True)


_TEMPLATES: tuple[Callable[[_Words], Described], ...] = (
    _by_colour,
    _on_side,
    _by_colour_on_side,
    _ordinal,
    _last,
    _from_side,
    _superlative,
    _near,
    _compass,
    _viewed,
    _between,
    _not_colour,
    _not_near,
    _all_but,
    _all,
    _both,
    _some,
    _first_few,
)

"""The words that numbers are made of, in one language."""

from __future__ import annotations

from dataclasses import dataclass

from voxml.words import ClosedClasses


@dataclass(frozen=True, slots=True)
class NumberWords:
    """Words by what they do in a number; values where they have one."""

    units: dict[str, float]
    multipliers: dict[str, float]
    fractions: dict[str, float]
    vague: dict[str, float]
    articles: frozenset[str]
    joining: frozenset[str]
    tens_joining: frozenset[str]
    point: frozenset[str]
    minus: frozenset[str]
    range: frozenset[str]
    of: frozenset[str]
    inner_zero: frozenset[str]

    def starters(self) -> frozenset[str]:
        """The words that a number can begin with."""
        valued = {*self.units, *self.multipliers, *self.fractions, *self.vague}
        return frozenset(valued | self.articles | self.point | self.minus)

    def digit(self, token: str) -> str:
        """The digit that a word is by itself: "4" for "four" and "4"; nothing for any other."""
        if token.isdecimal():
            return token if len(token) == 1 else ""
        value = self.units.get(token, 10.0)
        return str(int(value)) if value < 10 else ""


def number_words(closed: ClosedClasses) -> NumberWords:
    """The number words among a language's closed classes."""
    roles: dict[str, set[str]] = {}
    for word, name in closed.table("number_word").items():
        roles.setdefault(name, set()).add(word)

    def role(name: str) -> frozenset[str]:
        return frozenset(roles.pop(name, ()))

    return NumberWords(
        units=_values(closed, "number"),
        multipliers=_values(closed, "multiplier"),
        fractions=_values(closed, "fraction"),
        articles=role("article"),
        joining=role("and"),
        tens_joining=frozenset(closed.table("tens_and")),
        point=role("point"),
        minus=role("minus"),
        range=role("range"),
        of=role("of"),
        inner_zero=role("zero"),
        vague={word: float(value) for value, words in roles.items() for word in words},
    )


def _values(closed: ClosedClasses, name: str) -> dict[str, float]:
    return {word: float(value) for word, value in closed.table(name).items()}

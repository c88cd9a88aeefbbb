"""Sentences sampled from the grammar, each with the act and form it was sampled from.

The rules are those the reader walks and the words those of the lexicon, so a sample says what can be said. Chance comes
from outside, as a function that chooses one of several, which keeps the room pure and a seed reproducible.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from voxml.terms import Form, Quantity, Term, Unit, parse_form
from voxml.vocabulary import Lexicon

from .acts import Function
from .language import language_grammar
from .machine import Refused, Rule, grammar_rules
from .meaning import Meaning

_T = TypeVar("_T")
Chooser = Callable[[Sequence[_T]], _T]

DEPTH_MAX = 9  # rules inside rules; beyond it the shortest way to words is taken
RETRIES_MAX = 6  # of one rule, before the rule above it is tried anew
ATTEMPTS_MAX = 2_000
WORDS_MAX = 12  # in a sentence, about as many as people use
_ROUND_NUMBERS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "twenty", "forty five")


@dataclass(frozen=True, slots=True)
class Sample:
    """A sentence, and what it means by the rules and words that made it."""

    text: str
    function: Function
    form: Form


@dataclass(frozen=True, slots=True)
class _Part:
    """What a symbol was expanded to: words, and their value."""

    words: tuple[str, ...]
    value: Any


class Sampler:
    """Samples the sentences of one lexicon and language, by a chooser such as ``random.Random(7).choice``."""

    def __init__(self, lexicon: Lexicon, choose: Chooser[Any], language: str = "en") -> None:
        self._choose = choose
        self._rules = grammar_rules(language_grammar(language), Meaning(lexicon).action)
        self._words = _terminals(lexicon)
        self._heights = _heights(self._rules)

    def sample(self) -> Sample:
        """One sentence of one act.

        Raises:
            RuntimeError: the grammar makes none, whatever is tried.
        """
        text, (function, form) = self._sampled("act")
        return Sample(text, function, form)

    def instruction(self) -> Sample:
        """One sentence with a verb that asks for one thing. Raises as `sample`."""
        text, form = self._sampled("vp")
        return Sample(text, Function.INSTRUCT, form)

    def _sampled(self, symbol: str) -> tuple[str, Any]:
        for _ in range(ATTEMPTS_MAX):
            part = self._symbol(symbol, 0)
            if part is not None and len(part.words) <= WORDS_MAX:
                return " ".join(part.words), part.value
        raise RuntimeError("the grammar makes no sentence")

    def _symbol(self, symbol: str, depth: int) -> _Part | None:
        if symbol not in self._rules:
            words = self._words.get(symbol)
            return self._choose(words) if words else None
        rules = self._rules[symbol]
        for _ in range(RETRIES_MAX):
            rule = self._choose(rules)
            if depth >= DEPTH_MAX:
                rule = min(rules, key=lambda each: max(map(self._height, each.expansion)))
            part = self._expanded(rule, depth)
            if part is not None:
                return part
        return None

    def _expanded(self, rule: Rule, depth: int) -> _Part | None:
        parts = []
        for symbol in rule.expansion:
            part = self._symbol(symbol, depth + 1)
            if part is None:
                return None
            parts.append(part)
        try:
            value = rule.action(*(part.value for part in parts))
        except Refused:
            return None
        return _Part(tuple(word for part in parts for word in part.words), value)

    def _height(self, symbol: str) -> int:
        return self._heights.get(symbol, 0)


def _heights(rules: dict[str, tuple[Rule, ...]]) -> dict[str, int]:
    """How many rules deep each symbol goes at least."""
    far = len(rules) + 1
    heights = dict.fromkeys(rules, far)
    changed = True
    while changed:
        changed = False
        for symbol, expansions in rules.items():
            height = 1 + min(max(heights.get(each, 0) for each in rule.expansion) for rule in expansions)
            if height < heights[symbol]:
                heights[symbol], changed = height, True
    return heights


# ------------------------------------------------------------------ words
def _terminals(lexicon: Lexicon) -> dict[str, list[_Part]]:
    """Every terminal's words with what they stand for."""
    found: dict[str, list[_Part]] = {}
    for phrase in lexicon.words():
        for sense in lexicon.lookup(phrase):
            found.setdefault(sense.category, []).append(_Part(sense.words, sense.value))
    numbers = _numbers(lexicon)
    amounts = _amounts(lexicon, numbers)
    found["CARDINAL"] = numbers
    # In digits: of two in a row, the words may be one number ("two twenty").
    found["NUMBER"] = [_Part((str(part.value),), part.value) for part in numbers]
    found["QTY"] = amounts
    found["QTY_MORE"] = [_Part(("another", *part.words), Term("more", (part.value,))) for part in amounts]
    found["PREDICATIVE"] = found.get("ADJECTIVE", [])
    return found


def _numbers(lexicon: Lexicon) -> list[_Part]:
    units = {word: float(value) for word, value in lexicon.closed.table("number").items()}
    round_numbers = [text for text in _ROUND_NUMBERS if all(word in units for word in text.split())]
    return [_Part(tuple(text.split()), Quantity(sum(units[w] for w in text.split()))) for text in round_numbers]


def _amounts(lexicon: Lexicon, numbers: list[_Part]) -> list[_Part]:
    """A number with each unit that is one word of more than two letters."""
    found = []
    for word in lexicon.closed.words_of("unit"):
        unit = parse_form(word.text)
        if len(word.words) > 1 or len(word.words[0]) < 3 or not isinstance(unit, Quantity) or unit.unit is Unit.COUNT:
            continue
        for number in numbers:
            value = round(number.value.value * unit.value, 9)
            found.append(_Part((*number.words, *word.words), Quantity(value, unit.unit)))
    return found

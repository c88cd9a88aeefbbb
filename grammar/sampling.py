"""Sentences sampled from the grammar, each with the act and form it was sampled from.

The rules are those the reader walks, the words those of the lexicon, and each stands where its neighbours let it mean
what it was chosen for, so a sample says what can be said. Chance comes from outside, as a function that chooses one of
several, which keeps the room pure and a seed reproducible.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from voxml.terms import Form, Quantity, Term, Unit, parse_form
from voxml.vocabulary import Lexicon

from .acts import Function
from .amounts import AmountReader
from .language import language_grammar
from .lattice import Lattice
from .machine import Edge, Refused
from .meaning import Meaning
from .tables import Rule, grammar_rules
from .tokens import Token
from .word_edges import WordReader

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
    """What a symbol was expanded to: words, their value, and what each of the words was chosen for, in order."""

    words: tuple[str, ...]
    value: Any
    edges: tuple[Edge, ...]


class Sampler:
    """Samples the sentences of one lexicon and language, by a chooser such as ``random.Random(7).choice``."""

    def __init__(self, lexicon: Lexicon, choose: Chooser[Any], language: str = "en") -> None:
        self._choose = choose
        self._rules = grammar_rules(language_grammar(language), Meaning(lexicon).action)
        self._words = _terminals(lexicon)
        self._heights = _heights(self._rules)
        self._word_reader = WordReader(lexicon, AmountReader(lexicon.closed))

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
            if part is not None and len(part.words) <= WORDS_MAX and self._may_be_said(part):
                return " ".join(part.words), part.value
        raise RuntimeError("the grammar makes no sentence")

    def _may_be_said(self, part: _Part) -> bool:
        """Whether each word may be meant so among the others: "twenty" and "two" are not two numbers in a row."""
        lattice = Lattice([Token(word, 0, 0) for word in part.words], self._word_reader)
        at = 0
        for edge in part.edges:
            if edge not in lattice.edges(at):
                return False
            at += edge.length
        return True

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
        words = tuple(word for part in parts for word in part.words)
        return _Part(words, value, tuple(edge for part in parts for edge in part.edges))

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
            found.setdefault(sense.category, []).append(_word(sense.category, sense.words, sense.value))
    numbers = _numbers(lexicon)
    amounts = _amounts(lexicon, numbers)
    found["CARDINAL"] = [_word("CARDINAL", words, value) for words, value in numbers]
    found["NUMBER"] = [_word("NUMBER", (str(value),), value) for _, value in numbers]
    found["QTY"] = [_word("QTY", words, value) for words, value in amounts]
    found["QTY_MORE"] = [_word("QTY_MORE", ("another", *words), Term("more", (value,))) for words, value in amounts]
    found["PREDICATIVE"] = [_word("PREDICATIVE", part.words, part.value) for part in found.get("ADJECTIVE", [])]
    return found


def _word(terminal: str, words: tuple[str, ...], value: Any) -> _Part:
    return _Part(words, value, (Edge(terminal, value, len(words)),))


def _numbers(lexicon: Lexicon) -> list[tuple[tuple[str, ...], Quantity]]:
    units = {word: float(value) for word, value in lexicon.closed.table("number").items()}
    round_numbers = [text.split() for text in _ROUND_NUMBERS if all(word in units for word in text.split())]
    return [(tuple(words), Quantity(sum(units[word] for word in words))) for words in round_numbers]


def _amounts(
    lexicon: Lexicon, numbers: list[tuple[tuple[str, ...], Quantity]]
) -> list[tuple[tuple[str, ...], Quantity]]:
    """A number with each unit that is one word of more than two letters."""
    found = []
    for word in lexicon.closed.words_of("unit"):
        unit = parse_form(word.text)
        if len(word.words) > 1 or len(word.words[0]) < 3 or not isinstance(unit, Quantity) or unit.unit is Unit.COUNT:
            continue
        for words, number in numbers:
            found.append(((*words, *word.words), Quantity(round(number.value * unit.value, 9), unit.unit)))
    return found

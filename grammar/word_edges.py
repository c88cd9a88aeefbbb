"""What a word or phrase may be, by one lexicon: its senses, amounts, names, and what may be passed over."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from voxml.terms import Name, Quantity, Term, Unit
from voxml.vocabulary import Lexicon

from .amounts import AmountReader
from .fixed_phrases import FixedPhrases
from .machine import Edge
from .names import NameReader
from .neighbours import Neighbours
from .tokens import MARKS

DERIVED_TERMINALS = (*("QTY", "QTY_MORE", "NUMBER", "CARDINAL", "PREDICATIVE", "NAME", "NEW_NAME", "NAME_GIVEN"),)
_FIRST_CHOICE = frozenset(
    {"STOPPING", "LIGHT", "WAY", "BEFORE", "ENUM", "PRAISE", "VAGUE", "AXIS", "CLOSER", "AGAIN", "HEADING"}
)
_SECOND_CHOICE = frozenset({"PATH", "NUMBER", "CARDINAL"})
_SIDES = frozenset({"SIDE"})
_DIRECTIONS = frozenset({"AXIS", "SIDE", "HEADING"})
CARDINAL_MAX = 100
HOURS_MAX = 12


@dataclass(frozen=True, slots=True)
class Entry:
    """What begins with a word: edges of the word alone, and of phrases by their second word; the preferred first."""

    alone: tuple[Edge, ...]
    phrases: dict[str, tuple[tuple[tuple[str, ...], Edge], ...]]


_NOTHING = Entry((), {})


class WordReader:
    """Reads words by one lexicon. Everything that does not depend on the neighbours is made once."""

    def __init__(self, lexicon: Lexicon, amounts: AmountReader) -> None:
        self._lexicon = lexicon
        self._amount_reader = amounts
        self._neighbours = Neighbours(lexicon)
        self.names = NameReader(lexicon)
        self._clock = FixedPhrases.of(lexicon.closed, "clock")
        self._replies = frozenset(lexicon.closed.table("reply"))
        self._articles = frozenset(lexicon.closed.table("article"))
        self._entries = self._index()

    def _index(self) -> dict[str, Entry]:
        lexicon = self._lexicon
        skips = [word.words for word in lexicon.closed.words_of("skip")]
        edges = [(sense.words, Edge(sense.category, sense.value, len(sense.words))) for sense in lexicon.all_senses()]
        edges.extend((words, Edge(None, None, len(words))) for words in (*skips, *((mark,) for mark in MARKS)))
        edges.sort(key=lambda pair: _preference(pair[1]))
        alone: dict[str, list[Edge]] = {}
        phrases: dict[str, dict[str, list[tuple[tuple[str, ...], Edge]]]] = {}
        for words, edge in edges:
            alone.setdefault(words[0], [])
            if len(words) == 1:
                alone[words[0]].append(edge)
            else:
                phrases.setdefault(words[0], {}).setdefault(words[1], []).append((words, edge))
        return {
            word: Entry(tuple(own), {second: tuple(each) for second, each in phrases.get(word, {}).items()})
            for word, own in alone.items()
        }

    def is_reply(self, word: str) -> bool:
        """Whether the word can be all of an answer, with something else behind it: "no turn left"."""
        return word in self._replies

    def is_article(self, word: str) -> bool:
        return word in self._articles

    def adds_to(self, texts: Sequence[str], at: int) -> bool:
        """Whether an "and a half" begins here."""
        return self._amount_reader.adds_to(texts, at)

    def edges(self, texts: Sequence[str], at: int) -> tuple[Edge, ...]:
        """Every way to read on from ``at``, the preferred first."""
        word = texts[at]
        if word[0] == '"' and len(word) > 1:
            return (Edge("NAME", Name(word.strip('"').strip()), 1),)
        entry = self._entries.get(word, _NOTHING)
        following = entry.phrases.get(texts[at + 1]) if entry.phrases and at + 1 < len(texts) else None
        found: list[Edge] = []
        if following is not None:
            found = [edge for words, edge in following if tuple(texts[at : at + edge.length]) == words]
        if self._amount_reader.may_start(word):
            found.extend(self._amounts(texts, at))
        if found:
            found.extend(entry.alone)
            found.sort(key=_preference)
        return self._neighbours.agreeing(tuple(found) or entry.alone, texts, at)

    def _amounts(self, texts: Sequence[str], at: int) -> list[Edge]:
        reader = self._amount_reader
        found = []
        amount = reader.amount(texts, at)
        if amount is not None:
            quantity = amount[0].quantity
            terminal = "QTY_MORE" if amount[0].more else "QTY"
            value = Term("more", (quantity,)) if amount[0].more else quantity
            found.append(Edge(terminal, value, amount[1] - at))
        number = reader.numbers.number(texts, at)
        if number is not None:
            found.extend(self._numbers(texts, at, *number))
            if amount is None and at and self._may_be(texts[at - 1], _DIRECTIONS):
                elided = reader.with_unit_before(texts, at)
                if elided is not None and self._goes_on_with(texts, at, elided[0].unit):
                    found.append(Edge("QTY", elided[0], elided[1] - at))
        more = reader.more(texts, at)
        if more is not None:
            found.append(Edge("QTY_MORE", Term("more", (Quantity(more[0]),)), more[1] - at))
        return found

    def _numbers(self, texts: Sequence[str], at: int, number: float, end: int) -> list[Edge]:
        """A number by itself, as an hour of the clock, and as a count."""
        value, length = Quantity(number), end - at
        found = [Edge("NUMBER", value, length)]
        clock = self._clock.length(texts, end)
        if clock and 1 <= number <= HOURS_MAX:
            found.append(Edge("HEADING", Term("clock", (value,)), length + clock))
        if number == int(number) and 1 <= number <= CARDINAL_MAX:
            found.append(Edge("CARDINAL", value, length))
        return found

    def _goes_on_with(self, texts: Sequence[str], at: int, unit: Unit) -> bool:
        """Whether a number behind a direction may have left out the unit before: "(one meter and) back two", but not
        "(forward 3 feet,) right 90", for feet to a side take a side before them too."""
        if unit is Unit.DEGREE or not self._may_be(texts[at - 1], _SIDES):
            return True
        return any(self._may_be(text, _SIDES) for text in texts[: at - 1])

    def _may_be(self, word: str, terminals: frozenset[str]) -> bool:
        return any(edge.terminal in terminals for edge in self._entries.get(word, _NOTHING).alone)


def _preference(edge: Edge) -> tuple[bool, int, int]:
    """Longer phrases first; "down" is a way to go before "down the hallway", "one" a thing before it is a number.

    A light verb leaves its meaning to what follows ("take three steps") before it is a verb itself ("take the box").
    What may be passed over is passed over last.
    """
    choice = 0 if edge.terminal in _FIRST_CHOICE else 2 if edge.terminal in _SECOND_CHOICE else 1
    return edge.terminal is None, -edge.length, choice

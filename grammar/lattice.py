"""The ways to read each word of an utterance: senses of the lexicon, amounts, and what may be passed over."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from voxml.terms import Quantity, Term
from voxml.vocabulary import Lexicon

from .machine import Edge
from .numbers import NumberReader
from .tokens import MARKS, Token

DERIVED_TERMINALS = ("QTY", "QTY_MORE", "NUMBER", "CARDINAL", "PREDICATIVE")
SEPARATORS = frozenset({"AND", "THEN", "BEFORE_THAT", "BUT"})
CLAUSE_OPENERS = frozenset(
    {"VERB", "VERB_ING", "LEAD", "LEAD_ING", "LEAD_TO", "LEAD_PAST", "LIGHT", "IF", "UNTIL", "FORBID"}
)
BOUNDARIES = SEPARATORS | CLAUSE_OPENERS
_SECOND_CHOICE = frozenset({"PATH", "NUMBER", "CARDINAL"})
_CARDINAL_MAX = 100


class Lattice:
    """The edges over the tokens of one utterance, made once where they are asked for."""

    def __init__(self, tokens: Sequence[Token], words: WordReader) -> None:
        self.texts = [token.text for token in tokens]
        self._words = words
        self._edges: list[tuple[Edge, ...] | None] = [None] * len(tokens)
        self._categories: list[frozenset[str] | None] = [None] * len(tokens)

    def edges(self, at: int) -> tuple[Edge, ...]:
        """Every way to read on from ``at``, the preferred first."""
        if at >= len(self.texts):
            return ()
        known = self._edges[at]
        if known is None:
            known = self._edges[at] = self._words.edges(self.texts, at)
        return known

    def categories(self, at: int) -> frozenset[str]:
        """The terminals that the word (or a phrase that begins with it) may be."""
        if at >= len(self.texts):
            return frozenset()
        known = self._categories[at]
        if known is None:
            known = self._categories[at] = frozenset(edge.terminal for edge in self.edges(at) if edge.terminal)
        return known

    def may_end(self, at: int) -> bool:
        """Whether a clause may end before ``at``: at a mark, a connective, where another may begin, behind a first "no"."""
        if at >= len(self.texts) or self.texts[at] in MARKS:
            return True
        if at == 1 and "NO" in self.categories(0):
            return True
        return not self.categories(at).isdisjoint(BOUNDARIES)


class WordReader:
    """What a word or phrase may be, by one lexicon."""

    def __init__(self, lexicon: Lexicon, numbers: NumberReader) -> None:
        self._lexicon = lexicon
        self._numbers = numbers
        self._skips = _by_first(word.words for word in lexicon.closed.words_of("skip"))
        self._copulas = frozenset(lexicon.closed.table("BE"))
        self._names = frozenset(lexicon.closed.table("address"))
        self._refusals = frozenset(lexicon.closed.table("NO"))
        self._clock = frozenset(lexicon.closed.table("clock"))

    def edges(self, texts: Sequence[str], at: int) -> tuple[Edge, ...]:
        """As `Lattice.edges`."""
        word = texts[at]
        found = [*self._amounts(texts, at)] if self._numbers.may_start(word) else []
        for sense in self._lexicon.senses(word):
            end = at + len(sense.words)
            if tuple(texts[at:end]) == sense.words:
                found.append(Edge(sense.category, sense.value, end))
                if sense.category == "ADJECTIVE" and at and texts[at - 1] in self._copulas:
                    found.append(Edge("PREDICATIVE", sense.value, end))
        found.sort(key=_preference)
        opens = at == 0 or texts[at - 1] in MARKS
        if opens and word in self._refusals:
            found = [edge for edge in found if edge.terminal != "DETERMINER"]
        skips = self._skips.get(word, ())
        if opens and word in self._names and at + 1 < len(texts):
            found = [Edge(None, None, at + 1), *found]
        found.extend(Edge(None, None, at + len(skip)) for skip in skips if tuple(texts[at : at + len(skip)]) == skip)
        if word in MARKS:
            found.append(Edge(None, None, at + 1))
        return tuple(found)

    def _amounts(self, texts: Sequence[str], at: int) -> list[Edge]:
        found = []
        amount = self._numbers.amount(texts, at)
        if amount is not None:
            quantity = amount[0].quantity
            terminal = "QTY_MORE" if amount[0].more else "QTY"
            found.append(Edge(terminal, Term("more", (quantity,)) if amount[0].more else quantity, amount[1]))
        number = self._numbers.number(texts, at)
        if number is not None:
            value, end = number
            if end < len(texts) and texts[end] in self._clock and 1 <= value <= 12:
                found.append(Edge("HEADING", Term("clock", (Quantity(value),)), end + 1))
            found.append(Edge("NUMBER", Quantity(value), end))
            if value == int(value) and 1 <= value <= _CARDINAL_MAX:
                found.append(Edge("CARDINAL", Quantity(value), end))
        return found


def _preference(edge: Edge) -> tuple[int, int]:
    """Longer phrases first; "down" is a way to go before it is "down the hallway", "one" a thing before it is a number.

    A light verb leaves its meaning to what follows ("take three steps") before it is a verb of its own ("take the box").
    """
    return -edge.end, 0 if edge.terminal == "LIGHT" else 2 if edge.terminal in _SECOND_CHOICE else 1


def _by_first(phrases: Iterable[tuple[str, ...]]) -> dict[str, tuple[tuple[str, ...], ...]]:
    table: dict[str, list[tuple[str, ...]]] = {}
    for phrase in phrases:
        table.setdefault(phrase[0], []).append(phrase)
    return {first: tuple(sorted(found, key=lambda words: -len(words))) for first, found in table.items()}

"""The ways to read each word of an utterance: senses of the lexicon, amounts, and what may be passed over."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from voxml.terms import Name, Quantity, Term
from voxml.vocabulary import Lexicon

from .machine import Edge
from .numbers import NumberReader
from .tokens import MARKS, Token

DERIVED_TERMINALS = ("QTY", "QTY_MORE", "NUMBER", "CARDINAL", "PREDICATIVE", "NAME")
SEPARATORS = frozenset({"AND", "THEN", "BEFORE_THAT", "BUT"})
CLAUSE_OPENERS = frozenset({"VERB", "LEAD", "LEAD_ING", "LEAD_TO", "LEAD_PAST", "LIGHT", "IF", "UNTIL", "FORBID"})
BOUNDARIES = SEPARATORS | CLAUSE_OPENERS
_FIRST_CHOICE = frozenset({"STOPPING", "LIGHT", "WAY", "BEFORE", "ENUM", "PRAISE"})
_SECOND_CHOICE = frozenset({"PATH", "NUMBER", "CARDINAL"})
CARDINAL_MAX = 100
HOURS_MAX = 12


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
            known = self._words.edges(self.texts, at)
            if self.texts[at] in MARKS and (at in self._repeats(0) or self._repeats(at + 1)):
                known = tuple(edge for edge in known if edge.terminal is not None)
            self._edges[at] = known
        return known

    def _repeats(self, at: int) -> frozenset[int]:
        """Where a "twice" or "three times" ends that begins here: a mark beside it sets it off from a single clause."""
        if at >= len(self.texts) or self.texts[at] in MARKS:
            return frozenset()
        ends = {at + edge.length for edge in self.edges(at) if edge.terminal == "REPEAT"}
        for number in self.edges(at):
            if number.terminal == "NUMBER":
                after = at + number.length
                times = () if after < len(self.texts) and self.texts[after] in MARKS else self.edges(after)
                ends.update(after + edge.length for edge in times if edge.terminal == "TIMES")
        return frozenset(ends)

    def categories(self, at: int) -> frozenset[str]:
        """The terminals that the word (or a phrase that begins with it) may be."""
        if at >= len(self.texts):
            return frozenset()
        known = self._categories[at]
        if known is None:
            known = self._categories[at] = frozenset(edge.terminal for edge in self.edges(at) if edge.terminal)
        return known

    def may_end(self, at: int) -> bool:
        """Whether a clause may end before ``at``: at a mark, a connective, another's beginning, behind a first "no"."""
        if at >= len(self.texts) or self.texts[at] in MARKS:
            return True
        if at == 1 and "NO" in self.categories(0):
            return True
        return not self.categories(at).isdisjoint(BOUNDARIES)


@dataclass(frozen=True, slots=True)
class Entry:
    """What begins with a word: edges of the word alone, and of phrases by their second word; the preferred first."""

    alone: tuple[Edge, ...]
    phrases: dict[str, tuple[tuple[tuple[str, ...], Edge], ...]]


_NOTHING = Entry((), {})


class WordReader:
    """What a word or phrase may be, by one lexicon. Everything that does not depend on the neighbours is made once."""

    def __init__(self, lexicon: Lexicon, numbers: NumberReader) -> None:
        self._lexicon = lexicon
        self._numbers = numbers
        self._skips = [word.words for word in lexicon.closed.words_of("skip")]
        self._copulas = frozenset(lexicon.closed.table("BE"))
        self._enumerators = frozenset(lexicon.closed.table("enumerator"))
        self._verbs = frozenset(word for word in lexicon.words() if _is_verb(lexicon, word))
        self._determiners = frozenset(
            word for word in lexicon.words() if any(sense.category == "DETERMINER" for sense in lexicon.lookup(word))
        )
        self._names = frozenset(lexicon.closed.table("address"))
        self._refusals = frozenset(lexicon.closed.table("NO"))
        self._clock = frozenset(lexicon.closed.table("clock"))
        self._entries = self._index()

    def _index(self) -> dict[str, Entry]:
        edges = [
            (sense.words, Edge(sense.category, sense.value, len(sense.words))) for sense in self._lexicon.all_senses()
        ]
        edges.extend((words, Edge(None, None, len(words))) for words in (*self._skips, *((mark,) for mark in MARKS)))
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

    def edges(self, texts: Sequence[str], at: int) -> tuple[Edge, ...]:
        """As `Lattice.edges`."""
        word = texts[at]
        if word[0] == '"' and len(word) > 1:
            return (Edge("NAME", Name(word.strip('"').strip()), 1),)
        entry = self._entries.get(word, _NOTHING)
        following = entry.phrases.get(texts[at + 1]) if entry.phrases and at + 1 < len(texts) else None
        found: list[Edge] = []
        if following is not None:
            found = [edge for words, edge in following if tuple(texts[at : at + edge.length]) == words]
        if self._numbers.may_start(word):
            found.extend(self._amounts(texts, at))
        if found:
            found.extend(entry.alone)
            found.sort(key=_preference)
        return self._by_neighbours(tuple(found) or entry.alone, texts, at)

    def _by_neighbours(self, found: tuple[Edge, ...], texts: Sequence[str], at: int) -> tuple[Edge, ...]:
        """What the words before say: "no" first is an answer, "robot" first is spoken to, "is red" needs no noun."""
        word, before = texts[at], texts[at - 1] if at else ","
        if before in MARKS:
            if word in self._refusals:
                return tuple(edge for edge in found if edge.terminal != "DETERMINER")
            if word in self._enumerators and at + 1 < len(texts) and texts[at + 1] in self._verbs:
                return (Edge(None, None, 1),)
            if word in self._names and at + 1 < len(texts):
                return (Edge(None, None, 1), *found)
            return found
        qualities = [edge for edge in found if edge.terminal == "ADJECTIVE"]
        if not qualities:
            return found
        if at + 1 < len(texts) and texts[at + 1] in self._determiners:  # "near the door" is where, not what it is like
            found = tuple(edge for edge in found if edge.terminal != "ADJECTIVE" or edge.length > 1)
        asserted = before in self._copulas
        predicative = (edge for edge in qualities if asserted or _ends(texts, at + edge.length))
        return (*found, *(Edge("PREDICATIVE", edge.value, edge.length) for edge in predicative))

    def _amounts(self, texts: Sequence[str], at: int) -> list[Edge]:
        found = []
        amount = self._numbers.amount(texts, at)
        if amount is not None:
            quantity = amount[0].quantity
            terminal = "QTY_MORE" if amount[0].more else "QTY"
            value = Term("more", (quantity,)) if amount[0].more else quantity
            found.append(Edge(terminal, value, amount[1] - at))
        number = self._numbers.number(texts, at)
        if number is not None:
            value, length = Quantity(number[0]), number[1] - at
            if number[1] < len(texts) and texts[number[1]] in self._clock and 1 <= number[0] <= HOURS_MAX:
                found.append(Edge("HEADING", Term("clock", (value,)), length + 1))
            found.append(Edge("NUMBER", value, length))
        more = self._numbers.more(texts, at)
        if more is not None:
            found.append(Edge("QTY_MORE", Term("more", (Quantity(more[0]),)), more[1] - at))
        if number is not None and number[0] == int(number[0]) and 1 <= number[0] <= CARDINAL_MAX:
            found.append(Edge("CARDINAL", Quantity(number[0]), number[1] - at))
        return found


def _is_verb(lexicon: Lexicon, word: str) -> bool:
    """Whether a word is a verb and no name of a thing."""
    categories = {sense.category for sense in lexicon.lookup(word)}
    return "VERB" in categories and "NOUN" not in categories


def _ends(texts: Sequence[str], at: int) -> bool:
    return at >= len(texts) or texts[at] in MARKS


def _preference(edge: Edge) -> tuple[bool, int, int]:
    """Longer phrases first; "down" is a way to go before "down the hallway", "one" a thing before it is a number.

    A light verb leaves its meaning to what follows ("take three steps") before it is a verb itself ("take the box").
    What may be passed over is passed over last.
    """
    choice = 0 if edge.terminal in _FIRST_CHOICE else 2 if edge.terminal in _SECOND_CHOICE else 1
    return edge.terminal is None, -edge.length, choice

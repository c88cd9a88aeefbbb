"""What the words around a word say about how it is to be read."""

from __future__ import annotations

from collections.abc import Sequence

from voxml.vocabulary import Lexicon

from .machine import Edge
from .tokens import MARKS

_WITHOUT_OF = frozenset({"AXIS", "SIDE", "HEADING", "WHAT_ASK"})
_QUALITIES = frozenset({"ADJECTIVE", "ORDINAL", "SIDE_ADJ"})
_NAMES_OF_THINGS = frozenset({"NOUN", "NOUNS"})
_REFUSALS = frozenset({"NO", "NO_NO"})
_COMPARED = frozenset({"ADJECTIVE", "ORDINAL"})
_COUNTS = frozenset({"NUMBER", "CARDINAL", "QTY"})
_PASSED_OVER = Edge(None, None, 1)


class Neighbours:
    """Chooses among the readings of words, by one lexicon."""

    def __init__(self, lexicon: Lexicon) -> None:
        closed = lexicon.closed
        self._copulas = frozenset(closed.table("BE"))
        self._negations = frozenset(closed.table("negation"))
        self._refusing = frozenset(word.words[0] for name in _REFUSALS for word in closed.words_of(name))
        self._of = frozenset(closed.table("OF"))
        self._addresses = frozenset(closed.table("address"))
        self._refusals = frozenset(closed.table("NO"))
        self._openers = frozenset(closed.table("opener"))
        self._enumerators = frozenset(closed.table("enumerator"))
        self._intensifiers = frozenset(closed.table("intensifier"))
        self._benefactives = frozenset(closed.table("benefactive"))
        senses = lexicon.single_words()
        categories = {word: {sense.category for sense in found} for word, found in senses.items()}
        self._determiners = _in(categories, {"DETERMINER"})
        self._nouns = _in(categories, {"NOUN", "NOUNS"})
        self._verbs = _in(categories, {"VERB"}) - self._nouns
        self._to_do = _in(categories, {"VERB", "LIGHT"})
        self._clauses = self._verbs | _in(categories, {"LIGHT"}) | self._addresses
        self._ways = _in(categories, {"AXIS", "SIDE", "HEADING", "PLACE", "PATH"}) - self._nouns
        self._before_nouns = _in(categories, {"DETERMINER", "SIDE_ADJ", "ADJECTIVE", "ORDINAL"})
        self._backing = _in(categories, {"AXIS"}) & _in(categories, {"VERB"})
        self._ends_and_ways = _in(categories, {"AXIS"}) & self._nouns
        self._ones = _in(categories, {"ONE"})
        self._nouns |= self._ones
        self._sides = _in(categories, {"SIDE_ADJ"})
        self._before_robots = _in(categories, {"DETERMINER", "ADJECTIVE", "ORDINAL", "VERB", "PATH", "LOC", "BE"})
        self._before_robots -= self._sides
        self._places = frozenset(sense.words[0] for sense in lexicon.all_senses() if sense.category == "LOC")
        self._places -= self._determiners | self._ways | self._of
        adjectives = {sense.words[0] for sense in lexicon.all_senses() if sense.category == "ADJECTIVE"}
        openers = (
            self._addresses | self._refusals | self._openers | self._intensifiers | self._ones | self._ends_and_ways
        )
        self._delicate = self._enumerators | self._benefactives | self._determiners | openers | adjectives

    def agreeing(self, found: tuple[Edge, ...], texts: Sequence[str], at: int) -> tuple[Edge, ...]:
        """Those of the edges that agree with the words around, and what these add."""
        if texts[at] in self._refusing:
            found = tuple(edge for edge in found if not self._forbids(edge, texts, at))
        if texts[at] not in self._delicate and self._of.isdisjoint(texts):
            return found
        if not at or texts[at - 1] in MARKS:
            return self._opening(found, texts, at)
        word, before = texts[at], texts[at - 1]
        after = texts[at + 1] if at + 1 < len(texts) else ""
        if word in self._enumerators and before in self._verbs and after in self._ways:
            return (_PASSED_OVER,)  # "go first there, then there"
        if word in self._benefactives and before in self._to_do and after in self._determiners:
            return (_PASSED_OVER, *found)  # "find me a chair"
        if word in self._addresses and not after and before not in self._before_robots:
            return (_PASSED_OVER, *found)  # "face north, robot"
        if word in self._intensifiers and before in self._nouns and after in self._places:
            return (_PASSED_OVER, *found)  # "the box right behind you"
        if word in self._ones and before in self._sides:
            found = tuple(edge for edge in found if edge.length > 1 or edge.terminal not in _COUNTS)  # "the left one"
        if word in self._determiners and before in self._nouns:  # "exit the building" is no building
            found = tuple(edge for edge in found if edge.terminal is not None)
        return self._qualities(self._before_of(self._ways_first(found, texts, at), texts, at), texts, at)

    def _forbids(self, edge: Edge, texts: Sequence[str], at: int) -> bool:
        """Whether a "no, do not" goes on with what not to do: that is no answer."""
        end = at + edge.length
        return edge.terminal in _REFUSALS and texts[end - 1] in self._negations and not _ends(texts, end)

    def _opening(self, found: tuple[Edge, ...], texts: Sequence[str], at: int) -> tuple[Edge, ...]:
        """At the beginning: "no" is an answer, "robot" is spoken to, "first" counts, "right" opens."""
        word = texts[at]
        after = texts[at + 1] if at + 1 < len(texts) else ""
        if word in self._refusals:
            wrong = "NO" if after in self._ones else "DETERMINER"  # "no one" is nobody
            return tuple(edge for edge in found if edge.terminal != wrong or edge.length > 1)
        if word in self._enumerators and after in self._verbs:
            return (_PASSED_OVER,)
        if word in self._backing:  # "back out of the room" is to do, not where
            found = tuple(edge for edge in found if edge.terminal != "PATH")
        if word in self._addresses and (after or at):
            return (_PASSED_OVER, *found) if after else (_PASSED_OVER,)
        if word in self._openers and after in MARKS and at + 2 < len(texts) and texts[at + 2] in self._clauses:
            return (_PASSED_OVER, *found)
        return self._qualities(self._before_of(self._ways_first(found, texts, at), texts, at), texts, at)

    def _ways_first(self, found: tuple[Edge, ...], texts: Sequence[str], at: int) -> tuple[Edge, ...]:
        """ "and back" is a way; the back of something has its article, or its "of"."""
        if texts[at] not in self._ends_and_ways or _follows(texts, at + 1, self._of):
            return found
        if at and texts[at - 1] in self._before_nouns:
            return found
        return tuple(edge for edge in found if edge.length > 1 or edge.terminal != "NOUN")

    def _before_of(self, found: tuple[Edge, ...], texts: Sequence[str], at: int) -> tuple[Edge, ...]:
        """ "The middle of", "to the back of": before "of" stands a thing, not a quality nor a direction."""
        is_noun = any(edge.terminal in _NAMES_OF_THINGS for edge in found)
        return tuple(
            edge
            for edge in found
            if not _follows(texts, at + edge.length, self._of)
            or not ((is_noun and edge.terminal in _QUALITIES) or (edge.length > 1 and edge.terminal in _WITHOUT_OF))
        )

    def _qualities(self, found: tuple[Edge, ...], texts: Sequence[str], at: int) -> tuple[Edge, ...]:
        """A quality needs its noun, unless it is said of something ("is red") or alone in its clause ("the red")."""
        qualities = [edge for edge in found if edge.terminal == "ADJECTIVE"]
        if not qualities:
            return found
        if _follows(texts, at + 1, self._determiners):  # "near the door" is where, not what it is like
            found = tuple(edge for edge in found if edge.terminal not in _COMPARED or edge.length > 1)
        asserted = at > 0 and texts[at - 1] in self._copulas
        predicative = (edge for edge in qualities if asserted or _ends(texts, at + edge.length))
        return (*found, *(Edge("PREDICATIVE", edge.value, edge.length) for edge in predicative))


def _in(categories: dict[str, set[str]], wanted: set[str]) -> frozenset[str]:
    """The words that may be of one of the categories."""
    return frozenset(word for word, found in categories.items() if not found.isdisjoint(wanted))


def _follows(texts: Sequence[str], at: int, words: frozenset[str]) -> bool:
    return at < len(texts) and texts[at] in words


def _ends(texts: Sequence[str], at: int) -> bool:
    return at >= len(texts) or texts[at] in MARKS

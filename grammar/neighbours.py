"""What the words around a word say about how it is to be read."""

from __future__ import annotations

from collections.abc import Sequence

from voxml.vocabulary import Lexicon

from .machine import Edge
from .tokens import MARKS
from .word_sets import word_sets

Edges = tuple[Edge, ...]
Texts = Sequence[str]

_WITHOUT_OF = frozenset({"AXIS", "SIDE", "HEADING", "WHAT_ASK"})
_QUALITIES = frozenset({"ADJECTIVE", "ORDINAL", "SIDE_ADJ"})
_NAMES_OF_THINGS = frozenset({"NOUN", "NOUNS"})
_REFUSALS = frozenset({"NO", "NO_NO"})
_COMPARED = frozenset({"ADJECTIVE", "ORDINAL"})
_COUNTS = frozenset({"NUMBER", "CARDINAL", "QTY"})
PHRASE_MAX = 8  # words
_PASSED_OVER = Edge(None, None, 1)


class Neighbours:
    """Chooses among the readings of words, by one lexicon."""

    def __init__(self, lexicon: Lexicon) -> None:
        words = self._words = word_sets(lexicon)
        self._openers = words.verbs | words.to_do - words.nouns | words.addresses
        self._delicate = (
            words.enumerators | words.benefactives | words.determiners | words.adjectives | words.addresses
        ) | (words.refusals | words.openers | words.intensifiers | words.ones | words.way_nouns)

    def agreeing(self, found: Edges, texts: Texts, at: int) -> Edges:
        """Those of the edges that agree with the words around, and what these add."""
        word = texts[at]
        if word in self._words.refusal_starts:
            found = tuple(edge for edge in found if not self._forbids(edge, texts, at))
        if word not in self._delicate and self._words.of.isdisjoint(texts[at + 1 : at + PHRASE_MAX]):
            return found
        if not at or texts[at - 1] in MARKS:
            return self._at_beginning(found, texts, at)
        return self._behind(texts[at - 1], found, texts, at)

    def _forbids(self, edge: Edge, texts: Texts, at: int) -> bool:
        """Whether a "no, do not" goes on with what not to do: that is no answer."""
        end = at + edge.length
        return edge.terminal in _REFUSALS and texts[end - 1] in self._words.negations and not _ends(texts, end)

    def _at_beginning(self, found: Edges, texts: Texts, at: int) -> Edges:
        """ "no" is an answer, "robot" is spoken to, "first" counts, "right" opens, "back" is to do."""
        words, word, after = self._words, texts[at], _word(texts, at + 1)
        if word in words.refusals:
            wrong = "NO" if after in words.ones else "DETERMINER"  # "no one" is nobody
            return tuple(edge for edge in found if edge.terminal != wrong or edge.length > 1)
        if word in words.enumerators and after in words.verbs:
            return (_PASSED_OVER,)
        if word in words.addresses and (after or at):
            return (_PASSED_OVER, *found) if after else (_PASSED_OVER,)
        if word in words.openers and after in MARKS and _word(texts, at + 2) in self._openers:
            return (_PASSED_OVER, *found)
        if word in words.way_verbs:  # "back out of the room"
            found = tuple(edge for edge in found if edge.terminal != "PATH")
        return self._nominal(found, texts, at)

    def _behind(self, before: str, found: Edges, texts: Texts, at: int) -> Edges:
        """What may be passed over behind another word, and what may not be."""
        words, word, after = self._words, texts[at], _word(texts, at + 1)
        if word in words.enumerators and before in words.verbs and after in words.ways:
            return (_PASSED_OVER,)  # "go first there, then there"
        if word in words.benefactives and before in words.to_do and after in words.determiners:
            return (_PASSED_OVER, *found)  # "find me a chair"
        if word in words.addresses and not after and before not in words.before_robots:
            return (_PASSED_OVER, *found)  # "face north, robot"
        if word in words.addresses and before in words.determiners - words.refusals:  # who is told of is not spoken to
            found = tuple(edge for edge in found if edge.terminal is not None)
        if word in words.intensifiers and before in words.nouns and after in words.places:
            return (_PASSED_OVER, *found)  # "the box right behind you"
        if word in words.ones and before in words.sides:
            found = tuple(edge for edge in found if edge.length > 1 or edge.terminal not in _COUNTS)  # "the left one"
        if word in words.determiners and before in words.nouns:  # "exit the building" is no building
            found = tuple(edge for edge in found if edge.terminal is not None)
        return self._nominal(found, texts, at)

    def _nominal(self, found: Edges, texts: Texts, at: int) -> Edges:
        return self._qualities(self._before_of(self._ways_first(found, texts, at), texts, at), texts, at)

    def _ways_first(self, found: Edges, texts: Texts, at: int) -> Edges:
        """ "and back" is a way; the back of something has its article, or its "of"."""
        words = self._words
        if texts[at] not in words.way_nouns or _word(texts, at + 1) in words.of:
            return found
        if at and texts[at - 1] in words.before_nouns:
            return found
        return tuple(edge for edge in found if edge.length > 1 or edge.terminal != "NOUN")

    def _before_of(self, found: Edges, texts: Texts, at: int) -> Edges:
        """ "The middle of", "to the back of": before "of" stands a thing, not a quality nor a direction."""
        is_noun = any(edge.terminal in _NAMES_OF_THINGS for edge in found)
        return tuple(
            edge
            for edge in found
            if _word(texts, at + edge.length) not in self._words.of
            or not ((is_noun and edge.terminal in _QUALITIES) or (edge.length > 1 and edge.terminal in _WITHOUT_OF))
        )

    def _qualities(self, found: Edges, texts: Texts, at: int) -> Edges:
        """A quality needs its noun, unless it is said of something ("is red") or alone in its clause ("the red")."""
        qualities = [edge for edge in found if edge.terminal == "ADJECTIVE"]
        if not qualities:
            return found
        if _word(texts, at + 1) in self._words.determiners:  # "near the door" is where, not what it is like
            found = tuple(edge for edge in found if edge.terminal not in _COMPARED or edge.length > 1)
        asserted = at > 0 and texts[at - 1] in self._words.copulas
        predicative = (edge for edge in qualities if asserted or _ends(texts, at + edge.length))
        return (*found, *(Edge("PREDICATIVE", edge.value, edge.length) for edge in predicative))


def _word(texts: Texts, at: int) -> str:
    return texts[at] if at < len(texts) else ""


def _ends(texts: Texts, at: int) -> bool:
    return at >= len(texts) or texts[at] in MARKS

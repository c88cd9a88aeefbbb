"""The ways to read each word of an utterance, made once where they are asked for; and where a clause may end."""

from __future__ import annotations

from collections.abc import Sequence

from .machine import Edge
from .tokens import FULL_STOPS, MARKS, Token
from .word_edges import WordReader

SEPARATORS = frozenset({"AND", "THEN", "BEFORE_THAT", "BUT"})
CLAUSE_OPENERS = frozenset(
    {"VERB", "LEAD", "LEAD_ING", "LEAD_TO", "LEAD_PAST", "LIGHT", "IF", "UNTIL", "FORBID", "DO_THAT"}
)
BOUNDARIES = SEPARATORS | CLAUSE_OPENERS | {"THANK", "ABOUT"}
_REPLIES = frozenset({"YES", "NO", "ACK"})


class Lattice:
    """The edges over the tokens of one utterance."""

    def __init__(self, tokens: Sequence[Token], words: WordReader) -> None:
        self.texts = [token.text for token in tokens]
        self._tokens = tokens
        self._words = words
        self._may_name = words.names.may_name(self.texts)
        self._edges: list[tuple[Edge, ...] | None] = [None] * len(tokens)
        self._categories: list[frozenset[str] | None] = [None] * len(tokens)

    def edges(self, at: int) -> tuple[Edge, ...]:
        """Every way to read on from ``at``, the preferred first."""
        if at >= len(self.texts):
            return ()
        known = self._edges[at]
        if known is None:
            known = self._words.edges(self.texts, at)
            if self.texts[at] in MARKS and self._sets_apart(at):
                known = tuple(edge for edge in known if edge.terminal is not None)
            if self._may_name:
                known = (*known, *self._words.names.edges(self._tokens, at))
            self._edges[at] = known
        return known

    def _sets_apart(self, at: int) -> bool:
        """Whether the mark at ``at`` ends a clause: a full stop before a verb, any beside "twice" or "three times"."""
        if self.texts[at] in FULL_STOPS and "VERB" in self.categories(at + 1):
            return True
        return at in self._repeats(0) or bool(self._repeats(at + 1))

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

    def is_reply(self, at: int) -> bool:
        """Whether the word can be all of an answer, with something else behind it: "no turn left"."""
        return self._words.is_reply(self.texts[at])

    def may_end(self, at: int) -> bool:
        """Whether a clause may end before ``at``: at a mark, a connective, another's beginning, behind a reply."""
        if at >= len(self.texts) or self.texts[at] in MARKS:
            return True
        if at == 1 and self._words.is_reply(self.texts[0]):
            return True
        if self.categories(at).isdisjoint(BOUNDARIES):
            return at > 0 and not self.categories(at).isdisjoint(_REPLIES) and self._words.is_reply(self.texts[at - 1])
        return not self._holds_together(at)

    def _holds_together(self, at: int) -> bool:
        """Whether the words before and at ``at`` are one phrase: "the turn", "right hand", "(a second) and a half"."""
        if not at:
            return False
        if self.categories(at) & SEPARATORS:
            return self._words.adds_to(self.texts, at)
        if self._words.is_article(self.texts[at - 1]):
            return True
        return any(edge.length > 1 and edge.terminal == "SIDE_ADJ" for edge in self.edges(at - 1))

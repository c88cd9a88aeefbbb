"""Why an utterance means what it means: its tokens, and the rules and words by which each clause was read."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from voxml.vocabulary import Lexicon

from .acts import DialogueAct, NotUnderstood
from .machine import Edge, Machine, Trace
from .meaning import Meaning
from .reader import Reader, tables_of
from .tables import Action
from .tokens import Token


@dataclass(frozen=True, slots=True)
class Node:
    """A rule with its parts, or a word (or several) with the category it was taken in."""

    label: str
    words: str
    value: Any
    parts: tuple[Node, ...] = ()

    def leaves(self) -> Iterator[Node]:
        """The words in order, without those that were passed over."""
        if not self.parts:
            yield self
        for part in self.parts:
            yield from part.leaves()


@dataclass(frozen=True, slots=True)
class Explanation:
    """The tokens that were read (hesitations and what was taken back are gone), the acts, and a tree for each."""

    tokens: tuple[Token, ...]
    outcome: tuple[DialogueAct, ...] | NotUnderstood
    trees: tuple[Node, ...]


class Explainer:
    """Reads again what a reader has read, keeping the derivation."""

    def __init__(self, reader: Reader, lexicon: Lexicon, language: str = "en") -> None:
        self._reader = reader
        self._machine = Machine(tables_of(lexicon, language, _keeping(Meaning(lexicon))))

    def explain(self, text: str) -> Explanation:
        """The derivation of every act; without acts there are tokens alone."""
        tokens, outcome = self._reader.tokens(text), self._reader.read(text)
        if isinstance(outcome, NotUnderstood):
            return Explanation(tokens, outcome, ())
        trees = (self._tree(tokens, act) for act in outcome)
        return Explanation(tokens, outcome, tuple(tree for tree in trees if tree is not None))

    def _tree(self, tokens: tuple[Token, ...], act: DialogueAct) -> Node | None:
        clause = tuple(token for token in tokens if act.span[0] <= token.start and token.end <= act.span[1])
        lattice = self._reader.lattice(clause)

        def edges(at: int) -> tuple[Edge, ...]:
            return tuple(_worded(edge, lattice.texts[at : at + edge.length]) for edge in lattice.edges(at))

        readings = self._machine.readings(0, edges, lattice.may_end, Trace())
        return next((tree for tree, end in readings if end == len(clause) and tree.value[1] == act.form), None)


def _keeping(meaning: Meaning) -> Any:
    """The actions of a language, on nodes."""

    def actions(rule: str) -> Action | None:
        action = meaning.action(rule)
        if action is None:
            return None

        def keep(*parts: Node) -> Node:
            value = action(*(part.value for part in parts))
            return Node(rule, " ".join(part.words for part in parts), value, parts)

        return keep

    return actions


def _worded(edge: Edge, words: list[str]) -> Edge:
    if edge.terminal is None:
        return edge
    return Edge(edge.terminal, Node(edge.terminal, " ".join(words), edge.value), edge.length)

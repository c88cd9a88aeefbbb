"""The LALR automaton, run over a lattice of tokens: Lark builds the tables, this module walks them.

A word of several categories is offered to the automaton as each in turn, in order of preference; the state decides
which of them may stand there (a contextual lexer), and where a choice fails later the next one is tried. Where the
state could both shift and reduce, it shifts; a thorough walk tries to reduce as well, as a generalized LR parser does
(Tomita 1985, Efficient Parsing for Natural Language). The stack is a linked list, so that going back costs nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import count
from typing import Any

from .tables import END, Tables

STATES_MAX = 20
STEPS_MAX = 1_000  # people need fewer than a hundred, forty clauses a few hundred


class Refused(Exception):  # noqa: N818 - a reading that does not hold, with the reason; not an error of the program
    """Raised by an action: the words stand rightly but do not make sense together; ``str()`` says why."""


@dataclass(frozen=True, slots=True)
class Edge:
    """One way to read the next ``length`` tokens: as ``terminal`` with ``value``.

    Without a terminal the tokens are passed over.
    """

    terminal: str | None
    value: Any
    length: int


@dataclass(slots=True)
class Trace:
    """How far the automaton came and what it expected there; why readings were refused."""

    furthest: int = 0
    states: tuple[int, ...] = ()  # by which it came there
    refusals: list[tuple[int, str]] | None = None
    steps: int = 0

    def refuse(self, at: int, reason: str) -> None:
        if self.refusals is None:
            self.refusals = []
        self.refusals.append((at, reason))


Node = tuple[int, Any, Any]  # state, value, the node below


class Machine:
    """Runs the tables over a lattice. ``edges(i)`` gives the ways to read on from position i, the preferred first.

    A thorough one also reduces where it could shift: it reads all that the rules allow.
    """

    def __init__(self, tables: Tables, thorough: bool = False) -> None:
        self._tables = tables
        self._thorough = thorough

    def readings(
        self, start: int, edges: Callable[[int], Sequence[Edge]], may_end: Callable[[int], bool], trace: Trace
    ) -> Iterator[tuple[Any, int]]:
        """Every sentence that begins at ``start``, with its end; the longest of the preferred reading first."""
        pending: list[tuple[Node, int, int]] = [((self._tables.start, None, None), start, 0)]
        while pending and trace.steps <= STEPS_MAX:
            node, at = self._advance(*pending.pop(), pending, edges, may_end, trace)
            if at > start and may_end(at):
                ended = self._shift(node, END, None, at, trace)
                if ended is not None:
                    yield ended[2][1], at

    def _advance(
        self,
        node: Node,
        at: int,
        choice: int,
        pending: list[tuple[Node, int, int]],
        edges: Callable[[int], Sequence[Edge]],
        may_end: Callable[[int], bool],
        trace: Trace,
    ) -> tuple[Node, int]:
        """Go on by the first choices that hold, as far as they lead; the other choices are left in ``pending``."""
        options = edges(at)
        while choice < len(options) and trace.steps <= STEPS_MAX:
            edge = options[choice]
            choice += 1
            following = node if edge.terminal is None else self._shift(node, edge.terminal, edge.value, at, trace)
            if following is None:
                continue
            trace.steps += 1
            if choice < len(options) or may_end(at):
                pending.append((node, at, choice))
            if self._thorough and edge.terminal is not None:
                pending.extend((other, at + edge.length, 0) for other in self._other_shifts(node, edge, at, trace))
            node, at, choice, options = following, at + edge.length, 0, edges(at + edge.length)
            if edge.terminal is not None and at >= trace.furthest:
                trace.states = (node[0],) if at > trace.furthest else (*trace.states, node[0])[:STATES_MAX]
                trace.furthest = at
        return node, at

    def _other_shifts(self, node: Node, edge: Edge, at: int, trace: Trace) -> Iterator[Node]:
        """What comes of reducing where the terminal could have been shifted."""
        assert edge.terminal is not None
        for passed in count(1):
            other = self._shift(node, edge.terminal, edge.value, at, trace, passed)
            if other is None:
                return
            yield other

    def _shift(self, node: Node, terminal: str, value: Any, at: int, trace: Trace, passed: int = 0) -> Node | None:
        """Reduce as the lookahead demands, then shift, passing over the first ``passed`` states that could.

        None where the state does not accept the terminal or an action refuses.
        """
        tables = self._tables
        shifts, reductions, gotos = tables.shifts, tables.reductions, tables.gotos
        while True:
            state = node[0]
            if terminal == END and state == tables.accept:
                return (state, value, node)
            target = shifts[state].get(terminal)
            if target is not None:
                if not passed:
                    return (target, value, node)
                passed -= 1
            reduction = reductions[state].get(terminal)
            if reduction is None:
                return None
            size = reduction.size
            if size == 1:
                arguments = (node[1],)
                node = node[2]
            else:
                values = []
                for _ in range(size):
                    values.append(node[1])
                    node = node[2]
                values.reverse()
                arguments = tuple(values)
            try:
                made = reduction.action(*arguments)
            except Refused as refusal:
                trace.refuse(at, str(refusal))
                return None
            node = (gotos[node[0]][reduction.origin], made, node)

"""The search through one utterance: clause by clause, each the longest the grammar can make of what follows."""

from __future__ import annotations

from dataclasses import replace

from voxml.terms import Form, Quantity, Term

from .acts import Function
from .clauses import Clause, Clauses
from .lattice import SEPARATORS, Lattice
from .machine import Machine, Trace
from .tokens import MARKS

READINGS_MAX = 12
CLAUSES_MAX = 150
_STATING = frozenset({Function.QUESTION, Function.INFORM})


class Search:
    """What can be made of the tokens from each position on, found once. ``leading`` are fragments that may stand before
    an instruction without a break, such as "left".
    """

    def __init__(self, lattice: Lattice, machine: Machine, leading: frozenset[Form]) -> None:
        self.trace = Trace()
        self._steps = 0
        self._depth = 0
        self._count = len(lattice.texts)
        self._lattice = lattice
        self._machine = machine
        self._leading = leading
        self._known: dict[int, Clauses | None] = {}

    def clauses(self, at: int = 0) -> Clauses | None:
        """The clauses from ``at`` to the end; None where the rest cannot be read."""
        start, before = self._past_connectives(at)
        if start >= self._count:
            return ()
        found = self._from(start)
        if found is None and start > at:
            found, before = self._from(at), False  # "next or last" is an ordinal after all
        return found if found is None or not before else (replace(found[0], before=before), *found[1:])

    def _from(self, start: int) -> Clauses | None:
        if start not in self._known:
            self._known[start] = self._read_from(start)
        return self._known[start]

    def _read_from(self, start: int) -> Clauses | None:
        if self._depth >= CLAUSES_MAX:
            return None
        self._depth += 1
        trace = Trace(furthest=start, steps=self._steps)
        found = None
        for count, ((function, form), end) in enumerate(
            self._machine.readings(start, self._lattice.edges, self._lattice.may_end, trace)
        ):
            self._steps = trace.steps
            clause = Clause(function, form, start, end)
            rest = self.clauses(end)
            trace.steps = self._steps
            if rest is not None and (not rest or self._may_precede(clause, rest[0])):
                found = (clause, *rest)
                break
            if count >= READINGS_MAX:
                break
        self._depth -= 1
        self._steps = max(self._steps, trace.steps)
        if trace.furthest > self.trace.furthest:
            self.trace = trace
        return found

    def _may_precede(self, clause: Clause, following: Clause) -> bool:
        """Whether another clause may follow this one: where nothing sets them apart, only behind what is to be done."""
        if self._lends_condition(clause, following) or self._reaches_over(clause, following):
            return False
        if following.start > clause.end:
            return True
        if clause.function is Function.FRAGMENT:
            return isinstance(clause.form, Quantity) or clause.form in self._leading
        if clause.function is Function.DENY:
            return self._lattice.is_reply(clause.start)
        return clause.function not in _STATING

    def _reaches_over(self, clause: Clause, following: Clause) -> bool:
        """Whether what is denied or asked goes on behind "and": "don't go forward and turn left" orders nothing."""
        if not isinstance(clause.form, Term) or clause.form.pred not in ("not", "can"):
            return False
        joined = following.start == clause.end + 1 and "AND" in self._lattice.categories(clause.end)
        return joined and following.function is Function.INSTRUCT

    def _lends_condition(self, clause: Clause, following: Clause) -> bool:
        """Whether a condition at the end is rather that of the next clause: "go on, when you get there turn around"."""
        if not isinstance(clause.form, Term) or clause.form.pred not in ("if", "when", "seq"):
            return False
        marker = next((at for at in range(clause.end - 1, clause.start, -1) if self._is_condition(at)), clause.start)
        return marker > clause.start and (following.start == clause.end or self._lattice.texts[marker - 1] in MARKS)

    def _is_condition(self, at: int) -> bool:
        return not self._lattice.categories(at).isdisjoint(("IF", "AFTER"))

    def _past_connectives(self, at: int) -> tuple[int, bool]:
        """Past marks, "and", "then", "but"; and whether "before that" was among them."""
        before = False
        while at < self._count:
            edges = self._lattice.edges(at)
            longest = max((edge.length for edge in edges), default=0)
            step = next((edge for edge in edges if edge.terminal in SEPARATORS and edge.length == longest), None)
            if step is None and self._lattice.texts[at] not in MARKS:
                break
            before = before or (step is not None and step.terminal == "BEFORE_THAT")
            at += 1 if step is None else step.length
        return at, before

"""The tables that the machine walks: an automaton whose reductions know what to make of their values."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from .automaton import RuleShape, lark_rules, rule_shape, terminals_of
from .automaton_store import automaton

END = "$END"

Action = Callable[..., Any]
Actions = Callable[[str], Action | None]


@dataclass(frozen=True, slots=True)
class Reduction:
    """A rule to reduce by: how many values it takes, where it goes, and what it makes of them."""

    origin: str
    size: int
    action: Action


@dataclass(frozen=True, slots=True)
class Tables:
    """Shifts, reductions and gotos by state and symbol. A state may both shift a terminal and reduce before it."""

    start: int
    accept: int
    shifts: tuple[Mapping[str, int], ...]
    reductions: tuple[Mapping[str, Reduction], ...]
    gotos: tuple[Mapping[str, int], ...]

    def expected(self, states: tuple[int, ...]) -> frozenset[str]:
        """The terminals that one of the states accepts; of the start where there is none."""
        accepted = (self.shifts[state].keys() | self.reductions[state].keys() for state in states or (self.start,))
        return frozenset().union(*accepted) - {END}


def build_tables(grammar: str, terminals: Iterable[str], actions: Actions) -> Tables:
    """The tables of a grammar in Lark's notation, whose terminals are declared to it.

    ``actions`` gives the action for a rule's alias (or its name); a rule without one and of one symbol passes its
    value on.
    """
    missing = sorted(set(terminals_of(grammar)) - set(terminals))
    if missing:
        raise ValueError(f"grammar uses {', '.join(missing)}, of which the lexicon has no words")
    known = automaton(grammar)
    rules = [_reduction(rule, actions) for rule in known.rules]
    reductions = tuple({name: rules[rule] for name, rule in state.items()} for state in known.reductions)
    return Tables(known.start, known.accept, known.shifts, reductions, known.gotos)


@dataclass(frozen=True, slots=True)
class Rule:
    """One expansion of a symbol, and what it makes of the values of its parts."""

    expansion: tuple[str, ...]
    action: Action


def grammar_rules(grammar: str, actions: Actions) -> dict[str, tuple[Rule, ...]]:
    """The rules of a grammar by the symbol they expand, with their actions as in `build_tables`."""
    rules: dict[str, list[Rule]] = {}
    for rule in lark_rules(grammar):
        expansion = tuple(str(symbol.name) for symbol in rule.expansion)
        reduction = _reduction(rule_shape(rule), actions)
        rules.setdefault(reduction.origin, []).append(Rule(expansion, reduction.action))
    return {symbol: tuple(found) for symbol, found in rules.items()}


def _reduction(rule: RuleShape, actions: Actions) -> Reduction:
    action = actions(rule.name)
    if action is None and rule.size != 1:
        raise ValueError(f"rule {rule.name} of {rule.size} symbols has no action")
    return Reduction(rule.origin, rule.size, action or (lambda value: value))

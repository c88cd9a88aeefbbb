"""The LALR(1) automaton of a grammar as plain data: Lark analyses the rules, what is kept needs Lark no more."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class RuleShape:
    """A rule as the automaton reduces by it: its alias (or the symbol it makes), that symbol, and how many it takes."""

    name: str
    origin: str
    size: int


@dataclass(frozen=True, slots=True)
class Automaton:
    """Shifts, reductions (by index into ``rules``) and gotos by state and symbol, as `tables.Tables` has them."""

    start: int
    accept: int
    rules: tuple[RuleShape, ...]
    shifts: tuple[Mapping[str, int], ...]
    reductions: tuple[Mapping[str, int], ...]
    gotos: tuple[Mapping[str, int], ...]


def compiled(grammar: str) -> Automaton:
    """The automaton of a grammar in Lark's notation. Raises GrammarError where two rules reduce before one terminal."""
    analysis = _analysed(grammar)
    number = {state: index for index, state in enumerate(analysis.lr0_itemsets)}
    rules: dict[Any, int] = {}
    shifts, reductions, gotos = [], [], []
    for state in number:
        following = {str(symbol.name): number[target] for symbol, target in state.transitions.items()}
        shifts.append({name: target for name, target in following.items() if name.isupper()})
        gotos.append({name: target for name, target in following.items() if not name.isupper()})
        reductions.append(
            {str(symbol.name): rules.setdefault(rule, len(rules)) for symbol, (rule,) in state.lookaheads.items()}
        )
    start = number[analysis.lr0_start_states["start"]]
    shapes = tuple(map(rule_shape, rules))
    return Automaton(start, gotos[start]["start"], shapes, tuple(shifts), tuple(reductions), tuple(gotos))


def lark_rules(grammar: str) -> list[Any]:
    """Lark's rules of a grammar, its terminals declared."""
    from lark import Lark  # imported where it is used: it is slow to import, and mostly not needed

    text = f"{grammar}\n%declare {' '.join(terminals_of(grammar))}\n"
    rules: list[Any] = Lark(text, parser="earley", lexer="basic", start="start", maybe_placeholders=False).rules
    return rules


def rule_shape(rule: Any) -> RuleShape:
    """The shape of one of Lark's rules."""
    return RuleShape(str(rule.alias or rule.origin.name), str(rule.origin.name), len(rule.expansion))


def terminals_of(grammar: str) -> list[str]:
    """The names of the terminals that a grammar uses."""
    return sorted(set(re.findall(r"\b[A-Z][A-Z_]+\b", re.sub(r"//.*", "", grammar))))


def _analysed(grammar: str) -> Any:
    from lark.common import ParserConf
    from lark.parsers.lalr_analysis import LALR_Analyzer

    analysis: Any = LALR_Analyzer(ParserConf(lark_rules(grammar), {}, ["start"]))
    analysis.compute_lalr()
    return analysis

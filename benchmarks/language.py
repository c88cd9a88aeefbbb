"""Understanding a sentence: text -> acts with forms, against hassil, and bare Lark on the same tokens.

The sentences are the gold commands of SCOUT where that corpus is at hand (the folder in ``KIRBY_SCOUT``, or
``shared/data/scout`` beside this project), otherwise the plain commands of Kirby's own corpora. hassil has templates
that must get at least 90 % of the gold commands right, so that it is no straw man. The three take turns sentence by
sentence, and each time is the median of several; of long sentences it is the least, since a busy machine only adds.

Run as ``kirby bench language [--json]``.
"""

from __future__ import annotations

import json
import os
import statistics
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from corpora.cases import Case, load_corpus
from corpora.runner import FOLDER
from grammar import parse
from grammar.automaton import terminals_of
from grammar.explain import Explainer
from grammar.language import language_grammar
from grammar.reader import Reader
from voxml.vocabulary import load_lexicon

from ._peer import Hassil, Step, is_right

ROUNDS = 5
SENTENCES_MAX = 600
CLAUSES = (5, 10, 20, 40)
HASSIL_RIGHT_MIN = 0.9
_PLAIN = ("units", "numbers", "imperatives", "direction_order")
_BESIDE = Path(__file__).resolve().parents[2] / "shared" / "data" / "scout"


def run(sentences_max: int = SENTENCES_MAX, rounds: int = ROUNDS) -> dict[str, Any]:
    """The figures. Times are microseconds a sentence."""
    gold = _gold()
    texts = [text for text, _ in gold][:sentences_max] or _plain()[:sentences_max]
    hassil, reader = Hassil(), Reader(load_lexicon())
    floor = _Floor(reader)
    ours, theirs, bare = _times(texts, rounds, parse, hassil.recognise, floor)
    by_clauses = {count: _clauses_us(count, rounds) for count in CLAUSES}
    figures: dict[str, Any] = {
        "sentences": len(texts),
        "kirby_median_us": statistics.median(ours),
        "kirby_p99_us": _p99(ours),
        "hassil_median_us": statistics.median(theirs),
        "hassil_p99_us": _p99(theirs),
        "median_over_hassil": statistics.median(ours) / statistics.median(theirs),
        "lark_sentences": len(bare),
        "lark_median_us": statistics.median(bare),
        "median_over_lark": statistics.median(ours) / statistics.median(bare),
        "clause_of_40_over_clause_of_5": (by_clauses[40] / 40) / (by_clauses[5] / 5),
        **{f"clauses_{count}_us": figure for count, figure in by_clauses.items()},
    }
    if gold:
        right = sum(is_right(hassil.recognise(text), steps[0]) for text, steps in gold) / len(gold)
        figures["hassil_gold_right"] = right
        figures["hassil_is_fair"] = right >= HASSIL_RIGHT_MIN
    else:
        figures["hassil_gold_right"] = "not measured: SCOUT is not at hand (set KIRBY_SCOUT to its folder)"
    return figures


def _times(texts: list[str], rounds: int, *each: Callable[[str], Any]) -> tuple[list[float], ...]:
    """The median time of every sentence for every contestant, which take turns; a contestant may pass (None)."""
    found: tuple[list[float], ...] = tuple([] for _ in each)
    for read in each:
        read(texts[0])
    for text in texts:
        laps: list[list[float]] = [[] for _ in each]
        passed = [False] * len(each)
        for _ in range(rounds):
            for index, read in enumerate(each):
                start = time.perf_counter_ns()
                passed[index] = read(text) is _PASS
                laps[index].append((time.perf_counter_ns() - start) / 1_000)
        for index, lap in enumerate(laps):
            if not passed[index]:
                found[index].append(statistics.median(lap))
    return found


def _clauses_us(count: int, rounds: int) -> float:
    clauses = ("turn left ninety degrees", "go forward two feet", "go to the red block on your left", "take a picture")
    text = " and then ".join(clauses[index % len(clauses)] for index in range(count))
    laps = []
    for _ in range(rounds + 2):
        start = time.perf_counter_ns()
        acts = parse(text)
        laps.append((time.perf_counter_ns() - start) / 1_000)
        assert isinstance(acts, tuple), text
        assert len(acts) == count, text
    return min(laps)


def _p99(times: list[float]) -> float:
    return sorted(times)[min(len(times) - 1, round(0.99 * len(times)))]


# ------------------------------------------------------------------ sentences
def _gold() -> list[tuple[str, list[Step]]]:
    path = Path(os.environ.get("KIRBY_SCOUT", _BESIDE)) / "gold.jsonl"
    if not path.is_file():
        return []
    rows = map(json.loads, path.read_text(encoding="utf-8").splitlines())
    return [(row["text"], row["gold"]) for row in rows if row["set"] == "gold_clean"]


def _plain() -> list[str]:
    cases = (case for name in _PLAIN for case in load_corpus(FOLDER / "language" / f"{name}.yaml", name))
    return [case.text for case in cases if isinstance(case, Case) and case.act == "instruct" and case.commands]


# ------------------------------------------------------------------ the floor
_PASS = object()


class _Floor:
    """Lark's own LALR parser over the terminals of Kirby's reading of a sentence; no words, no meaning."""

    def __init__(self, reader: Reader) -> None:
        from lark import Lark, Token
        from lark.lexer import Lexer

        class Given(Lexer):
            """Hands the parser the tokens it is given."""

            def __init__(self, conf: Any) -> None:
                """As Lark calls it."""

            def lex(self, data: Any, _state: Any = None) -> Iterator[Token]:
                return iter(data)

        grammar = language_grammar("en")
        text = f"{grammar}\n%declare {' '.join(terminals_of(grammar))}\n"
        self._token = Token
        self._parser: Any = Lark(text, parser="lalr", lexer=Given, start="start", maybe_placeholders=False)
        self._explainer = Explainer(reader, load_lexicon())
        self._known: dict[str, list[Any] | None] = {}

    def __call__(self, text: str) -> Any:
        if text not in self._known:
            trees = self._explainer.explain(text).trees
            leaves = trees[0].leaves() if len(trees) == 1 else ()
            self._known[text] = [self._token(leaf.label, leaf.words) for leaf in leaves] or None
        tokens = self._known[text]
        return _PASS if tokens is None else self._parser.parse(tokens)

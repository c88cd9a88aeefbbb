"""Guesses of the language model about what people say in words that the lexicon lacks: how often they are right.

The model is trained first, as ``kirby train language`` does; the sentences are hand-written and none of them is in what
it learns from. What the grammar reads or repairs by itself is counted apart: no model is asked about it.

Run as ``kirby bench proposals [--json]``.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections import Counter
from typing import Any

from grammar import DialogueAct, NotUnderstood, parse
from kirby.train_model import train
from voxml.vocabulary import load_lexicon

from ._paraphrases import BYSTANDERS, PARAPHRASES


def run() -> dict[str, Any]:
    """Counts of what was proposed for orders in other words and for what is no order; the wrong ones themselves."""
    lexicon = load_lexicon()
    model = train(lexicon, lambda line: print(line, file=sys.stderr)).model
    orders = Counter({"right": 0, "wrong": 0, "nothing": 0, "read_without": 0})
    others = Counter({"proposed": 0, "nothing": 0, "read_without": 0})
    listed: list[str] = []
    times_ms: list[float] = []
    for text, form in (*PARAPHRASES, *((text, None) for text in BYSTANDERS)):
        counts = others if form is None else orders
        if isinstance(parse(text, lexicon), tuple):
            counts["read_without"] += 1
            continue
        start = time.perf_counter()
        acts = parse(text, lexicon, proposer=model)
        times_ms.append((time.perf_counter() - start) * 1e3)
        outcome = _outcome(acts, form)
        counts[outcome] += 1
        if outcome in ("wrong", "proposed"):
            listed.append(f"{text} | {_asked(acts)}")
    return {
        "threshold": model.classes.threshold,
        **{f"orders_{name}": count for name, count in orders.items()},
        **{f"others_{name}": count for name, count in others.items()},
        "median_ms": statistics.median(times_ms),
        "wrongly_proposed": listed,
    }


def _outcome(acts: tuple[DialogueAct, ...] | NotUnderstood, form: str | None) -> str:
    if isinstance(acts, NotUnderstood):
        return "nothing"
    if form is None:
        return "proposed"
    return "right" if str(acts[0].form) == form else "wrong"


def _asked(acts: tuple[DialogueAct, ...] | NotUnderstood) -> str:
    return "" if isinstance(acts, NotUnderstood) else acts[0].repaired or str(acts[0].form)

"""Conversations in which anything happens in any order: what must hold of each step, and steps a second."""

from __future__ import annotations

import time
from collections import Counter
from random import Random

from ._any_order import converse, vocabulary

STEPS = 200_000
STEPS_EACH = 50
SAMPLES = 5_000


def run(steps: int = STEPS, seed: int = 1) -> dict[str, object]:
    """Walk so many steps, each checked and each replayed from its log; the first that does not hold is raised."""
    begin_s = time.perf_counter()
    said = vocabulary(SAMPLES, seed)
    reading_s = time.perf_counter() - begin_s
    begin_s = time.perf_counter()
    conversations = steps // STEPS_EACH
    states: Counter[str] = Counter()
    for number in range(conversations):
        states += converse(Random(f"{seed} {number}"), said, STEPS_EACH)
    walking_s = time.perf_counter() - begin_s
    return {
        "steps": conversations * STEPS_EACH,
        "conversations": conversations,
        "texts": len(said),
        "steps_a_second": conversations * STEPS_EACH / walking_s,
        "texts_read_in_s": reading_s,
        "violations": 0,
        "steps_by_state": dict(states.most_common()),
    }

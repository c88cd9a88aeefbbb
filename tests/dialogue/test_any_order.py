"""Any events in any order: no exception, nothing sent by guess, stop always obeyed, replay equal to the run.

The walk and what must hold of it are the benchmark's, ``kirby bench any_order``; here hypothesis draws it, and shrinks
one that fails.
"""

from __future__ import annotations

from random import Random

from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks._any_order import converse, vocabulary

SAMPLES = 300


@settings(max_examples=150, deadline=None)
@given(st.randoms(use_true_random=False), st.integers(1, 30))
def test_any_order_of_events(rng: Random, steps: int) -> None:
    converse(rng, vocabulary(SAMPLES, seed=2), steps)

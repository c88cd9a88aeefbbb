"""The joint distribution behind the robot's pose: its equations against plain ones."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from robot.mapping.gaussian import Gaussian, Measurement


def grown(seed: int) -> tuple[Gaussian, list]:
    """Three quantities, and blocks of two, one and three more that depend on them."""
    chance = np.random.default_rng(seed)
    state = Gaussian(chance.normal(size=3), chance.uniform(0.5, 2.0, size=3))
    blocks = [
        state.grow([0, 1, 2], chance.normal(size=(count, 3)), chance.normal(size=count), 0.1 * np.eye(count))
        for count in (2, 1, 3)
    ]
    return state, blocks


@given(st.integers(0, 1000), st.integers(0, 2))
def test_forgetting_a_block_leaves_what_is_known_of_the_others(seed: int, which: int) -> None:
    state, blocks = grown(seed)
    gone = blocks.pop(which)
    kept = [0, 1, 2, *(column for block in blocks for column in block.columns)]
    mean, covariance = state.mean[kept], state.covariance[np.ix_(kept, kept)]
    state.forget(gone)
    assert [0, 1, 2, *(column for block in blocks for column in block.columns)] == list(range(len(kept)))
    assert np.array_equal(state.mean, mean)
    assert np.array_equal(state.covariance, covariance)


@given(st.integers(0, 1000))
def test_measurements_taken_in_at_once_or_one_after_the_other_come_to_the_same(seed: int) -> None:
    chance = np.random.default_rng(seed)
    together, _ = grown(seed)
    apart, _ = grown(seed)
    first = Measurement([0, 1, 4], chance.normal(size=(2, 3)), chance.normal(size=2), np.diag([0.2, 0.3]))
    second = Measurement([2, 8], chance.normal(size=(1, 2)), chance.normal(size=1), np.array([[0.1]]))
    before = apart.mean.copy()
    together.correct([first, second])
    apart.correct([first])
    moved = second.slopes @ (apart.mean - before)[second.columns]
    apart.correct([Measurement(second.columns, second.slopes, second.residual - moved, second.noise)])
    assert np.allclose(together.mean, apart.mean)
    assert np.allclose(together.covariance, apart.covariance)


@given(st.integers(0, 1000))
def test_a_measurement_makes_nothing_less_sure(seed: int) -> None:
    state, _ = grown(seed)
    before = state.covariance.diagonal().copy()
    chance = np.random.default_rng(seed)
    state.correct([Measurement([0, 5], chance.normal(size=(1, 2)), chance.normal(size=1), np.array([[0.1]]))])
    assert (state.covariance.diagonal() <= before + 1e-12).all()
    assert np.allclose(state.covariance, state.covariance.T)
    assert np.linalg.eigvalsh(state.covariance).min() > -1e-9

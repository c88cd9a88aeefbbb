"""A joint normal distribution of the robot's state and of all that it knows the place of."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

POSE = [0, 1, 2]  # the columns of the robot's x, y and yaw, by agreement of all who share one


@dataclass(slots=True, eq=False)
class Block:
    """Where quantities that belong together are among all of them; moves up when others are forgotten."""

    first: int
    count: int

    @property
    def columns(self) -> list[int]:
        return list(range(self.first, self.first + self.count))


@dataclass(frozen=True, slots=True)
class Measurement:
    """Figures (m,) that were measured: by how much they differ from the expected, and on what these depend.

    ``slopes`` (m, k) is how the expected figures change with the quantities of ``columns`` (k); ``noise`` is (m, m).
    """

    columns: list[int]
    slopes: Floats
    residual: Floats
    noise: Floats


class Gaussian:
    """Mean, shape (n,), and covariance, shape (n, n), of quantities that are named by their columns.

    Corrected by the equations of the extended Kalman filter (S. Thrun, W. Burgard, D. Fox, "Probabilistic Robotics",
    chapter 3.3); the slopes are the caller's.
    """

    def __init__(self, mean: Floats, variances: Floats) -> None:
        self.mean = mean
        self.covariance = np.diag(variances)
        self._blocks: list[Block] = []

    def advance(self, mean: Floats, slopes: Floats, noise: Floats) -> None:
        """The first k quantities become ``mean`` (k,), by ``slopes`` (k, k) from what they were, and less sure."""
        count = len(mean)
        self.mean[:count] = mean
        self.covariance[:count] = slopes @ self.covariance[:count]
        self.covariance[:, :count] = self.covariance[:, :count] @ slopes.T
        self.covariance[:count, :count] += noise

    def distance(self, measured: Measurement) -> float:
        """The squared Mahalanobis distance of a measurement from what is expected of it."""
        known = self.covariance[np.ix_(measured.columns, measured.columns)]
        spread = measured.slopes @ known @ measured.slopes.T + measured.noise
        return float(measured.residual @ np.linalg.solve(spread, measured.residual))

    def correct(self, measurements: Sequence[Measurement]) -> None:
        """Take in independent measurements at once."""
        if not measurements:
            return
        columns = sorted({column for each in measurements for column in each.columns})
        places = {column: place for place, column in enumerate(columns)}
        count = sum(len(each.residual) for each in measurements)
        slopes, noise, first = np.zeros((count, len(columns))), np.zeros((count, count)), 0
        for each in measurements:
            rows = slice(first, first + len(each.residual))
            slopes[rows, [places[column] for column in each.columns]] = each.slopes
            noise[rows, rows] = each.noise
            first = rows.stop
        gains = self.covariance[:, columns] @ slopes.T
        spread = slopes @ gains[columns] + noise
        # What does not depend on anything measured stays as it is: after a survey that is nearly all of a map.
        touched = np.flatnonzero(gains.any(axis=1))
        gains = gains[touched]
        weights = np.linalg.solve(spread, gains.T).T
        self.mean[touched] += weights @ np.concatenate([each.residual for each in measurements])
        block = np.ix_(touched, touched)
        surer = self.covariance[block] - weights @ gains.T
        self.covariance[block] = (surer + surer.T) / 2

    def grow(self, columns: list[int], slopes: Floats, values: Floats, noise: Floats) -> Block:
        """Add m quantities that depend on those of ``columns`` by ``slopes`` (m, k)."""
        block = Block(len(self.mean), len(values))
        known = block.first
        across = slopes @ self.covariance[columns]
        grown = np.empty((known + block.count, known + block.count))
        grown[:known, :known] = self.covariance
        grown[known:, :known], grown[:known, known:] = across, across.T
        grown[known:, known:] = across[:, columns] @ slopes.T + noise
        self.covariance = grown
        self.mean = np.append(self.mean, values)
        self._blocks.append(block)
        return block

    def settle(self, mean: Floats) -> None:
        """The first k quantities are ``mean`` (k,) for certain, whatever was thought of them."""
        count = len(mean)
        self.mean[:count] = mean
        self.covariance[:count] = 0.0
        self.covariance[:, :count] = 0.0

    def forget(self, block: Block) -> None:
        """Drop the quantities of ``block``, which was grown before."""
        self.mean = np.delete(self.mean, block.columns)
        self.covariance = np.delete(np.delete(self.covariance, block.columns, axis=0), block.columns, axis=1)
        self._blocks.remove(block)
        for other in self._blocks:
            other.first -= block.count if other.first > block.first else 0

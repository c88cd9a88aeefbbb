"""Which wall of the new map is which of the old: `Map` has no ids, and a wall that grows must not blink."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Segment

# A wall whose end moved stays the same wall while one end is near its old place or the line still covers its middle.
NEAR_M = 0.30
PARALLEL_RAD = 0.26


@dataclass(frozen=True, slots=True, eq=False)
class Walls:
    """Segments with the ids they keep from map to map; ``next_number`` is that of the next wall to come."""

    segments: tuple[Segment, ...] = ()
    ids: tuple[str, ...] = ()
    next_number: int = 0

    def with_segments(self, segments: tuple[Segment, ...]) -> Walls:
        """The walls of a new map: each keeps the id of the one it grew from, and the rest get new ones.

        A segment that is listed twice counts once.
        """
        segments = tuple(dict.fromkeys(segments))
        known = dict(zip(self.segments, self.ids, strict=True))
        ids = [known.get(segment, "") for segment in segments]
        unnamed = [row for row, name in enumerate(ids) if not name]
        kept = set(ids)
        free = [segment for segment, name in known.items() if name not in kept]
        for row, column in _pairs([segments[row] for row in unnamed], free):
            ids[unnamed[row]] = known[free[column]]
        number = self.next_number
        for row in unnamed:
            if not ids[row]:
                ids[row] = f"wall-{number}"
                number += 1
        return Walls(segments, tuple(ids), number)


def _pairs(new: list[Segment], old: list[Segment]) -> list[tuple[int, int]]:
    """Rows of ``new`` with rows of ``old``, nearest first, each used once."""
    if not new or not old:
        return []
    cost_m = _costs(_ends(new), _ends(old))
    rows, columns = np.nonzero(cost_m < NEAR_M)
    pairs: list[tuple[int, int]] = []
    used_new: set[int] = set()
    used_old: set[int] = set()
    for index in np.argsort(cost_m[rows, columns], kind="stable"):
        row, column = int(rows[index]), int(columns[index])
        if row not in used_new and column not in used_old:
            pairs.append((row, column))
            used_new.add(row)
            used_old.add(column)
    return pairs


def _ends(segments: list[Segment]) -> NDArray[np.float64]:
    """Shape (n, 2, 2): segment, end, coordinate."""
    return np.array([((s.start.x_m, s.start.y_m), (s.end.x_m, s.end.y_m)) for s in segments], dtype=np.float64)


def _costs(new: NDArray[np.float64], old: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far each new segment is from each old one, shape (new, old): infinite where they are not parallel.

    The nearer pair of ends counts, or how far the old middle is from the new segment: a wall may grow at either end.
    """
    direction_new, direction_old = new[:, 1] - new[:, 0], old[:, 1] - old[:, 0]
    angle_new = np.arctan2(direction_new[:, 1], direction_new[:, 0])[:, None]
    angle_old = np.arctan2(direction_old[:, 1], direction_old[:, 0])[None, :]
    turned = np.abs(np.remainder(angle_new - angle_old + np.pi / 2, np.pi) - np.pi / 2)
    ends = np.linalg.norm(new[:, None, :, None, :] - old[None, :, None, :, :], axis=-1).min(axis=(2, 3))
    middle = _distance_to(new, old.mean(axis=1))
    return np.where(turned < PARALLEL_RAD, np.minimum(ends, middle), np.inf)


def _distance_to(segments: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Distance of each point (m, 2) from each segment (n, 2, 2), shape (n, m)."""
    start = segments[:, None, 0, :]
    along = segments[:, None, 1, :] - start
    length2 = np.maximum((along**2).sum(axis=-1), 1e-12)
    offset = points[None, :, :] - start
    share = np.clip((offset * along).sum(axis=-1) / length2, 0.0, 1.0)
    return np.asarray(np.linalg.norm(offset - share[..., None] * along, axis=-1))

"""What stands in the world, one value a thing and one numpy column a property, so that many are looked at at once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from robot.geometry import Point, Pose

FIDUCIAL = "fiducial"
_MARKER_SIZE_M = (0.1, 0.1, 0.1)

Mask = NDArray[np.bool_]
Rows = NDArray[np.intp]
NO_ROWS: Rows = np.array([], dtype=np.intp)


@dataclass(frozen=True, slots=True)
class StandsFor:
    """What a fiducial stands for: a voxeme's type and attributes, from the world's file or as it was taught."""

    fiducial_id: str
    type: str
    attributes: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    size_m: tuple[float, float, float] = _MARKER_SIZE_M


@dataclass(frozen=True, slots=True)
class Entity:
    """A thing that was perceived. ``pose`` is where its front is and the way it looks, map frame.

    For a thing with a fiducial that is the marker's own pose, and ``id`` is the fiducial's.
    """

    id: str
    type: str
    pose: Pose
    attributes: tuple[str, ...] = ()
    names: tuple[str, ...] = ()
    size_m: tuple[float, float, float] = _MARKER_SIZE_M
    fiducial_id: str | None = None

    @property
    def point(self) -> Point:
        return self.pose.point


@dataclass(frozen=True)
class Entities:
    """Every thing perceived so far, in the order in which it was, with its columns (computed once, when first used)."""

    items: tuple[Entity, ...] = ()

    def __len__(self) -> int:
        return len(self.items)

    @cached_property
    def index(self) -> dict[str, int]:
        """Row by id."""
        return {entity.id: row for row, entity in enumerate(self.items)}

    def get(self, id: str) -> Entity | None:
        """The thing with this id."""
        row = self.index.get(id)
        return None if row is None else self.items[row]

    @cached_property
    def xy_m(self) -> NDArray[np.float64]:
        """Places, shape (n, 2), map frame."""
        return np.array([(e.pose.x_m, e.pose.y_m) for e in self.items], dtype=np.float64).reshape(-1, 2)

    @cached_property
    def middle_m(self) -> NDArray[np.float64]:
        """Middles of their bodies, shape (n, 2), map frame: a marker's pose is on the front of what it marks."""
        yaw_rad = np.array([e.pose.yaw_rad for e in self.items], dtype=np.float64)
        behind_m = np.array([e.fiducial_id is not None for e in self.items], dtype=np.float64) * self.size_m[:, 0] / 2
        return np.asarray(self.xy_m - behind_m[:, None] * np.stack([np.cos(yaw_rad), np.sin(yaw_rad)], axis=1))

    @cached_property
    def size_m(self) -> NDArray[np.float64]:
        """Length, width and height, shape (n, 3)."""
        return np.array([e.size_m for e in self.items], dtype=np.float64).reshape(-1, 3)

    @cached_property
    def rows_by_fiducial(self) -> dict[str, int]:
        """Row of each fiducial that marks a thing."""
        return {e.fiducial_id: row for row, e in enumerate(self.items) if e.fiducial_id is not None}

    @cached_property
    def fiducial_rows(self) -> Rows:
        """Rows of the things that carry a fiducial, or are nothing else."""
        rows = [row for row, e in enumerate(self.items) if e.fiducial_id is not None or e.type == FIDUCIAL]
        return np.array(rows, dtype=np.intp)

    @cached_property
    def all_rows(self) -> Rows:
        """Every row."""
        return np.arange(len(self.items), dtype=np.intp)

    @cached_property
    def rows_by_type(self) -> dict[str, Rows]:
        """Rows of each type that occurs."""
        return _grouped([(e.type,) for e in self.items])

    @cached_property
    def rows_by_attribute(self) -> dict[str, Rows]:
        """Rows of each attribute that occurs."""
        return _grouped([e.attributes for e in self.items])

    @cached_property
    def rows_by_name(self) -> dict[str, Rows]:
        """Rows of each name that was given, in lower case."""
        return _grouped([tuple(name.lower() for name in e.names) for e in self.items])


def _grouped(keys_of_rows: list[tuple[str, ...]]) -> dict[str, Rows]:
    groups: dict[str, list[int]] = {}
    for row, keys in enumerate(keys_of_rows):
        for key in keys:
            groups.setdefault(key, []).append(row)
    return {key: np.array(rows, dtype=np.intp) for key, rows in groups.items()}

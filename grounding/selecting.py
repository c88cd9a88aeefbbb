"""Things by noun and adjectives, and by where they are in the robot's view."""

from __future__ import annotations

import numpy as np

from .descriptions import Description
from .entities import FIDUCIAL, NO_ROWS, Rows
from .relations import REGIONS, local_m
from .world import World

ONE = "one"
_ANYTHING = frozenset({ONE, "object", "obstacle"})


def noun_rows(description: Description, world: World) -> Rows:
    """The things that the noun and its adjectives fit. "Fiducial" fits everything that carries one."""
    entities, noun = world.entities, description.noun
    if noun in _ANYTHING:
        rows = entities.all_rows
    elif noun == FIDUCIAL:
        rows = entities.fiducial_rows
    else:
        rows = entities.rows_by_type.get(noun, NO_ROWS)
    for adjective in description.adjectives:
        if adjective in REGIONS and adjective not in entities.rows_by_attribute:
            rows = in_region(adjective, rows, world)
        else:
            rows = common(rows, entities.rows_by_attribute.get(adjective, NO_ROWS), len(entities))
    return rows


def in_region(region: str, rows: Rows, world: World) -> Rows:
    """Those in a part of the robot's view (see `REGIONS`)."""
    return np.extract(REGIONS[region](local_m(world.robot, world.entities.xy_m[rows])), rows)


def common(rows: Rows, others: Rows, count: int) -> Rows:
    """Those of ``rows`` that are among the others, by a mask over all ``count``: no sorting."""
    among = np.zeros(count, dtype=np.bool_)
    among[others] = True
    return rows[among[rows]]

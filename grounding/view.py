"""What is in view from where the robot stands, by the map: ahead, near enough, and with no wall between."""

from __future__ import annotations

import math

import numpy as np

from .approach import sees, wall_ends_m
from .entities import Entity
from .relations import local_m
from .world import World

_HALF_VIEW_RAD = math.radians(50.0)
_FAR_M = 6.0


def in_view(world: World) -> tuple[Entity, ...]:
    """The things that are in view, nearest first."""
    local = local_m(world.robot, world.entities.xy_m)
    away_m = np.hypot(local[:, 0], local[:, 1])
    ahead = np.abs(np.arctan2(local[:, 1], local[:, 0])) <= _HALF_VIEW_RAD
    rows = np.flatnonzero(ahead & (away_m <= _FAR_M))
    ends_m = wall_ends_m(world.walls)
    things = (world.entities.items[row] for row in rows[np.argsort(away_m[rows], kind="stable")])
    return tuple(thing for thing in things if sees(world.robot.point, thing.point, ends_m))

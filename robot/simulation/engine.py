"""The physics engine: pybullet without a window, one independent client for each body."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def _quiet_stderr() -> Iterator[None]:
    """Whatever C code writes to the standard error stream is dropped."""
    sys.stderr.flush()
    kept = os.dup(2)
    try:
        with Path(os.devnull).open("w") as nowhere:
            os.dup2(nowhere.fileno(), 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


with _quiet_stderr():  # on import it announces when it was built
    import pybullet

__all__ = ["FLOOR_GROUP", "ROBOT_GROUP", "STEP_RATE_HZ", "connect", "pybullet"]

STEP_RATE_HZ = 240  # pybullet's own default, which its solver is tuned for
ROBOT_GROUP, FLOOR_GROUP = 1, 4  # collision groups; 1 is pybullet's own for whatever moves
_GRAVITY_MPS2 = 9.80665


def connect() -> int:
    """A new empty world, independent of all others; returns its client id."""
    client = int(pybullet.connect(pybullet.DIRECT))
    pybullet.setGravity(0, 0, -_GRAVITY_MPS2, physicsClientId=client)
    pybullet.setTimeStep(1 / STEP_RATE_HZ, physicsClientId=client)
    pybullet.setPhysicsEngineParameter(deterministicOverlappingPairs=1, enableFileCaching=0, physicsClientId=client)
    return client

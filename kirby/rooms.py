"""Whether the rooms are ours: their names are generic, and Robot Framework owns ``robot`` on the package index."""

from __future__ import annotations

import importlib

from .errors import KirbyError


def check_rooms() -> None:
    """Raises KirbyError where another package called ``robot`` stands in the place of Kirby's."""
    room = importlib.import_module("robot")
    if getattr(room, "KIRBY_ROOM", None) != "robot":
        raise KirbyError(
            f"the package 'robot' found at {room.__file__} is not Kirby's (Robot Framework has the same name): "
            "install Kirby in an environment of its own"
        )

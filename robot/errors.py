"""What the robot's side cannot go on from."""

from __future__ import annotations

from voxml.errors import KirbyError


class RobotError(KirbyError):
    """The base of the robot room's exceptions; ``str()`` of it is one line that says what to do."""

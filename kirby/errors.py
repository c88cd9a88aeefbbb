"""What the command line cannot go on from."""

from __future__ import annotations

from voxml.errors import KirbyError

__all__ = ["KirbyError", "UsageError"]


class UsageError(KirbyError):
    """Something the caller wrote cannot be: a file that is not there, a speed that is no number."""

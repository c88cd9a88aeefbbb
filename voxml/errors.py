"""The one base of every exception of Kirby's: broken files and lost connections. Expected failures are values."""

from __future__ import annotations


class KirbyError(Exception):
    """Something that cannot be gone on from; ``str()`` of it is one line that says what to do."""

"""What the application cannot go on from: its text is one line that says what to do."""

from __future__ import annotations


class KirbyError(Exception):
    """The base of Kirby's own exceptions; ``exit_status`` is the command line's."""

    exit_status = 1


class UsageError(KirbyError):
    """Something the caller wrote cannot be: a file that is not there, a speed that is no number."""

    exit_status = 2

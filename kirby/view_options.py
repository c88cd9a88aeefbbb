"""Where the view is to be found, as the command line has it; apart from the view, whose imports are heavy."""

from __future__ import annotations

import os
import secrets
from dataclasses import dataclass

TOKEN_VARIABLE = "KIRBY_TOKEN"  # noqa: S105 - its name, not its value
DEFAULT_PORT = 8080
LOOPBACK = "127.0.0.1"


@dataclass(frozen=True, slots=True)
class ViewOptions:
    """The address to listen on; port 0 takes a free one."""

    host: str = LOOPBACK
    port: int = DEFAULT_PORT

    def token_for(self, loopback: bool) -> str | None:
        """What every browser must present: `KIRBY_TOKEN` from the environment, else a new one where others reach us."""
        return os.environ.get(TOKEN_VARIABLE) or (None if loopback else secrets.token_urlsafe(24))

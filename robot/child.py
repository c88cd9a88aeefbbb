"""Child processes that are gone when their parent is, however it ended."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from .errors import RobotError

# The child is made by exec'ing over a small guard, which asks the kernel for SIGKILL on the parent's death first
# (PR_SET_PDEATHSIG = 1, kept across exec). That leaves three holes, closed here:
# - the parent may have died before the guard asked: then getppid() is no longer who started us;
# - the signal comes when the *thread* that forked ends, not the process: `Child` forks in a thread that stays for as
#   long as the child lives, so that any thread may start one;
# - preexec_fn could do the same without a guard, but is not safe in a process with threads.
# A pipe that the child watches would do for our own code, but redis-server watches none, and a watchdog process that
# does can itself be killed. Nothing forks twice, so that the child has no way out of the guarantee.
# The lock is taken by the guard and lives as long as the child: two never work in one folder, even if a new parent
# starts while the kernel is still burying the old one's child.
_GUARD = """
import ctypes, fcntl, os, signal, sys
parent, lock, *command = sys.argv[1:]
if ctypes.CDLL(None, use_errno=True).prctl(1, int(signal.SIGKILL), 0, 0, 0) != 0:
    sys.exit("prctl failed: " + os.strerror(ctypes.get_errno()))
if os.getppid() != int(parent):
    sys.exit("parent is gone")
if lock:
    fd = os.open(lock, os.O_RDWR | os.O_CREAT, 0o600)
    fcntl.flock(fd, fcntl.LOCK_EX)
    os.set_inheritable(fd, True)
os.execv(command[0], command)
"""
RESTARTS_MAX = 5
RESTART_WINDOW_S = 10.0


class Child:
    """A process that lives until :meth:`close` or its parent's end, and is started again when something kills it.

    An exit of its own accord is not repeated: it would only fail again. ``log`` takes what it writes, ``lock`` is held
    as long as it lives, and ``environment`` is added to ours.
    """

    def __init__(
        self,
        command: list[str],
        log: Path,
        lock: Path | None = None,
        environment: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        self._command = command
        self._log = log
        self._lock = lock
        self._environment = environment
        self._closing = threading.Event()
        self._started = threading.Event()
        self._ended = threading.Event()
        self._process: subprocess.Popen[bytes] | None = None
        self._exit_status: int | None = None
        self._thread = threading.Thread(target=self._keep, name=f"child {Path(command[0]).name}", daemon=True)

    def start(self) -> None:
        """Returns when the process exists (not yet when it is ready for anything)."""
        self._log.write_bytes(b"")
        self._thread.start()
        self._started.wait()

    @property
    def pid(self) -> int | None:
        """Of the process running now; None before the first and after the last."""
        return None if self._process is None or self._ended.is_set() else self._process.pid

    @property
    def exit_status(self) -> int | None:
        """How it ended for good, negative for a signal; None while it lives."""
        return self._exit_status if self._ended.is_set() else None

    def last_words(self) -> str:
        """The last line of its log."""
        lines = self._log.read_text(errors="replace").strip().splitlines() if self._log.exists() else []
        return lines[-1] if lines else ""

    def close(self, patience_s: float = 1.0) -> None:
        """SIGTERM, and SIGKILL if it is still there after ``patience_s``."""
        self._closing.set()
        for sign, wait_s in ((signal.SIGTERM, patience_s), (signal.SIGKILL, None)):
            if self._process is not None and not self._ended.is_set():
                self._process.send_signal(sign)
                self._ended.wait(wait_s)

    def wait(self, timeout_s: float | None = None) -> bool:
        """Wait for its end; False if it lives on."""
        return self._ended.wait(timeout_s)

    def _keep(self) -> None:
        starts: list[float] = []
        try:
            while not self._closing.is_set():
                starts = [at for at in starts if time.monotonic() - at < RESTART_WINDOW_S] + [time.monotonic()]
                self._exit_status = self._run()
                if self._exit_status >= 0 or len(starts) > RESTARTS_MAX:
                    return
        finally:
            self._ended.set()
            self._started.set()

    def _run(self) -> int:
        guard = [sys.executable, "-I", "-S", "-c", _GUARD, str(os.getpid()), str(self._lock or "")]
        with self._log.open("ab") as log:
            self._process = subprocess.Popen(  # noqa: S603 - a list, no shell
                [*guard, *self._command],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                env={**os.environ, **self._environment},
            )
        self._started.set()
        if self._closing.is_set():
            self._process.kill()
        return self._process.wait()


def require_linux() -> None:
    """Raises RobotError elsewhere: the kernel's word that a child dies with its parent is Linux's."""
    if sys.platform != "linux":
        raise RobotError("Kirby starts Redis and the robot by itself on Linux only: use --redis URL with one of yours")

"""The robot's way to whoever commands it: the bridge over Redis is one, a plain object in memory another."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace
from typing import Protocol

from .messages import Feedback, Fiducials, Lidar, Map, Odom, Status


@dataclass(frozen=True, slots=True)
class Entry:
    """One entry of the command list as it came, numbered in order of arrival; numbers are never used twice."""

    number: int
    text: bytes


@dataclass(frozen=True, slots=True)
class Boot:
    """What was left from before: the robot's record, and whether more entries were taken than it knows of.

    Entries numbered up to ``admitted`` were sent before this robot was up; those ``left`` the record should know of.
    """

    record: bytes | None = None
    unhandled: bool = False
    admitted: int = 0
    left: tuple[Entry, ...] = ()


@dataclass(frozen=True, slots=True)
class News:
    """What the robot has to say; None means unchanged.

    ``feedback``, ``ended`` (entry numbers) and ``record`` take effect together or not at all.
    """

    feedback: tuple[Feedback, ...] = ()
    ended: tuple[int, ...] = ()
    record: str | None = None
    map: Map | None = None
    odom: Odom | None = None
    fiducials: Fiducials | None = None
    lidar: Lidar | None = None
    status: Status | None = None


@dataclass(frozen=True, slots=True)
class Incoming:
    """What has come in. ``held``: a ``stop`` stands further back in the list, so the wheels must not turn until then.

    ``reset`` was asked for and everything on the wire is cleared.
    """

    entries: tuple[Entry, ...] = ()
    held: bool = False
    reset: bool = False


class Port(Protocol):
    """Never blocks for long, except in ``open`` and ``wait``."""

    def open(self) -> Boot:
        """Connect; what was left from before."""

    def exchange(self, news: News) -> Incoming:
        """Publish, and take what has come in since. News that cannot be delivered now is kept and goes first later."""

    def wait(self, timeout_s: float) -> bool:
        """Until something has come in (True) or the time is over (False)."""

    @property
    def silent_s(self) -> float:
        """How long the other side has not been heard."""

    def close(self) -> None: ...


class MemoryPort:
    """Commands and news in one process: for tests, and for embedding the robot without Redis."""

    def __init__(self) -> None:
        self.feedback: list[Feedback] = []
        self.latest = News()
        self.ended: list[int] = []
        self.silent_s = 0.0
        self.held = False
        self._entries: deque[Entry] = deque()
        self._count = 0
        self._reset = False

    def send(self, text: str | bytes) -> int:
        """As RPUSH does to the command list; the entry's number."""
        self._count += 1
        self._entries.append(Entry(self._count, text.encode() if isinstance(text, str) else text))
        return self._count

    def reset(self) -> None:
        """As SET Bridge_Reset 1."""
        self._reset = True
        self._entries.clear()
        self.feedback.clear()

    def open(self) -> Boot:
        """Nothing is left from before; all that was sent already waits."""
        return Boot(admitted=self._count)

    def exchange(self, news: News) -> Incoming:
        self.feedback.extend(news.feedback)
        self.ended.extend(news.ended)
        fresh = {
            name: value
            for name in ("record", "map", "odom", "fiducials", "lidar", "status")
            if (value := getattr(news, name)) is not None
        }
        self.latest = replace(self.latest, **fresh)
        incoming = Incoming(tuple(self._entries), self.held, self._reset)
        self._entries.clear()
        self._reset = False
        return incoming

    def wait(self, timeout_s: float) -> bool:
        """At once: nothing can come in while the caller waits in the same thread."""
        return bool(self._entries) or self._reset

    def close(self) -> None:
        """Nothing to let go of."""

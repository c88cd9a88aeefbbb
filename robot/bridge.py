"""The Robotic Services Bridge: the robot's side of the keys in Redis (RSB; the paper's section 3.2).

Delivery is at least once into the robot's durable list and exactly once out of it; how is in
``docs/decisions/0004-delivery.md``. The script beside this file does one whole exchange atomically.

The control loop calls :meth:`Bridge.exchange` itself, one round trip of well under a millisecond, rather than through a
thread: a command is acted upon without a detour, and what was done is durable before the wheels turn.
"""

from __future__ import annotations

import json
import logging
import time
import uuid
from importlib.resources import files
from typing import Any
from urllib.parse import urlsplit, urlunsplit

import redis

from .connections import LOST, Connections
from .errors import RobotError
from .messages import (
    FEEDBACK_HISTORY,
    FEEDBACK_STREAM_HISTORY,
    MAP_HISTORY,
    STATUS_EXPIRY_S,
    Keys,
    encode_feedback,
    encode_fiducials,
    encode_lidar,
    encode_map,
    encode_odom,
    encode_status,
    feedback_fields,
)
from .port import Boot, Entry, Incoming, News

TAKE_MAX = 256  # entries a cycle; a stop behind them is seen all the same
ENTRY_MAX_BYTES = 2048  # beyond any well-formed entry; the rest of a longer one is not even fetched
LIMITS = {
    "feedback_max": FEEDBACK_HISTORY,
    "stream_max": FEEDBACK_STREAM_HISTORY,
    "map_max": MAP_HISTORY,
    "status_expiry": STATUS_EXPIRY_S,
}
NO_NEWS = json.dumps({"batches": []})
COUNT_MAX_DIGITS = 15  # a longer number was not counted by us
log = logging.getLogger(__name__)


class ReplacedError(RobotError):
    """Another robot has taken over these keys; this one must not touch them any more."""


def masked(url: str) -> str:
    """The URL without its password, fit to show."""
    parts = urlsplit(url)
    if parts.password is None:
        return url
    host = parts.netloc.rpartition("@")[2]
    return urlunsplit(parts._replace(netloc=f"{parts.username or ''}:***@{host}", query=""))


class Bridge:
    """A :class:`robot.port.Port` over Redis 6.2 or newer, by URL (redis://, rediss:// or unix://)."""

    def __init__(self, url: str, namespace: str = "") -> None:
        self._url = url
        self._keys = Keys(namespace)
        self._token = uuid.uuid4().hex
        keys = self._keys
        names = [keys.commands, keys.queue, self._record, keys.feedback, keys.feedback_stream, keys.reset]
        names += [keys.map, keys.odom, keys.fiducials, keys.lidar, keys.status]
        self._names: tuple[str | int, ...] = (len(names), *names)
        try:
            self._connections = Connections(url, _script("bridge.lua"), self._keys.commands)
        except ValueError:
            raise RobotError(
                f"'{masked(url)}' is not a Redis URL: use redis://, rediss:// or unix://, as in redis://localhost:6379"
            ) from None
        self._batches: list[dict[str, Any]] = []
        self._sent = 0  # of the batches, those that Redis may have applied already
        self._batch = self._seen = self._resets = 0
        self._latest: dict[str, str] = {}
        self._early: Incoming | None = None
        self._heard_s = time.monotonic()

    # ------------------------------------------------------------------ Port
    def open(self) -> Boot:
        """Take over the keys, clear what an earlier robot sensed, and say what it left to do.

        Raises:
            RobotError: nothing usable answers at the URL.
        """
        keys = self._keys
        names = (keys.commands, keys.queue, self._record, keys.map, keys.odom, keys.fiducials, keys.lidar)
        try:
            answer = self._connections.open(
                _script("opening.lua"), (len(names), *names, self._token, ENTRY_MAX_BYTES, COUNT_MAX_DIGITS)
            )
        except redis.RedisError as error:
            raise RobotError(self._why_not(error)) from None
        self._heard_s = time.monotonic()
        return self._boot(answer)

    def exchange(self, news: News) -> Incoming:
        """As :class:`robot.port.Port`; with Redis lost it returns at once, and everything is kept for later.

        Raises:
            ReplacedError: another robot has taken over.
        """
        self._collect(news)
        early, self._early = self._early, None
        if early is not None:
            return early  # what there is to say goes with the next exchange, which follows a command at once
        if not self._connections.up:
            return Incoming()
        try:
            answer = self._run()
        except redis.RedisError as error:
            self._lose(error)
            return Incoming()
        incoming = self._read(answer)
        self._batches.clear()
        self._sent = 0
        self._latest.clear()
        return incoming

    def wait(self, timeout_s: float) -> bool:
        if not self._connections.up:
            return self._connections.wait_until_up(timeout_s)
        try:
            answer = self._connections.wait(self._arguments(), timeout_s)
        except redis.exceptions.NoScriptError:
            return True  # the next exchange brings the script back
        except redis.RedisError as error:
            self._lose(error)
            return False
        if answer is None:
            return False
        incoming = self._read(answer)
        if incoming.entries or incoming.reset:
            self._early = incoming
        return self._early is not None

    @property
    def silent_s(self) -> float:
        return time.monotonic() - self._heard_s

    def close(self) -> None:
        """Let go of Redis; the keys stay."""
        self._connections.close()

    # ------------------------------------------------------------------ exchanging
    def _boot(self, answer: list[Any]) -> Boot:
        flat, queue, waiting, handled, taken = answer
        names, values = flat[::2], flat[1::2]
        fields = {name.decode(errors="replace"): value for name, value in zip(names, values, strict=True)}
        self._batch, self._resets = (_whole(fields.get(name)) for name in ("batch", "resets"))
        self._seen = handled
        entries = [_entry(row) for row in queue]
        left = tuple(entry for entry in entries if entry.number <= handled)
        intact = self._resets == _whole(fields.get("resets_handled"))
        return Boot(fields.get("state") if intact else None, len(left) < len(entries), taken + waiting, left)

    def _why_not(self, error: redis.RedisError) -> str:
        """One line for people."""
        reason = " ".join(str(error).split())
        if isinstance(error, LOST) and not isinstance(error, redis.AuthenticationError):
            return f"no Redis answers at {masked(self._url)} ({reason}): start it, or give another --redis URL"
        return f"Redis at {masked(self._url)} refuses: {reason}"

    def _lose(self, error: redis.RedisError) -> None:
        log.warning("Redis is lost: %s", error)
        self._connections.lose()

    @property
    def _record(self) -> str:
        return f"{self._keys.queue}_Record"

    def _collect(self, news: News) -> None:
        if news.feedback or news.ended or news.record is not None or news.map is not None:
            if len(self._batches) == self._sent:
                self._batch += 1
                self._batches.append({"number": self._batch, "ended": [], "feedback": [], "fields": []})
            # A batch may grow until it is first sent: while Redis is away there is one, however long that takes.
            batch = self._batches[-1]
            batch |= {"handled": self._seen, "resets": self._resets}
            batch["ended"].extend(news.ended)
            batch["feedback"].extend(encode_feedback(entry) for entry in news.feedback)
            batch["fields"].extend(_flat(feedback_fields(entry)) for entry in news.feedback)
            if news.record is not None:
                batch["state"] = news.record
            if news.map is not None:
                batch["map"] = encode_map(news.map)
        if news.odom is not None:
            self._latest["odom"] = encode_odom(news.odom)
        if news.fiducials is not None:
            self._latest["fiducials"] = encode_fiducials(news.fiducials)
        if news.lidar is not None:
            self._latest["lidar"] = encode_lidar(news.lidar)
        if news.status is not None:
            self._latest["status"] = encode_status(news.status)

    def _run(self) -> list[Any]:
        self._sent = len(self._batches)
        news = json.dumps({"batches": self._batches, "issued": self._batch, **LIMITS, **self._latest})
        return self._connections.exchange(self._arguments(news))

    def _arguments(self, news: str = NO_NEWS) -> tuple[str | int, ...]:
        return (*self._names, self._token, self._seen, TAKE_MAX, ENTRY_MAX_BYTES, news)

    def _read(self, answer: list[Any]) -> Incoming:
        owner, resets, hold, rows = answer
        if not owner:
            raise ReplacedError("another robot has taken over these keys: give each its own --namespace")
        self._heard_s = time.monotonic()
        # An answer may be to a question of before the last exchange: then some of it is known.
        entries = tuple(entry for row in rows if (entry := _entry(row)).number > self._seen)
        self._seen = max((entry.number for entry in entries), default=self._seen)
        reset = resets > self._resets
        self._resets = max(resets, self._resets)
        return Incoming(entries, hold > 0, reset)


def _script(name: str) -> str:
    return files(__package__).joinpath(name).read_text()


def _entry(row: bytes) -> Entry:
    number, text = row.split(b" ", 1)
    return Entry(int(number), text)


def _flat(fields: dict[str, str]) -> list[str]:
    """Names and values in turn. Half a surrogate pair, which JSON may hold, is no text that Redis' JSON can read."""
    return [part.encode(errors="replace").decode() for pair in fields.items() for part in pair]


def _whole(text: bytes | None) -> int:
    return int(text) if text is not None and text.isdigit() and len(text) <= COUNT_MAX_DIGITS else 0

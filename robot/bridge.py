"""The Robotic Services Bridge: the robot's side of the keys in Redis (RSB; the paper's section 3.2).

Delivery is at least once into the robot's durable list and exactly once out of it; how is in
``docs/decisions/0004-delivery.md``. The script beside this file does one whole exchange atomically.

The control loop calls :meth:`Bridge.exchange` itself, one round trip of well under a millisecond, rather than through a
thread: a command is acted upon without a detour, and what was done is durable before the wheels turn. A thread of its
own only waits where waiting is long: for something to arrive, and for a lost Redis to come back.
"""

from __future__ import annotations

import json
import logging
import threading
import time
import uuid
from importlib.resources import files
from typing import Any
from urllib.parse import urlsplit, urlunsplit

import redis
from redis.backoff import ExponentialBackoff, NoBackoff
from redis.retry import Retry

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
# A Redis that does not answer for so long is treated as lost; well within the second after which the wheels stop.
EXCHANGE_TIMEOUT_S = 0.25
CONNECT_TIMEOUT_S = 5.0
WATCH_S = 0.25
BACKOFF_MAX_S = 1.0
LOST = (redis.ConnectionError, redis.TimeoutError)

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
        try:
            once = Retry(NoBackoff(), 0)
            options: dict[str, Any] = {"socket_connect_timeout": CONNECT_TIMEOUT_S, "retry": once}
            self._client = redis.Redis.from_url(url, socket_timeout=EXCHANGE_TIMEOUT_S, **options)
            self._watcher = redis.Redis.from_url(url, socket_timeout=WATCH_S + CONNECT_TIMEOUT_S, **options)
        except ValueError:
            raise RobotError(
                f"'{masked(url)}' is not a Redis URL: use redis://, rediss:// or unix://, as in redis://localhost:6379"
            ) from None
        self._script = self._client.register_script(files(__package__).joinpath("bridge.lua").read_text())
        self._batches: list[dict[str, Any]] = []
        self._sent = 0  # of the batches, those that Redis may have applied already
        self._batch = self._seen = self._resets = 0
        self._latest: dict[str, str] = {}
        self._heard_s = time.monotonic()
        self._reachable = threading.Event()
        self._arrived = threading.Event()
        self._taken = threading.Event()
        self._closed = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="bridge-watch", daemon=True)

    # ------------------------------------------------------------------ Port
    def open(self) -> Boot:
        """Take over the keys, clear what an earlier robot sensed, and say what it left to do.

        Raises:
            RobotError: nothing usable answers at the URL.
        """
        try:
            boot = self._open()
        except LOST:
            raise RobotError(
                f"no Redis answers at {masked(self._url)}: start it, or give another --redis URL"
            ) from None
        except redis.RedisError as error:
            raise RobotError(f"Redis at {masked(self._url)} refuses: {error}") from None
        self._reachable.set()
        self._heard_s = time.monotonic()
        self._thread.start()
        return boot

    def exchange(self, news: News) -> Incoming:
        """As :class:`robot.port.Port`; with Redis lost it returns at once, and everything is kept for later.

        Raises:
            ReplacedError: another robot has taken over.
        """
        self._collect(news)
        self._arrived.clear()
        if not self._reachable.is_set():
            return Incoming()
        try:
            answer = self._run()
        except redis.RedisError as error:
            log.warning("Redis is lost: %s", error)
            self._reachable.clear()
            return Incoming()
        finally:
            self._taken.set()
        return self._read(answer)

    def wait(self, timeout_s: float) -> bool:
        return self._arrived.wait(timeout_s)

    @property
    def silent_s(self) -> float:
        return time.monotonic() - self._heard_s

    def close(self) -> None:
        """Let go of Redis; the keys stay."""
        self._closed.set()
        self._taken.set()
        if self._thread.is_alive():
            self._thread.join(timeout=2 * WATCH_S)  # it may be waiting for a command: not under its feet
        self._client.close()
        self._watcher.close()

    # ------------------------------------------------------------------ exchanging
    def _open(self) -> Boot:
        keys, client = self._keys, self._watcher
        client.lmove(f"{self._record}:none", f"{self._record}:none", "LEFT", "LEFT")  # an older Redis refuses here
        for key, kind in ((self._record, b"hash"), (keys.queue, b"list"), (keys.commands, b"list")):
            if client.type(key) not in (b"none", kind):
                client.delete(key)
        pipe = client.pipeline(transaction=True)
        pipe.delete(keys.map, keys.odom, keys.fiducials, keys.lidar)
        pipe.hset(self._record, "owner", self._token)
        pipe.hgetall(self._record)
        pipe.lindex(keys.queue, -1)
        pipe.llen(keys.commands)
        _, _, held, last, waiting = pipe.execute()
        fields: dict[str, bytes] = {name.decode(errors="replace"): value for name, value in held.items()}
        self._batch, self._seen, taken = (_whole(fields.get(name)) for name in ("batch", "handled", "seq"))
        self._resets = _whole(fields.get("resets"))
        intact = self._resets == _whole(fields.get("resets_handled"))
        unhandled = last is not None and _whole(last.split(b" ")[0]) > self._seen
        return Boot(fields.get("state") if intact else None, unhandled, taken + waiting)

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
        keys = self._keys
        names = [keys.commands, keys.queue, self._record, keys.feedback, keys.feedback_stream, keys.reset]
        names += [keys.map, keys.odom, keys.fiducials, keys.lidar, keys.status]
        limits = {
            "feedback_max": FEEDBACK_HISTORY,
            "stream_max": FEEDBACK_STREAM_HISTORY,
            "map_max": MAP_HISTORY,
            "status_expiry": STATUS_EXPIRY_S,
        }
        news = json.dumps({"batches": self._batches, **limits, **self._latest})
        self._sent = len(self._batches)
        answer: list[Any] = self._script(keys=names, args=[self._token, self._seen, TAKE_MAX, ENTRY_MAX_BYTES, news])
        return answer

    def _read(self, answer: list[Any]) -> Incoming:
        owner, resets, hold, rows = answer
        if not owner:
            raise ReplacedError("another robot has taken over these keys: give each its own --namespace")
        self._batches.clear()
        self._sent = 0
        self._latest.clear()
        self._heard_s = time.monotonic()
        entries = tuple(Entry(int(number), text) for number, text in (row.split(b" ", 1) for row in rows))
        if entries:
            self._seen = entries[-1].number
        reset = resets > self._resets
        self._resets = max(resets, self._resets)
        return Incoming(entries, hold > 0, reset)

    # ------------------------------------------------------------------ the waiting thread
    def _watch(self) -> None:
        """Wake the control loop when a command arrives; notice when Redis is back."""
        backoff, failures = ExponentialBackoff(cap=BACKOFF_MAX_S, base=0.05), 0
        while not self._closed.is_set():
            try:
                found = self._watch_once()
            except LOST:
                failures += 1
                self._closed.wait(backoff.compute(failures))
                continue
            failures = 0
            self._reachable.set()
            if found:
                self._taken.clear()
                self._arrived.set()
                self._taken.wait(WATCH_S)

    def _watch_once(self) -> bool:
        """Whether there are commands, waiting for them up to `WATCH_S`.

        Moving the head of a list to its own head changes nothing, but blocks until there is one.
        """
        try:
            commands = self._keys.commands
            run: Any = self._watcher.execute_command  # blmove()'s annotation knows whole seconds only
            return run("BLMOVE", commands, commands, "LEFT", "LEFT", WATCH_S) is not None
        except redis.ResponseError as error:  # the key is no list; the next exchange puts that right
            log.warning("waiting for commands: %s", error)
            self._closed.wait(WATCH_S)
            return True


def _flat(fields: dict[str, str]) -> list[str]:
    return [part for pair in fields.items() for part in pair]


def _whole(text: bytes | None) -> int:
    return int(text) if text is not None and text.isdigit() else 0

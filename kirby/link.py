"""The people's end of the Robotic Services Bridge: commands out, the robot's feedback and senses in, as events."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

import redis
from redis.backoff import ExponentialBackoff

from dialogue.events import Dispatch, RobotFeedback, WorldUpdate
from robot.bridge import masked
from robot.messages import (
    Envelope,
    Keys,
    Malformed,
    decode_fiducials,
    decode_map,
    decode_odom,
    encode_entry,
    feedback_from_fields,
)

from .errors import KirbyError

POLL_S = 0.1
FEEDBACK_BATCH = 100
_MAX_PAUSE_S = 2.0

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Lost:
    """Redis or the robot is gone; ``reason`` is fit to show."""

    reason: str


@dataclass(frozen=True, slots=True)
class Found:
    """What was lost is back."""


@dataclass(frozen=True, slots=True)
class Garbled:
    """Something on the wire was not of the contract; it was passed over."""

    reason: str


LinkEvent = WorldUpdate | RobotFeedback | Lost | Found | Garbled


def connect(url: str) -> redis.Redis:
    """A client for ``url`` (redis://, rediss:// or unix://); no traffic yet."""
    return redis.Redis.from_url(url, socket_timeout=5.0, socket_connect_timeout=5.0)


class RobotLink:
    """Reads the robot's keys in a thread of its own and hands every change to ``deliver``, in the order of publication.

    World news is delivered before the feedback read in the same turn, so that "where is it now" is answered from the
    place where the robot said "arrived".
    """

    def __init__(self, url: str, namespace: str = "", clock: Callable[[], float] = time.monotonic) -> None:
        """No traffic yet. Raises KirbyError when ``url`` is not a Redis URL."""
        self.url, self.namespace = url, namespace
        try:
            self._client = connect(url)
        except ValueError as error:
            raise KirbyError(f"'{masked(url)}' is not a Redis URL ({error}): try redis://localhost:6379") from None
        self._keys = Keys(namespace)
        self._clock = clock
        self._deliver: Callable[[LinkEvent], None] = _nowhere
        self._stopped = threading.Event()
        self._seen: dict[str, bytes] = {}
        self._alive: bool | None = None
        self._cursor: bytes | str = "0-0"
        self._thread = threading.Thread(target=self._run, name="robot-link", daemon=True)

    def start(self, deliver: Callable[[LinkEvent], None]) -> None:
        """Begin at the feedback published from now on; ``deliver`` is called in the link's own thread.

        Raises:
            KirbyError: nothing answers at the URL.
        """
        try:
            newest: Any = self._client.xrevrange(self._keys.feedback_stream, count=1)
        except redis.RedisError as error:
            raise KirbyError(f"no Redis answers at {masked(self.url)} ({error}): check --redis") from None
        if newest:
            self._cursor = newest[0][0]
        self._deliver = deliver
        self._thread.start()

    def close(self) -> None:
        self._stopped.set()
        if self._thread.is_alive():
            self._thread.join(timeout=2.0)
        self._client.close()

    def alive(self) -> bool:
        """Whether the robot shows a sign of life."""
        return bool(self._client.exists(self._keys.status))

    def send(self, dispatch: Dispatch) -> None:
        """Push the commands with their ids, all or none.

        Raises:
            redis.RedisError: they were not taken.
        """
        entries = [encode_entry(Envelope(c, i)) for c, i in zip(dispatch.commands, dispatch.ids, strict=True)]
        self._client.rpush(self._keys.commands, *entries)

    # ------------------------------------------------------------------ the reading thread
    def _run(self) -> None:
        backoff = ExponentialBackoff(cap=_MAX_PAUSE_S, base=POLL_S)
        failures = 0
        while not self._stopped.is_set():
            try:
                self._turn()
            except redis.RedisError as error:
                if failures == 0:
                    self._deliver(Lost(f"Redis does not answer ({error}); trying again"))
                failures += 1
                self._stopped.wait(backoff.compute(failures))
            else:
                if failures:
                    self._deliver(Found())
                failures = 0

    def _turn(self) -> None:
        """Wait for feedback, at most `POLL_S`, then pass on what is new."""
        answer: Any = self._client.xread(
            {self._keys.feedback_stream: self._cursor}, count=FEEDBACK_BATCH, block=int(POLL_S * 1000)
        )
        entries = answer[0][1] if answer else []
        self._deliver_world()
        for cursor, fields in entries:
            self._cursor = cursor
            try:
                self._deliver(RobotFeedback(feedback_from_fields(fields), self._clock()))
            except Malformed as error:
                self._deliver(Garbled(str(error)))

    def _deliver_world(self) -> None:
        pipe = self._client.pipeline(transaction=False)
        pipe.get(self._keys.odom)
        pipe.lindex(self._keys.map, -1)
        pipe.get(self._keys.fiducials)
        pipe.exists(self._keys.status)
        odom, walls, fiducials, alive = pipe.execute()
        self._deliver_life(bool(alive))
        update = WorldUpdate(
            self._clock(),
            odom=self._news("odom", odom, decode_odom),
            map=self._news("map", walls, decode_map),
            fiducials=self._news("fiducials", fiducials, decode_fiducials),
        )
        if update.odom or update.map or update.fiducials:
            self._deliver(update)

    def _deliver_life(self, alive: bool) -> None:
        """A robot that was there and is not any more is lost; one that has not come up yet is no news."""
        if self._alive is True and not alive:
            self._deliver(Lost("the robot shows no sign of life"))
        elif self._alive is False and alive:
            self._deliver(Found())
        if alive or self._alive is not None:
            self._alive = alive

    def _news(self, name: str, text: bytes | None, decode: Callable[[bytes], T]) -> T | None:
        """The decoded value if the key holds another text than before."""
        if text is None or self._seen.get(name) == text:
            return None
        self._seen[name] = text
        try:
            return decode(text)
        except Malformed as error:
            self._deliver(Garbled(f"{name}: {error}"))
            return None


def _nowhere(event: LinkEvent) -> None:
    """Before the link is started there is nobody to deliver to."""

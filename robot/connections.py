"""The robot's two connections to Redis: one on which it exchanges, one on which commands come by themselves.

A round trip to a Redis on the same machine costs less than handing the answer from one thread to another, so the
control loop uses both connections itself. What may take long, finding a lost Redis again, is done in a thread.
"""

from __future__ import annotations

import hashlib
import logging
import threading
import time
from collections.abc import Sequence
from typing import Any

import redis
from redis.backoff import ExponentialBackoff, NoBackoff
from redis.retry import Retry

# A Redis that does not answer for so long is treated as lost; well within the second after which the wheels stop.
EXCHANGE_TIMEOUT_S = 0.25
CONNECT_TIMEOUT_S = 5.0
# When the robot comes up its Redis may just be being started again.
OPENING_PATIENCE_S, LOADING_PATIENCE_S = 1.0, 30.0
BACKOFF_MIN_S, BACKOFF_MAX_S = 0.025, 1.0
DOUBLINGS_MAX = 10
LOST = (redis.ConnectionError, redis.TimeoutError)

Arguments = Sequence[str | int]

log = logging.getLogger(__name__)


class Connections:
    """For the control loop's thread alone, but for the finding of a lost Redis, which they do themselves.

    ``script`` is what :meth:`exchange` runs, and what runs as soon as the list ``commands`` holds something.
    Raises ValueError if ``url`` is not one of redis-py's.
    """

    def __init__(self, url: str, script: str, commands: str) -> None:
        self._url = url
        self._options: dict[str, Any] = {
            "socket_connect_timeout": CONNECT_TIMEOUT_S,
            "retry": Retry(NoBackoff(), 0),
        }
        self._pool = redis.ConnectionPool.from_url(url, socket_timeout=EXCHANGE_TIMEOUT_S, **self._options)
        self._script = script
        # Moving a list's head onto itself changes nothing, but blocks until there is one.
        self._until_pushed = ("BLMOVE", commands, commands, "LEFT", "LEFT", 0)
        self._exchanging: Any = self._pool.make_connection()  # redis-py's connections carry no types
        self._waiting: Any = self._pool.make_connection()
        self._sha = hashlib.sha1(script.encode(), usedforsecurity=False).hexdigest()
        self._armed = False
        self._failures = 0
        self._up = threading.Event()
        self._closed = threading.Event()

    # ------------------------------------------------------------------ for the one who opens
    def open(self, script: str, arguments: Arguments) -> Any:
        """Connect, and what ``script`` answers, run once.

        Raises:
            redis.RedisError: nothing answers, or not as wanted, even after a little while.
        """
        began_s = time.monotonic()
        while True:
            try:
                answer = self._open(script, arguments)
            except LOST as error:
                loading = isinstance(error, redis.BusyLoadingError)
                patience_s = LOADING_PATIENCE_S if loading else OPENING_PATIENCE_S
                if isinstance(error, redis.AuthenticationError) or time.monotonic() - began_s > patience_s:
                    raise
                self._closed.wait(BACKOFF_MIN_S)
            else:
                self._up.set()
                return answer

    def close(self) -> None:
        self._closed.set()
        self._up.clear()
        self._disconnect()

    # ------------------------------------------------------------------ for the control loop
    @property
    def up(self) -> bool:
        """Whether Redis is there as far as is known; once :meth:`lose` was called, it is being looked for."""
        return self._up.is_set()

    def exchange(self, arguments: Arguments) -> list[Any]:
        """What the script answers.

        Raises:
            redis.RedisError: it does not; say :meth:`lose` then.
        """
        try:
            answer: list[Any] = self._ask("EVALSHA", self._sha, *arguments)
        except redis.exceptions.NoScriptError:
            self._ask("SCRIPT", "LOAD", self._script)
            answer = self._ask("EVALSHA", self._sha, *arguments)
        self._failures = 0
        return answer

    def wait(self, arguments: Arguments, timeout_s: float) -> list[Any] | None:
        """What the script answered as soon as there was a command, or None if there was none in ``timeout_s``.

        Redis runs the script itself when the wait is over: no round trip lies between the push and the taking. The
        arguments are those of when the waiting began, which may have been some calls ago.

        Raises:
            redis.RedisError: as :meth:`exchange`.
        """
        connection = self._waiting
        if not self._armed:
            both = [self._until_pushed, ("EVALSHA", self._sha, *arguments)]
            connection.send_packed_command(connection.pack_commands(both))
            self._armed = True
        if not connection.can_read(timeout_s):
            return None
        self._armed = False
        try:
            connection.read_response()
        except redis.ResponseError as error:  # the key is no list; the script puts that right
            log.warning("waiting for commands: %s", error)
        answer: list[Any] = connection.read_response()
        return answer

    def lose(self) -> None:
        """Give these connections up and look for new ones, as long as it takes."""
        self._up.clear()
        self._disconnect()
        self._failures += 1
        threading.Thread(target=self._find, name="bridge-find", daemon=True).start()

    def wait_until_up(self, timeout_s: float) -> bool:
        return self._up.wait(timeout_s)

    # ------------------------------------------------------------------ connecting
    def _open(self, script: str, arguments: Arguments) -> Any:
        options: dict[str, Any] = {**self._options, "socket_timeout": CONNECT_TIMEOUT_S}
        with redis.Redis.from_url(self._url, **options) as client:
            answer = client.execute_command("EVAL", script, *arguments)
            client.script_load(self._script)
        self._connect()
        return answer

    def _find(self) -> None:
        backoff = ExponentialBackoff(cap=BACKOFF_MAX_S, base=BACKOFF_MIN_S)
        while not self._closed.wait(backoff.compute(min(self._failures, DOUBLINGS_MAX))):
            try:
                self._connect()
            except redis.RedisError:
                self._failures += 1
            else:
                self._up.set()
                return

    def _connect(self) -> None:
        self._exchanging, self._waiting = self._pool.make_connection(), self._pool.make_connection()
        self._armed = False
        self._exchanging.connect()
        self._waiting.connect()

    def _disconnect(self) -> None:
        self._exchanging.disconnect()
        self._waiting.disconnect()

    def _ask(self, *command: str | int) -> Any:
        self._exchanging.send_command(*command)
        return self._exchanging.read_response()

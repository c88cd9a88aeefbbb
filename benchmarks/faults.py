"""Whether commands survive kills of the robot and of Redis, and the robot what is pushed to its keys.

- *kills*: commands with ids are queued while the robot's process (a body without physics, as fast as it goes) and Redis
  (append-only file on) are killed at random moments and started again; endings are counted by id in the feedback
  stream. A client answers PAUSED with ``continue`` and sends nothing while the robot is away.
- *junk*: entries that are no commands, pushed to ``Kirby``, each to be answered with INVALID; then junk in every key,
  keys deleted, keys made into other types, and the robot's record spoilt by hand. The robot must not end, must obey
  afterwards, and its memory and Redis' must not grow.

Run as ``kirby bench faults [--json]``.
"""

from __future__ import annotations

import json
import random
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import psutil
import redis

from robot.messages import Keys
from robot.redis_server import RedisServer

from ._fuzz import junk, meddle

COMMANDS = 2000
ROBOT_KILLS, REDIS_KILLS = 100, 30
FUZZED = 100_000
WAITING_MAX = 60  # commands queued at a time; the robot's queue holds 100
REDIS_SPACING_S = 2.2  # a Redis that dies more than five times in ten seconds is not started again
PATIENCE_S = 60.0
PAUSE_S = 0.01
FUZZ_BATCH = 500
MOVEMENTS = ("go forward 0.1", "turn left 20", "turn right 20", "go forward -0.1")  # ends where it began
SUCCESSES = {"SUCCESS_FORWARD", "SUCCESS_VERIFY_ROTATION"}
ENDINGS = SUCCESSES | {"UNREACHABLE", "STRAYED", "CANCELLED_GOAL", "INVALID"}
KEYS = Keys()

Figures = dict[str, float]


def run(
    commands: int = COMMANDS,
    robot_kills: int = ROBOT_KILLS,
    redis_kills: int = REDIS_KILLS,
    fuzzed: int = FUZZED,
    seed: int = 4,
) -> Figures:
    """Commands lost and done twice, junk answered, and memory before and after."""
    source = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:
        figures = _Siege(Path(folder), source).run(commands, robot_kills, redis_kills)
    print(f"after the kills: {figures}; now junk", file=sys.stderr)
    with tempfile.TemporaryDirectory() as folder, RedisServer(Path(folder)) as server:
        return figures | _junk(server, fuzzed, source)


def _start(url: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen([sys.executable, "-m", "benchmarks._stub", url, "--speed", "max"])  # noqa: S603 - a list


# ------------------------------------------------------------------ kills
class _Siege:
    """A client that keeps the robot busy, and the one who kills."""

    def __init__(self, folder: Path, source: random.Random) -> None:
        self._source = source
        self._server = RedisServer(folder)
        self._server.start()
        self._client = redis.Redis.from_url(self._server.url)
        self._robot = _start(self._server.url)
        self._ended_by_itself = 0
        self._cursor = "0-0"
        self._killed: Counter[str] = Counter()
        self._endings: Counter[str] = Counter()
        self._codes: Counter[str] = Counter()
        self._pushed = 0
        self._listening = False

    def run(self, commands: int, robot_kills: int, redis_kills: int) -> Figures:
        victims = ["robot"] * robot_kills + ["redis"] * redis_kills
        self._source.shuffle(victims)
        moments = sorted(self._source.sample(range(commands - WAITING_MAX), len(victims)), reverse=True)
        began_s = redis_killed_s = heard_s = time.monotonic()
        while sum(self._endings.values()) < commands and time.monotonic() - heard_s < PATIENCE_S:
            if self._turn(commands):
                heard_s = time.monotonic()
            if not victims or len(self._endings) < moments[-1]:
                continue
            if victims[-1] == "redis":
                if time.monotonic() - redis_killed_s < REDIS_SPACING_S:
                    continue
                redis_killed_s = time.monotonic()
            threading.Event().wait(self._source.uniform(0.0, 0.1))
            moments.pop()
            self._kill(victims.pop())
        self._close()
        names = [f"c{n}" for n in range(self._pushed)]
        return {
            "commands": self._pushed,
            "robot_ended_by_itself": self._ended_by_itself,
            "robot_kills": self._killed["robot"],
            "redis_kills": self._killed["redis"],
            "lost": sum(self._endings[name] == 0 for name in names),
            "ended_twice": sum(count > 1 for count in self._endings.values()),
            "done": sum(self._codes[code] for code in SUCCESSES),
            "refused": self._codes["INVALID"],
            "otherwise": sum(self._codes[code] for code in ENDINGS - SUCCESSES - {"INVALID"}),
            "kills_seconds": round(time.monotonic() - began_s, 1),
        }

    def _turn(self, commands: int) -> bool:
        """Read the news, answer them, and send more; whether there were any."""
        if self._robot.poll() is not None:
            self._ended_by_itself += 1
            self._restart_robot()
        try:
            codes = self._read()
            if "PAUSED" in codes or "READY" in codes or "RESTARTING" in codes:
                self._listening = True
            if "PAUSED" in codes:
                self._client.rpush(KEYS.commands, "continue")
            if self._listening:
                self._send(commands)
        except (redis.ConnectionError, redis.TimeoutError):
            codes = []
        threading.Event().wait(PAUSE_S)
        return bool(codes)

    def _read(self) -> list[str]:
        """The codes told since the last time; endings are counted."""
        codes = []
        for cursor, code, name in _feedback(self._client, self._cursor):
            self._cursor = cursor
            codes.append(code)
            if name and code in ENDINGS:
                self._endings[name] += 1
                self._codes[code] += 1
        return codes

    def _send(self, commands: int) -> None:
        room = WAITING_MAX - (self._pushed - len(self._endings))
        for number in range(self._pushed, min(self._pushed + room, commands)):
            entry = {"id": f"c{number}", "command": MOVEMENTS[number % len(MOVEMENTS)]}
            self._client.rpush(KEYS.commands, json.dumps(entry))
            self._pushed += 1

    def _kill(self, victim: str) -> None:
        """Returns when it is dead: what is pushed from then on is not half pushed."""
        self._killed[victim] += 1
        if victim == "robot":
            self._robot.kill()
            self._restart_robot()
            return
        old = self._server.pid
        self._server.kill()
        while self._server.pid == old:
            threading.Event().wait(PAUSE_S)

    def _restart_robot(self) -> None:
        self._robot.wait()
        self._listening = False
        self._robot = _start(self._server.url)

    def _close(self) -> None:
        self._robot.kill()
        self._robot.wait()
        self._client.close()
        self._server.close()


# ------------------------------------------------------------------ junk
def _junk(server: RedisServer, count: int, source: random.Random) -> Figures:
    with redis.Redis.from_url(server.url) as client:
        robot = _start(server.url)
        try:
            _wait_for(lambda: client.xlen(KEYS.feedback_stream))
            answered = _entries(client, count // 2, source)
            middle = _memory_mb(client, robot.pid)
            for _ in range(count - count // 2):
                meddle(client, KEYS, source)
            obeys = _obeys(client)
            end = _memory_mb(client, robot.pid)
            crashes = int(robot.poll() is not None)
        finally:
            robot.kill()
            robot.wait()
    return {
        "junk_entries": count // 2,
        "junk_answered_invalid": answered,
        "meddled": count - count // 2,
        "crashes": crashes,
        "obeys_afterwards": int(obeys),
        "robot_mb_at_half": middle[0],
        "robot_mb_at_end": end[0],
        "redis_mb_at_half": middle[1],
        "redis_mb_at_end": end[1],
    }


def _entries(client: redis.Redis, count: int, source: random.Random) -> int:
    """Push junk to the commands; how many INVALID came."""
    cursor, invalid, pushed = "0-0", 0, 0
    heard_s = time.monotonic()
    while invalid < count and time.monotonic() - heard_s < PATIENCE_S:
        if pushed < count and pushed - invalid < 2 * FUZZ_BATCH:
            entries = [junk(source) for _ in range(min(FUZZ_BATCH, count - pushed))]
            client.rpush(KEYS.commands, *entries)
            pushed += len(entries)
        for last, code, _ in _feedback(client, cursor):
            cursor, heard_s = last, time.monotonic()
            invalid += code == "INVALID"
        threading.Event().wait(PAUSE_S)
    return invalid


def _obeys(client: redis.Redis) -> bool:
    """Whether, left in peace, it still does what it is told and says so."""
    threading.Event().wait(1.0)
    client.rpush(KEYS.commands, "cancel all", json.dumps({"id": "last", "command": "turn left 20"}))

    return _wait_for(lambda: any(name == "last" and code in SUCCESSES for _, code, name in _feedback(client)))


def _feedback(client: redis.Redis, after: str = "0-0") -> list[tuple[str, str, str]]:
    """Cursor, code and id of every entry of the stream after that cursor."""
    entries: Any = client.xrange(KEYS.feedback_stream, f"({after}")
    return [(at.decode(), said[b"code"].decode(), said.get(b"id", b"").decode()) for at, said in entries]


def _wait_for(condition: Callable[[], object]) -> bool:
    end_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < end_s:
        if condition():
            return True
        threading.Event().wait(PAUSE_S)
    return False


def _memory_mb(client: redis.Redis, pid: int) -> tuple[float, float]:
    """Of the robot's process (resident) and of Redis (in use)."""
    used: int = client.info("memory")["used_memory"]
    return round(psutil.Process(pid).memory_info().rss / 2**20, 1), round(used / 2**20, 1)

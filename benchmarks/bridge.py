"""How fast the bridge carries a stop and an answer, and whether twenty robots keep their pace under one Redis.

- *stop*: from RPUSH of ``stop`` to the zero command at the wheels, at 1x, at random moments of a turn; with the
  simulated robot in figure3 (physics, laser, camera, markers) and with a body without physics. Clocks are the machine's
  monotonic one, which all processes share.
- *round trip*: from RPUSH of a command to its first feedback on the list, against a bare redis-py process that BLPOPs
  one list and RPUSHes to another. They take turns under the same Redis; the figures are medians.
- *twenty robots*: namespaced, each patrolling in a body without physics, at 20 Hz. A period is missed when it starts
  more than one period after it was due. Beside them runs a bare loop that only sleeps until its next period is due:
  what it misses, the machine was too busy for.

Run as ``kirby bench bridge [--json]``.
"""

from __future__ import annotations

import json
import random
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import redis

from robot.control import PERIOD_S
from robot.messages import Keys
from robot.redis_server import RedisServer

STOPS = 200
TRIPS = 2000
ROBOTS = 20
ROBOTS_S = 60.0
WARM_UP_S = 30.0  # until all have come up
WORLD = "figure3"
ANSWER_TIMEOUT_S = 30
KEYS = Keys()
PEER = """
import sys, redis
client = redis.Redis.from_url(sys.argv[1], socket_timeout=None)
while client.blpop("ping"):
    client.rpush("pong", "x")
"""

BARE_LOOP = """
import json, signal, sys, time
from benchmarks._stub import PERIOD_S, lateness_s
signal.signal(signal.SIGTERM, lambda *_: sys.exit())
due_s, began_s = time.monotonic(), []
try:
    while True:
        due_s += PERIOD_S
        time.sleep(max(0.0, due_s - time.monotonic()))
        began_s.append(time.monotonic())
finally:
    print(json.dumps({"late_s": lateness_s(began_s, float(sys.argv[1])), "cpu_s": time.process_time()}))
"""

Figures = dict[str, float]


def run(
    stops: int = STOPS,
    trips: int = TRIPS,
    robots: int = ROBOTS,
    robots_s: float = ROBOTS_S,
    warm_up_s: float = WARM_UP_S,
) -> Figures:
    """Milliseconds of a stop, the round trip's ratio to the bare one, and the lateness of the robots' periods."""
    figures: Figures = {}
    for name, options in (("stop", ("--world", WORLD)), ("stop_without_physics", ())):
        with _server() as url:
            figures |= _percentiles(name, _stops(url, options, stops))
    with _server() as url:
        figures |= _round_trips(url, trips)
    with _server() as url:
        figures |= _robots(url, robots, robots_s, warm_up_s)
    return figures


# ------------------------------------------------------------------ stop
def _stops(url: str, options: Sequence[str], count: int) -> list[float]:
    """Seconds from RPUSH of ``stop`` to the wheels' zero command."""
    seconds = []
    with _robot(url, "--stops", *options) as robot, _client(url) as client:
        _told(client, "READY")
        for _ in range(count):
            client.rpush(KEYS.commands, "turn left 360")
            _told(client, "ESTIMATE_ROTATION")
            threading.Event().wait(random.uniform(0.1, 0.6))
            began_s = time.monotonic()
            client.rpush(KEYS.commands, "stop")
            assert robot.stdout is not None
            seconds.append(float(robot.stdout.readline()) - began_s)
            client.rpush(KEYS.commands, "cancel all")
            _told(client, "READY")
    return seconds


def _percentiles(name: str, seconds: list[float]) -> Figures:
    ordered = sorted(seconds)
    return {
        f"{name}_trials": len(ordered),
        f"{name}_ms_p50": round(1000 * statistics.median(ordered), 2),
        f"{name}_ms_p99": round(1000 * ordered[int(0.99 * len(ordered))], 2),
        f"{name}_ms_max": round(1000 * ordered[-1], 2),
    }


# ------------------------------------------------------------------ round trip
def _round_trips(url: str, count: int) -> Figures:
    with _python("-c", PEER, url), _robot(url), _client(url) as client:
        _told(client, "READY")
        bare, bridge = [], []
        for _ in range(count):
            bare.append(_round_trip(client, "ping", "x", "pong"))
            bridge.append(_round_trip(client, KEYS.commands, "queue", KEYS.feedback))
    return {
        "round_trips": count,
        "round_trip_ms": round(1000 * statistics.median(bridge), 3),
        "bare_round_trip_ms": round(1000 * statistics.median(bare), 3),
        "round_trip_ratio": round(statistics.median(bridge) / statistics.median(bare), 3),
    }


def _round_trip(client: redis.Redis, there: str, text: str, back: str) -> float:
    began_s = time.perf_counter()
    client.rpush(there, text)
    assert client.blpop([back], ANSWER_TIMEOUT_S) is not None
    return time.perf_counter() - began_s


# ------------------------------------------------------------------ many robots
def _robots(url: str, count: int, seconds: float, warm_up_s: float) -> Figures:
    since_s = time.monotonic() + warm_up_s
    with _client(url) as client:
        bare = _spawn("-c", BARE_LOOP, str(since_s))
        robots = [_start(url, "--namespace", f"robot{n}", "--lateness", str(since_s)) for n in range(count)]
        try:
            for n in range(count):
                _told(client, "READY", Keys(f"robot{n}"))
                client.rpush(Keys(f"robot{n}").commands, "patrol 16 0.5 0.5")
            threading.Event().wait(max(0.0, since_s - time.monotonic()) + seconds)
        finally:
            for process in (bare, *robots):
                process.terminate()
        said = [json.loads(robot.communicate()[0]) for robot in robots]
        bare_late = json.loads(bare.communicate()[0])["late_s"]
    late = [each for one in said for each in one["late_s"]]
    return {
        "robots": count,
        "robots_seconds": seconds,
        **_lateness("robots", late),
        **_lateness("bare_loop", bare_late),
        "robots_cpu_seconds_each": round(sum(one["cpu_s"] for one in said) / count, 2),
    }


def _lateness(name: str, late_s: list[float]) -> Figures:
    return {
        f"{name}_periods": len(late_s),
        f"{name}_missed_periods": sum(each > PERIOD_S for each in late_s),
        f"{name}_late_ms_p99": round(1000 * sorted(late_s)[int(0.99 * len(late_s))], 2),
        f"{name}_late_ms_max": round(1000 * max(late_s), 2),
    }


# ------------------------------------------------------------------ processes
def _told(client: redis.Redis, code: str, keys: Keys = KEYS) -> None:
    """Read the feedback list up to that code."""
    while True:
        answer = client.blpop([keys.feedback], ANSWER_TIMEOUT_S)
        assert isinstance(answer, tuple), f"the robot never said {code}"
        if json.loads(answer[1])["code"] == code:
            return


def _client(url: str) -> redis.Redis:
    return redis.Redis.from_url(url, socket_timeout=2 * ANSWER_TIMEOUT_S)


@contextmanager
def _server() -> Iterator[str]:
    with tempfile.TemporaryDirectory() as folder, RedisServer(Path(folder)) as server:
        yield server.url


@contextmanager
def _robot(url: str, *options: str) -> Iterator[subprocess.Popen[str]]:
    with _python("-m", "benchmarks._stub", url, *options) as robot:
        yield robot


@contextmanager
def _python(*arguments: str) -> Iterator[subprocess.Popen[str]]:
    process = _spawn(*arguments)
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def _start(url: str, *options: str) -> subprocess.Popen[str]:
    return _spawn("-m", "benchmarks._stub", url, *options)


def _spawn(*arguments: str) -> subprocess.Popen[str]:
    return subprocess.Popen([sys.executable, *arguments], stdout=subprocess.PIPE, text=True)  # noqa: S603 - a list

"""Junk for the bridge: entries that are no commands, and what a careless hand may do to the keys."""

from __future__ import annotations

import contextlib
import json
import random
from collections.abc import Callable

import redis

from robot.messages import Keys

HUGE_BYTES = 300_000
DEEP = 2_000

_WRONG_JSON: tuple[object, ...] = (
    None,
    7,
    "stop",
    [],
    {},
    {"id": 7, "command": "stop"},
    {"id": None, "command": "stop"},
    {"id": "", "command": "stop"},
    {"id": "x" * 65, "command": "stop"},
    {"id": "a", "command": ["stop"]},
    {"id": "a", "command": {"stop": True}},
    {"id": "a", "command": "stop", "more": 1},
    {"id": "a"},
    {"command": "stop"},
    {"id": "\ud800", "command": "fly"},
    {"id": "\x00\x01", "command": "fly"},
    {"id": "a", "command": "go forward \udfff"},
    {"id": float("nan"), "command": "stop"},
    {"id": "a", "command": float("inf")},
)
_WRONG_TEXT = (
    "",
    " ",
    "STOP",
    "stop stop",
    "go forward nan",
    "go forward inf",
    "go forward 1e309",
    "go forward ٣",
    "go forward 1 2",
    "go forward 100.1",
    "go to 1",
    "go to 1001 0",
    "turn left -5",
    "turn left 0",
    "turn right 3601",
    "patrol 1 2",
    "patrol 2 1 1",
    "patrol 16 0 1",
    "cancel everything",
    "queue; flushall",
    "' OR 1=1",
    "{",
    '{"id"',
    "NaN",
    '"stop',
    "go\x00forward",
)


def junk(source: random.Random) -> bytes:
    """One entry that is not a command."""
    kind = source.random()
    if kind < 0.35:
        return source.choice(_WRONG_TEXT).encode()
    if kind < 0.65:
        return json.dumps(source.choice(_WRONG_JSON)).encode()
    if kind < 0.85:
        return b"\xff" + source.randbytes(source.randrange(200))
    if kind < 0.95:
        depth = source.randrange(1, DEEP)
        return source.choice([b"[", b'{"id":', b'{"id":"a","command":[']) * depth
    return b"x" * source.choice([201, 3_000, HUGE_BYTES])


def meddle(client: redis.Redis, keys: Keys, source: random.Random) -> None:
    """One thing done to one of the keys that a client has no business doing."""
    record = f"{keys.queue}_Record"
    key = source.choice([*_names(keys), record])
    with contextlib.suppress(redis.ResponseError):  # the robot has put the key right in the meantime
        source.choice(_DEEDS)(client, key, source)
        if source.random() < 0.2:
            _spoil_record(client, record, source)


def _names(keys: Keys) -> list[str]:
    names = [keys.commands, keys.queue, keys.feedback, keys.feedback_stream, keys.reset]
    return [*names, keys.map, keys.odom, keys.fiducials, keys.lidar, keys.status]


def _spoil_record(client: redis.Redis, record: str, source: random.Random) -> None:
    names = ("batch", "seq", "handled", "resets_handled", "scanned", "hold", "state", "owner")
    values: tuple[str | bytes, ...] = ("", "-1", "nan", "1e9", "9" * 400, "999999999999999", "0x10", junk(source))
    if client.type(record) == b"hash":
        client.hset(record, source.choice(names), source.choice(values))


def _anew(push: Callable[[redis.Redis, str, bytes], object]) -> Callable[[redis.Redis, str, random.Random], None]:
    """The key becomes another type."""

    def deed(client: redis.Redis, key: str, source: random.Random) -> None:
        with client.pipeline(transaction=True) as pipe:
            pipe.delete(key)
            push(pipe, key, junk(source))
            pipe.execute()

    return deed


def _delete(client: redis.Redis, key: str, source: random.Random) -> None:
    client.delete(key)


def _push(client: redis.Redis, key: str, source: random.Random) -> None:
    if client.type(key) == b"list":
        source.choice([client.lpush, client.rpush])(key, junk(source))


def _number(client: redis.Redis, key: str, source: random.Random) -> None:
    """An entry as the robot's own list has them, with a number that it never gave."""
    if client.type(key) == b"list":
        client.rpush(key, b"%d %s" % (10 ** source.randrange(20), junk(source)))


def _last_stream_entry(client: redis.Redis, key: str, source: random.Random) -> None:
    if client.type(key) == b"none":
        client.xadd(key, {"code": "junk"}, id=f"{2**64 - 1}-{2**64 - 1}")


def _ask_for_reset(client: redis.Redis, key: str, source: random.Random) -> None:
    if source.random() < 0.01:
        client.set(key, "1")


_DEEDS: tuple[Callable[[redis.Redis, str, random.Random], None], ...] = (
    _delete,
    _push,
    _push,
    _push,
    _number,
    _last_stream_entry,
    _ask_for_reset,
    _anew(lambda client, key, value: client.set(key, value)),
    _anew(lambda client, key, value: client.sadd(key, value)),
    _anew(lambda client, key, value: client.hset(key, "a", value)),
    _anew(lambda client, key, value: client.zadd(key, {value: 1.0})),
    _anew(lambda client, key, value: client.rpush(key, value)),
)

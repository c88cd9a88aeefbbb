"""Frozen values as JSON data and back, by their types: for whole sessions and for logs of events.

A dataclass is an object of its fields that differ from their defaults, an enum its value, a tuple a list. Where a type
leaves a choice, an object with ``type`` says which. Reading is strict: what has not the shape of the type is refused.
"""

from __future__ import annotations

import math
import sys
import types
from collections.abc import Callable
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from functools import cache
from typing import Any, TypeVar, Union, cast, get_args, get_origin, get_type_hints

from voxml.errors import KirbyError

Value = TypeVar("Value")
Write = Callable[[Any], Any]
Read = Callable[[Any], Any]


class UnreadableError(KirbyError):
    """Data that is not of the type it should be; ``str()`` says what was expected."""


def to_data(value: Any, kind: Any) -> Any:
    """JSON data for a value of the type ``kind``."""
    return _codec(kind)[0](value)


def from_data(data: Any, kind: type[Value]) -> Value:
    """The value that `to_data` wrote.

    Raises:
        UnreadableError: the data is not of that type.
    """
    try:
        value: Value = _codec(cast(Any, kind))[1](data)
    except RecursionError:
        raise UnreadableError(f"{_name(kind)}: nested too deep") from None
    return value


@cache
def _codec(kind: Any) -> tuple[Write, Read]:
    """How values of a type are written and read. Types that hold themselves are looked up when they are met again."""
    if kind in (str, bool, int):
        return _same, _exactly(kind)
    if kind is float:
        return _same, _number
    if get_origin(kind) in (Union, types.UnionType):
        return _union(get_args(kind))
    if get_origin(kind) is tuple:
        return _tuple(get_args(kind))
    if isinstance(kind, type) and issubclass(kind, Enum):
        return (lambda member: member.value), _member(kind)
    if is_dataclass(kind):
        return _record(kind)
    raise TypeError(f"{kind} is not a type that a session is made of")


def _same(value: Any) -> Any:
    return value


def _name(kind: Any) -> str:
    return getattr(kind, "__name__", str(kind))


def _fail(data: Any, expected: str) -> UnreadableError:
    return UnreadableError(f"expected {expected}, not {str(data)[:60]!r}")


def _exactly(kind: type) -> Read:
    def read(data: Any) -> Any:
        if type(data) is not kind:
            raise _fail(data, kind.__name__)
        return data

    return read


def _number(data: Any) -> float:
    if type(data) not in (int, float) or not math.isfinite(data):
        raise _fail(data, "a finite number")
    return float(data)


def _member(kind: type[Enum]) -> Read:
    members = {member.value: member for member in kind}

    def read(data: Any) -> Any:
        if not isinstance(data, str) or data not in members:
            raise _fail(data, f"one of {', '.join(map(str, members))}")
        return members[data]

    return read


def _tuple(kinds: tuple[Any, ...]) -> tuple[Write, Read]:
    if len(kinds) == 2 and kinds[1] is Ellipsis:
        item = kinds[0]

        def read_all(data: Any) -> Any:
            if not isinstance(data, list):
                raise _fail(data, "a list")
            read = _codec(item)[1]
            return tuple([read(part) for part in data])

        return (lambda values: [_codec(item)[0](value) for value in values]), read_all

    def read_each(data: Any) -> Any:
        if not isinstance(data, list) or len(data) != len(kinds):
            raise _fail(data, f"a list of {len(kinds)}")
        return tuple(_codec(kind)[1](part) for kind, part in zip(kinds, data, strict=True))

    return (lambda values: [_codec(k)[0](v) for k, v in zip(kinds, values, strict=True)]), read_each


def _union(kinds: tuple[Any, ...]) -> tuple[Write, Read]:
    """None and plain values as they are; records and members as ``{"type": ...}`` where there is more than one kind."""
    nullable = type(None) in kinds
    plain = [kind for kind in kinds if kind in (str, bool, int, float)]
    tagged = {_name(kind): kind for kind in kinds if kind is not type(None) and kind not in plain}
    alone = next(iter(tagged.values())) if len(tagged) == 1 and not plain else None

    def write(value: Any) -> Any:
        if value is None or type(value) in plain:
            return value
        if alone is not None:
            return _codec(alone)[0](value)
        name = type(value).__name__
        return {"type": name, "value": _codec(tagged[name])[0](value)}

    def read(data: Any) -> Any:
        if data is None and nullable:
            return None
        if alone is not None:
            return _codec(alone)[1](data)
        if type(data) in plain:
            return data
        if not isinstance(data, dict) or set(data) != {"type", "value"} or data["type"] not in tagged:
            raise _fail(data, f"an object whose type is one of {', '.join(tagged)}")
        return _codec(tagged[data["type"]])[1](data["value"])

    return write, read


def _record(kind: Any) -> tuple[Write, Read]:
    hints = get_type_hints(kind, vars(sys.modules[kind.__module__]))
    names = [field.name for field in fields(kind) if field.init]
    defaults = {field.name: field.default for field in fields(kind)}

    def write(value: Any) -> Any:
        written = {}
        for name in names:
            part = getattr(value, name)
            if part is not defaults[name] and part != defaults[name]:
                written[name] = _codec(hints[name])[0](part)
        return written

    def read(data: Any) -> Any:
        if not isinstance(data, dict) or not set(data) <= set(names):
            raise _fail(data, f"an object with {', '.join(names)}")
        missing = next((name for name in names if name not in data and defaults[name] is MISSING), None)
        if missing is not None:
            raise _fail(data, f"{kind.__name__} with {missing}")
        return kind(**{name: _codec(hints[name])[1](part) for name, part in data.items()})

    return write, read

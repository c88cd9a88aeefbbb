"""Strict reading of values from YAML: each reader takes a value and where it stands, and says what would be right."""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Mapping
from typing import Any, TypeVar

import yaml

COORDINATE_MAX_M = 1_000.0
NUMBER_MAX = 1e15  # anything beyond, infinities and NaN among it, is a slip of the pen

_Value = TypeVar("_Value")


class StrictLoader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
    """A safe loader that refuses a key given twice, which YAML says and PyYAML does not check."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        keys = [key.value for key, _ in node.value]
        repeated = next((key for index, key in enumerate(keys) if key in keys[:index]), None)
        if repeated is not None:
            raise yaml.constructor.ConstructorError(None, None, f"'{repeated}' is given twice", node.start_mark)
        mapping: dict[Hashable, Any] = super().construct_mapping(node, deep)
        return mapping


class FieldError(Exception):
    """What is wrong with which field; becomes a SceneError once the file is known."""


def check_fields(data: Any, at: str, required: set[str], optional: set[str]) -> None:
    if not isinstance(data, Mapping):
        raise FieldError(f"{at}: must be a mapping with {', '.join(sorted(required))}")
    missing = required - data.keys()
    if missing:
        raise FieldError(f"{at}: '{min(missing)}' is missing: add it")
    unknown = sorted(str(key) for key in data.keys() - required - optional)
    if unknown:
        allowed = ", ".join(sorted(required | optional))
        raise FieldError(f"{at}: '{unknown[0]}' is not a field: use {allowed}")


def check_unique(ids: list[Any], at: str, what: str) -> None:
    repeated = next((given for index, given in enumerate(ids) if given in ids[:index]), None)
    if repeated is not None:
        raise FieldError(f"{at}: {what} '{repeated}' is used twice: give each object its own")


def read_each(rows: Any, at: str, read: Callable[[Any, str], _Value]) -> tuple[_Value, ...]:
    if not isinstance(rows, list):
        raise FieldError(f"{at}: must be a list")
    return tuple(read(row, f"{at}[{index}]") for index, row in enumerate(rows))


def read_row(values: Any, at: str, count: int, shape: str, read: Callable[[Any, str], float]) -> tuple[float, ...]:
    if not isinstance(values, list) or len(values) != count:
        raise FieldError(f"{at}: must be {count} numbers: {shape}")
    return tuple(read(value, at) for value in values)


def read_number(value: Any, at: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < NUMBER_MAX:
        raise FieldError(f"{at}: '{value}' is not a number: write one such as 1.5")
    return float(value)


def read_coordinate(value: Any, at: str) -> float:
    number = read_number(value, at)
    if abs(number) > COORDINATE_MAX_M:
        raise FieldError(f"{at}: {number:g} is out of range: at most {COORDINATE_MAX_M:g} m from the origin")
    return number


def read_length(value: Any, at: str) -> float:
    number = read_coordinate(value, at)
    if number <= 0:
        raise FieldError(f"{at}: {number:g} is not a length: give metres greater than 0")
    return number


def read_angle(value: Any, at: str) -> float:
    number = read_number(value, at)
    if abs(number) > 360:
        raise FieldError(f"{at}: {number:g} is out of range: give degrees from -360 to 360")
    return math.remainder(math.radians(number), math.tau)


def read_whole(value: Any, at: str, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= most:
        raise FieldError(f"{at}: '{value}' must be a whole number from 0 to {most}")
    return value


def read_text(value: Any, at: str) -> str:
    if not isinstance(value, str) or not value.strip():
        raise FieldError(f"{at}: '{value}' must be text that is not empty")
    return value

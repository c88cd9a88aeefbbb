"""Corpora as values: what is said, shown and sensed, and what must come of it. Read strictly from YAML.

A file holds ``cases`` (one utterance each, nothing said before) and ``dialogues`` (turns, each checked)::

    world: figure3                 # optional, for every case of the file: a world of Kirby's, or a file beside this one
    cases:
      - say: turn left forty five degrees      # or a list of sentences that mean the same
        act: instruct                          # compared where given, as are form, status (ok) and reply
        form: turn(left,45deg)
        commands: [turn left 45]               # always compared: none where none are given
    dialogues:
      - name: a place is pointed at
        world: figure3
        at: [0, 0, 90]                         # where the robot stands: x, y and yaw in degrees (the world's start)
        seen: [1, 2]                           # fiducials seen so far (all)
        turns:
          - point: [1.0, 0.5]                  # or the id of a thing
          - say: go there
            after: 2                           # seconds since the turn before (1)
            commands: [go to 1 0.5]            # always compared, as is reply
            state: executing                   # compared where given
          - feedback: {code: SUCCESS_GO_TO, of: 1, at: [1.0, 0.5]}   # of the first command that was sent
            reply: successfully navigated to (1, 0.5)
          - gesture: open palm
          - see: [1, 2, 3]
          - move: [1.0, 0.5, 0]
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from voxml.errors import KirbyError

EVENTS = frozenset({"say", "point", "gesture", "feedback", "see", "move", "tick"})
_TURN = EVENTS | {"after", "commands", "reply", "state"}
_CASE = frozenset({"say", "world", "at", "seen", "act", "form", "status", "commands", "reply"})
_DIALOGUE = frozenset({"name", "world", "at", "seen", "turns"})
_STATUSES = ("ok", "ambiguous", "not_understood", "needs_world")


class CorpusError(KirbyError):
    """A corpus that cannot be used; ``str()`` is one line that names the file, the place and the remedy."""


@dataclass(frozen=True, slots=True)
class Setting:
    """The world by name or path, where the robot stands (None: its start), and the fiducials seen (None: all)."""

    world: str | None = None
    at: tuple[float, float, float] | None = None
    seen: tuple[str, ...] | None = None


@dataclass(frozen=True, slots=True)
class Case:
    """One sentence by itself. ``None`` is not compared, except ``commands``, which always are."""

    source: str
    text: str
    setting: Setting
    status: str
    commands: tuple[str, ...] | None
    act: str | None = None
    form: str | None = None
    replies: tuple[str, ...] | None = None


@dataclass(frozen=True, slots=True)
class TurnCase:
    """One turn of a dialogue: an event as ``(name, value)`` and what must come of it."""

    event: tuple[str, Any]
    after_s: float
    commands: tuple[str, ...]
    replies: tuple[str, ...]
    state: str | None


@dataclass(frozen=True, slots=True)
class DialogueCase:
    """A conversation from its beginning."""

    source: str
    text: str
    setting: Setting
    turns: tuple[TurnCase, ...]


@dataclass(frozen=True, slots=True)
class KnownFailure:
    """What does not work yet: the case, the step at which it fails (``commands``, ``form``, ``turn 3``), and why."""

    source: str
    text: str
    step: str
    reason: str


def load_corpus(path: Path, source: str) -> tuple[Case | DialogueCase, ...]:
    """Every case of a file, in its order; ``source`` names the file in reports and errors.

    Raises:
        CorpusError: the file cannot be read, or says something that this module does not know.
    """
    data = _load(path)
    _check(data, source, frozenset({"world", "cases", "dialogues"}), frozenset())
    setting = Setting(data.get("world"))
    cases = [case for row, at in _rows(data, "cases", source) for case in _cases(row, at, source, setting)]
    dialogues = [_dialogue(row, at, source, setting) for row, at in _rows(data, "dialogues", source)]
    return (*cases, *dialogues)


def load_known_failures(path: Path) -> tuple[KnownFailure, ...]:
    """The list of what does not work yet. Raises CorpusError."""
    data = _load(path) if path.exists() else {}
    _check(data, path.name, frozenset({"known_failures"}), frozenset())
    fields = frozenset({"file", "case", "step", "reason"})
    failures = []
    for row, at in _rows(data, "known_failures", path.name):
        _check(row, at, fields, fields)
        failures.append(KnownFailure(str(row["file"]), str(row["case"]), str(row["step"]), str(row["reason"])))
    return tuple(failures)


def _load(path: Path) -> Any:
    try:
        return yaml.load(path.read_text(encoding="utf-8"), Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader)) or {}  # noqa: S506
    except OSError as error:
        raise CorpusError(f"{path}: cannot be read ({error.strerror}): give the path of a corpus") from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise CorpusError(f"{path}: is not YAML: {' '.join(str(error).split())}") from None


def _rows(data: Mapping[str, Any], name: str, source: str) -> list[tuple[Any, str]]:
    rows = data.get(name) or []
    if not isinstance(rows, list):
        raise CorpusError(f"{source}: '{name}' must be a list")
    return [(row, f"{source}: {name}[{index}]") for index, row in enumerate(rows)]


def _check(row: Any, at: str, allowed: frozenset[str], required: frozenset[str]) -> None:
    if not isinstance(row, dict):
        raise CorpusError(f"{at}: must be a mapping with {', '.join(sorted(allowed))}")
    unknown = sorted(str(key) for key in row.keys() - allowed)
    if unknown:
        raise CorpusError(f"{at}: '{unknown[0]}' is not a field: use {', '.join(sorted(allowed))}")
    missing = sorted(required - row.keys())
    if missing:
        raise CorpusError(f"{at}: '{missing[0]}' is missing: add it")


# ------------------------------------------------------------------ cases
def _cases(row: Any, at: str, source: str, setting: Setting) -> list[Case]:
    _check(row, at, _CASE, frozenset({"say"}))
    status = row.get("status", "ok")
    if status not in _STATUSES:
        raise CorpusError(f"{at}: status '{status}' is unknown: use {', '.join(_STATUSES)}")
    commands = _texts(row["commands"], f"{at}.commands") if "commands" in row else () if status == "ok" else None
    replies = _texts(row["reply"], f"{at}.reply") if "reply" in row else None
    here = _setting(row, at, setting)
    return [
        Case(source, text, here, status, commands, _text(row, "act", at), _text(row, "form", at), replies)
        for text in _texts(row["say"], f"{at}.say")
    ]


def _dialogue(row: Any, at: str, source: str, setting: Setting) -> DialogueCase:
    _check(row, at, _DIALOGUE, frozenset({"name", "turns"}))
    turns = row["turns"]
    if not isinstance(turns, list) or not turns:
        raise CorpusError(f"{at}: 'turns' must be a list with at least one turn")
    read = tuple(_turn(turn, f"{at}.turns[{index}]") for index, turn in enumerate(turns))
    return DialogueCase(source, str(row["name"]), _setting(row, at, setting), read)


def _turn(row: Any, at: str) -> TurnCase:
    _check(row, at, _TURN, frozenset())
    events = sorted(EVENTS & row.keys())
    if len(events) != 1:
        raise CorpusError(f"{at}: must have exactly one of {', '.join(sorted(EVENTS))}")
    after_s = row.get("after", 1.0)
    if isinstance(after_s, bool) or not isinstance(after_s, int | float) or after_s < 0:
        raise CorpusError(f"{at}: after '{after_s}' must be seconds, 0 or more")
    commands, replies = _texts(row.get("commands", []), f"{at}.commands"), _texts(row.get("reply", []), f"{at}.reply")
    return TurnCase((events[0], row[events[0]]), float(after_s), commands, replies, _text(row, "state", at))


def _setting(row: Mapping[str, Any], at: str, default: Setting) -> Setting:
    seen = row.get("seen", "all")
    if seen != "all" and not isinstance(seen, list):
        raise CorpusError(f"{at}: seen '{seen}' must be 'all' or a list of fiducials")
    place = numbers(row["at"], 3, f"{at}.at") if "at" in row else None
    return Setting(
        row.get("world", default.world),
        None if place is None else (place[0], place[1], place[2]),
        None if seen == "all" else tuple(map(str, seen)),
    )


def numbers(values: Any, count: int, at: str) -> tuple[float, ...]:
    """So many numbers. Raises CorpusError."""
    good = isinstance(values, list) and len(values) == count
    if not good or any(isinstance(v, bool) or not isinstance(v, int | float) for v in values):
        raise CorpusError(f"{at}: must be {count} numbers")
    return tuple(map(float, values))


def _text(row: Mapping[str, Any], name: str, at: str) -> str | None:
    value = row.get(name)
    if value is not None and not isinstance(value, str):
        raise CorpusError(f"{at}: '{name}' must be text: put it in quotes")
    return value


def _texts(value: Any, at: str) -> tuple[str, ...]:
    """A text, or a list of texts. YAML's own booleans are a trap: an unquoted ``yes`` is refused."""
    rows = value if isinstance(value, list) else [value]
    if not all(isinstance(row, str) for row in rows):
        raise CorpusError(f"{at}: must be text, or a list of texts: put it in quotes")
    return tuple(rows)

"""Logs of conversations: every event with what came of it, a JSON object a line; and showing that it comes out again.

The first line holds the session as it was before the first event: ``{"session": ...}``. Every other is
``{"event": ..., "outputs": [...]}``, in the notation of `dialogue.codec`.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TextIO

from dialogue.codec import UnreadableError, from_data, to_data
from dialogue.events import Event, Output
from dialogue.session import Session

from .agent import Agent
from .conversation import Conversation, Happening
from .errors import KirbyError
from .link import Found, Garbled, Lost
from .proposer import trained_here


@contextmanager
def logged(conversation: Conversation, path: Path | None) -> Iterator[None]:
    """Write everything that happens to ``path``, if there is one.

    Raises:
        KirbyError: the file cannot be written.
    """
    if path is None:
        yield
        return
    try:
        file = path.open("w", encoding="utf-8")
    except OSError as error:
        raise KirbyError(f"{path}: {error.strerror}") from None
    with file:
        _write(file, {"session": to_data(conversation.agent.session, Session)})

        def watch(happening: Happening, outputs: tuple[Output, ...]) -> None:
            if not isinstance(happening, Lost | Found | Garbled):
                _write(file, {"event": to_data(happening, Event), "outputs": _outputs(outputs)})

        conversation.watch(watch)
        try:
            yield
        finally:
            conversation.unwatch(watch)


def _write(file: TextIO, data: dict[str, Any]) -> None:
    file.write(json.dumps(data, separators=(",", ":"), ensure_ascii=False) + "\n")


def _outputs(outputs: tuple[Output, ...]) -> list[Any]:
    return [to_data(output, Output) for output in outputs]


def replay(path: Path) -> bool:
    """Give the events of a log to a new agent; True if the same comes of them. What differs is printed.

    Raises:
        KirbyError: the file cannot be read, or is no log.
    """
    agent: Agent | None = None
    events = 0
    for number, row in _rows(path):
        try:
            if agent is None:
                agent = Agent.from_json(json.dumps(row["session"]), proposer=trained_here())
                continue
            got = _outputs(agent.handle(from_data(row["event"], Event)))  # type: ignore[arg-type]
            expected = row["outputs"]
        except (KeyError, TypeError, UnreadableError) as error:
            raise KirbyError(f"{path}: line {number} is not of a log: {error}") from None
        events += 1
        if got != expected:
            print(f"line {number}: something else came of {json.dumps(row['event'])}")
            print(f"  logged: {json.dumps(expected)}\n  now:    {json.dumps(got)}")
            return False
    if agent is None:
        raise KirbyError(f"{path}: the log is empty")
    print(f"{events} events: the outputs came out the same")
    return True


def _rows(path: Path) -> Iterator[tuple[int, Any]]:
    try:
        with path.open(encoding="utf-8") as file:
            for number, line in enumerate(file, start=1):
                yield number, json.loads(line)
    except (OSError, UnicodeDecodeError) as error:
        raise KirbyError(f"{path}: {getattr(error, 'strerror', None) or 'not text'}") from None
    except ValueError:
        raise KirbyError(f"{path}: a log is a JSON object a line") from None

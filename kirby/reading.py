"""``kirby parse``: what Kirby makes of an utterance said out of the blue."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

from voxml.vocabulary import load_lexicon

from .agent import understand
from .proposer import trained_here

Record = dict[str, Any]


def reader(world: str | None) -> Callable[[str], Record]:
    """A function from an utterance to the record that ``kirby parse --json`` prints; each call stands on its own.

    Raises:
        UsageError: there is no such world.
    """
    known = None
    if world is not None:
        from grounding import World

        from .worlds import find_world

        known = World.explored(find_world(world))
    return partial(understand, world=known, lexicon=load_lexicon(), proposer=trained_here())


def show_record(record: Record) -> str:
    """The record for people: act, form and commands on one line; or a caret under what was not understood."""
    if record["status"] == "not_understood":
        start, end = record["span"]
        caret = " " * start + "^" * max(1, end - start)
        return f"{record['utterance']}\n{caret} {record['reason']}"
    commands = record["commands"]
    sent = "" if commands is None else f" -> {', '.join(commands) or 'no command'}"
    why = f" ({record['reason']})" if record.get("reason") else ""
    return f"{record['act']}: {record['form']}{sent} [{record['status']}]{why}"

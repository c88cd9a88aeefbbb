"""From an entry of the command list to an event for the queue: whatever was pushed, there is one."""

from __future__ import annotations

from .messages import ENTRY_MAX_CHARS, ID_MAX_CHARS, Malformed, decode_entry, decode_object
from .port import Entry
from .queue import Garbled, Orphaned, Received


def read_entry(entry: Entry) -> Received | Garbled:
    """The command, or why it is none."""
    try:
        return Received(entry.number, decode_entry(entry.text))
    except Malformed as error:
        return Garbled(entry.number, str(error), _id_of(entry.text))


def read_orphan(entry: Entry) -> Orphaned:
    """The entry as one that will not be done, under its id if it has a readable one."""
    read = read_entry(entry)
    return Orphaned(entry.number, read.envelope.id if isinstance(read, Received) else read.id)


def _id_of(text: bytes) -> str | None:
    """The id of an envelope whose command is not readable: its sender wants to know."""
    try:
        id = decode_object(text, ENTRY_MAX_CHARS).get("id")  # noqa: A001 - the wire's word
    except Malformed:
        return None
    return id if isinstance(id, str) and 0 < len(id) <= ID_MAX_CHARS else None

"""What could have stood where an utterance went wrong, in words for people."""

from __future__ import annotations

from collections.abc import Iterable

from .machine import Trace

_NAMES = {
    "VERB": "something to do",
    "VERB_ING": "something to do",
    "AXIS": "forward or back",
    "SIDE": "left or right",
    "HEADING": "a compass heading",
    "QTY": "an amount with its unit",
    "NUMBER": "a number",
    "PATH": "to, through, around ...",
    "PLACE": "here or there",
    "LOC": "on, near, between ...",
    "NOUN": "a thing or place",
    "NOUNS": "a thing or place",
    "ONE": "a thing or place",
    "DETERMINER": "the, a, every ...",
    "ORDINAL": "first, last, nearest ...",
    "ADJECTIVE": "a colour, size or shape",
    "WHAT_SEE": "a question",
    "WHERE": "a question",
    "$END": "the end",
}
EXPECTED_MAX = 6


def describe_expected(terminals: Iterable[str], trace: Trace) -> tuple[str, ...]:
    """Why readings were refused where the trace ended, and the kinds of words that could have stood there."""
    refused = [reason for at, reason in trace.refusals or () if at >= trace.furthest]
    named = [_NAMES[terminal] for terminal in _NAMES if terminal in set(terminals)]
    return tuple(dict.fromkeys([*refused, *named]))[:EXPECTED_MAX]

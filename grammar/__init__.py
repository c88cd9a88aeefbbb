"""English in, logical forms out. The grammar never sees the world: a text means the same wherever the robot is."""

from __future__ import annotations

from functools import lru_cache

from voxml.vocabulary import Lexicon, load_lexicon

from .acts import DialogueAct, Function, NotUnderstood
from .forms import Form, Name, Quantity, Term, Unit, parse_form
from .reader import Reader

__all__ = [
    "DialogueAct",
    "Form",
    "Function",
    "Name",
    "NotUnderstood",
    "Quantity",
    "Term",
    "Unit",
    "parse",
    "parse_form",
]


def parse(text: str, lexicon: Lexicon | None = None) -> tuple[DialogueAct, ...] | NotUnderstood:
    """The acts of an utterance, or where it went wrong.

    The reader for a lexicon is built at its first use (about 0.2 s) and kept.
    """
    return _reader(lexicon or load_lexicon()).read(text)


@lru_cache(maxsize=8)
def _reader(lexicon: Lexicon) -> Reader:
    return Reader(lexicon)

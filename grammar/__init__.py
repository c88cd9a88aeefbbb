"""English in, logical forms out. The grammar never sees the world: a text means the same wherever the robot is."""

from __future__ import annotations

from functools import lru_cache

from voxml.vocabulary import Lexicon, load_lexicon

from .acts import DialogueAct, Function, NotUnderstood
from .forms import Form, Name, Quantity, Term, Unit, parse_form
from .guessing import Proposer
from .mending import Mender
from .reader import Reader

__all__ = [
    "DialogueAct",
    "Form",
    "Function",
    "Name",
    "NotUnderstood",
    "Proposer",
    "Quantity",
    "Term",
    "Unit",
    "parse",
    "parse_form",
]


def parse(
    text: str, lexicon: Lexicon | None = None, language: str = "en", proposer: Proposer | None = None
) -> tuple[DialogueAct, ...] | NotUnderstood:
    """The acts of an utterance, or where it went wrong.

    What the grammar cannot read but may mean stop, stops; where words were repaired, or the reading is one that the
    ``proposer`` guessed, the acts say so, to be confirmed.
    ``language`` names the grammar; the lexicon must be in its words. The reader for a lexicon is built at its first use
    and kept; its grammar is compiled once and kept in the cache folder.
    """
    words = lexicon or load_lexicon()
    reading = _reader(words, language).read(text)
    return _mender(words, language).mend(text, reading, proposer) if isinstance(reading, NotUnderstood) else reading


@lru_cache(maxsize=8)
def _reader(lexicon: Lexicon, language: str) -> Reader:
    return Reader(lexicon, language)


@lru_cache(maxsize=8)
def _mender(lexicon: Lexicon, language: str) -> Mender:
    return Mender(lexicon, _reader(lexicon, language))

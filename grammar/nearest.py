"""The nearest thing Kirby does understand, for an utterance that it does not."""

from __future__ import annotations

from rapidfuzz import fuzz, process

from voxml.vocabulary import Lexicon

SCORE_MIN = 72.0


class Nearest:
    """Compares utterances with the examples of a lexicon (class ``example`` of its words)."""

    def __init__(self, lexicon: Lexicon) -> None:
        self._examples = tuple(lexicon.closed.table("example"))

    def __call__(self, text: str) -> str | None:
        """The example that shares most of its letters and words with the text; None where nothing is alike."""
        found = process.extractOne(text.lower(), self._examples, scorer=fuzz.token_sort_ratio, score_cutoff=SCORE_MIN)
        return None if found is None else found[0]

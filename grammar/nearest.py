"""The nearest thing Kirby does understand, for an utterance that it does not."""

from __future__ import annotations

from collections.abc import Callable

from rapidfuzz import fuzz, process

from voxml.vocabulary import Lexicon

SCORE_MIN = 72.0
PROPOSED_MAX_CHARS = 80


class Nearest:
    """Proposes by one lexicon; ``understands`` tells whether a text can be read as one thing to do or to answer."""

    def __init__(self, lexicon: Lexicon, understands: Callable[[str], bool]) -> None:
        self._understands = understands
        self._known = lexicon.vocabulary()
        self._stand_ins = tuple(lexicon.closed.table("stand_in"))
        self._examples = tuple(lexicon.closed.table("example"))

    def __call__(self, text: str, span: tuple[int, int]) -> str | None:
        """What is understood and nearest to a text that went wrong at the span; None where nothing is alike."""
        return self._alike(text) or self._with_known_word(text, span)

    def _alike(self, text: str) -> str | None:
        """The example that shares most of its letters and words with the text."""
        found = process.extractOne(text.lower(), self._examples, scorer=fuzz.token_sort_ratio, score_cutoff=SCORE_MIN)
        return None if found is None else found[0]

    def _with_known_word(self, text: str, span: tuple[int, int]) -> str | None:
        """The text with a word of Kirby's where a strange one stands: "find the door" for "find the dodecahedron"."""
        start, end = span
        strange = text[start:end].lower()
        if strange in self._known or not strange.isalpha() or len(text) > PROPOSED_MAX_CHARS:
            return None
        words = sorted(self._stand_ins, key=lambda word: word[-1] != strange[-1])  # "doors" for "unicorns"
        proposed = (f"{text[:start]}{word}{text[end:]}" for word in words)
        return next(filter(self._understands, proposed), None)

"""Phrases that are said word for word, such as "i mean" and "can you": found where they begin."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from voxml.words import ClosedClasses


class FixedPhrases:
    """A set of phrases by their first words, the longest first."""

    def __init__(self, phrases: Iterable[tuple[str, ...]]) -> None:
        table: dict[str, list[tuple[str, ...]]] = {}
        for words in phrases:
            table.setdefault(words[0], []).append(words)
        self.first_words = frozenset(table)
        self.last_words = frozenset(words[-1] for found in table.values() for words in found)
        self._table = {first: tuple(sorted(found, key=lambda words: -len(words))) for first, found in table.items()}

    @classmethod
    def of(cls, closed: ClosedClasses, *names: str) -> FixedPhrases:
        """The phrases of closed classes."""
        return cls(word.words for name in names for word in closed.words_of(name))

    def length(self, texts: Sequence[str], at: int) -> int:
        """How many words the longest phrase has that begins at ``at``; 0 for none."""
        if at >= len(texts):
            return 0
        for phrase in self._table.get(texts[at], ()):
            if tuple(texts[at : at + len(phrase)]) == phrase:
                return len(phrase)
        return 0

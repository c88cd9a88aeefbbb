"""Words that were misspelt or misheard: the words of the lexicon that look or sound like them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice, product

import jellyfish
from rapidfuzz import process
from rapidfuzz.distance import OSA

from voxml.vocabulary import Lexicon

WORD_MAX_CHARS = 24
MISSPELT_MAX = 3  # more unknown words than that, and it is another subject rather than bad spelling
CANDIDATES_MAX = 5
PROPOSALS_MAX = 12
_WORD = re.compile(r"[^\W\d_]+(?:'[^\W\d_]+)*")
_SOUND_MIN = 3  # consonants: with fewer every short word sounds like every other


@dataclass(frozen=True, slots=True)
class Misspelt:
    """A word that may not be meant as written, where it stands, and what may be meant, the likeliest first."""

    start: int
    end: int
    candidates: tuple[str, ...]


class Speller:
    """Finds what was meant, among the words of one lexicon."""

    def __init__(self, lexicon: Lexicon) -> None:
        self._words = frozenset(lexicon.vocabulary())
        self._homophones = {word: text.split() for word, text in lexicon.closed.table("homophone").items()}
        self._known = tuple(sorted(word for word in self._words if word.isalpha() and word not in self._homophones))
        self._be = frozenset(lexicon.closed.table("BE"))
        self._by_sound: dict[str, list[str]] = {}
        for word in self._known:
            self._by_sound.setdefault(jellyfish.metaphone(word), []).append(word)

    def proposals(self, text: str) -> Iterator[str]:
        """The text with its doubtful words replaced, the likeliest first; nothing where none is doubtful."""
        found = self._misspelt(text)
        if not found or len(found) > MISSPELT_MAX or not all(each.candidates for each in found):
            return
        choices = product(*(each.candidates for each in found))
        for chosen in islice(choices, PROPOSALS_MAX):
            yield _replaced(text, found, chosen)

    def candidates(self, word: str) -> tuple[str, ...]:
        """What an unknown word may have been meant to be: by its letters first, then by its sound."""
        if not 2 <= len(word) <= WORD_MAX_CHARS:
            return ()
        limit = 1 if len(word) <= 7 else 2  # a slip in a short word, two in a long one
        near = process.extract(word, self._known, scorer=OSA.distance, score_cutoff=limit, limit=None)
        sound = jellyfish.metaphone(word)
        ranked = sorted(
            (distance, sorted(known) != sorted(word), jellyfish.metaphone(known) != sound, known)
            for known, distance, _ in near
            if _is_likely(word, known)
        )
        alike = self._by_sound.get(sound, []) if len(sound) >= _SOUND_MIN else []
        same_start = [each for each in alike if each[0] == word[0] and OSA.distance(each, word) <= 2]
        return tuple(dict.fromkeys([*(found[-1] for found in ranked), *same_start]))[:CANDIDATES_MAX]

    def _misspelt(self, text: str) -> list[Misspelt]:
        lowered = text.lower()
        words = [(match[0], match.start(), match.end()) for match in _WORD.finditer(lowered)]
        unknown = [
            Misspelt(start, end, tuple(self._homophones.get(word, ())) or self.candidates(word))
            for word, start, end in words
            if word not in self._words
        ]
        if unknown or not self._be.isdisjoint(word for word, _, _ in words):
            return unknown  # what says how things are is no order, and known words are taken as they stand
        return [
            Misspelt(start, end, tuple(self._homophones[word]))
            for word, start, end in words
            if word in self._homophones
        ]


def _is_likely(word: str, known: str) -> bool:
    """Letters swapped, left out or doubled; another letter in place of one only inside a word that is long enough."""
    if sorted(word) == sorted(known):
        return True
    return word[0] == known[0] and (len(word) > 3 or (len(word) == 3 and len(known) > 3))


def _replaced(text: str, found: list[Misspelt], chosen: tuple[str, ...]) -> str:
    parts, at = [], 0
    for misspelt, word in zip(found, chosen, strict=True):
        parts += [text[at : misspelt.start], word]
        at = misspelt.end
    return "".join([*parts, text[at:]])

"""Words misheard or misspelt: the known words that look or sound most like them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import islice, product

from rapidfuzz import process
from rapidfuzz.distance import OSA

LIKE_MIN = 0.66
SHORT_CHARS = 4  # shorter words must begin alike
SOUND_LIKE = 0.9
CANDIDATES_MAX = 5
UNKNOWN_MAX = 3
ATTEMPTS_MAX = 16

# Spelling to sound, coarse on purpose: voiced and unvoiced consonants are alike, vowels after the first say nothing
# (after Philips, "Hanging on the Metaphone", Computer Language 7(12), 1990, cut down to what a recogniser confuses).
_SOUNDS = tuple(
    (re.compile(pattern), sound)
    for pattern, sound in (
        (r"^kn|^gn", "n"), (r"^wr", "r"), (r"wh", "w"), (r"ph", "f"), (r"ght", "t"), (r"gh", ""), (r"ck|q|x", "k"),
        (r"c(?=[eiy])", "s"), (r"c", "k"), (r"sch|sh|tch|ch", "j"), (r"z", "s"), (r"v", "f"), (r"d", "t"), (r"b", "p"),
        (r"g", "k"), (r"th", "t"), (r"mb$", "m"), (r"h", ""), (r"(?<=.)[aeiouyw]+", ""), (r"(.)\1+", r"\1"),
    )
)  # fmt: skip


def sound_key(word: str) -> str:
    """A key that words of like sound share: ``right`` and ``write``, ``four`` and ``for``."""
    key = word
    for pattern, sound in _SOUNDS:
        key = pattern.sub(sound, key)
    return "o" + key[1:] if key[:1] in "aeiou" else key


class Repairer:
    """Proposes texts in which single words are replaced by known ones."""

    def __init__(self, vocabulary: frozenset[str], first: frozenset[str]) -> None:
        """``first`` are the words that go before others as much alike."""
        self._first = first
        self._words = tuple(sorted(word for word in vocabulary if word.isalpha() and len(word) > 1))
        self._sounds: dict[str, list[str]] = {}
        for word in self._words:
            self._sounds.setdefault(sound_key(word), []).append(word)

    def proposals(self, texts: Sequence[str], unknown: Sequence[int], furthest: int) -> Iterator[tuple[str, ...]]:
        """Texts to try, the likeliest first: every unknown word replaced, or the known one where reading stopped.

        More than one unknown word in three is another language, not a slip; a known word is only taken for another of the
        same sound.
        """
        if unknown and (len(unknown) > UNKNOWN_MAX or 3 * (len(unknown) - 1) >= len(texts)):
            return
        if unknown:
            choices = [self.like(texts[at], LIKE_MIN) for at in unknown]
            for words in islice(product(*choices), ATTEMPTS_MAX):
                yield _replaced(texts, unknown, words)
            return
        for at in (furthest, furthest - 1):
            if 0 <= at < len(texts):
                for word in self._sounding(texts[at]):
                    yield _replaced(texts, [at], (word,))

    def like(self, word: str, least: float) -> tuple[str, ...]:
        """Known words that look or sound like this one, the most alike first; never the word itself."""
        found = process.extract(
            word, self._words, scorer=OSA.normalized_similarity, score_cutoff=least, limit=2 * CANDIDATES_MAX
        )
        scores = {each: score for each, score, _ in found if len(word) > SHORT_CHARS or each[0] == word[0]}
        for each in self._sounding(word):
            scores[each] = max(scores.get(each, 0.0), (SOUND_LIKE + OSA.normalized_similarity(word, each)) / 2)
        scores.pop(word, None)
        ranked = sorted(
            scores, key=lambda each: (-round(scores[each], 2), each not in self._first, abs(len(each) - len(word)), each)
        )
        return tuple(ranked[:CANDIDATES_MAX])

    def _sounding(self, word: str) -> tuple[str, ...]:
        """Known words of the same sound, to the vowel: "right" for "write"."""
        same = self._sounds.get(sound_key(word), ())
        return tuple(each for each in same if each != word and _first_vowel(each) == _first_vowel(word))


def _first_vowel(word: str) -> str:
    return next((letter for letter in word if letter in "aeiouy"), "")


def _replaced(texts: Sequence[str], places: Sequence[int], words: Sequence[str]) -> tuple[str, ...]:
    changed = list(texts)
    for at, word in zip(places, words, strict=True):
        changed[at] = word
    return tuple(changed)

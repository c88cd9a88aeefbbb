"""Words broken off in the middle: "mo move", "ff four", "ten deg ten feet"; units whose beginning was swallowed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from voxml.words import ClosedClasses

from .known_words import KnownWords
from .tokens import Token

_FRAGMENT_MAX = 3
_CLIPPED_MIN = 4
_SHARED_MIN = 3
_FOLLOWING_MAX = 24


class Fragments:
    """Takes broken-off words out of utterances; ``words`` are those of the same language as ``closed``."""

    def __init__(self, closed: ClosedClasses, words: KnownWords) -> None:
        self._words = words
        self._spoken_units = tuple(sorted(unit for unit in closed.table("unit") if len(unit) > _CLIPPED_MIN))
        self._editing = frozenset(closed.table("edit_weak"))

    def without(self, tokens: Sequence[Token]) -> tuple[list[Token], frozenset[int]]:
        """The tokens without fragments and with units in full, and the offsets (in characters) of those that follow a
        fragment which they do not say in full.
        """
        spoken = [token.text for token in tokens]
        lowered = any(token.written.islower() for token in tokens)
        kept: list[Token] = []
        texts: list[str] = []
        after_fragments: set[int] = set()
        for at, token in enumerate(tokens):
            following = [word for word in spoken[at + 1 : at + 1 + _FOLLOWING_MAX] if word not in self._editing]
            is_letter = lowered and at > 0 and token.written.isupper()  # "the L shape"
            if not is_letter and token.text not in self._editing and self._is_broken_off(token.text, texts, following):
                if following and not following[0].startswith(token.text.rstrip("-")):
                    after_fragments.add(tokens[at + 1].start)
                continue
            whole = self._whole(token.text, following)
            if whole is not None:
                kept.append(token if whole == token.text else replace(token, text=whole))
                texts.append(whole)
        return kept, frozenset(after_fragments)

    def without_beginnings(self, tokens: Sequence[Token]) -> list[Token]:
        """The tokens without the words, known or not, with which the next begins: "for forward", "yo your"."""
        following = [*(token.text for token in tokens[1:]), ""]
        return [
            token
            for token, after in zip(tokens, following, strict=False)
            if token.text in self._editing
            or not _is_beginning(token.text, after)
            or self._words.differ(token.text, after)
        ]

    def _is_broken_off(self, word: str, before: Sequence[str], following: Sequence[str]) -> bool:
        if word.endswith("-"):
            return True
        after = following[0] if following else ""
        counted = bool(before) and self._words.is_number(before[-1])
        if _is_beginning(word, after) and self._parts_amount(word, counted, following):
            return True
        if len(word) == 1 and word.isalpha():
            return self._is_lone_letter(word, counted and not before[-1].isalpha(), counted, following)
        if _is_beginning(word, after) and self._is_said_in_full(word, after, counted):
            return True
        if counted and self._words.is_unit(word):
            return False
        return not self._words.is_word(word) and self._is_dropped(word, before, following)

    def _is_lone_letter(self, word: str, written: bool, counted: bool, following: Sequence[str]) -> bool:
        """A letter that is no word here, as "a", "i", the "t" of "t junction" and the "m" of "10 m" are."""
        after = following[0] if following else ""
        if counted and self._words.is_unit(word):
            said_in_full = _is_beginning(word, after) and (self._words.is_unit(after) or self._words.is_number(after))
            return said_in_full and not (written and self._words.is_number(after))
        if self._words.amounts.may_start(word):
            return False
        return not self._words.begins_phrase([word, *following], 0)

    def _is_said_in_full(self, word: str, after: str, counted: bool) -> bool:
        """Whether the next word, which begins with this one, is this one said in full."""
        if not self._words.is_word(word):
            return True
        if counted and self._words.is_unit(after):
            return True
        if self._words.is_number(word) and self._words.is_number(after):
            return True  # "nine ninety", and "six sixteen" too
        if self._words.is_article(after) or self._words.are_nouns(word, after):
            return True  # "you your", "door doorway"
        return self._words.mean_the_same(word, after)

    def _parts_amount(self, word: str, counted: bool, following: Sequence[str]) -> bool:
        """Whether a word can only be the beginning of the amount behind it, or of its "and": "on one foot"."""
        amounts = self._words.amounts
        if counted and amounts.may_start(word):
            return not amounts.may_start(following[0]) and amounts.may_belong(following[0])
        return not amounts.may_start(word) and amounts.amount(following, 0) is not None

    def _is_dropped(self, word: str, before: Sequence[str], following: Sequence[str]) -> bool:
        """Whether an unknown word was given up for what follows."""
        after = following[0] if following else ""
        begun = list(self._words.beginning_with(word)) if after else []
        if begun and (_shared(word, after) >= _SHARED_MIN or _said_again(before, following)):
            return True
        if begun and self._words.is_number(after) and any(map(self._words.is_number, begun)):
            return True  # "thr four feet"
        if len(word) > _FRAGMENT_MAX:
            return _is_hiss(word)
        return _is_hiss(word) or any(each[0] == word[0] for each in following[:2])

    def _whole(self, word: str, following: Sequence[str]) -> str | None:
        """A unit whose beginning was swallowed ("thirty grees") in full; nothing where it is said again."""
        if len(word) < _CLIPPED_MIN or self._words.is_word(word):
            return word
        whole = next((unit for unit in self._spoken_units if unit.endswith(word)), None)
        if whole is None:
            return word
        return None if following and following[0] == whole else whole


def _is_beginning(word: str, whole: str) -> bool:
    return len(word) < len(whole) and whole.startswith(word) and word.isalpha() and whole.isalpha()


def _shared(word: str, other: str) -> int:
    """How many letters two words have in common at their beginnings."""
    return next(
        (at for at, (one, two) in enumerate(zip(word, other, strict=False)) if one != two), min(len(word), len(other))
    )


def _said_again(before: Sequence[str], following: Sequence[str]) -> bool:
    """Whether what follows repeats the last words before: "turn ri turn left"."""
    return any(list(before[start:]) == list(following[: len(before) - start]) for start in range(len(before)))


def _is_hiss(word: str) -> bool:
    """ "ff", "sss", "thh", "t": no vowel, and drawn out or very short."""
    if any(letter in "aeiouy" for letter in word) or not word.isalpha():
        return False
    return len(word) <= 2 or word[-1] == word[-2]

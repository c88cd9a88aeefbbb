"""Regular English inflection by rule (Quirk et al., A Comprehensive Grammar, ch. 3 and 5); entries tell the rest."""

from __future__ import annotations

import re
from collections.abc import Mapping

from .schema import FormKind

_SIBILANT = re.compile(r".*(s|x|z|ch|sh)$")
_CONSONANT_Y = re.compile(r".*[^aeiou]y$")
# One short vowel and one consonant at the end of a word of one syllable: the consonant is doubled (stop, stopping).
_DOUBLING = re.compile(r"[^aeiou]*[aeiou][^aeiouwxy]$")

Irregular = Mapping[tuple[str, FormKind], str]


def inflect(word: str, kind: FormKind, irregular: Irregular) -> str:
    """The inflected form of a word of one or several words; in a verb of several words the first is inflected.

    ``irregular`` maps a word (all of it, or the one that is inflected) and a kind to its spelt-out form.
    """
    if (word, kind) in irregular:
        return irregular[word, kind]
    words = word.split()
    at = -1 if kind is FormKind.PLURAL else 0
    words[at] = irregular.get((words[at], kind)) or _RULES[kind](words[at])
    return " ".join(words)


def _plural(word: str) -> str:
    if _SIBILANT.match(word):
        return word + "es"
    return word[:-1] + "ies" if _CONSONANT_Y.match(word) else word + "s"


def _ing(word: str) -> str:
    if word.endswith("ie"):
        return word[:-2] + "ying"
    if word.endswith("e") and not word.endswith("ee"):
        return word[:-1] + "ing"
    return _doubled(word) + "ing"


def _past(word: str) -> str:
    if word.endswith("e"):
        return word + "d"
    return word[:-1] + "ied" if _CONSONANT_Y.match(word) else _doubled(word) + "ed"


def _comparative(word: str) -> str:
    if word.endswith("e"):
        return word + "r"
    return word[:-1] + "ier" if _CONSONANT_Y.match(word) else _doubled(word) + "er"


def _superlative(word: str) -> str:
    return _comparative(word)[:-1] + "st"


def _doubled(word: str) -> str:
    return word + word[-1] if _DOUBLING.fullmatch(word) else word


_RULES = {
    FormKind.PLURAL: _plural,
    FormKind.THIRD: _plural,
    FormKind.ING: _ing,
    FormKind.PAST: _past,
    FormKind.PARTICIPLE: _past,
    FormKind.COMPARATIVE: _comparative,
    FormKind.SUPERLATIVE: _superlative,
}

"""Text -> tokens: words and marks with their places, contractions spelt out, fillers and stutters taken out."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from voxml.words import ClosedClasses

_TOKEN = re.compile(
    r"[0-9]+/[1-9][0-9]*|[0-9]*\.?[0-9]+"  # a half may be written 1/2
    r"|[^\W\d_]+(?:'[^\W\d_]+)*(?:-(?=\s|$))?"  # a word; cut off where a hyphen ends it
    r"|(?<![\w.])-(?=[0-9.])|\.{2,}|[°\"',.;:!?…]"
)
_QUOTES = str.maketrans({"\u2018": "'", "\u2019": "'", "\u201c": '"', "\u201d": '"', "\u2212": "-", "\u2013": "-"})
_PAUSES = frozenset({"...", "\u2026"})
MARKS = frozenset({",", ";", ":", ".", "!", "?"})


@dataclass(frozen=True, slots=True)
class Token:
    """A word as the grammar reads it, and where it stands in the utterance (character offsets, end exclusive)."""

    text: str
    start: int
    end: int


class Tokenizer:
    """Splits utterances with the words of one language."""

    def __init__(self, closed: ClosedClasses, is_word: Callable[[str], bool]) -> None:
        self._contractions = {word: text.split() for word, text in closed.table("contraction").items()}
        self._fillers = frozenset(closed.table("filler"))
        self._numbers = frozenset(closed.table("number")) | frozenset(closed.table("multiplier"))
        self._is_word = is_word

    def __call__(self, text: str) -> tuple[Token, ...]:
        """The tokens of an utterance, without what is noise: fillers, pauses, words said twice or broken off."""
        return self._fluent([token for token in self._split(text) if token.text not in self._fillers])

    def _split(self, text: str) -> list[Token]:
        tokens: list[Token] = []
        for match in _TOKEN.finditer(text.lower().translate(_QUOTES)):
            word, start, end = match[0], match.start(), match.end()
            if word in _PAUSES or word.strip(".") == "" and len(word) > 1:
                continue
            if word == "-":
                word = "minus"
            for part in self._contractions.get(word, (word,)):
                tokens.append(Token(part, start, end))
        return tokens

    def _fluent(self, tokens: list[Token]) -> tuple[Token, ...]:
        kept: list[Token] = []
        for index, token in enumerate(tokens):
            following = tokens[index + 1].text if index + 1 < len(tokens) else ""
            if self._is_broken_off(token.text, following):
                continue
            kept.append(token)
            self._drop_repeat(kept)
        return tuple(kept)

    def _is_broken_off(self, word: str, following: str) -> bool:
        """ "for- forward", "mo move": what was begun is said in full at once."""
        if word.endswith("-"):
            return True
        return not self._is_word(word) and len(following) > len(word) and following.startswith(word)

    def _drop_repeat(self, kept: list[Token]) -> None:
        """Take out the first of two equal runs of words: "turn turn left", "go to the go to the door"."""
        for length in (4, 3, 2, 1):
            run = kept[-length:]
            if len(kept) >= 2 * length and _texts(kept[-2 * length : -length]) == _texts(run) and self._may_drop(run):
                del kept[-2 * length : -length]
                return

    def _may_drop(self, run: Sequence[Token]) -> bool:
        """Not "no no", which means something else than "no", nor digits said one by one."""
        texts = _texts(run)
        return not any(text in self._numbers or text[0].isdigit() or text in MARKS or text == "no" for text in texts)


def _texts(tokens: Sequence[Token]) -> list[str]:
    return [token.text for token in tokens]

"""Text -> tokens: words and marks with their places, contractions spelt out."""

from __future__ import annotations

import re
from dataclasses import dataclass

from voxml.words import ClosedClasses

_TOKEN = re.compile(
    r"(?<![0-9.])\"[^\W\d_][^\"]{0,60}\""  # a quoted name
    r"|[0-9]+(?:st|nd|rd|th)\b"
    r"|[0-9]+/[1-9][0-9]*|[0-9]*\.?[0-9]+|[½¼¾⅓⅔⅛]"  # a half may be written 1/2
    r"|[^\W\d_]+(?:'[^\W\d_]+)*(?:-(?=\s|$))?"  # a word; cut off where a hyphen ends it
    r"|(?<![\w.])-(?=[0-9.])|\.{2,}|[°\"',.;:!?…]"
)
_QUOTES = str.maketrans({"\u2018": "'", "\u2019": "'", "\u201c": '"', "\u201d": '"', "\u2212": "-", "\u2013": "-"})
_FRACTIONS = {"½": "1/2", "¼": "1/4", "¾": "3/4", "⅓": "1/3", "⅔": "2/3", "⅛": "1/8"}
_PAUSES = frozenset({"...", "\u2026"})
FULL_STOPS = frozenset({".", "!", "?"})
MARKS = FULL_STOPS | {",", ";", ":"}


@dataclass(frozen=True, slots=True)
class Token:
    """A word as the grammar reads it, where it stands in the utterance (character offsets, end exclusive), and how."""

    text: str
    start: int
    end: int
    written: str = ""


class Tokenizer:
    """Splits utterances with the words of one language."""

    def __init__(self, closed: ClosedClasses) -> None:
        self._contractions = {word: text.split() for word, text in closed.table("contraction").items()}

    def __call__(self, text: str) -> list[Token]:
        """The words and marks of an utterance in order; pauses ("...") are none."""
        tokens: list[Token] = []
        spoken = text.lower().translate(_QUOTES)
        for match in _TOKEN.finditer(spoken):
            word, start, end = match[0], match.start(), match.end()
            if word in _PAUSES or (len(word) > 1 and not word.strip(".")):
                continue
            written = text[start:end]
            word = "minus" if word == "-" else _FRACTIONS.get(word, word)
            parts = self._contractions.get(word)
            if parts is None or (_begins_next(word, spoken, end) and not parts[0].startswith(word)):
                tokens.append(Token(word, start, end, written))
            else:
                tokens.extend(Token(part, start, end, written) for part in parts)
        return tokens


def _begins_next(word: str, spoken: str, end: int) -> bool:
    """Whether the word that ends there is the beginning of the next: "(take an) im image" has no "i'm"."""
    rest = end + 1 + len(word)
    return spoken.startswith(word, end + 1) and spoken[rest : rest + 1].isalpha()

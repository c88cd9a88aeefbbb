"""Whether words that cannot be read may mean stop: then the robot stops, whatever else they mean."""

from __future__ import annotations

import re
from collections.abc import Sequence

from voxml.vocabulary import Lexicon

_WORD = re.compile(r"[^\W\d_]+(?:'[^\W\d_]+)*|[?]")


class Stopping:
    """Looks for words that stop or call off, of one lexicon."""

    def __init__(self, lexicon: Lexicon) -> None:
        closed = lexicon.closed
        self._words = frozenset(closed.table("stop_word"))
        self._phrases = tuple(word.words for word in closed.words_of("stop_phrase"))
        self._not = frozenset(closed.table("no_stop"))
        self._determiners = frozenset(closed.table("stop_object"))
        self._own = frozenset(closed.table("stop_own"))

    def may_be_meant(self, text: str) -> bool:
        """A word or phrase that stops, neither denied, asked about, told of, nor with others' things for its object."""
        words = _WORD.findall(text.lower())
        at = next((at for at in range(len(words)) if words[at] in self._words or self._phrase(words, at)), None)
        if at is None or words[-1] == "?" or not self._not.isdisjoint(words[:at]):
            return False
        return self._phrase(words, at) > 0 or not self._has_object(words[at + 1 :])

    def _phrase(self, words: Sequence[str], at: int) -> int:
        """How long a phrase that begins here is, 0 for none."""
        return next((len(each) for each in self._phrases if tuple(words[at : at + len(each)]) == each), 0)

    def _has_object(self, rest: Sequence[str]) -> bool:
        """ "stop the music", but not "stop the robot" nor "cancel the last command"."""
        named = len(rest) > 1 and rest[0] in self._determiners and rest[1] not in self._determiners
        return named and self._own.isdisjoint(rest)

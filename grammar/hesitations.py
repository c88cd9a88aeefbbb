"""Hesitations: filled pauses ("uh"), words drawn out ("leeeft"), and phrases that only keep the turn ("like")."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from voxml.words import ClosedClasses

from .fixed_phrases import FixedPhrases
from .known_words import KnownWords
from .tokens import MARKS, Token

_DRAWN_OUT = re.compile(r"([^\W\d_])\1{2,}")
_COMMAS = frozenset({",", "-"})
_DOUBLED = re.compile(r"([^\W\d_])\1+")


class Hesitations:
    """Takes hesitations out of utterances; ``words`` are those of the same language as ``closed``."""

    def __init__(self, closed: ClosedClasses, words: KnownWords) -> None:
        self._words = words
        self._filled = frozenset(_DOUBLED.sub(r"\1", filler) for filler in words.fillers)
        self.editing = words.fillers & closed.table("edit_weak").keys()
        self._discourse = FixedPhrases.of(closed, "discourse")
        self._interrupting = self._discourse.last_words | _COMMAS
        self.last_words = words.fillers | self._discourse.last_words

    def without(self, tokens: Sequence[Token]) -> tuple[list[Token], frozenset[int]]:
        """The tokens without filled pauses, and the offsets (in characters) of those that follow one."""
        texts = [token.text for token in tokens]
        kept: list[Token] = []
        after_pauses: set[int] = set()
        for at, token in enumerate(tokens):
            if not self._is_filled_pause(texts, at):
                kept.append(self._as_known(token))
            elif at + 1 < len(tokens):
                after_pauses.add(tokens[at + 1].start)
        return self._amounts_closed(kept), frozenset(after_pauses)

    def is_filled_pause(self, word: str) -> bool:
        """ "uh", "errr", "hmm"; "mm" is one too, unless it closes an amount."""
        if word in self._words.fillers:
            return True
        return not self._words.is_word(word) and len(word) > 1 and _DOUBLED.sub(r"\1", word) in self._filled

    def _is_filled_pause(self, texts: Sequence[str], at: int) -> bool:
        word = texts[at]
        if not self.is_filled_pause(word) or self._words.begins_phrase(texts, at, length=2):
            return False
        if at and self._words.is_unit(word) and self._closes_amount(texts, at):
            return False
        return not (word in self.editing and self._may_repair(texts, at))

    def _closes_amount(self, texts: Sequence[str], at: int) -> bool:
        """Whether what may be a pause is the unit: "ten mm", but not "ten mm feet"."""
        if texts[at - 1][-1].isdigit():
            return True
        following = next((text for text in texts[at + 1 :] if not self.is_filled_pause(text)), "")
        return self._words.is_number(texts[at - 1]) and not self._words.is_unit(following)

    def _may_repair(self, texts: Sequence[str], at: int) -> bool:
        """Whether "er" may be an editing term, as in "left er right"; "back er up" is one verb, and numbers add up."""
        before = [text for text in texts[:at] if text not in MARKS]
        after = [text for text in texts[at + 1 :] if text not in MARKS]
        if not before or not after or self._words.is_phrase((before[-1], after[0]), "VERB"):
            return False
        if self._words.is_number(after[0]):
            return False
        if any(before[start : start + 2] == after[:2] for start in range(len(before) - 1)):
            return True  # "turn right ninety er turn right eighty"
        alike = self._words.kinds(before, len(before) - 1) & self._words.kinds(after, 0)
        return not alike <= {"VERB"}

    def _as_known(self, token: Token) -> Token:
        """A word that was drawn out, as it is known: "sssstop", "leeeft"."""
        word = token.text
        if self._words.is_word(word) or not _DRAWN_OUT.search(word):
            return token
        shortened = (_DRAWN_OUT.sub(r"\1\1", word), _DRAWN_OUT.sub(r"\1", word))
        known = next((each for each in shortened if len(each) > 1 and self._words.is_word(each)), word)
        return replace(token, text=known)

    # ------------------------------------------------------------ phrases that keep the turn
    def _amounts_closed(self, tokens: list[Token]) -> list[Token]:
        """Amounts without what interrupts them: "ten like feet", "a hundred okay and eighty degrees"."""
        texts = [token.text for token in tokens]
        at = 1 if not self._interrupting.isdisjoint(texts) else len(texts)
        while at < len(tokens) - 1:
            end = self._past_discourse(texts, at)
            if at < end < len(texts) and self._interrupts_amount(texts, at, end):
                del tokens[at:end], texts[at:end]
            else:
                at += 1
        return tokens

    def _past_discourse(self, texts: Sequence[str], at: int) -> int:
        """Behind all that only keeps the turn from ``at`` on, and behind the comma of "two, meters"."""
        if texts[at] in _COMMAS and self._words.is_unit(texts[at + 1]):
            return at + 1
        while length := self._discourse.length(texts, at):
            at += length
        return at

    def _interrupts_amount(self, texts: Sequence[str], start: int, end: int) -> bool:
        """Whether the number before ``start`` goes on at ``end``, or its unit stands there."""
        amounts = self._words.amounts
        begin = start
        while begin and amounts.may_belong(texts[begin - 1]):
            begin -= 1
        closed = [*texts[begin:start], *texts[end:]]
        for first in range(start - begin):
            found = amounts.amount(closed, first) or amounts.numbers.number(closed, first)
            if found is not None:
                return found[1] > start - begin
        return False

    def without_discourse(self, tokens: Sequence[Token]) -> list[Token]:
        """The tokens without any phrase that may only keep the turn, and without any filled pause."""
        texts = [token.text for token in tokens]
        kept: list[Token] = []
        at = 0
        while at < len(tokens):
            length = self._discourse.length(texts, at)
            if not length and not self.is_filled_pause(texts[at]):
                kept.append(tokens[at])
            at += length or 1
        return kept

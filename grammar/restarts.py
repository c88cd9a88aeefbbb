"""Words said again: repeats ("turn turn left") and restarts ("turn to your, uh, turn to your right").

In Shriberg's terms the repair begins with the whole reparandum: what stands from where it began up to where it is said
again goes, with whatever was said in between.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

from .editing import EditingTerms
from .known_words import KnownWords
from .tokens import FULL_STOPS, MARKS, Token

REPARANDUM_MAX = 24
_PASSES_MAX = 3


class Break(IntEnum):
    """How sure it is that speech broke off between two words, by what was heard between them."""

    NONE = 0
    PAUSE = 1  # a filled pause
    FRAGMENT = 2  # a word that was broken off, and is not said in full behind it
    EDIT = 3  # an editing term


@dataclass(frozen=True, slots=True)
class Again:
    """Words ``[start, at)`` that are said again from ``resume`` on, and how surely they broke off."""

    start: int
    at: int
    resume: int
    broken: Break

    @property
    def length(self) -> int:
        return self.at - self.start


class Restarts:
    """Takes out what is said again, with the words of one language."""

    def __init__(self, words: KnownWords, terms: EditingTerms) -> None:
        self._words = words
        self._terms = terms

    def without(self, tokens: list[Token], breaks: dict[int, Break]) -> list[Token]:
        """The tokens without the first of two sayings; ``breaks`` by the offset of the token behind each."""
        for _ in range(_PASSES_MAX):
            if len({token.text for token in tokens}) == len(tokens) or not self._take_out(tokens, breaks):
                break
        return tokens

    def _take_out(self, tokens: list[Token], breaks: dict[int, Break]) -> bool:
        """Whether anything was said again; it is taken out of ``tokens``."""
        texts = [token.text for token in tokens]
        said = len(texts)
        at = 1
        while at < len(texts):
            again = self._said_again(texts, at, breaks.get(tokens[at].start, Break.NONE))
            if again is None:
                at += 1
            else:
                del tokens[again.start : again.resume], texts[again.start : again.resume]
                at = max(again.start, 1)
        return len(texts) < said

    def _said_again(self, texts: Sequence[str], at: int, broken: Break) -> Again | None:
        """What is given up before ``at``, if anything is."""
        resume = self._terms.end(texts, at)
        found = None
        if at < resume < len(texts):
            found = self._restart(texts, at, resume, Break.EDIT)
        return found or self._restart(texts, at, at, broken)

    def _restart(self, texts: Sequence[str], at: int, resume: int, broken: Break) -> Again | None:
        """The longest words before ``at`` that are said again from ``resume`` on and were given up."""
        earliest = max(0, at - REPARANDUM_MAX, at - (len(texts) - resume))
        for start in (start for start in range(earliest, at) if texts[start] == texts[resume]):
            again = Again(start, at, resume, broken)
            if self._is_begun(texts, again) and self._is_given_up(texts, again):
                return again
        return None

    def _is_begun(self, texts: Sequence[str], again: Again) -> bool:
        """Whether the words are the same, the last as far as it was said: "move for move forward"."""
        end = again.resume + again.length - 1
        if list(texts[again.start : again.at - 1]) != list(texts[again.resume : end]):
            return False
        last, full = texts[again.at - 1], texts[end]
        if last == full or again.length == 1:
            return last == full
        cut_off = last.isalpha() and full.startswith(last)
        return cut_off and (again.broken > Break.NONE or not self._words.differ(last, full))

    def _is_given_up(self, texts: Sequence[str], again: Again) -> bool:
        """Whether the words were only begun, and are not to be done twice."""
        run = texts[again.start : again.at]
        if run[0] in MARKS or not FULL_STOPS.isdisjoint(run) or all(map(self._words.refuses, run)):
            return False  # "no no" is more than "no"
        if again.length == 1 and self._words.is_number(run[0]):
            return again.broken > Break.NONE or self._is_number_repeated(texts, again.start, again.resume)
        if again.broken >= Break.FRAGMENT or run[-1] != texts[again.resume + again.length - 1]:
            return True
        joins = [at for at in range(again.length) if self._words.joins(texts, again.resume + at)]
        if len(joins) == again.length:
            return True  # "and and"
        joins = [at for at in joins if not self._words.is_idle(run[at])]
        if not joins:
            return self._clauses(run) <= 1
        return self._is_joined_and_begun(texts, again, joins)

    def _is_joined_and_begun(self, texts: Sequence[str], again: Again, joins: Sequence[int]) -> bool:
        """ "and move, uh, and move up": not to be confused with "(turn left) and move and move up"."""
        run = texts[again.start : again.at]
        opening = next((at for at, word in enumerate(run) if at not in joins and not self._words.is_idle(word)), 0)
        if joins[-1] > opening or self._clauses(run) > 1:
            return False  # "go forward and, uh, go forward and turn"
        broken = again.broken > Break.NONE or again.start == 0 or self._is_unfinished(run)
        return broken and self._goes_on(texts, again.resume + again.length)

    def _is_unfinished(self, run: Sequence[str]) -> bool:
        """Whether the words end with a bare verb or number, or with one that leaves a phrase open."""
        last = len(run) - 1
        words = self._words
        return words.is_open(run[last]) or words.is_number(run[last]) or self._begins_clause(run, last)

    def _clauses(self, run: Sequence[str]) -> int:
        """How many clauses the words are at least: verbs that are no directions, as "back" is one."""
        return sum(self._begins_clause(run, at) for at in range(len(run)))

    def _begins_clause(self, texts: Sequence[str], at: int) -> bool:
        return self._words.is_verb(texts, at) and self._words.kind(texts, at) != "direction"

    def _goes_on(self, texts: Sequence[str], at: int) -> bool:
        """Whether what is said again says more than the first time."""
        if at >= len(texts) or self._begins_clause(texts, at):
            return False
        return self._words.kind(texts, at) is not None or self._words.is_thing(texts, at)

    def _is_number_repeated(self, texts: Sequence[str], first: int, second: int) -> bool:
        """ "five five feet", "forty five five degrees"; but not digits said one by one, nor the two of a point."""
        words = self._words
        if not texts[first].isalpha() or words.amounts.numbers.is_spelt(texts, first):
            return False
        if first and words.is_number(texts[first - 1]):
            return True
        if second + 1 < len(texts):
            return words.is_unit(texts[second + 1]) or words.amounts.may_belong(texts[second + 1])
        return first > 0 and not words.is_open(texts[first - 1]) and words.kind(texts, first - 1) != "thing"

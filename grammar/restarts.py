"""Words said again: repeats ("turn turn left") and restarts ("turn to your, uh, turn to your right").

In Shriberg's terms the repair begins with the whole reparandum: what stands from where it began up to where it is said
again goes, with whatever was said in between.
"""

from __future__ import annotations

from collections.abc import Sequence

from .editing import EditingTerms
from .known_words import KnownWords
from .tokens import MARKS, Token

REPARANDUM_MAX = 24
_LEAD_MAX = 8


class Restarts:
    """Takes out what is said again, with the words of one language."""

    def __init__(self, words: KnownWords, terms: EditingTerms) -> None:
        self._words = words
        self._terms = terms

    def without(self, tokens: list[Token], halted: frozenset[int]) -> list[Token]:
        """The tokens without the first of two sayings; ``halted`` are the places that follow a filled pause."""
        texts = [token.text for token in tokens]
        at = 1 if len(set(texts)) < len(texts) else len(texts)
        while at < len(tokens):
            start, resume = self._said_again(texts, at, tokens[at].start in halted)
            if start < resume:
                del tokens[start:resume], texts[start:resume]
                at = max(start, 1)
            else:
                at += 1
        return tokens

    def _said_again(self, texts: Sequence[str], at: int, halted: bool) -> tuple[int, int]:
        """Where what is given up before ``at`` began, and where it is said again; twice ``at`` where it is not."""
        resume = self._terms.end(texts, at)
        if at < resume < len(texts):
            start = self._restart(texts, at, resume, edited=True)
            if start is not None:
                return start, resume
        start = self._restart(texts, at, at, edited=False, halted=halted)
        if start is None:
            start = self._request_again(texts, at)
        if start is None:
            start = self._clause_again(texts, at)
        return (at, at) if start is None else (start, at)

    def _restart(self, texts: Sequence[str], at: int, resume: int, edited: bool, halted: bool = False) -> int | None:
        """From where on the words before ``at`` are those from ``resume`` on, the last perhaps not said in full."""
        for start in range(max(0, at - REPARANDUM_MAX, at - (len(texts) - resume)), at):
            if texts[start] != texts[resume] or not _is_begun(texts, start, at, resume):
                continue
            if at - start == 1 and self._words.is_number(texts[start]):
                if edited or halted or self._is_number_repeated(texts, start, resume):
                    return start
            elif self._is_given_up(texts, start, at, resume, edited, halted):
                return start
        return None

    def _is_given_up(self, texts: Sequence[str], start: int, at: int, resume: int, edited: bool, halted: bool) -> bool:
        """Whether the words from ``start`` to ``at`` were only begun, and are not to be done twice."""
        run = texts[start:at]
        if run[0] in MARKS or run == ["no"] or "." in run:
            return False
        length = at - start
        joins = [index for index in range(length) if self._words.joins(texts, resume + index)]
        if len(joins) == length:
            return True  # "and and"
        if length - 1 in joins:
            return False  # "go forward and (uh) go forward and ..."
        clauses = self._clauses(run)
        if edited or (halted and clauses <= 1 and not joins):
            return True
        if joins and (joins != [0] or not (halted or start == 0)):
            return False
        return clauses <= 1 and (not joins or self._goes_on(texts, resume + length))

    def _clauses(self, run: Sequence[str]) -> int:
        """How many clauses the words are at least: verbs that are no directions, as "back" is one."""
        return sum(self._words.is_verb(run, at) and self._words.kind(run, at) != "direction" for at in range(len(run)))

    def _goes_on(self, texts: Sequence[str], at: int) -> bool:
        """Whether what is said again says more than the first time."""
        return at < len(texts) and self._words.kind(texts, at) is not None and not self._words.begins_clause(texts, at)

    def _is_number_repeated(self, texts: Sequence[str], first: int, second: int) -> bool:
        """ "five five feet", "forty five five degrees"; but not digits said one by one, nor the two of a point."""
        words = self._words
        if not texts[first].isalpha() or words.amounts.numbers.is_spelt(texts, first):
            return False
        after = texts[second + 1] if second + 1 < len(texts) else ""
        in_longer = first > 0 and words.is_number(texts[first - 1])
        return in_longer or (after != "" and (words.is_unit(after) or words.amounts.may_belong(after)))

    def _request_again(self, texts: Sequence[str], at: int) -> int | None:
        """ "can you move can you turn": a request that begins anew, with at most one word said of the first."""
        leads = self._words.leads
        if leads.length(texts, at) == 0 or self._words.joins(texts, at - 1) or self._words.denies(texts[at - 1]):
            return None
        for start in range(max(0, at - _LEAD_MAX), at - 1):
            length = leads.length(texts, start)
            if length > 1 and at - length - start in (0, 1):
                return start
        return None

    def _clause_again(self, texts: Sequence[str], at: int) -> int | None:
        """ "go to the go forward", "move forward three move forward four feet": the verb again, where the first
        clause still lacks a noun or a unit."""
        if not self._words.begins_clause(texts, at):
            return None
        start = next(
            (index for index in range(at - 2, max(-1, at - REPARANDUM_MAX), -1) if texts[index] == texts[at]), None
        )
        if start is None or (start and not self._words.joins(texts, start - 1)):
            return None
        breaks_off = self._words.is_open(texts[at - 1]) and not self._words.is_thing(texts, at)
        return start if breaks_off or self._counts_anew(texts, start, at) else None

    def _counts_anew(self, texts: Sequence[str], start: int, at: int) -> bool:
        """Whether the clause from ``start`` ends with a number, and the one from ``at`` has one with a unit there."""
        amounts = self._words.amounts
        for index in range(start + 1, at):
            number = amounts.numbers.number(texts, index)
            if number is not None:
                again = at + index - start
                same = list(texts[start:index]) == list(texts[at:again])
                return same and number[1] == at and amounts.amount(texts, again) is not None
        return False


def _is_begun(texts: Sequence[str], start: int, at: int, resume: int) -> bool:
    """Whether the words from ``start`` to ``at`` are those from ``resume`` on, the last as far as it was said."""
    length = at - start
    if list(texts[start : at - 1]) != list(texts[resume : resume + length - 1]):
        return False
    last, full = texts[at - 1], texts[resume + length - 1]
    return last == full or (length > 1 and last.isalpha() and full.startswith(last))

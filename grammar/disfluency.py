"""Disfluencies taken out before parsing: fillers, broken-off words, repeats, restarts, repairs with an editing term.

A repair is reparandum, interregnum, repair (Shriberg 1994, Preliminaries to a Theory of Speech Disfluencies): in "turn
left forty, I mean, fifty degrees" the reparandum "forty" begins at the nearest word of the kind with which the repair
begins.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from voxml.vocabulary import Lexicon

from .amounts import AmountReader
from .tokens import MARKS, Token

_CLAUSE = frozenset({"VERB", "VERB_ING", "LIGHT", "LEAD", "LEAD_ING", "LEAD_TO"})
_DIRECTION = frozenset({"SIDE", "AXIS", "HEADING", "TO_THE", "OPPOSITE"})
_RELATION = frozenset({"PATH", "LOC"})
_THING = frozenset({"NOUN", "NOUNS", "ADJECTIVE", "ORDINAL", "DETERMINER", "DEMONSTRATIVE", "SIDE_ADJ"})
_CLEAVE = frozenset({"AND", "THEN", "BUT"})
_RUN_MAX = 5
_FRAGMENT_MAX = 3
_CLIPPED_MIN = 4


class Fluency:
    """Cleans the tokens of utterances with the words of one language."""

    def __init__(self, lexicon: Lexicon, amounts: AmountReader) -> None:
        closed = lexicon.closed
        self._lexicon = lexicon
        self._amounts = amounts
        self._numbers = amounts.numbers
        self.vocabulary = lexicon.vocabulary() - frozenset(closed.table("filler")) | _number_words(lexicon)
        self._fillers = frozenset(closed.table("filler"))
        self._strong = _phrases(lexicon, "edit")
        self._trailing = _phrases(lexicon, "edit_trailing")
        self._weak = _phrases(lexicon, "edit_weak")
        self._spoken_units = tuple(sorted(unit for unit in closed.table("unit") if len(unit) > _CLIPPED_MIN))
        self._leads = _phrases(lexicon, "LEAD")
        self._joining = frozenset(closed.table("AND")) | frozenset(closed.table("THEN"))

        self._fluent = self._never_disfluent()

    def _never_disfluent(self) -> frozenset[str]:
        """Words that, each said once, need no mending."""
        openers = {*self._strong, *self._weak, *self._trailing}
        numbers = {word for word in self.vocabulary if self._is_number(word)}
        begun = {word for word in numbers for other in numbers if other != word and other.startswith(word)}
        return frozenset(
            word for word in self.vocabulary - openers - begun - self._fillers if len(word) > 1 or word == "a"
        )

    def is_word(self, word: str) -> bool:
        return word in self.vocabulary or word in MARKS or word[0].isdigit() or self._amounts.may_start(word)

    def clean(self, tokens: Sequence[Token]) -> tuple[tuple[Token, ...], bool]:
        """The tokens as they were meant, and whether they begin by taking something back ("no, I mean ...")."""
        texts = [token.text for token in tokens]
        if self._fluent.issuperset(texts) and len(set(texts)) == len(texts):
            return tuple(tokens), False
        kept = self._without_noise(tokens)
        kept, corrects = self._leading_edit(self._without_trailing_edit(kept))
        kept = self._repaired(kept)
        return tuple(self._without_restarts(self._without_repeats(kept))), corrects

    # ------------------------------------------------------------ words that are none
    def _without_noise(self, tokens: Sequence[Token]) -> list[Token]:
        kept: list[Token] = []
        for index, token in enumerate(tokens):
            if self._is_filler(tokens, index) or self._is_broken_off(tokens, index, kept):
                continue
            whole = self._whole(token, tokens, index)
            if whole is not None:
                kept.append(whole)
        return kept

    def _is_filler(self, tokens: Sequence[Token], at: int) -> bool:
        """A hesitation; but "er" may be an editing term ("forty er ninety"), which is seen later."""
        word = tokens[at].text
        if word in self._fillers and at and self._amounts.is_unit(word) and tokens[at - 1].text[-1].isdigit():
            return False
        return word in self._fillers and not (word in self._weak and 0 < at < len(tokens) - 1)

    def _is_broken_off(self, tokens: Sequence[Token], at: int, kept: Sequence[Token]) -> bool:
        """ "for- forward", "mo move", "ff four", "tas take": a beginning that is said again in full."""
        word = tokens[at].text
        if word.endswith("-"):
            return True
        if kept and self._amounts.is_unit(word) and self._is_number(kept[-1].text):
            return False
        if len(word) == 1 and word.isalpha() and (not kept or not self._is_number(kept[-1].text)):
            return not self._begins_phrase(tokens, at)
        following = [token.text for token in tokens[at + 1 : at + 3] if token.text not in self._fillers]
        if any(len(each) > len(word) and each.startswith(word) for each in following[:1]) and not self._numbers_apart(
            word, following[0]
        ):
            return not self.is_word(word) or self._is_cut_number(word, following[0])
        if self.is_word(word) or len(word) > _FRAGMENT_MAX:
            return _is_hiss(word) and not self.is_word(word)
        return len(word) == 1 or _is_hiss(word) or any(each[0] == word[0] for each in following)

    def _begins_phrase(self, tokens: Sequence[Token], at: int) -> bool:
        """Whether a letter is a word here: "a", "i", "t junction"."""
        word = tokens[at].text
        texts = tuple(token.text for token in tokens[at : at + 8])
        if self._amounts.may_start(word):
            return True
        return any(texts[: len(sense.words)] == sense.words for sense in self._lexicon.senses(word))

    def _numbers_apart(self, word: str, following: str) -> bool:
        return word[0].isdigit() or not word.isalpha() or not following.isalpha()

    def _is_cut_number(self, word: str, following: str) -> bool:
        """ "nine ninety" and "for forty": a number begun; "six sixteen" is taken as begun again too."""
        return self._is_number(following) and self._is_number(word) and word not in ("a", "an", "one", "two")

    def _is_number(self, word: str) -> bool:
        return self._numbers.is_number_word(word)

    def _whole(self, token: Token, tokens: Sequence[Token], at: int) -> Token | None:
        """A unit whose beginning was swallowed ("thirty grees") in full; nothing where it is said again."""
        word = token.text
        if len(word) < _CLIPPED_MIN or self.is_word(word):
            return token
        whole = next((unit for unit in self._spoken_units if unit.endswith(word)), None)
        if whole is None:
            return token
        said_again = at + 1 < len(tokens) and tokens[at + 1].text == whole
        return None if said_again else replace(token, text=whole)

    # ------------------------------------------------------------ editing terms
    def _leading_edit(self, tokens: list[Token]) -> tuple[list[Token], bool]:
        at = 0
        while at < len(tokens):
            if tokens[at].text in MARKS:
                at += 1
                continue
            length = self._match(self._strong, tokens, at) or self._weak_before_strong(tokens, at)
            if not length or all(token.text in ("no", *MARKS) for token in tokens[at + length :]):
                break
            at += length
        corrects = any(token.text not in MARKS for token in tokens[:at])
        return (tokens[at:] if corrects else tokens), corrects

    def _weak_before_strong(self, tokens: Sequence[Token], at: int) -> int:
        """How long the "no," of "no, I mean" is."""
        length = self._match(self._weak, tokens, at)
        end = at + length
        while length and end < len(tokens) and tokens[end].text in MARKS:
            end += 1
        return end - at if length and self._match(self._strong, tokens, end) else 0

    def _without_trailing_edit(self, tokens: list[Token]) -> list[Token]:
        """ "left, I said" and "the red one, I mean" take nothing back."""
        for at in range(max(1, len(tokens) - 3), len(tokens)):
            if at + self._match(self._trailing, tokens, at) == len(tokens):
                return tokens[:at]
        return tokens

    def _repaired(self, tokens: list[Token]) -> list[Token]:
        at = 1
        while at < len(tokens):
            strong = self._match(self._strong, tokens, at)
            length = strong or self._match(self._weak, tokens, at)
            mended = self._mend(tokens, at, at + length, bool(strong)) if length else None
            if mended is None:
                at += 1
            else:
                tokens, at = mended, 1
        return tokens

    def _mend(self, tokens: list[Token], start: int, end: int, strong: bool) -> list[Token] | None:
        """The tokens with the reparandum before ``start`` replaced by what follows ``end``, if it can be."""
        while True:  # "no, wait, I mean"
            more = self._match(self._strong, tokens, end) or self._match(self._weak, tokens, end)
            if not more and not (end < len(tokens) and tokens[end].text in MARKS):
                break
            end += more or 1
        if end >= len(tokens):
            return None
        before = tokens[:start]
        while before and before[-1].text in MARKS:
            before.pop()
        begins = self._kinds(tokens, end)
        if begins & _CLAUSE and not self._reads_as_thing(tokens, end):
            return [*before[: self._reparandum_start(before, tokens[end:])], *tokens[end:]]
        at = self._counterpart(before, tokens, end)
        if at is None:
            return None
        repair = tokens[end:]
        rest = before[at + self._length(before, at) :] if self._length(tokens, end) == len(repair) else []
        return [*before[:at], *repair, *rest]

    def _reads_as_thing(self, tokens: Sequence[Token], at: int) -> bool:
        kinds = self._kinds(tokens, at)
        return bool(kinds & _DIRECTION) and "VERB" in kinds and self._length(tokens, at) == len(tokens) - at

    def _counterpart(self, before: Sequence[Token], tokens: Sequence[Token], at: int) -> int | None:
        """Where in ``before`` the nearest words of the kind stand with which the repair begins."""
        group = self._group(tokens, at)
        if group is None:
            return None
        found = None
        for index in range(len(before) - 1, -1, -1):
            if self._group(before, index) == group:
                found = index
                if index == 0 or self._group(before, index - 1) != group:
                    break
            elif found is not None:
                break
        return found

    def _group(self, tokens: Sequence[Token], at: int) -> str | None:
        word = tokens[at].text
        if self._numbers.is_number_word(word):
            return "number"
        kinds = self._kinds(tokens, at)
        for name, group in (("direction", _DIRECTION), ("relation", _RELATION), ("thing", _THING)):
            if kinds & group:
                return name
        return "unit" if self._amounts.is_unit(word) else None

    def _kinds(self, tokens: Sequence[Token], at: int) -> frozenset[str]:
        """The categories of the longest phrases that begin at the token."""
        length = self._length(tokens, at)
        texts = tuple(token.text for token in tokens[at : at + length])
        return frozenset(sense.category for sense in self._lexicon.senses(texts[0]) if sense.words == texts)

    def _length(self, tokens: Sequence[Token], at: int) -> int:
        word = tokens[at].text
        if self._numbers.is_number_word(word):
            found = self._numbers.number([token.text for token in tokens], at)
            return found[1] - at if found else 1
        texts = [token.text for token in tokens[at : at + 8]]
        return next(
            (
                len(sense.words)
                for sense in self._lexicon.senses(word)
                if sense.category in _DIRECTION and tuple(texts[: len(sense.words)]) == sense.words
            ),
            1,
        )

    def _reparandum_start(self, before: Sequence[Token], repair: Sequence[Token]) -> int:
        """Where the clauses begin that clauses replace: the last one, or as many back as the repair has, if it begins
        as that one did ("turn left and go forward, no, turn right and go forward").
        """
        starts = self._clause_starts(before)
        count = len(self._clause_starts(repair))
        for start in starts[-count:]:
            if before[start].text == repair[0].text:
                return start
        return starts[-1]

    def _clause_starts(self, tokens: Sequence[Token]) -> list[int]:
        """Where clauses begin: at the first word, and behind each connective that a verb follows."""
        starts = [0]
        for at in range(1, len(tokens)):
            joins = self._kinds(tokens, at - 1) & _CLEAVE or tokens[at - 1].text in MARKS
            if joins and self._kinds(tokens, at) & _CLAUSE:
                starts.append(at)
        return starts

    def _match(self, table: dict[str, tuple[tuple[str, ...], ...]], tokens: Sequence[Token], at: int) -> int:
        """How many tokens from ``at`` are a phrase of the table, 0 for none."""
        if at >= len(tokens):
            return 0
        for phrase in table.get(tokens[at].text, ()):
            if tuple(token.text for token in tokens[at : at + len(phrase)]) == phrase:
                return len(phrase)
        return 0

    # ------------------------------------------------------------ said twice
    def _without_repeats(self, tokens: Sequence[Token]) -> list[Token]:
        """The first of two equal runs of words goes: "turn turn left", "go to the go to the door"."""
        kept: list[Token] = []
        for token in tokens:
            kept.append(token)
            for length in range(min(_RUN_MAX, len(kept) // 2), 0, -1):
                run = _texts(kept[-length:])
                if run == _texts(kept[-2 * length : -length]) and self._may_repeat(run):
                    del kept[-2 * length : -length]
                    break
        return kept

    def _may_repeat(self, run: Sequence[str]) -> bool:
        """Not "no no", which is more than "no", a lone number or mark, nor what is joined to its like by "and"."""
        if run[0] in MARKS or run == ["no"] or not self._joining.isdisjoint(run):
            return False
        return len(run) > 1 or not self._is_number(run[0])

    def _without_restarts(self, tokens: list[Token]) -> list[Token]:
        """ "can you move can you turn": the request begins anew; "ten deg ten feet": so does the amount."""
        at = 0
        while at < len(tokens):
            cut = self._lead_again(tokens, at) or self._amount_again(tokens, at)
            if cut:
                del tokens[at:cut]
            else:
                at += 1
        return tokens

    def _lead_again(self, tokens: Sequence[Token], at: int) -> int:
        length = self._match(self._leads, tokens, at)
        if length < 2:
            return 0
        for start in (at + length, at + length + 1):
            if self._match(self._leads, tokens, start) and not self._kinds(tokens, start - 1) & _CLEAVE:
                return start
        return 0

    def _amount_again(self, tokens: Sequence[Token], at: int) -> int:
        """Where an amount that replaces the one at ``at`` begins: the same number, or another of the same dimension."""
        word = tokens[at].text
        if not self._is_number(word) or (at and self._is_number(tokens[at - 1].text)):
            return 0
        texts = _texts(tokens)
        number = self._numbers.number(texts, at)
        if number is None or not number[1] < len(texts):
            return 0
        start = number[1] + 1 if self._amounts.is_unit(texts[number[1]]) else number[1]
        again = self._numbers.number(texts, start) if start > number[1] else None
        if again is not None and again[0] == number[0]:
            return start
        first, second = self._amounts.amount(texts, at), None
        if first is not None and first[1] < len(texts) and self._is_number(texts[first[1]]):
            second = self._amounts.amount(texts, first[1])
        same = second is not None and first is not None and second[0].quantity.unit is first[0].quantity.unit
        return first[1] if same and first is not None else 0


def _is_hiss(word: str) -> bool:
    """ "ff", "sss", "thh", "t": no vowel, and drawn out or very short."""
    if any(letter in "aeiouy" for letter in word) or not word.isalpha():
        return False
    return len(word) <= 2 or word[-1] == word[-2]


def _texts(tokens: Sequence[Token]) -> list[str]:
    return [token.text for token in tokens]


def _phrases(lexicon: Lexicon, name: str) -> dict[str, tuple[tuple[str, ...], ...]]:
    table: dict[str, list[tuple[str, ...]]] = {}
    for word in lexicon.closed.words_of(name):
        table.setdefault(word.words[0], []).append(word.words)
    return {first: tuple(sorted(found, key=lambda words: -len(words))) for first, found in table.items()}


def _number_words(lexicon: Lexicon) -> frozenset[str]:
    return frozenset(word for name in ("number", "multiplier", "fraction") for word in lexicon.closed.table(name))

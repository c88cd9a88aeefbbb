"""What words tell about fluency: which are words at all, of what kind they are, and which leave a phrase open."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from itertools import takewhile

from voxml.vocabulary import Lexicon

from .amounts import AmountReader
from .fixed_phrases import FixedPhrases
from .tokens import MARKS

_VERB = frozenset({"VERB", "VERB_ING", "LIGHT"})
_CLAUSE = _VERB | {"LEAD", "LEAD_ING", "LEAD_TO"}
_DIRECTION = frozenset({"SIDE", "AXIS", "HEADING", "TO_THE", "OPPOSITE"})
_RELATION = frozenset({"PATH", "LOC"})
_THING = frozenset({"NOUN", "NOUNS", "ADJECTIVE", "ORDINAL", "DETERMINER", "DEMONSTRATIVE", "SIDE_ADJ"})
_KINDS = (("direction", _DIRECTION), ("relation", _RELATION), ("thing", _THING))
_NAMED = frozenset({"NOUN", "NOUNS", "ADJECTIVE", "SIDE_ADJ", "EVENT"})
_MEANT = _NAMED | {"VERB", "HEADING"}
_JOINING = frozenset({"AND", "THEN", "BUT"})
_PHRASE_MAX = 8


class KnownWords:
    """The words of one lexicon. Indices are positions in the words of an utterance."""

    def __init__(self, lexicon: Lexicon, amounts: AmountReader) -> None:
        closed = lexicon.closed
        numbers = {word for name in ("number", "multiplier", "fraction") for word in closed.table(name)}
        self.fillers = frozenset(closed.table("filler"))
        self.vocabulary = lexicon.vocabulary() - self.fillers | numbers
        self.amounts = amounts
        self.leads = FixedPhrases.of(closed, "LEAD")
        self.forbids = FixedPhrases.of(closed, "FORBID")
        self._lexicon = lexicon
        self._sorted = sorted(self.vocabulary)
        self._joining = frozenset(closed.table("AND")) | frozenset(closed.table("THEN"))
        self._not = frozenset(closed.table("NOT"))
        self._no = frozenset(closed.table("NO"))
        self._idle = frozenset(closed.table("skip")) | frozenset(closed.table("reply")) | MARKS
        self._articles = frozenset(closed.table("article"))
        self._open = self._articles | closed.table("open").keys()

    def is_word(self, word: str) -> bool:
        return word in self.vocabulary or word in MARKS or word[0].isdigit() or self.amounts.may_start(word)

    def beginning_with(self, letters: str) -> Iterator[str]:
        """The known words that begin with the letters."""
        start = bisect_left(self._sorted, letters)
        return takewhile(
            lambda word: word.startswith(letters), (self._sorted[at] for at in range(start, len(self._sorted)))
        )

    def is_number(self, word: str) -> bool:
        return self.amounts.numbers.is_number_word(word)

    def is_unit(self, word: str) -> bool:
        return self.amounts.is_unit(word)

    def is_article(self, word: str) -> bool:
        return word in self._articles

    def is_open(self, word: str) -> bool:
        """Whether a phrase cannot end with the word: "to", "the", "your"."""
        return word in self._open

    def denies(self, word: str) -> bool:
        """Whether the word is "not"."""
        return word in self._not

    def refuses(self, word: str) -> bool:
        """Whether the word is "no"."""
        return word in self._no

    def is_idle(self, word: str) -> bool:
        """Whether the word adds nothing to what is asked for: "okay", "please"."""
        return word in self._idle

    def is_to_do(self, texts: Sequence[str]) -> bool:
        """Whether the words say what to do, or how much, or which way, or nothing at all: "okay", but not "it's a"."""
        if all(text in self._idle for text in texts):
            return True
        return any(
            self.is_verb(texts, at) or self.kind(texts, at) in ("direction", "number") for at in range(len(texts))
        )

    def joins(self, texts: Sequence[str], at: int) -> bool:
        """Whether the word joins clauses, as the "and" of "a hundred and eighty" does not."""
        if texts[at] not in self._joining:
            return False
        in_number = 0 < at < len(texts) - 1 and self.is_number(texts[at - 1])
        return not (in_number and (self.is_number(texts[at + 1]) or self.amounts.numbers.fraction(texts, at + 1)))

    def mean_the_same(self, first: str, second: str) -> bool:
        """Whether two words are names of one thing: "deg" and "degrees", "pic" and "picture"."""
        if self.is_unit(first) and self.is_unit(second):
            return self.amounts.unit_of(first) == self.amounts.unit_of(second)
        meant = [(sense.category, sense.value) for sense in self._lexicon.lookup(first)]
        return any((sense.category, sense.value) in meant for sense in self._lexicon.lookup(second))

    def are_nouns(self, *words: str) -> bool:
        return all(any(sense.category == "NOUN" for sense in self._lexicon.lookup(word)) for word in words)

    def differ(self, first: str, second: str) -> bool:
        """Whether two words of one category stand for different things: "north" and "northwest"."""
        meant = {sense.category: sense.value for sense in self._lexicon.lookup(first)}
        others = {sense.category: sense.value for sense in self._lexicon.lookup(second)}
        return any(meant[category] != others[category] for category in _MEANT & meant.keys() & others.keys())

    def kinds(self, texts: Sequence[str], at: int) -> frozenset[str]:
        """The categories of the longest phrase that begins with the word."""
        words = tuple(texts[at : at + self.length(texts, at)])
        return frozenset(sense.category for sense in self._lexicon.senses(words[0]) if sense.words == words)

    def kind(self, texts: Sequence[str], at: int) -> str | None:
        """Of what kind the phrase at ``at`` is, as far as one phrase can stand for another."""
        if self.is_number(texts[at]):
            return "number"
        kinds = self.kinds(texts, at)
        named = next((name for name, categories in _KINDS if kinds & categories), None)
        return named or ("unit" if self.is_unit(texts[at]) else None)

    def length(self, texts: Sequence[str], at: int) -> int:
        """How many words the number or direction has that begins at ``at``; 1 for everything else."""
        if self.is_number(texts[at]):
            found = self.amounts.numbers.number(texts, at)
            return found[1] - at if found else 1
        following = tuple(texts[at : at + _PHRASE_MAX])
        return next(
            (
                len(sense.words)
                for sense in self._lexicon.senses(texts[at])
                if sense.category in _DIRECTION and following[: len(sense.words)] == sense.words
            ),
            1,
        )

    def is_phrase(self, words: tuple[str, ...], category: str) -> bool:
        return any(sense.words == words and sense.category == category for sense in self._lexicon.senses(words[0]))

    def begins_phrase(self, texts: Sequence[str], at: int, length: int = 1) -> bool:
        """Whether some phrase of the lexicon, of so many words or more, begins at ``at``."""
        following = tuple(texts[at : at + _PHRASE_MAX])
        return any(
            len(sense.words) >= length and following[: len(sense.words)] == sense.words
            for sense in self._lexicon.senses(texts[at])
        )

    def is_thing(self, texts: Sequence[str], at: int) -> bool:
        """Whether the phrase may be a thing or a quality: "(to the) back"."""
        return bool(self.kinds(texts, at) & _NAMED)

    def is_verb(self, texts: Sequence[str], at: int) -> bool:
        """Whether a clause may begin with the phrase, as the "turn" of "a right turn" and "do not turn" does not."""
        if not self.kinds(texts, at) & _VERB or (at and self.denies(texts[at - 1])):
            return False
        if at and self.is_number(texts[at - 1]) and (self.amounts.may_belong(texts[at]) or self.is_unit(texts[at])):
            return False  # "one point five", "four steps"
        while at and self.kind(texts, at - 1) in ("thing", "direction", "number", "unit"):
            at -= 1
            if self.is_open(texts[at]):
                return False
        return not (at and self.is_open(texts[at - 1]))

    def begins_clause(self, texts: Sequence[str], at: int) -> bool:
        """Whether a clause may begin at ``at``: with a verb, or a phrase that leads to one."""
        return bool(self.kinds(texts, at) & _CLAUSE) or self.leads.length(texts, at) > 0

    def clause_starts(self, texts: Sequence[str]) -> list[int]:
        """Where clauses begin: at the first word, and behind each mark or connective that a verb follows."""
        starts = [0]
        for at in range(1, len(texts)):
            joined = texts[at - 1] in MARKS or self.kinds(texts, at - 1) & _JOINING
            if joined and self.begins_clause(texts, at):
                starts.append(at)
        return starts

"""Utterances without a reading: said again with a verb of the program that a classifier takes them to ask for.

What is guessed is a verb and nothing else. The rest must be the person's own words, nearly all that Kirby knows among
them, and the grammar must read the whole: so a guess means what its words say, and its words can be asked about.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations, islice
from typing import Protocol

from voxml.terms import Form, Quantity, Term
from voxml.vocabulary import Lexicon

from .acts import DialogueAct, Function
from .lattice import SEPARATORS, Lattice
from .reader import Reader
from .tokens import MARKS

NONE = "none"
"""What a classifier calls utterances that ask for nothing."""

STOPPED = "stop"
"""The program that is carried out without asking."""

UNKNOWN_MAX = 3  # more unknown words than that, and it is another subject
WORDS_MAX = 16
DROPPED_MAX = 1  # known words that may be passed over
TRIALS_MAX = 40
CLAUSES_MAX = 3
LIGHT_VERBS_MAX = 3
_DROPPABLE = frozenset({"PRONOUN", "DETERMINER", "DEMONSTRATIVE", "VERB", "VERB_ING", "LIGHT", "MANNER", "AS", "BE"})
"""A word of these categories alone may be passed over: never an amount, a side, a place or a thing, nor "not"."""

_PARTICLES = frozenset({"AXIS", "PATH", "LOC"})
"""Behind an unknown verb a word of these may belong to it, as in "hunt down"."""


class Proposer(Protocol):
    """Guesses what is asked for: a classifier of utterances as `Guesser.words` shows them."""

    def __call__(self, words: tuple[str, ...]) -> str | None:
        """The predicate of the program that the words ask for; None where it is not sure that they ask for one."""


@dataclass(frozen=True, slots=True)
class _Word:
    """A word, or an amount of several, as the classifier sees it and as it was said; the programs that it names."""

    shown: str
    said: str
    known: bool = True
    droppable: bool = False
    verb_of: frozenset[str] = frozenset()
    event_of: frozenset[str] = frozenset()


class Guesser:
    """Rewords utterances with the words of one lexicon; ``reader`` is the grammar's."""

    def __init__(self, lexicon: Lexicon, reader: Reader) -> None:
        self._lexicon = lexicon
        self._reader = reader
        self._vocabulary = lexicon.vocabulary()
        self._verbs = _verbs(lexicon)
        lights = (word.words[0] for word in lexicon.closed.words_of("LIGHT") if len(word.words) == 1)
        self._light_verbs = tuple(islice(lights, LIGHT_VERBS_MAX))

    @property
    def programs(self) -> frozenset[str]:
        """The predicates that a proposer may name: those of verbs."""
        return frozenset(self._verbs)

    def words(self, text: str) -> tuple[str, ...]:
        """The utterance as a classifier sees it: fluent, and with the dimension in place of each amount."""
        return tuple(word.shown for word in self._words(text))

    def guess(self, text: str, proposer: Proposer) -> tuple[DialogueAct, ...] | None:
        """The acts that the proposer's programs make of the text, to be confirmed; stopping needs no confirmation."""
        clauses = self._clauses(text)
        said = self._clause_by_clause(clauses, proposer)
        if said is None and not any(self._begins_unknown(clause) for clause in clauses[1:]):
            said = self._said_again(text, proposer)
        if said is None:
            return None
        whole = (0, len(text))
        if said == STOPPED:
            return (DialogueAct(Function.INSTRUCT, Term("stop"), whole),)
        acts = self._reader.read(said)
        assert isinstance(acts, tuple)
        return tuple(replace(act, span=whole, repaired=said) for act in acts)

    def _clause_by_clause(self, clauses: list[str], proposer: Proposer) -> str | None:
        """Several orders, those that cannot be read said again; None where one of them is none."""
        if not 1 < len(clauses) <= CLAUSES_MAX:
            return None
        said = [clause if self._is_order(clause) else self._said_again(clause, proposer) for clause in clauses]
        if STOPPED in said:
            return STOPPED
        again = ", then ".join(clause for clause in said if clause is not None)
        return again if None not in said and self._is_order(again) else None

    def _said_again(self, text: str, proposer: Proposer) -> str | None:
        """One order with the verb of the program that the proposer names, if it can be read so."""
        words = self._words(text)
        unknown = sum(not word.known for word in words)
        if unknown > UNKNOWN_MAX or unknown == len(words) or len(words) > WORDS_MAX:
            return None
        pred = proposer(tuple(word.shown for word in words))
        if pred is None or pred not in self._verbs:
            return None
        if pred == STOPPED:
            return STOPPED
        trials = islice(self._reworded(words, pred), TRIALS_MAX)
        return next((reworded for reworded in trials if self._asks_for(reworded, pred)), None)

    def _asks_for(self, text: str, pred: str) -> bool:
        """Whether the text is one instruction to carry out the program, without a slip of the tongue."""
        acts = self._reader.read(text, thorough=False) if self._reader.is_fluent(text) else None
        if not isinstance(acts, tuple) or len(acts) != 1 or acts[0].function is not Function.INSTRUCT:
            return False
        return head_program(acts[0].form, self._lexicon) == pred

    def _begins_unknown(self, clause: str) -> bool:
        """Whether a verb may stand first in a clause that nobody knows: it would be lost."""
        words = self._words(clause)
        return bool(words) and not words[0].known

    def _is_order(self, text: str) -> bool:
        acts = self._reader.read(text, thorough=False)
        return isinstance(acts, tuple) and all(act.function is Function.INSTRUCT for act in acts)

    def _clauses(self, text: str) -> list[str]:
        """What stands between "and", "then" and marks."""
        tokens = self._reader.tokens(text)
        lattice = self._reader.lattice(tokens)
        clauses: list[list[str]] = [[]]
        for at, token in enumerate(tokens):
            if token.text in MARKS or not SEPARATORS.isdisjoint(lattice.categories(at)):
                clauses.append([])
            else:
                clauses[-1].append(token.text)
        return [" ".join(clause) for clause in clauses if clause]

    # ------------------------------------------------------------ words
    def _words(self, text: str) -> tuple[_Word, ...]:
        tokens = self._reader.tokens(text)
        lattice = self._reader.lattice(tokens)
        words: list[_Word] = []
        at = 0
        while at < len(tokens):
            word, length = self._word(lattice, at, behind_unknown=bool(words) and not words[-1].known)
            if not _is_passed_over(lattice, at):
                words.append(word)
            at += length
        return tuple(words)

    def _word(self, lattice: Lattice, at: int, behind_unknown: bool) -> tuple[_Word, int]:
        edges = lattice.edges(at)
        amount = next((edge for edge in edges if edge.terminal in ("QTY", "QTY_MORE", "NUMBER")), None)
        if amount is not None:
            return _Word(_dimension(amount.value), " ".join(lattice.texts[at : at + amount.length])), amount.length
        text = lattice.texts[at]
        alone = [edge for edge in edges if edge.length == 1 and edge.terminal is not None]
        categories = {edge.terminal for edge in alone}
        droppable = bool(categories) and categories <= _DROPPABLE
        programs = {
            kind: frozenset(each.entry.lex.pred for edge in alone if edge.terminal == kind for each in edge.value)
            for kind in ("VERB", "EVENT")
        }
        known = text in self._vocabulary
        droppable = droppable or (behind_unknown and not categories.isdisjoint(_PARTICLES))
        return _Word(text, text, known, droppable, programs["VERB"], programs["EVENT"]), 1

    def _reworded(self, words: tuple[_Word, ...], pred: str) -> Iterator[str]:
        """Texts with a verb of the program, those that keep the most of what was said first."""
        kept = frozenset(index for index, word in enumerate(words) if word.known)
        places = [index for index, word in enumerate(words) if not word.known or pred in word.verb_of]
        droppable = [index for index in sorted(kept) if words[index].droppable]
        light = self._light_verbs if any(pred in word.event_of for word in words) else ()
        for count in range(DROPPED_MAX + 1):
            for dropped in combinations(droppable, count):
                for place in dict.fromkeys([*places, 0]):
                    for verb in (*light, self._verbs[pred]):
                        yield _said_again(words, kept - set(dropped), place, verb, pred)


def _is_passed_over(lattice: Lattice, at: int) -> bool:
    """Whether a token is a mark, a "please", or who is spoken to."""
    edges = lattice.edges(at)
    return lattice.texts[at] in MARKS or (bool(edges) and edges[0].terminal is None)


def _said_again(words: tuple[_Word, ...], kept: frozenset[int], place: int, verb: str, pred: str) -> str:
    """The words that are kept, with the verb at its place, where no verb of the program stands there already."""
    said = []
    for index, word in enumerate(words):
        own = pred in word.verb_of
        if index == place and not own:
            said.append(verb)
        if index in kept or (index == place and own):
            said.append(word.said)
    return " ".join(said)


def _verbs(lexicon: Lexicon) -> dict[str, str]:
    """A verb for each program, its own name where that is a word."""
    verbs: dict[str, str] = {}
    for sense in lexicon.all_senses():
        if sense.category != "VERB" or not isinstance(sense.value, tuple):
            continue
        for reading in sense.value:
            pred, phrase = reading.entry.lex.pred, " ".join(sense.words)
            if reading.gives is None and (pred not in verbs or phrase == pred.replace("_", " ")):
                verbs[pred] = phrase
    return verbs


def _dimension(value: Form) -> str:
    """An amount as the classifier sees it: ``<metre>``, ``<count>``."""
    while isinstance(value, Term) and value.args:
        value = value.args[0]
    return f"<{value.unit.name.lower()}>" if isinstance(value, Quantity) else "<amount>"


def head_program(form: Form, lexicon: Lexicon) -> str | None:
    """The program that one instruction asks for, whatever the manner and however often; None where it is several."""
    while isinstance(form, Term) and form.pred not in lexicon.programs:
        if form.pred != "repeat" and form.pred not in lexicon.attributes:
            return None
        form = form.args[-1]
    return form.pred if isinstance(form, Term) else None

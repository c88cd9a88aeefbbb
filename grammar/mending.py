"""Utterances that the grammar cannot read: whether they may mean stop, and what they may have been meant to be."""

from __future__ import annotations

import re
from dataclasses import replace

from voxml.terms import Term
from voxml.vocabulary import Lexicon

from .acts import DialogueAct, Function, NotUnderstood
from .guessing import Guesser, Proposer
from .nearest import Nearest
from .reader import Reader
from .spelling import Speller

Reading = tuple[DialogueAct, ...] | NotUnderstood

MENDED_MAX_CHARS = 200
_STOP = Term("stop")
_WORD = re.compile(r"[^\W\d_]+(?:'[^\W\d_]+)*|[?]")


class Mender:
    """Second thoughts about utterances, with the words of one lexicon; ``reader`` is the grammar's."""

    def __init__(self, lexicon: Lexicon, reader: Reader) -> None:
        closed = lexicon.closed
        self._read = reader.read
        self._guesser = Guesser(lexicon, reader)
        self._speller = Speller(lexicon)
        self._nearest = Nearest(lexicon)
        self._stop_words = frozenset(closed.table("stop_word"))
        self._no_stop = frozenset(closed.table("no_stop"))
        self._determiners = frozenset(" ".join(word.words) for word in closed.words_of("stop_object"))

    def mend(self, text: str, failure: NotUnderstood, proposer: Proposer | None = None) -> Reading:
        """Stop at once where that may be meant; a repaired or guessed reading, to be confirmed; or the failure."""
        if len(text) > MENDED_MAX_CHARS:
            return failure
        proposals = tuple(self._speller.proposals(text))
        if any(map(self._may_mean_stop, (text, *proposals))):
            return (DialogueAct(Function.INSTRUCT, _STOP, (0, len(text))),)
        for proposal in proposals:
            reading = self._read(proposal)
            if isinstance(reading, tuple):
                return tuple(replace(act, span=(0, len(text)), repaired=proposal) for act in reading)
        guessed = None if proposer is None else self._guesser.guess(text, proposer)
        return guessed or replace(failure, nearest=self._nearest(text))

    def _may_mean_stop(self, text: str) -> bool:
        """A stop word that is neither denied, asked about, told of, nor has another thing for its object."""
        words = _WORD.findall(text.lower())
        at = next((index for index, word in enumerate(words) if word in self._stop_words), None)
        if at is None or words[-1] == "?" or not self._no_stop.isdisjoint(words[:at]):
            return False
        rest = words[at + 1 :]
        has_object = len(rest) > 1 and rest[0] in self._determiners and rest[1] not in self._determiners
        return not has_object

"""Utterances that the grammar cannot read: whether they may mean stop, and what they may have been meant to be."""

from __future__ import annotations

from dataclasses import replace

from voxml.terms import Term
from voxml.vocabulary import Lexicon

from .acts import DialogueAct, Function, NotUnderstood
from .guessing import Guesser, Proposer
from .nearest import Nearest
from .reader import Reader
from .spelling import Speller
from .stopping import Stopping

Reading = tuple[DialogueAct, ...] | NotUnderstood

MENDED_MAX_CHARS = 200
WORDS_TRIED_MAX = 72  # in all proposals together: a dozen for a few words, fewer for many
_STOP = Term("stop")
_REQUESTS = frozenset({Function.INSTRUCT, Function.QUESTION})


class Mender:
    """Second thoughts about utterances, with the words of one lexicon; ``reader`` is the grammar's."""

    def __init__(self, lexicon: Lexicon, reader: Reader) -> None:
        self._read = reader.read
        self._guesser = Guesser(lexicon, reader)
        self._speller = Speller(lexicon)
        self._nearest = Nearest(lexicon, self._is_one_request)
        self._stopping = Stopping(lexicon)

    def mend(self, text: str, failure: NotUnderstood, proposer: Proposer | None = None) -> Reading:
        """Stop at once where that may be meant; a repaired or guessed reading, to be confirmed; or the failure."""
        if len(text) > MENDED_MAX_CHARS or not text.split():
            return failure
        proposals = tuple(self._speller.proposals(text))
        if any(map(self._stopping.may_be_meant, (text, *proposals))):
            return (DialogueAct(Function.INSTRUCT, _STOP, (0, len(text))),)
        for proposal in proposals[: max(1, WORDS_TRIED_MAX // len(text.split()))]:
            reading = self._read(proposal)
            if isinstance(reading, tuple):
                return tuple(replace(act, span=(0, len(text)), repaired=proposal) for act in reading)
        guessed = None if proposer is None else self._guesser.guess(text, proposer)
        return guessed or replace(failure, nearest=self._nearest(text, failure.span))

    def _is_one_request(self, text: str) -> bool:
        reading = self._read(text, thorough=False)
        return isinstance(reading, tuple) and len(reading) == 1 and reading[0].function in _REQUESTS

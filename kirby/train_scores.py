"""How good a language model is on sentences that it was not trained on, and how sure it must be of what it proposes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

from grammar.guessing import NONE, STOPPED, Guesser

from .proposer import LanguageModel
from .train_examples import Sentence

FALSE_MAX = 0.02  # share of what is no instruction about which Kirby may ask all the same
WRONG_MAX = 0.20  # share of the proposals that may be wrong
THRESHOLDS = tuple(percent / 100 for percent in range(50, 100, 5))


@dataclass(frozen=True, slots=True)
class Scores:
    """What came of sentences that the grammar cannot read: ``asking`` of them are orders, ``other`` are none.

    ``labelled`` orders had the likeliest label right, however unsure; ``right`` and ``wrong`` ones were proposed with
    the form that was meant and with another; ``false`` are proposals where nothing was asked for, but for ``stopped``:
    what is guessed to mean stop asks nothing and moves nothing.
    """

    asking: int
    labelled: int
    right: int
    wrong: int
    other: int
    false: int
    stopped: int

    @property
    def accuracy(self) -> float:
        """Of the orders, those with the right label."""
        return _share(self.labelled, self.asking)

    @property
    def coverage(self) -> float:
        """Of the orders, those for which something is proposed."""
        return _share(self.right + self.wrong, self.asking)

    @property
    def precision(self) -> float:
        """Of what is proposed for orders, that with the right form."""
        return _share(self.right, self.right + self.wrong)

    @property
    def false_share(self) -> float:
        """Of what is no order, that for which something is proposed."""
        return _share(self.false, self.other)


def score(model: LanguageModel, sentences: Sequence[Sentence], guesser: Guesser) -> Scores:
    """Count what the model, put to use as Kirby does, makes of the sentences."""
    counts: Counter[str] = Counter()
    for sentence in sentences:
        acts = guesser.guess(sentence.text, model)
        proposed = None if acts is None else str(acts[0].form)
        if sentence.label == NONE:
            counts["other"] += 1
            if proposed is not None:
                counts["stopped" if proposed == STOPPED else "false"] += 1
            continue
        label, _ = model.likeliest(guesser.words(sentence.text))
        counts.update(asking=1, labelled=int(label == sentence.label))
        if proposed is not None:
            counts["right" if proposed == sentence.form else "wrong"] += 1
    return Scores(*(counts[name] for name in Scores.__dataclass_fields__))


def calibrated(model: LanguageModel, sentences: Sequence[Sentence], guesser: Guesser) -> LanguageModel:
    """The model with the lowest threshold at which it is wrong seldom enough, or else with the highest there is."""
    tried = model
    for threshold in THRESHOLDS:
        tried = LanguageModel(model.pipe, replace(model.classes, threshold=threshold))
        scores = score(tried, sentences, guesser)
        if scores.false_share <= FALSE_MAX and scores.precision >= 1 - WRONG_MAX:
            break
    return tried


def _share(part: int, whole: int) -> float:
    return part / whole if whole else 0.0

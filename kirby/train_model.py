"""The training of the language model, offline: the same lexicon, corpora and seed give the same model."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from grammar import NotUnderstood, parse
from grammar.guessing import NONE, Guesser
from grammar.reader import Reader
from voxml.vocabulary import Lexicon

from .proposer import UNKNOWN, Classes, LanguageModel, blank, document
from .train_examples import SAMPLES, Damager, Sentence, gather
from .train_scores import Scores, calibrated, score

SEED = 1
EPOCHS = 8
BATCH = 64
LEARN_RATE = 0.005
CORPORA_TIMES = 6  # an epoch has a hand-written sentence so often, each time damaged otherwise

Tell = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Trained:
    """A model, and how it did on sentences that it was not trained on, by where they come from."""

    model: LanguageModel
    scores: dict[str, Scores]


def train(lexicon: Lexicon, tell: Tell, seed: int = SEED, samples: int = SAMPLES, epochs: int = EPOCHS) -> Trained:
    """Train a model on the language of a lexicon; ``tell`` hears of the progress."""
    guesser = Guesser(lexicon, Reader(lexicon))
    damager = Damager(lexicon, guesser, random.Random(seed))  # noqa: S311 - not for secrets
    tell("gathering sentences")
    split = gather(lexicon, guesser.programs, seed, samples)
    tell(f"{len(split.train)} sentences to learn from, {len(split.dev)} to calibrate by, {len(split.test)} to test on")
    model = _fitted(split.train, damager, seed, epochs, tell)
    tell("calibrating and testing")
    said = [sentence for sentence in split.dev if sentence.source == "corpora"]  # as people talk, unlike samples
    model = calibrated(model, _unreadable(said, damager, lexicon), guesser)
    test = _unreadable(split.test, damager, lexicon)
    sources = sorted({each.source for each in test})
    by_source = {name: [each for each in test if each.source == name] for name in sources}
    return Trained(model, {name: score(model, sentences, guesser) for name, sentences in by_source.items()})


def _fitted(sentences: Sequence[Sentence], damager: Damager, seed: int, epochs: int, tell: Tell) -> LanguageModel:
    from spacy.training import Example
    from thinc.api import fix_random_seed

    rng = random.Random(seed)  # noqa: S311 - not for secrets
    fix_random_seed(seed)
    labels = tuple(sorted({sentence.label for sentence in sentences} | {NONE}))
    words = frozenset(word for sentence in sentences for word in damager.whole(sentence)) | {UNKNOWN}
    nlp, pipe = blank(labels)

    def example(sentence: Sentence) -> Example:
        shown, label = damager.words(sentence)
        return Example.from_dict(
            document(nlp.vocab, shown, words), {"cats": {each: float(each == label) for each in labels}}
        )

    often = [sentence for sentence in sentences for _ in range(CORPORA_TIMES if sentence.source == "corpora" else 1)]
    optimizer = nlp.initialize(lambda: [example(sentence) for sentence in sentences[:BATCH]])
    optimizer.learn_rate = LEARN_RATE
    for epoch in range(1, epochs + 1):
        rng.shuffle(often)
        losses: dict[str, float] = {}
        for start in range(0, len(often), BATCH):
            pipe.update([example(sentence) for sentence in often[start : start + BATCH]], sgd=optimizer, losses=losses)
        tell(f"epoch {epoch} of {epochs}: loss {losses['textcat']:.2f}")
    return LanguageModel(pipe, Classes(labels, words, threshold=1.0))


def _unreadable(sentences: Sequence[Sentence], damager: Damager, lexicon: Lexicon) -> list[Sentence]:
    """The sentences damaged, but for what can be read or repaired all the same: no model is asked about that."""
    made = [each for sentence in sentences for each in damager.damaged(sentence)]
    return [each for each in made if isinstance(parse(each.text, lexicon), NotUnderstood)]

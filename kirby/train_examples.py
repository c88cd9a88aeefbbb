"""What the language model learns from: Kirby's own corpora and sentences sampled from the grammar, with words damaged.

A damaged sentence stands for one that the grammar cannot read: its verb, most often, is a word that nobody has taught.
What is no instruction is learned too, and so is an instruction put into somebody else's mouth ("he ... to the door").
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from corpora.cases import Case, load_corpus
from corpora.runner import default_corpora
from grammar import parse
from grammar.acts import DialogueAct, Function, NotUnderstood
from grammar.guessing import NONE, Guesser, head_program
from grammar.sampling import Sampler
from voxml.vocabulary import Lexicon

from .proposer import UNKNOWN

SAMPLES = 6_000
SAMPLED_WORDS_MAX = 9
PER_LABEL_MAX = 400  # sampled sentences of one label: those of a rare verb must not drown
TEST_SHARE = 0.1
DEV_SHARE = 0.15
_SUBJECTS = (
    "he", "she", "they", "we", "i", "it", "nobody", "somebody", "people", "the robot", "a man", "the {}", "a {}",
    "my {}", "the {} {}", "his {}", "i just", "he just", "i would", "she will", "they always", "why did it",
    "why would you", "how do i", "how did you", "did you", "did he", "when did it", "should i", "who will",
    "what if i", "he said to",
)  # fmt: skip
"""Beginnings that make of an order something else; ``{}`` is any word."""


@dataclass(frozen=True, slots=True)
class Sentence:
    """A sentence of known meaning: the label is the predicate of the program it asks for, or ``none``."""

    text: str
    label: str
    form: str | None
    source: str


@dataclass(frozen=True, slots=True)
class Split:
    """Sentences to learn from, to choose the threshold by, and to test on; none is in two of them."""

    train: tuple[Sentence, ...]
    dev: tuple[Sentence, ...]
    test: tuple[Sentence, ...]


def gather(lexicon: Lexicon, programs: frozenset[str], seed: int, samples: int = SAMPLES) -> Split:
    """Sentences that ask for one of the programs or for nothing, each once, shuffled and split, the same for a seed."""
    rng = random.Random(seed)  # noqa: S311 - not for secrets
    found: dict[str, Sentence] = {}
    for sentence in (*_said(lexicon), *_sampled(lexicon, rng, samples)):
        if sentence.label in programs or sentence.label == NONE:
            found.setdefault(sentence.text, sentence)
    shuffled = list(found.values())
    rng.shuffle(shuffled)
    test = int(len(shuffled) * TEST_SHARE)
    dev = test + int(len(shuffled) * DEV_SHARE)
    return Split(tuple(shuffled[dev:]), tuple(shuffled[test:dev]), tuple(shuffled[:test]))


def _said(lexicon: Lexicon) -> Iterator[Sentence]:
    """The single cases of the corpora."""
    for path in default_corpora():
        for case in load_corpus(path, path.name):
            if isinstance(case, Case):
                acts = parse(case.text, lexicon)
                sentence = _labelled(case.text, acts, lexicon)
                if sentence is not None:
                    yield sentence


def _labelled(text: str, acts: tuple[DialogueAct, ...] | NotUnderstood, lexicon: Lexicon) -> Sentence | None:
    """The sentence with its label; None where it is misspelt, or asks for several things or on a condition."""
    if isinstance(acts, NotUnderstood):
        return Sentence(text.lower(), NONE, None, "corpora")
    if any(act.repaired is not None for act in acts):
        return None
    instructed = [act for act in acts if act.function is Function.INSTRUCT]
    if not instructed:
        return Sentence(text.lower(), NONE, None, "corpora")
    label = head_program(acts[0].form, lexicon) if len(acts) == 1 else None
    return None if label is None else Sentence(text.lower(), label, str(acts[0].form), "corpora")


def _sampled(lexicon: Lexicon, rng: random.Random, samples: int) -> Iterator[Sentence]:
    sampler = Sampler(lexicon, rng.choice)
    counts: dict[str, int] = {}
    for index in range(samples):
        sample = sampler.instruction() if index % 4 else sampler.sample()
        if len(sample.text.split()) > SAMPLED_WORDS_MAX:
            continue
        label = head_program(sample.form, lexicon) if sample.function is Function.INSTRUCT else NONE
        if label is None or counts.get(label, 0) >= PER_LABEL_MAX:
            continue
        counts[label] = counts.get(label, 0) + 1
        yield Sentence(sample.text, label, None if label == NONE else str(sample.form), "sampled")


# ------------------------------------------------------------------ damage
class Damager:
    """Makes sentences of sentences: with words that nobody knows in the place of others, mostly of verbs."""

    def __init__(self, lexicon: Lexicon, guesser: Guesser, rng: random.Random) -> None:
        self._rng = rng
        self._guesser = guesser
        self._verbs = _verb_words(lexicon)
        self._vocabulary = lexicon.vocabulary()
        self._pronouns = tuple(word.words[0] for word in lexicon.closed.words_of("PRONOUN") if len(word.words) == 1)

    def whole(self, sentence: Sentence) -> tuple[str, ...]:
        """The sentence as the model sees it undamaged."""
        return self._guesser.words(sentence.text)

    def words(self, sentence: Sentence) -> tuple[tuple[str, ...], str]:
        """One variant as the model sees it, with its label."""
        words = list(self.whole(sentence))
        label = sentence.label
        if label == NONE:
            return tuple(self._unknown(words, self._is_foreign, 0.4)), NONE
        if self._rng.random() < 0.2:
            words = [*self._subject(UNKNOWN), *words]
            label = NONE
        words = self._unknown(words, self._verbs.__contains__, 0.6)
        words = self._unknown(words, lambda word: True, 0.05)
        if self._rng.random() < 0.25:
            padding = self._rng.choice((UNKNOWN, *self._pronouns))
            words.insert(self._rng.randrange(len(words) + 1), padding)
        return tuple(words), label

    def damaged(self, sentence: Sentence) -> Iterator[Sentence]:
        """What is no instruction as it stands; an order with a verb that nobody knows, and as somebody else's deed."""
        if sentence.label == NONE:
            yield sentence
            return
        words = sentence.text.split()
        verbs = [index for index, word in enumerate(words) if word in self._verbs]
        if verbs:
            words[verbs[0]] = _nonsense(self._rng)
            yield replace(sentence, text=" ".join(words))
            told = " ".join([*self._subject(_nonsense(self._rng)), *words])
            yield replace(sentence, text=told, label=NONE, form=None)

    def _subject(self, name: str) -> list[str]:
        return self._rng.choice(_SUBJECTS).replace("{}", name).split()

    def _unknown(self, words: list[str], chosen: Callable[[str], bool], share: float) -> list[str]:
        return [UNKNOWN if chosen(word) and self._rng.random() < share else word for word in words]

    def _is_foreign(self, word: str) -> bool:
        return word not in self._vocabulary


def _verb_words(lexicon: Lexicon) -> frozenset[str]:
    """The words with which verbs begin, but for those that have another office: "not" of "not so fast"."""
    categories = {"VERB", "VERB_ING", "LIGHT", "CALL"}
    verbs = {sense.words[0] for sense in lexicon.all_senses() if sense.category in categories}
    offices = ("FORBID", "NOT", "NO", "LEAD", "BE", "YOU", "SIDE", "AXIS", "HEADING", "PLACE", "VAGUE", "IF", "WHAT")
    return frozenset(verbs) - {word.words[0] for name in offices for word in lexicon.closed.words_of(name)}


def _nonsense(rng: random.Random) -> str:
    """A word that sounds like none."""
    return "".join(rng.choice("bdfgklmnprstvz") + rng.choice("aeiou") for _ in range(3)) + rng.choice("bdgklmnprt")

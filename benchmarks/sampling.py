"""Sentences sampled from the grammar, read back: how many come back as the form they were sampled from.

One that does not is ambiguous: the form it was sampled from is one of its readings, and another is preferred. Or it is
heard as a slip of the tongue ("this this one" is said twice), so that other words are read than were sampled. Both are
listed, with the form sampled and what was read. What is neither is lost.

Run as ``python -m benchmarks.sampling [SENTENCES] [--seed N] [--json]``.
"""

from __future__ import annotations

import argparse
import json
import random
from enum import Enum
from typing import Any

from grammar.acts import DialogueAct, NotUnderstood
from grammar.reader import Reader
from grammar.sampling import Sample, Sampler
from voxml.vocabulary import load_lexicon

SENTENCES = 20_000


class Outcome(Enum):
    """What came of a sampled sentence."""

    SAME = "same"
    AMBIGUOUS = "ambiguous"
    SLIP = "heard_as_slip"
    LOST = "lost"


def run(sentences: int = SENTENCES, seed: int = 1) -> dict[str, Any]:
    """How many sentences had each outcome, and all that did not come back: sentence, form sampled, and form read."""
    lexicon = load_lexicon()
    reader, sampler = Reader(lexicon), Sampler(lexicon, random.Random(seed).choice)
    listed: dict[Outcome, list[str]] = {outcome: [] for outcome in Outcome if outcome is not Outcome.SAME}
    for _ in range(sentences):
        sample = sampler.sample()
        acts = reader.read(sample.text)
        outcome = came_back(reader, sample, acts)
        if outcome is not Outcome.SAME:
            listed[outcome].append(f"{sample.text} | {sample.function.value} {sample.form} | {_shown(acts)}")
    return {
        "sentences": sentences,
        "same": sentences - sum(map(len, listed.values())),
        **{outcome.value: len(found) for outcome, found in listed.items()},
        **{f"{outcome.value}_sentences": found for outcome, found in listed.items()},
    }


def came_back(reader: Reader, sample: Sample, acts: tuple[DialogueAct, ...] | NotUnderstood) -> Outcome:
    """The outcome for a sample of which the reader made these acts."""
    meant = (sample.function, sample.form)
    if isinstance(acts, NotUnderstood):
        return Outcome.LOST
    if [(act.function, act.form) for act in acts] == [meant]:
        return Outcome.SAME
    if not reader.is_fluent(sample.text):
        return Outcome.SLIP
    return Outcome.AMBIGUOUS if meant in reader.readings(sample.text) else Outcome.LOST


def _shown(acts: tuple[DialogueAct, ...] | NotUnderstood) -> str:
    if isinstance(acts, NotUnderstood):
        return "not understood"
    return ", ".join(f"{act.function.value} {act.form}" for act in acts)


def main() -> None:
    """Print the counts, and the sentences that did not come back."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("sentences", nargs="?", type=int, default=SENTENCES)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", action="store_true", help="one JSON object")
    options = parser.parse_args()
    figures = run(options.sentences, options.seed)
    if options.json:
        print(json.dumps(figures))
        return
    for name, value in figures.items():
        print(f"{name:20}", value if not isinstance(value, list) else "\n  " + "\n  ".join(value))


if __name__ == "__main__":
    main()

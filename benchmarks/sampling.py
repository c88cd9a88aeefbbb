"""Sentences sampled from the grammar, read back: how many come back as the form they were sampled from.

One that does not is ambiguous (its form is among the other readings), or looks like a repair ("two or three" is a
number that replaces another), or is lost: the grammar's own choices cut its reading off. Those are listed.

Run as ``python -m benchmarks.sampling [SENTENCES] [--seed N] [--json]``.
"""

from __future__ import annotations

import argparse
import json
import random
from collections import Counter
from itertools import islice
from typing import Any

from grammar.reader import Reader
from grammar.sampling import Sample, Sampler
from voxml.vocabulary import load_lexicon

SENTENCES = 20_000
READINGS_MAX = 500
LISTED_MAX = 200


def run(sentences: int = SENTENCES, seed: int = 1) -> dict[str, Any]:
    """Counts of what came of the sentences, and the ambiguous and the lost ones themselves."""
    lexicon = load_lexicon()
    reader, sampler = Reader(lexicon), Sampler(lexicon, random.Random(seed).choice)
    counts: Counter[str] = Counter()
    listed: dict[str, list[str]] = {"ambiguous": [], "lost": []}
    for _ in range(sentences):
        sample = sampler.sample()
        outcome = came_back(reader, sample)
        counts[outcome] += 1
        if outcome in listed:
            listed[outcome].append(f"{sample.text} | {sample.form}")
    return {
        "sentences": sentences,
        **{name: counts[name] for name in ("same", "ambiguous", "repair", "lost")},
        "same_or_ambiguous": 1 - counts["lost"] / sentences,
        **{f"{name}_sentences": found[:LISTED_MAX] for name, found in listed.items()},
    }


def came_back(reader: Reader, sample: Sample) -> str:
    """``same``, ``ambiguous``, ``repair`` or ``lost``."""
    acts = reader.read(sample.text)
    meant = (sample.function, sample.form)
    if isinstance(acts, tuple) and [(act.function, act.form) for act in acts] == [meant]:
        return "same"
    if not reader.is_fluent(sample.text):
        return "repair"
    return "ambiguous" if meant in islice(reader.readings(sample.text), READINGS_MAX) else "lost"


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

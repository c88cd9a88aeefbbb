"""A million strings that nobody would say: none raises, none takes long, what is not understood moves nothing.

Strings are random bytes as text, and sentences sampled from the grammar with words dropped, doubled, swapped, cut off
or misspelt. Each is read and planned as ``kirby parse`` does, with a proposer at its worst: sure of anything. Times are
of the processor, whatever else it does.

Run as ``python -m benchmarks.robustness [STRINGS] [--processes 2] [--json]``.
"""

from __future__ import annotations

import argparse
import gc
import json
import multiprocessing
import random
import sys
import time
from collections import Counter
from functools import partial
from typing import Any

from dialogue.understanding import understand
from grammar import parse
from grammar.sampling import Sampler
from robot.messages import Control
from voxml.vocabulary import load_lexicon

STRINGS = 1_000_000
SLOW_MS = 50.0
BYTES_MAX = 120
SURE = 0.1  # how often the proposer is sure: a guess takes longer than all the rest
_STILL = frozenset({control.value for control in Control} - {"continue", "go back", "keep going"})
_EXAMPLES = 5
TOLD_EVERY = 50_000


def run(strings: int = 100_000, processes: int = 1, seed: int = 1) -> dict[str, Any]:
    """The figures over so many strings."""
    parse("go forward")
    long_line_us = _long_line_us()
    shares = [
        (strings // processes + (index < strings % processes), seed * 1_000 + index) for index in range(processes)
    ]
    if processes == 1:
        found = [_share(*shares[0])]
    else:
        with multiprocessing.get_context("spawn").Pool(processes) as pool:
            found = pool.starmap(_share, shares)
    total: Counter[str] = sum((counts for counts, _ in found), Counter())
    return {
        "strings": strings,
        "raised": total["raised"],
        "slow": total["slow"],
        "slowest_ms": max(notes["slowest_ms"] for _, notes in found),
        "moved_though_not_understood": total["moved"],
        "not_understood": total["not_understood"],
        "understood": total["understood"],
        "to_be_confirmed": total["repaired"],
        "long_line_us": long_line_us,
        "examples": [example for _, notes in found for example in notes["examples"]][:_EXAMPLES],
    }


def _share(strings: int, seed: int) -> tuple[Counter[str], dict[str, Any]]:
    rng = random.Random(seed)
    lexicon = load_lexicon()
    programs = sorted(lexicon.programs)
    read = partial(parse, lexicon=lexicon, proposer=lambda words: rng.choice(programs) if rng.random() < SURE else None)
    sampler = Sampler(lexicon, rng.choice)
    read("go forward")
    gc.freeze()  # the lexicon is no garbage, and looking through it is no part of a sentence's time
    counts: Counter[str] = Counter()
    examples: list[str] = []
    slowest_ms = 0.0
    for index in range(1, strings + 1):
        if index % TOLD_EVERY == 0:
            print(f"{index} of {strings} strings", file=sys.stderr, flush=True)
        text = _string(rng, sampler)
        start = time.process_time()
        try:
            record = understand(text, None, lexicon, read)
        except Exception as error:  # noqa: BLE001 - whatever is raised is what is counted
            counts["raised"] += 1
            examples.append(f"{text!r}: {error!r}")
            continue
        took_ms = (time.process_time() - start) * 1_000
        slowest_ms = max(slowest_ms, took_ms)
        fault = _count(counts, record, took_ms)
        if fault:
            examples.append(f"{text!r}: {fault} ({took_ms:.0f} ms)")
    return counts, {"slowest_ms": slowest_ms, "examples": examples[:_EXAMPLES]}


def _count(counts: Counter[str], record: dict[str, Any], took_ms: float) -> str:
    """Take one outcome into the counts; what is wrong with it, if anything."""
    fault = ""
    if took_ms > SLOW_MS:
        counts["slow"] += 1
        fault = "slow"
    if record["status"] == "not_understood":
        counts["not_understood"] += 1
        if any(command not in _STILL for command in record["commands"] or ()):
            counts["moved"] += 1
            fault = "moved"
    elif (record.get("reason") or "").startswith("Did you mean"):
        counts["repaired"] += 1
        if record["commands"] is not None:
            counts["moved"] += 1
            fault = "moved"
    else:
        counts["understood"] += 1
    return fault


# ------------------------------------------------------------------ strings
def _string(rng: random.Random, sampler: Sampler) -> str:
    if rng.random() < 0.2:
        return rng.randbytes(rng.randrange(BYTES_MAX)).decode("utf-8", "replace")
    words = sampler.sample().text.split()
    for _ in range(rng.randrange(4)):
        words = rng.choice(_CHANGES)(rng, words) or words
    return " ".join(words)


def _dropped(rng: random.Random, words: list[str]) -> list[str]:
    at = rng.randrange(len(words))
    return words[:at] + words[at + 1 :]


def _doubled(rng: random.Random, words: list[str]) -> list[str]:
    at = rng.randrange(len(words))
    return words[: at + 1] + words[at:]


def _swapped(rng: random.Random, words: list[str]) -> list[str]:
    one, other = rng.randrange(len(words)), rng.randrange(len(words))
    words = list(words)
    words[one], words[other] = words[other], words[one]
    return words


def _cut_off(rng: random.Random, words: list[str]) -> list[str]:
    at = rng.randrange(len(words))
    return [*words[:at], words[at][: rng.randrange(1, len(words[at]) + 1)], *words[at + 1 :]]


def _misspelt(rng: random.Random, words: list[str]) -> list[str]:
    at = rng.randrange(len(words))
    letters = list(words[at])
    letters[rng.randrange(len(letters))] = rng.choice("abcdefghijklmnopqrstuvwxyz")
    return [*words[:at], "".join(letters), *words[at + 1 :]]


_CHANGES = (_dropped, _doubled, _swapped, _cut_off, _misspelt)


def _long_line_us() -> float:
    """How long it takes to refuse a line of 100,000 characters."""
    line = "turn left and " * 7_143
    start = time.perf_counter()
    record = parse(line)
    assert not isinstance(record, tuple)
    return (time.perf_counter() - start) * 1e6


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("strings", nargs="?", type=int, default=STRINGS)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--json", action="store_true", help="one JSON object")
    options = parser.parse_args()
    figures = run(options.strings, options.processes, options.seed)
    print(json.dumps(figures) if options.json else "\n".join(f"{k:32} {v}" for k, v in figures.items()))


if __name__ == "__main__":
    main()

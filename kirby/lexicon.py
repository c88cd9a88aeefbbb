"""``kirby lexicon``: check the entries, show those of a word, list every word, sample sentences."""

from __future__ import annotations

import random
from collections import Counter
from pathlib import Path

from rich.console import Console
from rich.syntax import Syntax
from rich.table import Table

from grammar.sampling import Sampler
from voxml.schema import Entry
from voxml.vocabulary import ENTRY_FOLDERS, LEXICON_FOLDER, Lexicon, read_lexicon

from .errors import UsageError

SAMPLES = 10
SAMPLE_SEED = 1


def run_lexicon(action: str, word: str | None, folder: Path | None) -> None:
    """Do one of check, show, words, sample.

    Raises:
        UsageError: no such action, or a word is missing or unknown.
        VoxmlError: the lexicon is broken; the text names file, element and remedy.
    """
    where = folder or LEXICON_FOLDER
    lexicon = read_lexicon(where)
    match action:
        case "check":
            _check(lexicon)
        case "words":
            print("\n".join(lexicon.words()))
        case "show":
            _show(lexicon, word, where)
        case "sample":
            _sample(lexicon, word)
        case _:
            raise UsageError(f"'{action}' is nothing to do with a lexicon: use check, show WORD, words or sample N")


def _sample(lexicon: Lexicon, count: str | None) -> None:
    """Sentences sampled from the grammar, with their acts and forms; the same ones every time."""
    if count is not None and not count.isdecimal():
        raise UsageError(f"'{count}' is no number of sentences: kirby lexicon sample 20")
    sampler = Sampler(lexicon, random.Random(SAMPLE_SEED).choice)  # noqa: S311 - not for secrets
    for _ in range(int(count or SAMPLES)):
        sample = sampler.sample()
        print(f"{sample.text}\t{sample.function.value}\t{sample.form}")


def _check(lexicon: Lexicon) -> None:
    counts = Counter(type(entry).__name__.removesuffix("Entry") for entry in lexicon.entries)
    table = Table("entries", "of type", box=None)
    for kind, count in sorted(counts.items()):
        table.add_row(str(count), kind)
    Console().print(table)
    print(f"{len(lexicon.entries)} entries, {len(lexicon.words())} words and phrases: all well formed")


def _show(lexicon: Lexicon, word: str | None, folder: Path) -> None:
    if word is None:
        raise UsageError("which word? for instance: kirby lexicon show fiducial")
    entries = _entries(lexicon, word)
    if not entries:
        raise UsageError(f"'{word}' is not in the lexicon: kirby lexicon words lists what is")
    console = Console()
    for entry in entries:
        path = _file(folder, entry)
        console.print(f"[bold]{path.relative_to(folder)}[/bold]")
        console.print(Syntax(path.read_text(encoding="utf-8"), "xml", background_color="default"))


def _entries(lexicon: Lexicon, word: str) -> tuple[Entry, ...]:
    """The entries whose predicate the word is, or that say it in some form."""
    preds = {word.lower().replace(" ", "_")}
    for sense in lexicon.lookup(word):
        forms = [reading.entry.lex.pred for reading in sense.value] if isinstance(sense.value, tuple) else [sense.value]
        preds.update(name for form in forms for name in _names(form))
    return tuple(entry for entry in lexicon.entries if entry.lex.pred in preds)


def _names(form: object) -> set[str]:
    if isinstance(form, str):
        return {form}
    inner = set().union(*(_names(arg) for arg in getattr(form, "args", ())))
    return {getattr(form, "pred", ""), *inner}


def _file(folder: Path, entry: Entry) -> Path:
    found = [path for name in ENTRY_FOLDERS if (path := folder / name / f"{entry.lex.pred}.xml").exists()]
    kind = type(entry).__name__.removesuffix("Entry").lower()
    return next((path for path in found if path.parent.name.startswith(kind)), found[0])

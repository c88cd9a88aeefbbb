"""The lexicon: every entry by its predicate, and every word or phrase with the senses it may have."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TypeVar

from .inflection import inflect
from .reader import read_entry
from .schema import (
    AttributeEntry,
    Entry,
    FormKind,
    FunctionEntry,
    ObjectEntry,
    ProgramEntry,
    RelationEntry,
    Synonym,
    VoxmlError,
    WordKind,
)
from .terms import Form, Term
from .words import ClosedClasses, read_words

LEXICON_FOLDER = Path(__file__).parent / "lexicon"
ENTRY_FOLDERS = ("objects", "programs", "attributes", "relations", "functions")
ENTRIES_MAX = 10_000

_Entry = TypeVar("_Entry", ObjectEntry, ProgramEntry, AttributeEntry, RelationEntry, FunctionEntry)


@dataclass(frozen=True, slots=True)
class Reading:
    """A verb read as one program, with the argument that the word says by itself, if any.

    ``bare`` says whether it takes a thing without a marker, where it differs from its argument.
    """

    entry: ProgramEntry
    gives: Form | None = None
    bare: bool | None = None


@dataclass(frozen=True, slots=True)
class Sense:
    """What a phrase may be: its category (a terminal of the grammar) and what it stands for there.

    ``value`` is a form, or for verbs the readings it may have, the entry whose own predicate it is first.
    """

    words: tuple[str, ...]
    category: str
    value: Form | tuple[Reading, ...]


class Lexicon:
    """Entries and words. Immutable once built; build it with `load_lexicon`."""

    def __init__(self, entries: tuple[Entry, ...], closed: ClosedClasses) -> None:
        self.entries = entries
        self.closed = closed
        self.objects = _by_pred(entries, ObjectEntry)
        self.programs = _by_pred(entries, ProgramEntry)
        self.attributes = _by_pred(entries, AttributeEntry)
        self.relations = _by_pred(entries, RelationEntry)
        self.functions = _by_pred(entries, FunctionEntry)
        self._senses = _index((*_open_senses(entries), *_closed_senses(closed)))

    def senses(self, first_word: str) -> tuple[Sense, ...]:
        """Every sense of every phrase that begins with the word, the longest phrases first."""
        return self._senses.get(first_word, ())

    def all_senses(self) -> Iterator[Sense]:
        """Every sense of every phrase."""
        return (sense for senses in self._senses.values() for sense in senses)

    def lookup(self, phrase: str) -> tuple[Sense, ...]:
        """The senses of exactly this phrase, inflected or not."""
        words = tuple(phrase.lower().split())
        return tuple(sense for sense in self.senses(words[0]) if sense.words == words) if words else ()

    def categories(self) -> frozenset[str]:
        """Every category that some sense has: the terminals of the grammar that stand for words."""
        return frozenset(sense.category for senses in self._senses.values() for sense in senses)

    def single_words(self) -> dict[str, tuple[Sense, ...]]:
        """The senses of every word that means something by itself."""
        return {
            word: found
            for word, senses in self._senses.items()
            if (found := tuple(sense for sense in senses if len(sense.words) == 1))
        }

    def words(self) -> tuple[str, ...]:
        """Every phrase that means something, in alphabetical order: for completion and for the speech recogniser."""
        return tuple(sorted({" ".join(sense.words) for senses in self._senses.values() for sense in senses}))

    def vocabulary(self) -> frozenset[str]:
        """Every single word that stands in some phrase or closed class."""
        phrases = {word for senses in self._senses.values() for sense in senses for word in sense.words}
        closed = {word for words in self.closed.classes.values() for entry in words for word in entry.words}
        return frozenset(phrases | closed)


def _by_pred(entries: tuple[Entry, ...], kind: type[_Entry]) -> dict[str, _Entry]:
    return {entry.lex.pred: entry for entry in entries if isinstance(entry, kind)}


def _index(senses: tuple[Sense, ...]) -> dict[str, tuple[Sense, ...]]:
    merged: dict[tuple[tuple[str, ...], str, str], Sense] = {}
    for sense in senses:
        is_verb = isinstance(sense.value, tuple)
        key = (sense.words, sense.category, "" if is_verb else str(sense.value))
        known = merged.get(key)
        if known is not None and isinstance(known.value, tuple) and isinstance(sense.value, tuple):
            merged[key] = Sense(sense.words, sense.category, (*known.value, *sense.value))
        else:
            merged[key] = sense
    index: dict[str, list[Sense]] = {}
    for sense in merged.values():
        index.setdefault(sense.words[0], []).append(sense)
    return {word: tuple(sorted(found, key=lambda sense: -len(sense.words))) for word, found in index.items()}


# ------------------------------------------------------------------ senses of entries
def _open_senses(entries: tuple[Entry, ...]) -> Iterator[Sense]:
    # Own predicates come before synonyms, so that a verb's own entry is the first of its readings.
    for own in (True, False):
        for entry in entries:
            for word in _words(entry, own):
                yield from _inflected(entry, word)


def _words(entry: Entry, own: bool) -> tuple[Synonym, ...]:
    if own:
        return (Synonym(entry.lex.pred.replace("_", " ")),) if entry.lex.spoken else ()
    return entry.lex.synonyms


def _inflected(entry: Entry, word: Synonym) -> Iterator[Sense]:
    phrase, kind = word.text.lower(), word.kind
    readings = (Reading(entry, word.gives, word.bare),) if isinstance(entry, ProgramEntry) else ()
    irregular = {(form.of, form.kind): form.value for form in entry.lex.forms}
    base = tuple(phrase.split())

    def sense(category: str, form: FormKind | None, value: Form | tuple[Reading, ...]) -> Sense:
        return Sense(base if form is None else tuple(inflect(phrase, form, irregular).split()), category, value)

    term = Term(entry.lex.pred)
    match entry:
        case ProgramEntry() if kind is WordKind.NOUN:
            yield sense("EVENT", None, readings)
            yield sense("EVENT", FormKind.PLURAL, readings)
        case ProgramEntry():
            yield sense("VERB", None, readings)
            yield sense("VERB_ING", FormKind.ING, readings)
            yield sense("VERB_PAST", FormKind.PAST, readings)
            yield sense("VERB_THIRD", FormKind.THIRD, readings)
        case ObjectEntry():
            yield sense("NOUN", None, term)
            yield sense("NOUNS", FormKind.PLURAL, Term("plural", (term,)))
        case AttributeEntry():
            compared = (sense("", form, term).words for form in (FormKind.SUPERLATIVE, FormKind.COMPARATIVE))
            yield from _attribute_senses(entry, base, tuple(compared), kind)
        case RelationEntry():
            yield sense("PATH" if entry.relation_class == "force_dynamic" else "LOC", None, term)
        case FunctionEntry():
            yield sense(entry.referent.upper(), None, term)


def _attribute_senses(
    entry: AttributeEntry, base: tuple[str, ...], compared: tuple[tuple[str, ...], ...], kind: WordKind | None
) -> Iterator[Sense]:
    """ "the smaller one" is the smallest of those that are meant."""
    term = Term(entry.lex.pred)
    if any("event" in arg.types for arg in entry.args) or kind is WordKind.ADVERB:
        yield Sense(base, "MANNER", term)
    elif entry.scale == "ordinal":
        yield Sense(base, "ORDINAL", term)
    else:
        yield Sense(base, "ADJECTIVE", term)
        if entry.scale == "rational":
            superlative = Term(inflect(entry.lex.pred, FormKind.SUPERLATIVE, {}))
            yield from (Sense(words, "ORDINAL", superlative) for words in compared)


def _closed_senses(closed: ClosedClasses) -> Iterator[Sense]:
    for name, words in closed.classes.items():
        for word in words:
            if word.value is not None:
                yield Sense(word.words, name, word.value)


# ------------------------------------------------------------------ loading
def read_lexicon(folder: Path) -> Lexicon:
    """Read every entry under a folder laid out as ``voxml/lexicon``.

    Raises:
        VoxmlError: an entry that is malformed, in the wrong folder, or whose predicate is taken; names file and remedy.
    """
    found: dict[tuple[type, str], Path] = {}
    entries = []
    for path in _entry_paths(folder):
        entry = read_entry(path)
        key = (type(entry), entry.lex.pred)
        if key in found:
            raise VoxmlError(f"{path}: <Pred>: '{entry.lex.pred}' is also in {found[key]}: merge the two or rename one")
        found[key] = path
        entries.append(entry)
    return Lexicon(tuple(entries), read_words(folder / "words.xml"))


def _entry_paths(folder: Path) -> list[Path]:
    paths = [path for name in ENTRY_FOLDERS for path in sorted((folder / name).glob("*.xml"))]
    if len(paths) > ENTRIES_MAX:
        raise VoxmlError(f"{folder}: {len(paths)} entries are too many: at most {ENTRIES_MAX}")
    return paths


@cache
def load_lexicon(folder: Path = LEXICON_FOLDER) -> Lexicon:
    """The lexicon of a folder, read once per process. Raises VoxmlError."""
    return read_lexicon(folder)

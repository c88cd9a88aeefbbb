"""Other languages: the same entries under other words. A language is data, ``voxml/languages/<code>/``."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path
from xml.etree.ElementTree import Element

from .reader import parse_xml, read_xml_text
from .schema import (
    AttributeEntry,
    Entry,
    FunctionEntry,
    Lex,
    ObjectEntry,
    ProgramEntry,
    RelationEntry,
    Synonym,
    VoxmlError,
    WordKind,
)
from .terms import parse_form
from .vocabulary import Lexicon, load_lexicon
from .words import read_words

LANGUAGES_FOLDER = Path(__file__).parent / "languages"
_KINDS = {
    "Program": ProgramEntry,
    "Object": ObjectEntry,
    "Attribute": AttributeEntry,
    "Relation": RelationEntry,
    "Function": FunctionEntry,
}


@cache
def load_language(code: str) -> Lexicon:
    """Kirby's lexicon in the words of another language, by its code such as ``es``. Raises VoxmlError."""
    if not (LANGUAGES_FOLDER / code).is_dir():
        raise VoxmlError(f"{code}: there is no such language: give one of {', '.join(languages())}")
    return translated(load_lexicon(), LANGUAGES_FOLDER / code)


def languages() -> tuple[str, ...]:
    """The codes of the languages beside English."""
    return tuple(sorted(path.name for path in LANGUAGES_FOLDER.iterdir() if path.is_dir()))


def translated(lexicon: Lexicon, folder: Path) -> Lexicon:
    """The entries of a lexicon under the words of a folder's ``entries.xml``; closed classes are its ``words.xml``.

    Entries that have no words there stay known by their predicate, for what programs are made of, but cannot be said.

    Raises:
        VoxmlError: names file, element and remedy.
    """
    words = _entry_words(folder / "entries.xml", {(type(entry), entry.lex.pred) for entry in lexicon.entries})
    entries = tuple(_renamed(entry, words.get((type(entry), entry.lex.pred), ())) for entry in lexicon.entries)
    return Lexicon(entries, read_words(folder / "words.xml"))


def _renamed(entry: Entry, words: tuple[Synonym, ...]) -> Entry:
    lex = Lex(entry.lex.pred, entry.lex.types, spoken=False, synonyms=words)
    return replace(entry, lex=lex)


def _entry_words(path: Path, known: set[tuple[type, str]]) -> dict[tuple[type, str], tuple[Synonym, ...]]:
    found: dict[tuple[type, str], tuple[Synonym, ...]] = {}
    for element in parse_xml(read_xml_text(path), str(path), "Entries"):
        key = (_KINDS.get(element.tag, type(None)), element.get("Pred", ""))
        if key not in known:
            raise VoxmlError(f'{path}: <{element.tag} Pred="{key[1]}">: the lexicon has no such entry: correct Pred')
        found[key] = tuple(word for child in element for word in _synonyms(child, path))
    return found


def _synonyms(element: Element, path: Path) -> Iterator[Synonym]:
    texts = [text.strip() for text in (element.text or "").split("|")]
    if element.tag != "Word" or not all(texts):
        raise VoxmlError(f"{path}: <{element.tag}>: write <Word>one | several spellings</Word>")
    gives, kind = element.get("Gives"), element.get("Kind")
    for text in texts:
        yield Synonym(text, WordKind(kind) if kind else None, parse_form(gives) if gives else None)

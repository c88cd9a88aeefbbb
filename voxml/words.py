"""Closed-class vocabulary: ``words.xml``, the words that have no entry of their own, by class."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from xml.etree.ElementTree import Element

from .reader import parse_xml, read_xml_text
from .schema import VoxmlError
from .terms import Form, FormError, parse_form


@dataclass(frozen=True, slots=True)
class ClosedWord:
    """A word (or several) of a class. ``value`` is what it stands for; ``text`` is that as written."""

    words: tuple[str, ...]
    text: str
    value: Form | None


@dataclass(frozen=True, slots=True)
class ClosedClasses:
    """Every class by its name, in the order of the file."""

    classes: dict[str, tuple[ClosedWord, ...]] = field(default_factory=dict)

    def words_of(self, name: str) -> tuple[ClosedWord, ...]:
        return self.classes.get(name, ())

    def table(self, name: str) -> dict[str, str]:
        """Word (several joined by spaces) to its value's text."""
        return {" ".join(word.words): word.text for word in self.words_of(name)}


def read_words(path: Path) -> ClosedClasses:
    """Read ``words.xml``: ``<Words><Class Name="UNIT"><Word Value="0.3048m">foot | feet | ft</Word>...``.

    Classes whose name is in capitals are terminals of the grammar, and their values are forms.

    Raises:
        VoxmlError: names file, element and remedy.
    """
    root = parse_xml(read_xml_text(path), str(path), "Words")
    classes: dict[str, tuple[ClosedWord, ...]] = {}
    for element in root:
        name = element.get("Name")
        if element.tag != "Class" or not name:
            raise VoxmlError(f'{path}: <{element.tag}>: only <Class Name="..."> may stand in <Words>')
        classes[name] = (*classes.get(name, ()), *(word for child in element for word in _words(child, name, path)))
    return ClosedClasses(classes)


def _words(element: Element, name: str, path: Path) -> list[ClosedWord]:
    spellings = [spelling.split() for spelling in (element.text or "").split("|")]
    if element.tag != "Word" or not all(spellings):
        raise VoxmlError(f"{path}: <Class {name}>: write <Word>one | several spellings</Word>")
    value = element.get("Value")
    if value:
        meant = _meant(value, name, path)
        return [ClosedWord(tuple(words), *meant) for words in spellings]
    joint = "_" if name.isupper() else " "
    return [ClosedWord(tuple(words), *_meant(joint.join(words), name, path)) for words in spellings]


def _meant(text: str, name: str, path: Path) -> tuple[str, Form | None]:
    """What a word stands for, as written and as the form it is in classes that are terminals."""
    if not name.isupper():
        return text, None
    try:
        return text, parse_form(text)
    except FormError as error:
        raise VoxmlError(f"{path}: <Class {name}><Word Value>: {error}") from None

"""Every world speaks the lexicon's language: what stands in it has a type and attributes that have entries."""

from __future__ import annotations

from pathlib import Path

import pytest

import corpora
from voxml.scene import load_scene
from voxml.vocabulary import load_lexicon

WORLDS = sorted((Path(corpora.__file__).parent / "worlds").glob("*.yaml"))
LEXICON = load_lexicon()


@pytest.mark.parametrize("path", WORLDS, ids=lambda path: path.stem)
def test_types_and_attributes_are_entries_of_the_lexicon(path: Path) -> None:
    scene = load_scene(path)
    assert scene.name == path.stem
    assert {thing.type for thing in scene.objects} <= LEXICON.objects.keys()
    words = {attribute for thing in scene.objects for attribute in thing.attributes}
    unknown = {word for word in words if not any(sense.category == "ADJECTIVE" for sense in LEXICON.lookup(word))}
    assert unknown == set()

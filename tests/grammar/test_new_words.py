"""Adding a verb and a noun takes two XML files and no Python."""

from __future__ import annotations

import shutil
from pathlib import Path

from dialogue.understanding import understand
from grammar import NotUnderstood, parse
from voxml.vocabulary import LEXICON_FOLDER, Lexicon, read_lexicon

VERB = """<?xml version="1.0" encoding="utf-8"?>
<VoxML>
  <Entity Type="Program" />
  <Lex>
    <Pred>pirouette</Pred>
    <Type>process</Type>
    <Synonyms><Synonym>do a twirl</Synonym></Synonyms>
  </Lex>
  <Type>
    <Head>process</Head>
    <Args>
      <Arg Value="x:agent" />
      <Arg Value="y:side" Optional="true" />
      <Arg Value="z:angle" Default="360deg" />
    </Args>
    <Body><Subevent Value="e1:rotate(x,y,z)" /></Body>
  </Type>
</VoxML>
"""
NOUN = """<?xml version="1.0" encoding="utf-8"?>
<VoxML>
  <Entity Type="Object" />
  <Lex>
    <Pred>samovar</Pred>
    <Type>physobj*artifact</Type>
    <Synonyms><Synonym>tea urn</Synonym></Synonyms>
  </Lex>
  <Type>
    <Head>cylindroid[1]</Head>
    <Components />
    <Concavity>Convex</Concavity>
    <RotatSym>Y</RotatSym>
    <ReflSym>XY,YZ</ReflSym>
  </Type>
  <Habitat>
    <Intrinsic><Intr Name="UP[2]" Value="align(Y,E_y)" /></Intrinsic>
    <Extrinsic />
  </Habitat>
  <Afford_Str>
    <Affordances><Affordance Formula="H[2]-&gt;[go(x, to([1]))]at(x, [1])" /></Affordances>
  </Afford_Str>
  <Embodiment>
    <Scale>agent</Scale>
    <Movable>true</Movable>
  </Embodiment>
</VoxML>
"""


def extended(folder: Path) -> Lexicon:
    """A copy of Kirby's lexicon with the two files."""
    shutil.copytree(LEXICON_FOLDER, folder / "lexicon")
    (folder / "lexicon" / "programs" / "pirouette.xml").write_text(VERB, encoding="utf-8")
    (folder / "lexicon" / "objects" / "samovar.xml").write_text(NOUN, encoding="utf-8")
    return read_lexicon(folder / "lexicon")


def test_two_files_make_a_new_verb_and_a_new_noun(tmp_path: Path) -> None:
    lexicon = extended(tmp_path)

    def read(text: str) -> dict[str, object]:
        return understand(text, None, lexicon, lambda words: parse(words, lexicon))

    turned = read("kirby, could you pirouette to the left please")
    assert (turned["form"], turned["commands"]) == ("pirouette(left)", ["turn left 360"])
    assert read("do a twirl")["commands"] == ["turn left 360"]
    assert read("go to the nearest red samovar")["form"] == "go(to(the(nearest(red(samovar)))))"
    assert read("how many tea urns do you see")["form"] == "count(samovar)"
    assert read("stop pirouetting and go past the samovars")["status"] != "not_understood"


def test_without_the_files_nobody_knows_the_words() -> None:
    assert isinstance(parse("pirouette"), NotUnderstood)
    assert isinstance(parse("go to the samovar"), NotUnderstood)

"""A second language is data: Spanish words and rules for the same entries and meanings."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import pytest

from dialogue.understanding import understand
from grammar import Function, NotUnderstood, parse
from voxml.language import languages, load_language, translated
from voxml.schema import VoxmlError
from voxml.vocabulary import load_lexicon

SPANISH = [
    ("avanza dos metros", "go(forward,2m)", ["go forward 2"]),
    ("por favor retrocede medio metro", "go(back,0.5m)", ["go forward -0.5"]),
    ("avanza un metro y medio", "go(forward,1.5m)", ["go forward 1.5"]),
    ("gira a la izquierda cuarenta y cinco grados", "turn(left,45deg)", ["turn left 45"]),
    ("¿puedes girar a la derecha?", "turn(right)", ["turn right 90"]),
    ("date la vuelta", "turn_around", ["turn left 180"]),
    ("mira hacia el norte", "face(north)", ["turn left 90"]),
    ("ve a 2 3", "go(to(point(2m,3m)))", ["go to 2 3"]),
    ("toma una foto", "take_picture", ["take picture"]),
    ("patrulla", "patrol", ["patrol 16 1.5 1"]),
    ("deja de patrullar", "stop_patrol", ["stop patrol"]),
    ("para", "stop", ["stop"]),
    ("sigue", "continue", ["continue"]),
    ("cancela", "cancel", ["cancel"]),
    ("cancela todo", "cancel_all", ["cancel all"]),
    ("vuelve", "go_back", ["go back"]),
    ("sigue adelante", "keep_going", ["keep going"]),
    (
        "gira noventa grados a la derecha y luego avanza un metro",
        "seq(turn(right,90deg),go(forward,1m))",
        ["turn right 90", "go forward 1"],
    ),
    ("ve a la primera puerta roja a la derecha", "go(to(the(first(red(door),on(right)))))", None),
    ("ve al bloque azul cerca de la mesa", "go(to(the(blue(block),near(the(table)))))", None),
    ("ve despacio a la caja pequeña detrás de la silla", "slowly(go(to(the(small(box),behind(the(chair))))))", None),
    ("ve a la puerta más cercana", "go(to(the(nearest(door))))", None),
    ("busca el tercer marcador", "find(the(third(fiducial)))", None),
]


@pytest.mark.parametrize(("text", "form", "commands"), SPANISH)
def test_spanish_means_what_english_means(text: str, form: str, commands: list[str] | None) -> None:
    lexicon = load_language("es")
    record = understand(text, None, lexicon, partial(parse, lexicon=lexicon, language="es"))
    assert (record["act"], record["form"], record["commands"]) == ("instruct", form, commands)


def test_repair_and_stopping_work_in_spanish() -> None:
    read = partial(parse, lexicon=load_language("es"), language="es")
    acts = read("gira a la izqierda")
    assert isinstance(acts, tuple)
    assert acts[0].repaired == "gira a la izquierda"
    stopped = read("para blorp")
    assert isinstance(stopped, tuple)
    assert (stopped[0].function, str(stopped[0].form)) == (Function.INSTRUCT, "stop")
    assert isinstance(read("turn left"), NotUnderstood)


def test_an_unknown_language_is_refused_with_those_there_are() -> None:
    assert "es" in languages()
    with pytest.raises(VoxmlError, match="es"):
        load_language("tlh")


def test_words_for_an_entry_that_is_not_there_are_refused(tmp_path: Path) -> None:
    (tmp_path / "entries.xml").write_text('<Entries><Object Pred="wug"><Word>wug</Word></Object></Entries>')
    (tmp_path / "words.xml").write_text("<Words />")
    with pytest.raises(VoxmlError, match="wug"):
        translated(load_lexicon(), tmp_path)

"""``kirby parse``: the JSON that other programs read, a record a line, in order."""

import json
import subprocess
import sys

WITHOUT_WORLD = "turn left forty five degrees\nface north\ngo to the red block\nblorp\n"


def parse(*arguments, said=None):
    command = [sys.executable, "-m", "kirby", "parse", *arguments]
    return subprocess.run(command, input=said, capture_output=True, text=True, timeout=120, check=False)


def records(*arguments, said=None):
    return [json.loads(line) for line in parse("--json", *arguments, said=said).stdout.splitlines()]


def test_a_record_for_each_line_in_order():
    turn, face, go, blorp = records(said=WITHOUT_WORLD)
    assert (turn["status"], turn["act"], turn["form"], turn["commands"]) == (
        *("ok", "instruct", "turn(left,45deg)"),
        ["turn left 45"],
    )
    assert (face["status"], face["commands"]) == ("ok", ["turn left 90"])
    assert (go["status"], go["commands"]) == ("needs_world", None)
    assert (blorp["status"], blorp["form"], blorp["commands"], blorp["span"]) == ("not_understood", None, None, [0, 5])
    assert blorp["expected"]
    assert [each["utterance"] for each in (turn, face, go, blorp)] == WITHOUT_WORLD.splitlines()


def test_an_empty_line_has_its_record_too():
    assert [record["status"] for record in records(said="stop\n\nstop\n")] == ["ok", "not_understood", "ok"]


def test_with_a_world_places_become_commands():
    (record,) = records("--world", "figure3", "go", "to", "the", "red", "block")
    assert record["status"] == "ok"
    assert record["commands"][0].startswith("go to ")


def test_for_people_the_place_is_marked():
    shown = parse("go", "to", "the", "blorp")
    assert shown.returncode == 1
    text, marks = shown.stdout.splitlines()[:2]
    assert text[marks.index("^") :] == "blorp"


def test_a_line_beyond_all_measure_is_refused_at_once():
    (record,) = records(said="go forward " * 10_000 + "\n")
    assert record["status"] == "not_understood"
    assert record["commands"] is None

"""Writes docs/paper-dialogues.md: the paper's dialogues as they go in pybullet (see tests/kirby/paper.py)."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
DOCUMENT = ROOT / "docs" / "paper-dialogues.md"
HEADER = """# The paper's dialogues

Every utterance quoted in the paper, and its scenario, spoken to Kirby over a real Redis with the robot driving in
pybullet. `tests/kirby/test_paper.py` plays them again and checks where the robot truly is; `script/paper-dialogues`
writes this page.

`>` is what went to the `Kirby` key; in brackets is a gesture, in parentheses where the robot truly stands, in metres.
"""


def write() -> None:
    """Play every dialogue and write down how it went."""
    sys.path.insert(0, str(ROOT / "tests" / "kirby"))
    from paper import SCENES, Rehearsal, section
    from stage import stage

    sections = []
    for scene in SCENES:
        with tempfile.TemporaryDirectory() as folder, stage(Path(folder), scene.world) as made:
            kirby = Rehearsal(made)
            scene.play(kirby)
            sections.append(section(scene, kirby))
        print(scene.title, file=sys.stderr)
    DOCUMENT.write_text("\n".join([HEADER, *sections]), encoding="utf-8")


if __name__ == "__main__":
    write()

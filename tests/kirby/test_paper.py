"""Every utterance quoted in the paper, and its scenario, said to Kirby in pybullet; and the transcript in the docs."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from paper import SCENES, Rehearsal, Scene, section
from stage import stage

DOCUMENT = Path(__file__).parents[2] / "docs" / "paper-dialogues.md"


@pytest.mark.physics
@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.play.__name__)
def test_a_dialogue_of_the_paper(tmp_path: Path, scene: Scene) -> None:
    with stage(tmp_path, scene.world) as made:
        kirby = Rehearsal(made)
        scene.play(kirby)
        assert made.body.contacts() == ()
    written = DOCUMENT.read_text(encoding="utf-8")
    is_current = _gist(section(scene, kirby)) in _gist(written)
    assert is_current, "run: script/paper-dialogues"


def _gist(text: str) -> str:
    """Where exactly the robot came to stand differs by a hair from machine to machine, and words are added."""
    return re.sub(r"-?\d+(\.\d+)?|I expected .*", "#", text)

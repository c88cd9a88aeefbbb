"""The view is changed by words, and the robot stays where it is."""

import pytest

from dialogue.events import CameraMove, MoveCamera
from kirby.agent import Agent


@pytest.mark.parametrize(
    ("said", "move"),
    [
        ("show me your view", CameraMove.ROBOT_VIEW),
        ("switch to your camera", CameraMove.ROBOT_VIEW),
        ("show me the bird's eye view", CameraMove.BIRDS_EYE),
        ("show me the map", CameraMove.BIRDS_EYE),
        ("rotate the camera left", CameraMove.ROTATE_LEFT),
        ("turn the view right", CameraMove.ROTATE_RIGHT),
        ("switch views", CameraMove.SWITCH_RIGHT),
    ],
)
def test_words_move_the_camera_alone(said: str, move: CameraMove) -> None:
    assert Agent().hear(said, time_s=1.0) == (MoveCamera(move),)

"""The worlds that come with Kirby, and those of the caller."""

from __future__ import annotations

from pathlib import Path

import corpora
from voxml.scene import Scene, SceneError, find_scene

from .errors import UsageError

DEFAULT_WORLD = "figure3"
FOLDER = Path(corpora.__file__).parent / "worlds"


def find_world(name_or_path: str) -> Scene:
    """The scene of that name among Kirby's own, or in a ``.yaml`` file.

    Raises:
        UsageError: there is no such world, or its file is broken; the text says which there are.
    """
    try:
        return find_scene(name_or_path, FOLDER)
    except SceneError as error:
        raise UsageError(str(error)) from None


def world_file(name_or_path: str) -> tuple[Path, Scene]:
    """The file, absolute, and what it holds. Raises UsageError as :func:`find_world` does."""
    scene = find_world(name_or_path)
    own = FOLDER / f"{name_or_path}.yaml"
    return (own if own.exists() else Path(name_or_path)).absolute(), scene

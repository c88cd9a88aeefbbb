"""The worlds that come with Kirby, and those of the caller."""

from __future__ import annotations

from importlib.resources import files

from voxml.scene import Scene, SceneError, find_scene

from .errors import UsageError

DEFAULT_WORLD = "figure3"


def find_world(name_or_path: str) -> Scene:
    """The scene of that name among Kirby's own, or in a ``.yaml`` file.

    Raises:
        UsageError: there is no such world, or its file is broken; the text says which there are.
    """
    try:
        return find_scene(name_or_path, files("corpora") / "worlds")
    except SceneError as error:
        raise UsageError(str(error)) from None

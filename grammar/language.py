"""The grammars of the languages, as text: one ``.lark`` file each."""

from __future__ import annotations

from functools import cache
from pathlib import Path

FOLDER = Path(__file__).parent / "languages"


@cache
def language_grammar(language: str) -> str:
    """The grammar of a language by its code, such as ``en``, in Lark's notation."""
    return (FOLDER / f"{language}.lark").read_text(encoding="utf-8")

"""Automata kept in a file, so that a grammar is analysed once and not at every start.

A file is named by a hash of the grammar, of the code that compiles it and of Lark's version, and is JSON; what is not
there, does not fit or cannot be written is compiled anew, which takes about 0.3 s.
"""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from dataclasses import astuple
from importlib.metadata import version
from pathlib import Path

from . import automaton as compiler
from .automaton import Automaton, RuleShape, compiled

FILES_MAX = 8


def default_folder() -> Path:
    """The user's cache folder (XDG Base Directory Specification), whether it can be written or not."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "kirby"


def automaton(grammar: str, folder: Path | None = None) -> Automaton:
    """The automaton of a grammar in Lark's notation, read from the folder or compiled and kept there."""
    kept = (folder or default_folder()) / f"grammar-{_fingerprint(grammar)}.json"
    known = _read(kept)
    if known is None:
        known = compiled(grammar)
        _keep(known, kept)
    return known


def _fingerprint(grammar: str) -> str:
    code = Path(compiler.__file__).read_bytes()
    return hashlib.sha256(b"\0".join((grammar.encode(), code, version("lark").encode()))).hexdigest()[:32]


def _read(path: Path) -> Automaton | None:
    """The automaton of a file; None where there is none, or it is not as `_keep` writes it."""
    try:
        text, _, digest = path.read_text(encoding="utf-8").rpartition("\n")
    except (OSError, UnicodeDecodeError):
        return None
    if _digest(text) != digest:
        return None
    start, accept, rules, shifts, reductions, gotos = json.loads(text)
    shapes = tuple(RuleShape(*rule) for rule in rules)
    return Automaton(start, accept, shapes, tuple(shifts), tuple(reductions), tuple(gotos))


def _keep(known: Automaton, path: Path) -> None:
    """Write the file in one step; a folder that cannot be written costs the next start some time and nothing else."""
    text = json.dumps(astuple(known), separators=(",", ":"))
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=path.parent, delete=False) as file:
            file.write(f"{text}\n{_digest(text)}")
        Path(file.name).replace(path)
        _forget_old(path.parent)
    except OSError:
        return


def _forget_old(folder: Path) -> None:
    """Grammars that were changed since are not needed any more."""
    files = sorted(folder.glob("grammar-*.json"), key=lambda path: path.stat().st_mtime)
    for path in files[:-FILES_MAX]:
        path.unlink(missing_ok=True)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()

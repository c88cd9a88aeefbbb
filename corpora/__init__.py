"""Corpora of utterances and dialogues with what must come of them, the worlds they speak of, and their runner.

Worlds are wanted by rooms that have no use for the dialogue engine, so it is imported only when corpora are run.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from voxml.vocabulary import Lexicon

    from .runner import Report

__all__ = ["run"]


def run(paths: Iterable[Path] = (), lexicon: Lexicon | None = None) -> Report:
    """See `corpora.runner.run`; `corpora.reporting.report_text` puts the report into words."""
    from .runner import run as run_corpora

    return run_corpora(paths, lexicon)

"""``kirby corpus``: run corpora and show what failed, step by step."""

from __future__ import annotations

from pathlib import Path

from corpora.cases import CorpusError
from corpora.reporting import report_text
from corpora.runner import run

from .errors import UsageError


def run_corpora(paths: tuple[Path, ...]) -> bool:
    """Print the report; True when everything came out as expected.

    Raises:
        UsageError: a file cannot be used.
    """
    try:
        report = run(paths)
    except CorpusError as error:
        raise UsageError(str(error)) from None
    print(report_text(report))
    return report.ok

"""Corpora of utterances and dialogues with what must come of them, the worlds they speak of, and their runner."""

from .cases import CorpusError
from .reporting import failure_text, report_text
from .runner import Difference, Report, Result, default_corpora, run

__all__ = ["CorpusError", "Difference", "Report", "Result", "default_corpora", "failure_text", "report_text", "run"]

"""``kirby train language``: a language model from Kirby's own corpora and grammar, kept for the talks to come."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console
from rich.table import Table

from voxml.vocabulary import load_lexicon

from .errors import UsageError
from .proposer import check_extra, model_folder
from .train_model import Trained, train


def run_train(what: str, out: Path | None) -> None:
    """Train the model, save it, and print how good it is.

    Raises:
        UsageError: there is no such thing to train.
        ModelError: a package of the extra is not installed, or the folder cannot be written.
    """
    if what != "language":
        raise UsageError(f"'{what}' is nothing to train: kirby train language")
    check_extra()
    console = Console()
    trained = train(load_lexicon(), console.print)
    folder = out or model_folder()
    trained.model.save(folder)
    console.print(_table(trained))
    whose = "which Kirby asks from now on" if out is None else "for Agent(proposer=LanguageModel.load(...))"
    console.print(f"the model is in {folder}, {whose}", soft_wrap=True, highlight=False)


def _table(trained: Trained) -> Table:
    table = Table(
        "held out", "orders", "label right", "proposed", "of these right", "others", "proposed", "stopped for",
        title=f"Orders with an unknown verb; asked about where surer than {trained.model.classes.threshold:.0%}",
    )  # fmt: skip
    for source, scores in trained.scores.items():
        table.add_row(
            source,
            str(scores.asking),
            f"{scores.accuracy:.1%}",
            f"{scores.coverage:.1%}",
            f"{scores.precision:.1%}",
            str(scores.other),
            f"{scores.false_share:.1%}",
            str(scores.stopped),
        )
    return table

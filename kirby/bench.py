"""``kirby bench``: the benchmarks by name, and their figures as a table or as JSON."""

from __future__ import annotations

import importlib
import json
import pkgutil

from rich.console import Console
from rich.table import Table

import benchmarks

from .errors import UsageError


def names() -> tuple[str, ...]:
    """Every benchmark there is."""
    return tuple(module.name for module in pkgutil.iter_modules(benchmarks.__path__) if not module.name.startswith("_"))


def run_bench(name: str | None, as_json: bool) -> None:
    """Run one benchmark and print what it measured; without a name, say which there are.

    Raises:
        UsageError: there is no benchmark of that name.
    """
    if name is None:
        for each in names():
            print(f"{each:14} {(importlib.import_module(f'benchmarks.{each}').__doc__ or '').splitlines()[0]}")
        return
    if name not in names():
        raise UsageError(f"there is no benchmark '{name}': choose one of {', '.join(names())}")
    figures = importlib.import_module(f"benchmarks.{name}").run()
    if as_json:
        print(json.dumps(figures))
        return
    table = Table(title=f"kirby bench {name}", show_header=False)
    for key, value in figures.items():
        table.add_row(key.replace("_", " "), f"{value:,.4g}" if isinstance(value, float) else str(value))
    Console().print(table)

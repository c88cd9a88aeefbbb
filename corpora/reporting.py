"""A report in words: every failing case with what was expected and what came, and a table of the files."""

from __future__ import annotations

from collections import Counter

from .runner import Report, Result


def failure_text(result: Result) -> str:
    """A failing case, step by step."""
    lines = [f"{result.source}: {result.text}"]
    if result.known is not None and not result.differences:
        lines.append(f"  passes, but is listed as a known failure ({result.known.reason}): take it off the list")
    for difference in result.differences:
        lines.append(f"  {difference.step}")
        lines.append(f"    expected: {_shown(difference.expected)}")
        lines.append(f"    got:      {_shown(difference.got)}")
    return "\n".join(lines)


def report_text(report: Report) -> str:
    """All failures, then one line a file: cases, passed, failed, known to fail."""
    parts = [failure_text(result) for result in report.failures()]
    parts += [f"{k.source}: {k.text}\n  is listed as a known failure, and there is no such case" for k in report.stale]
    return "\n\n".join([*parts, _table(report)])


def _table(report: Report) -> str:
    counts: dict[str, Counter[str]] = {}
    for result in report.results:
        kind = "failed" if not result.ok else "known" if result.known else "passed"
        counts.setdefault(result.source, Counter())[kind] += 1
    width = max([len("corpus"), *map(len, counts)])
    rows = [f"{'corpus':{width}}  cases  passed  failed  known"]
    total: Counter[str] = Counter()
    for source, count in [*counts.items(), ("all", total)]:
        total.update(count if source != "all" else {})
        rows.append(
            f"{source:{width}}  {count.total():5}  {count['passed']:6}  {count['failed']:6}  {count['known']:5}"
        )
    return "\n".join(rows)


def _shown(value: object) -> str:
    if isinstance(value, tuple):
        return "; ".join(map(str, value)) if value else "nothing"
    return "nothing" if value is None else str(value)

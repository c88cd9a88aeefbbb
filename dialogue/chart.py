"""The state chart of the dialogue manager, drawn from its table (Mermaid)."""

from __future__ import annotations

from .table import FOLLOWING, QUESTIONS, TABLE, Row, State

_GROUPS = {FOLLOWING: "Following the robot", QUESTIONS: "A question of Kirby's own", tuple(State): "Any state"}


def chart() -> str:
    """The table as a Mermaid state diagram: an edge for each row whose sources are a group, drawn from the group."""
    lines = ["stateDiagram-v2"]
    for name, group in (("Following", FOLLOWING), ("Question", QUESTIONS)):
        lines.append(f'    state "{_GROUPS[group]}" as {name} {{')
        lines += [f'        state "{state.value}" as {state.name}' for state in group]
        lines.append("    }")
    lines += [f'    state "{_GROUPS[tuple(State)]}" as Any', f"    [*] --> {State.IDLE.name}"]
    lines += [line for row in TABLE if (line := _edge(row))]
    return "\n".join(lines) + "\n"


def _edge(row: Row) -> str:
    source = {FOLLOWING: "Following", QUESTIONS: "Question", tuple(State): "Any"}[row.sources]
    label = row.trigger.value + (f" [{row.when.value}]" if row.when else "")
    target = source if row.target is None else row.target.name
    return f"    {source} --> {target}: {label}"

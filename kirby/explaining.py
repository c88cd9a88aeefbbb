"""``kirby parse --explain``: tokens, derivation, form, and why."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from grammar.acts import NotUnderstood
from grammar.explain import Explainer, Node
from grammar.reader import Reader
from voxml.vocabulary import load_lexicon


def explainer() -> Callable[[str], str]:
    """A function from an utterance to the lines that tell how it was read."""
    lexicon = load_lexicon()
    reader = Reader(lexicon)
    explain = Explainer(reader, lexicon).explain

    def show(text: str) -> str:
        found = explain(text)
        lines = [f"tokens: {' | '.join(token.text for token in found.tokens)}"]
        if isinstance(found.outcome, NotUnderstood):
            start, end = found.outcome.span
            expected = ", ".join(found.outcome.expected)
            return "\n".join([*lines, f"stopped at: '{text[start:end]}'", f"expected: {expected}"])
        for act in found.outcome:
            tree = next((tree for tree in found.trees if tree.value[1] == act.form), None)
            lines.append(f"{act.function.value}: {act.form}")
            lines += [] if tree is None else _drawn(tree, 1)
        return "\n".join(lines)

    return show


def _drawn(node: Node, depth: int) -> Iterator[str]:
    """A line for each rule and word, indented by depth."""
    indent = "  " * depth
    if not node.parts:
        yield f"{indent}{node.label} '{node.words}'"
        return
    yield f"{indent}{node.label}"
    for part in node.parts:
        yield from _drawn(part, depth + 1)

"""Writes the state chart into docs/dialogue.md, from the dialogue manager's own table."""

from __future__ import annotations

import re
from pathlib import Path

from dialogue.chart import chart

DOCUMENT = Path(__file__).parent / "dialogue.md"

if __name__ == "__main__":
    text = DOCUMENT.read_text(encoding="utf-8")
    drawn = re.sub(r"(```mermaid\n).*?(```)", lambda fence: fence[1] + chart() + fence[2], text, flags=re.DOTALL)
    DOCUMENT.write_text(drawn, encoding="utf-8")

"""Small pieces of Markdown."""

from __future__ import annotations

import re

CODE = re.compile(r"\b[A-Z]{3}\d{3}\b")


def cell(text: str) -> str:
    """Text as a cell of a table: one line, no bar."""
    return " ".join(text.split()).replace("|", "\\|")


def code(text: str, longest: int = 90) -> str:
    """Text as code in one line, shortened."""
    line = " ".join(text.split())
    if len(line) > longest:
        line = line[: longest - 1] + "…"
    fence = "``" if "`" in line else "`"
    space = " " if "`" in line else ""
    return f"{fence}{space}{line}{space}{fence}" if line else "(empty)"


def table(head: list[str], rows: list[list[str]]) -> str:
    """A table. Cells are Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join("| " + " | ".join(cell(text) for text in line) + " |\n" for line in lines)


def outside_code(page: str) -> list[tuple[str, bool]]:
    """The lines of a page, each with whether it is outside of a fenced block."""
    lines, fence = [], ""
    for line in page.splitlines():
        found = re.match(r"\s*(`{3,}|~{3,})", line)
        if fence:
            lines.append((line, False))
            if found and found.group(1).startswith(fence):
                fence = ""
        else:
            lines.append((line, not found))
            if found:
                fence = found.group(1)
    return lines


def outside_spans(line: str) -> list[tuple[str, bool]]:
    """The parts of a line, each with whether it is outside of code between backticks and of links."""
    parts = re.split(r"(`+[^`]*`+|!?\[[^\]]*\]\([^)]*\))", line)
    return [(part, index % 2 == 0) for index, part in enumerate(parts)]

"""SPEC.md: clauses get anchors (`SPEC/#6.2.3`), codes link to their rules, numbers of clauses to the clauses."""

from __future__ import annotations

import re

from text import CODE, outside_code, outside_spans

CLAUSE = re.compile(r"^\*\*(\d+(?:\.\d+)+)([^*]*)\*\*")
HEADING = re.compile(r"^#+ (\d+(?:\.\d+)*) ")


def clauses(spec: str) -> set[str]:
    """The numbers of all clauses."""
    lines = [line for line, text in outside_code(spec) if text]
    return {found.group(1) for line in lines for found in [CLAUSE.match(line) or HEADING.match(line)] if found}


def page(spec: str, known: set[str], rules: set[str]) -> str:
    """The page of the specification."""
    lines = []
    for line, text in outside_code(spec):
        if not text:
            lines.append(line)
            continue
        clause, heading = CLAUSE.match(line), HEADING.match(line)
        begin = ""
        if clause:
            number, title = clause.groups()
            begin = f"[**{number}{title}**](#{number}){{ #{number} .clause }}"
            line = line[clause.end() :]
        elif heading:
            # Before the heading: a heading keeps the anchor that GitHub gives it.
            lines += [f'<span id="{heading.group(1)}"></span>', ""]
        if not line.startswith("#"):
            line = linked(line, known, rules, "", "rules/")
        lines.append(begin + line)
    return "\n".join(lines) + "\n"


def with_links(page: str, known: set[str], rules: set[str], spec: str, folder: str) -> str:
    """A page whose codes and clauses link as `linked` has them."""
    lines = outside_code(page)
    made = [linked(line, known, rules, spec, folder) if text and line[:1] != "#" else line for line, text in lines]
    return "\n".join(made) + "\n"


def linked(line: str, known: set[str], rules: set[str], spec: str, folder: str) -> str:
    """A line whose codes link to their rules, and whose clauses (6.1.8, §12, `(11.2)`, `clause 7.5`) to SPEC.md."""

    def clause(found: re.Match[str]) -> str:
        before, number = found.groups()
        return f"{before}[{number}]({spec}#{number})" if number in known else found.group(0)

    def rule(found: re.Match[str]) -> str:
        name = found.group(0)
        return f"[{name}]({folder}{name}.md){{ .rule }}" if name in rules else name

    parts = []
    for part, text in outside_spans(line):
        if text:
            part = re.sub(r"(§ ?|\(|[Cc]lauses? |SPEC )(\d+(?:\.\d+)*)(?![\d.]*\d)", clause, part)
            part = re.sub(r"(?<![\w.#\[])()(\d+\.\d+\.\d+)(?![\d.]*\d|\])", clause, part)
            part = re.sub(r"\[([A-Z]{3}\d{3}(?:, [A-Z]{3}\d{3})*)\]", r"\\[\1\\]", part)
            part = CODE.sub(rule, part)
        parts.append(part)
    return "".join(parts)

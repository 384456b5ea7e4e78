"""llms.txt: the pages of the menu, a line each, as https://llmstxt.org asks for."""

from __future__ import annotations

import re

from text import outside_code

HEAD = """# URDD

> urdd checks URDFs and says what programs do with them. It makes, validates and uses Universal Robot Description \
Directories (URDDs): a robot's URDF with everything that robotics programs otherwise compute from it again.

Commands answer as JSON with `--format json`. "For scripts" says in which order to ask, and what to read.
"""
SECTION = re.compile(r"  - ([^:]+):$")
ITEM = re.compile(r"\s+- ([^:]+): (\S+\.md)$")
SHORTEST, LONGEST = 40, 200


def text(settings: str, pages: dict[str, str]) -> str:
    """The file, of mkdocs.yml's menu and the pages by name."""
    menu = settings.partition("\nnav:\n")[2]
    parts = [HEAD]
    in_section = False
    for line in menu.splitlines():
        if found := SECTION.match(line):
            parts.append(f"\n## {found.group(1)}\n\n")
            in_section = True
        elif found := ITEM.match(line):
            title, name = found.groups()
            if not line.startswith("      ") and in_section:
                parts.append(f"\n## {title}\n\n")
            elif not in_section:
                parts.append("\n## Start\n\n")
                in_section = True
            parts.append(f"- [{title}]({address(name)}): {about(pages[name])}\n")
    return "".join(parts)


def address(name: str) -> str:
    """Where mkdocs puts a page."""
    folder = re.sub(r"(^|/)(README|index)\.md$", r"\1", name)
    return (folder.removesuffix(".md") + "/" if folder.endswith(".md") else folder) or "index.html"


def about(page: str) -> str:
    """What a page says first, as text: a sentence, or two short ones."""
    lines = outside_code(page)
    begin = next(k for k, (line, is_text) in enumerate(lines) if is_text and line.startswith("# "))
    lines = lines[begin + 1 :]
    # No table, list, picture or caption.
    first = next((k for k, (line, is_text) in enumerate(lines) if is_text and re.match(r"[\w`(]|\*\*|\[\w", line)), 0)
    words = []
    for line, _ in lines[first:]:
        if not line.strip():
            break
        words.append(line.strip())
    prose = re.sub(r"!?\[([^\]]*)\]\([^)]*\)(\{[^}]*\})?", r"\1", " ".join(words).replace("**", ""))
    text = ""
    for sentence in re.split(r"(?<=[.:]) (?=[A-Z`])", prose):
        if len(text) < SHORTEST:
            text = f"{text} {sentence}".strip()
    return text if len(text) <= LONGEST else text[: LONGEST - 1].rsplit(" ", 1)[0] + " …"

"""The repository's own Markdown pages: copied to the same places, so that their links work, and mended for mkdocs.

Links to folders lead to the README in them. Files of code get a page each. A link to a folder without a page becomes
text.
"""

from __future__ import annotations

import re
import shutil
from html import escape
from pathlib import Path

from text import outside_code

# Pages besides docs/*.md.
PAGES = [
    "README.md",
    "SPEC.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "conformance/README.md",
    "conformance/kill_rate.md",
    "python/README.md",
    "wasm/README.md",
    "wasm/npm/README.md",
    "fuzz/README.md",
    "benches/evaluation/lint/corpus.md",
    "benches/evaluation/lint/evidence.md",
    "page/README.md",
    "tests/figures/exports/README.md",
    "tests/figures/geometry/README.md",
]
# Pages that other scripts make, by the folder or file that links name.
MADE = {
    "rules/README.md": "rules/README.md",
    "schema": "schema/README.md",
    "schema/README.md": "schema/README.md",
}
# Where pages of the repository are on the site, if not in the same place: the site has a first page of its own.
PLACES = {"README.md": "clone.md"}
LANGUAGES = {".py": "python", ".rs": "rust", ".sh": "bash", ".mjs": "javascript", ".ts": "typescript", ".json": "json"}
LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")


class BrokenLinkError(Exception):
    """A page links to something that is not in the repository."""


def names(root: Path) -> list[str]:
    """All pages, by their paths in the repository."""
    return [
        *(page for page in PAGES if (root / page).exists()),
        *sorted(f"docs/{path.name}" for path in root.glob("docs/*.md")),
    ]


class Stage:
    """The folder of pages that mkdocs reads."""

    def __init__(self, root: Path, out: Path) -> None:
        self.root, self.out, self.pages = root, out, set(names(root))

    def write(self, name: str, page: str) -> None:
        """Writes a page that was made."""
        path = self.out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(page, encoding="utf-8")

    def copy(self, name: str) -> None:
        """Copies a file as it is."""
        path = self.out / name
        path.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(self.root / name, path)

    def page(self, name: str, place: str | None = None) -> str:
        """A page of the repository, with links that the site has; for another place of the site, if one is given."""
        up = "../" * (place or name).count("/")
        lines = []
        for line, text in outside_code(lists(self.root.joinpath(name).read_text(encoding="utf-8"))):
            if text:
                line = LINK.sub(lambda found: self.link(name, up, found), line)
                # mkdocs takes `<!` in code for the beginning of a comment, and finds no anchor after it.
                line = re.sub(r"`([^`]*<![^`]*)`", lambda found: f"<code>{escape(found.group(1))}</code>", line)
            lines.append(line)
        return "\n".join(lines) + "\n"

    def link(self, page: str, up: str, found: re.Match[str]) -> str:
        picture, words, target = found.groups()
        if re.match(r"[a-z]+:|#", target):
            return found.group(0)
        path, _, anchor = target.partition("#")
        folder = (self.root / page).parent
        aim = (folder / path).resolve()
        if not aim.exists() and aim.relative_to(self.root).as_posix() not in MADE:
            raise BrokenLinkError(f"{page}: `{target}` is not in the repository; mend the link")
        goal = self.goal(aim.relative_to(self.root).as_posix())
        if goal is None:
            return words
        return f"{picture}[{words}]({up}{goal}{'#' + anchor if anchor else ''})"

    def goal(self, aim: str) -> str | None:
        """What a link to this path of the repository leads to."""
        if aim in MADE:
            return MADE[aim]
        path = self.root / aim
        if path.is_dir():
            readme = f"{aim}/README.md"
            return readme if readme in self.pages else None
        if aim in self.pages:
            return PLACES.get(aim, aim)
        if path.suffix not in LANGUAGES:
            self.copy(aim)
            return aim
        made = aim + ".md"
        made = made if aim.startswith(("examples/", "python/", "tests/", "crates/")) else "source/" + made
        language = LANGUAGES[path.suffix]
        self.write(made, f"# `{aim}`\n\n~~~~{language}\n{path.read_text(encoding='utf-8').rstrip()}\n~~~~\n")
        return made


def lists(page: str) -> str:
    """Indents lists as Python-Markdown wants it: four spaces a level, a blank line before the first item."""
    lines: list[str] = []
    in_list, previous = False, ""
    for line, text in outside_code(page):
        item = text and re.match(r"(\s*)(?:[-*]|\d+\.) ", line)
        if text and line and not line[0].isspace() and not item and not previous.strip():
            in_list = False
        if item and not item.group(1) and not in_list:
            if previous.strip() and not previous.startswith("|"):
                lines.append("")
            in_list = True
        spaces = len(line) - len(line.lstrip(" "))
        if in_list and line.strip() and spaces > 0:
            line = " " * (4 - spaces if spaces < 4 else 0) + line
        lines.append(line)
        previous = line
    return "\n".join(lines)

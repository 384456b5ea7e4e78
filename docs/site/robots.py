"""The page of the gallery: a card a robot, each a link that opens it in the page of `urdd view`."""

from __future__ import annotations

import json
from html import escape
from pathlib import Path
from urllib.parse import quote

INTRODUCTION = """# Robots to look at

The repository's own robots, as `urdd view --export` publishes them: move them, look at their shapes and distances, read
what the validator finds. All of it runs in your browser. [See a robot](docs/view.md) says what each panel shows.

[All robots](gallery/index.html){ .md-button }

"""


def page(robots: Path) -> str:
    """A card for each URDD in this folder."""
    cards = [card(folder) for folder in sorted(robots.iterdir()) if (folder / "urdd.json").is_file()]
    return INTRODUCTION + '<div class="robots">\n' + "".join(cards) + "</div>\n"


def many(count: int, word: str) -> str:
    return f"{count} {word}" if count == 1 else f"{count} {word}s"


def card(folder: Path) -> str:
    robot = json.loads((folder / "urdf_module/module.json").read_text(encoding="utf-8"))
    dofs = json.loads((folder / "dof_module/module.json").read_text(encoding="utf-8"))["num_dofs"]
    counts = f"{many(len(robot['links']), 'link')} · {many(dofs, 'DOF')}"
    name = escape(folder.name)
    return (
        f'<a href="../gallery/index.html#r={quote(folder.name)}"><strong>{name}</strong><small>{counts}</small></a>\n'
    )

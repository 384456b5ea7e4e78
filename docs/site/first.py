"""The first page: `first.md` with robots to click."""

from __future__ import annotations

import json
import re
from html import escape
from pathlib import Path
from urllib.parse import quote

MARK = "<!-- try -->"
ROBOTS = ["welding_arm", "quadruped", "hand"]


def page(text: str, gallery: Path) -> str:
    """The page with a card for each of our robots in place of the mark."""
    if text.count(MARK) != 1:
        raise ValueError(f"docs/site/first.md needs `{MARK}` once")
    index = (gallery / "index.html").read_text(encoding="utf-8")
    listed = re.search(r"robots\.json (\S+\.json)", index)
    if listed is None:
        raise ValueError(f"{gallery / 'index.html'} does not name robots.json")
    robots = {robot["id"]: robot for robot in json.loads((gallery / listed.group(1)).read_text(encoding="utf-8"))}
    cards = "".join(card(robots[name]) for name in ROBOTS)
    return text.replace(
        MARK,
        '<div class="try" markdown="0">\n'
        '<a class="md-button md-button--primary" href="gallery/index.html">Try it here</a>\n'
        "<p>Click a robot, or drop the folder of yours. It runs in your browser, and nothing is uploaded.</p>\n"
        f'<div class="robots">\n{cards}</div>\n</div>\n\n'
        '<a href="gallery/index.html"><img src="docs/picture/page.png" width="1280" height="720" '
        'alt="A robot in the page: the tree of links, its convex pieces, its nearest pairs"></a>',
    )


def card(robot: dict[str, str]) -> str:
    name = escape(robot["name"])
    picture = f'<img src="gallery/{escape(robot["picture"])}" alt="" width="320" height="240">'
    words = f"{robot['links']} links · {robot['dofs']} DOFs"
    link = f"gallery/index.html#r={quote(robot['id'])}"
    return f'<a href="{link}">{picture}<strong>{name}</strong><small>{words}</small></a>\n'

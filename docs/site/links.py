"""Checks the built site: `links.py FOLDER`.

Every link and anchor in every page, and in llms.txt, leads somewhere, and nothing is loaded from another host. The
gallery is checked by its own tests.
"""

from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# What a browser loads by itself.
LOADS = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}


class Page(HTMLParser):
    """The links and anchors of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[tuple[str, bool]] = []
        self.anchors = {"", "__top"}
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for key, value in attrs:
            if value is None:
                continue
            if key == "id" or (tag == "a" and key == "name"):
                self.anchors.add(value)
            if key in ("href", "src"):
                self.links.append((value, (tag, key) in LOADS))


def broken(folder: Path) -> list[str]:
    """What is wrong, a line each."""
    paths = [path for path in sorted(folder.rglob("*.html")) if "gallery" not in path.relative_to(folder).parts]
    pages = {path.resolve(): Page(path.read_text(encoding="utf-8")) for path in paths}
    wrong = []
    for path, page in pages.items():
        name = path.relative_to(folder.resolve()).as_posix()
        for link, loaded in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                if loaded and parts.scheme != "data":
                    wrong.append(f"{name}: loads {link} from another host")
                continue
            aim = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if parts.path.startswith("/"):
                # Only 404.html, which is served for any address, and mkdocs makes them so there.
                aim = (folder / unquote(parts.path).lstrip("/")).resolve()
            aim = aim / "index.html" if aim.is_dir() else aim
            if not aim.is_file():
                wrong.append(f"{name}: {link} is not in the site")
            elif aim in pages and unquote(parts.fragment) not in pages[aim].anchors:
                wrong.append(f"{name}: {link} has an anchor that is not there")
    wrong += [f"llms.txt: {link} is not in the site" for link in unlisted(folder)]
    print(f"{len(pages)} pages, {sum(len(page.links) for page in pages.values())} links, {len(wrong)} broken")
    return wrong


def unlisted(folder: Path) -> list[str]:
    """The links of llms.txt that lead nowhere."""
    links = re.findall(r"\]\(([^)]+)\)", (folder / "llms.txt").read_text(encoding="utf-8"))
    aims = [(link, folder / link) for link in links]
    return [link for link, aim in aims if not (aim / "index.html" if aim.is_dir() else aim).is_file()]


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = broken(Path(sys.argv[1]))
    for line in found:
        print(line, file=sys.stderr)
    sys.exit(1 if found else 0)

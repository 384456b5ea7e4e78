"""Makes the pages that mkdocs reads: `make.py URDD MADE OUT`.

URDD is the program. MADE has the URDDs of robots in `robots`, and what `urdd view --export` made of them in `gallery`.
OUT is the folder of pages, which is replaced.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import first
import llms
import robots
import schemas
import spec
import trials
from pages import PLACES, BrokenLinkError, Stage

import rules

ROOT = Path(__file__).resolve().parents[2]


def make(program: Path, made: Path, out: Path) -> None:
    shutil.rmtree(out, ignore_errors=True)
    stage = Stage(ROOT, out)
    explained = subprocess.run([program, "explain", "--format", "json"], check=True, capture_output=True)
    all_rules = json.loads(explained.stdout)
    codes = {rule["code"] for rule in all_rules}
    known = spec.clauses((ROOT / "SPEC.md").read_text(encoding="utf-8"))

    for name in sorted(stage.pages):
        page = stage.page(name)
        if name == "SPEC.md":
            page = spec.page(page, known, codes)
        else:
            up = "../" * name.count("/")
            page = spec.with_links(page, set(), codes, "", f"{up}rules/")
        stage.write(PLACES.get(name, name), page)
    stage.write("index.md", first.page(stage.page("docs/site/first.md", "index.md"), made / "gallery"))
    for name, page in {**rules.pages(all_rules, known, ROOT), **schemas.pages(ROOT / "schema")}.items():
        stage.write(name, page)
    for schema in sorted((ROOT / "schema").glob("*/*.json")):
        stage.copy(schema.relative_to(ROOT).as_posix())
    stage.write("robots.md", robots.page(made / "robots"))
    shutil.copytree(made / "gallery", out / "gallery")
    trials.write(ROOT, [rule["code"] for rule in all_rules], out / "gallery")
    settings = (ROOT / "docs/site/mkdocs.yml").read_text(encoding="utf-8")
    written = {path.relative_to(out).as_posix(): path.read_text(encoding="utf-8") for path in out.rglob("*.md")}
    stage.write("llms.txt", llms.text(settings, written))
    for name in ("site.css", "site.svg"):
        shutil.copyfile(Path(__file__).parent / name, out / name)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    try:
        make(*(Path(word).resolve() for word in sys.argv[1:]))
    except BrokenLinkError as error:
        sys.exit(str(error))

"""The measured figures of README.md and the docs: one file a script, and pages that are made of them.

    python benches/results.py            writes the pages again from benches/results/*.json; standard library alone

A script measures, and calls `write`: it writes `benches/results/<part>.json` (where, when and by what it was measured, and
items: tables, or short texts), prints what changed, and puts the items into the pages. `tests/program/results.rs` fails where a page
and the results differ. In a page an item is between markers, a table or the line on its origin (`made`) on lines of its own:

    <!-- results: conversion/times -->
    | ... |
    <!-- end of results -->
    <!-- results: conversion/made -->
    *`python benches/evaluation/conversion.py ...`, 2026-11-22: commit ...*
    <!-- end of results -->

and a text within a line, though not at its beginning: it takes <!-- results: conversion/validate -->0.3 to 1.3 s<!-- end of results -->.
"""

from __future__ import annotations

import datetime
import json
import os
import platform
import re
import resource
import shlex
import subprocess
import sys
import time
from pathlib import Path
from typing import TypedDict

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "benches" / "results"
MARKED = re.compile(r"(<!-- results: (?P<name>\S+) -->)(?P<text>.*?)(<!-- end of results -->)", re.DOTALL)


class Table(TypedDict):
    """Columns, and rows of as many cells. The cells are text, as the page shows it."""

    columns: list[str]
    rows: list[list[str]]


def pages() -> list[Path]:
    """The pages that may hold results."""
    folders = ["", "docs", "conformance", "python", "wasm", "benches/evaluation/lint"]
    found = [page for folder in folders for page in (ROOT / folder).glob("*.md")]
    return sorted([*found, *(ROOT / "tests" / "figures").rglob("*.md")])


def write(part: str, items: dict[str, Table | str], *programs: str, how: str = "", command: str = "") -> None:
    """Writes the results of a script, prints what changed, and writes the pages that show them.

    `programs` are names and versions of what was measured; `how` says what a reader must know of the method.
    """
    for name, item in items.items():
        if isinstance(item, dict) and any(len(row) != len(item["columns"]) for row in item["rows"]):
            sys.exit(f"{part}/{name}: a row has other than {len(item['columns'])} cells")
    made = {
        "command": command or shlex.join(["python", _script(), *(["..."] if len(sys.argv) > 1 else [])]),
        "date": datetime.datetime.now(datetime.timezone.utc).date().isoformat(),
        "commit": commit(),
        "programs": ", ".join(programs),
        "how": how,
        "machine": f"{platform.system()} {platform.machine()}, {processor()}",
        "load": load(),
    }
    path = FOLDER / f"{part}.json"
    before = json.loads(path.read_text("utf-8"))["items"] if path.is_file() else {}
    path.write_text(_text(made, items), "utf-8")
    print("\n".join(_changes(part, before, items)) or f"{part}: unchanged", flush=True)
    insert()


def insert() -> None:
    """Writes every page again from the results."""
    for page in pages():
        text = page.read_text("utf-8")
        new = MARKED.sub(lambda found: f"{found[1]}{_shown(found['name'], page)}{found[4]}", text)
        if new != text:
            page.write_text(new, "utf-8")
            print(f"{page.relative_to(ROOT)} written")


def _shown(name: str, page: Path) -> str:
    """An item as a page shows it."""
    part, _, item = name.partition("/")
    path = FOLDER / f"{part}.json"
    if not path.is_file():
        sys.exit(f"{page.relative_to(ROOT)} shows {name}: {path.relative_to(ROOT)} is missing; run the script that writes it")
    results = json.loads(path.read_text("utf-8"))
    if item == "made":
        return f"\n{origin(results['made'])}\n"
    if item not in results["items"]:
        sys.exit(f"{page.relative_to(ROOT)} shows {name}: {path.relative_to(ROOT)} has only {', '.join(results['items'])}")
    found = results["items"][item]
    return found if isinstance(found, str) else f"\n{markdown(found)}\n"


def origin(made: dict[str, str]) -> str:
    """The line that says where results come from."""
    said = [f"commit {made['commit']}", made["programs"], made["how"], made["machine"], made["load"]]
    return f"*`{made['command']}`, {made['date']}: {'; '.join(filter(None, said))}.*"


def markdown(table: Table) -> str:
    """A table in Markdown: columns whose cells are mostly numbers are aligned right."""
    rows = table["rows"]
    numeric = [sum(row[k][:1].isdigit() for row in rows) * 2 > len(rows) for k in range(len(table["columns"]))]
    rule = ["---:" if right and k else "---" for k, right in enumerate(numeric)]
    return "\n".join(f"| {' | '.join(row)} |" for row in [table["columns"], rule, *rows])


def _text(made: dict[str, str], items: dict[str, Table | str]) -> str:
    """JSON with a line for each row, so that a difference can be read."""
    one = lambda value: json.dumps(value, ensure_ascii=False)
    parts = []
    for name, item in items.items():
        if isinstance(item, str):
            parts.append(f"    {one(name)}: {one(item)}")
        else:
            rows = ",\n".join(f"        {one(row)}" for row in item["rows"])
            columns = f'      "columns": {one(item["columns"])}'
            parts.append(f'    {one(name)}: {{\n{columns},\n      "rows": [\n{rows}\n      ]\n    }}')
    facts = ",\n".join(f"    {one(key)}: {one(value)}" for key, value in made.items())
    return f'{{\n  "made": {{\n{facts}\n  }},\n  "items": {{\n' + ",\n".join(parts) + "\n  }\n}\n"


def _changes(part: str, before: dict[str, Table | str], items: dict[str, Table | str]) -> list[str]:
    """What differs from the results before: a line for each text and each cell."""
    lines = [f"{part}/{name}: gone" for name in before if name not in items]
    for name, item in items.items():
        old = before.get(name)
        if old == item:
            continue
        if isinstance(item, str) or not isinstance(old, dict) or old["columns"] != item["columns"]:
            lines.append(f"{part}/{name}: {old if isinstance(old, str) else 'new'} -> {item if isinstance(item, str) else markdown(item)}")
            continue
        if len(old["rows"]) != len(item["rows"]):
            lines.append(f"{part}/{name}: {len(old['rows'])} rows -> {len(item['rows'])}")
        for was, row in zip(old["rows"], item["rows"]):
            cells = zip(item["columns"], was, row)
            lines += [f"{part}/{name}, {row[0]}, {column}: {a} -> {b}" for column, a, b in cells if a != b]
    return lines


def _script() -> str:
    path = Path(sys.argv[0]).resolve()
    return str(path.relative_to(ROOT) if path.is_relative_to(ROOT) else path.name)


def processor() -> str:
    """The processor's name and number."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").splitlines()
        name = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        name = platform.processor() or platform.machine()
    return f"{name}, {os.cpu_count()} processors"


def commit() -> str:
    """The commit of this repository, and whether its sources were changed since; without git, the version of a release."""
    try:
        revision = _git("rev-parse", "--short=10", "HEAD")
        changed = _git("status", "--porcelain", "--untracked-files=no", "--", "src", "Cargo.lock", "python/src")
    except (OSError, subprocess.CalledProcessError):
        manifest = (ROOT / "Cargo.toml").read_text("utf-8")
        found = re.search(r'^version = "(.*)"', manifest, re.MULTILINE)
        return f"unknown, of the sources of version {found[1] if found else '?'}"
    return revision + (" with changes" if changed else "")


def _git(*arguments: str) -> str:
    done = subprocess.run(["git", *arguments], cwd=ROOT, check=True, capture_output=True, text=True)
    return done.stdout.strip()


def _busy() -> float | None:
    """Processor time that the whole machine has used, seconds; none where the system does not say."""
    try:
        words = Path("/proc/stat").read_text("utf-8").split("\n", 1)[0].split()
    except OSError:
        return None
    user, nice, system, _idle, _wait, interrupts, soft = (int(word) for word in words[1:8])
    return (user + nice + system + interrupts + soft) / os.sysconf("SC_CLK_TCK")


def _own() -> float:
    """Processor time of this program and of those that it ran."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


_BEGIN = (time.monotonic(), _busy(), _own())


def load() -> str:
    """How much of the machine other programs used since this one began."""
    begin, busy, own = _BEGIN
    now = _busy()
    if busy is None or now is None:
        return f"load {os.getloadavg()[0]:.1f}"
    others = (now - busy - (_own() - own)) / max(time.monotonic() - begin, 1e-3)
    return f"other programs used {max(others, 0.0):.1f} of the processors"


if __name__ == "__main__":
    insert()

#!/usr/bin/env python3
"""Single changes of the base files, and pairs of them.

python3 changes.py                  # how many there are of each kind
python3 changes.py --list           # one JSON object a line
python3 changes.py --write FOLDER   # the changed files, beside their meshes, with changes.jsonl
options: --every (all singles instead of the sample), --only TEXT (those with TEXT in their id), --pairs
"""

from __future__ import annotations

import argparse
import collections
import json
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import attributes
import document
import documents
import elements
import facts
import structure
from change import BASE, Change, chosen, mix, overlap

BASES = (
    "all.urdf", "small.urdf", "free.urdf", "all_1_1.urdf", "all_1_2.urdf", "capsule.urdf", "meshes.urdf",
    "meshes_stl.urdf", "meshes_dae.urdf", "written.urdf",
)  # fmt: skip
# Percent of changes that are taken: of the core and of others where an element or attribute is the first of its kind,
# and where it is not; of names of files everywhere.
CORE, FIRST, AGAIN, FILENAMES = 50, 9, 1.6, 35
# Fewer of those that stand in small.urdf, which has nothing of its own.
BY_BASE = {"small.urdf": 0.15, "written.urdf": 0.35, "meshes.urdf": 0.7, "meshes_dae.urdf": 0.5}
PAIRS = 1000


def kinds(base: str) -> Iterator[tuple[Change, str, bool]]:
    """All single changes of a base, the place of each ("" where all are taken), and whether it is in the core."""
    data = (BASE / base).read_bytes()
    root = document.parse(data)
    for change, attribute, element in attributes.changes(base, root):
        core = change.kind.removeprefix("attribute ").removeprefix("value_") in attributes.CORE
        yield change, "/".join([*element.tags(), attribute.name]), core
    for change, element in elements.changes(base, root, data):
        yield change, "/".join(element.tags()), change.kind.removeprefix("element ") in elements.ONCE
    for change in attributes.of_text(base, root, data):
        yield change, "text", False
    if base == "all.urdf":
        for change in structure.names(base, root):
            yield change, "", True
        for change in structure.materials(base, root):
            yield change, "", True
    if base == "small.urdf":
        of = [
            documents.changes(base, root, data),
            structure.tree(base, root, data),
            structure.inside_joint(base, root),
            structure.mimics(base, root),
            structure.bodies(base, root),
        ]
        for changes in of:
            for change in changes:
                yield change, "", True


def singles(every: bool = False) -> list[Change]:
    """The sample, or every single change that changes a byte, without those that give a file that was there already."""
    taken = []
    seen: dict[str, str] = {}
    files: set[bytes] = set()
    for base in BASES:
        data = (BASE / base).read_bytes()
        files.add(data)
        factor = BY_BASE.get(base, 1.0)
        for change, place, core in kinds(base):
            if place:
                subject = change.id.rsplit(":", 1)[0]
                is_first = seen.setdefault(place, subject) == subject
                percent = (CORE if core and is_first else FIRST if is_first else AGAIN) * factor
                if place.endswith("mesh/filename"):
                    percent = FILENAMES
                if not every and not chosen(change.id, percent):
                    continue
            content = change.apply(data)
            if content in files:
                continue
            files.add(content)
            taken.append(change)
    return taken


def pairs(count: int = PAIRS) -> list[Change]:
    """Two single changes of one base at once."""
    of: dict[str, list[Change]] = collections.defaultdict(list)
    for change in singles():
        if change.kind != "document":
            of[change.base].append(change)
    found: dict[str, Change] = {}
    index = 0
    while len(found) < count:
        index += 1
        base = BASES[mix(f"base {index}") % len(BASES)] if index % 2 else "all.urdf"
        first, second = (of[base][mix(f"{side} {index}") % len(of[base])] for side in ("first", "second"))
        if (
            overlap(first.edits, second.edits)
            or overlap(first.meant, second.meant)
            or overlap(first.edits, second.meant)
        ):
            continue
        stem = base.removesuffix(".urdf")
        change = Change(
            f"{stem}/{first.id.removeprefix(stem + '/')} & {second.id.removeprefix(stem + '/')}",
            base,
            "pair",
            first.edits + second.edits,
            first.meant + second.meant,
        )
        found.setdefault(change.id, change)
    return list(found.values())


def write(changes: list[Change], folder: Path) -> None:
    """The changed files as NUMBER.urdf in a copy of base/, and what each is in changes.jsonl."""
    shutil.copytree(BASE, folder, dirs_exist_ok=True)
    lines = []
    for number, change in enumerate(changes):
        file = folder / f"{number:05}.urdf"
        file.write_bytes(change.apply((BASE / change.base).read_bytes()))
        lines.append(json.dumps({"file": file.name, **described(change)}, ensure_ascii=False))
    (folder / "changes.jsonl").write_text("\n".join(lines) + "\n", encoding="utf-8")


def described(change: Change) -> dict[str, object]:
    data = (BASE / change.base).read_bytes()
    before = facts.meant(data)
    edits = [[edit.start, edit.end, edit.text.decode("latin-1")] for edit in change.edits]
    return {
        "id": change.id,
        "base": change.base,
        "kind": change.kind,
        "edits": edits,
        "means": change.means(data, before),
    }


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--write", type=Path)
    parser.add_argument("--every", action="store_true")
    parser.add_argument("--pairs", action="store_true")
    parser.add_argument("--only", default="")
    asked = parser.parse_args()
    changes = [*singles(asked.every), *(pairs() if asked.pairs else [])]
    changes = [change for change in changes if asked.only in change.id]
    if asked.list:
        for change in changes:
            print(json.dumps(described(change), ensure_ascii=False))
    elif asked.write:
        write(changes, asked.write)
    else:
        count(changes)


def count(changes: list[Change]) -> None:
    bases = collections.Counter(change.base for change in changes)
    words = collections.Counter(change.kind.split(" ")[0] for change in changes)
    for name, number in [*bases.most_common(), *words.most_common(), ("all", len(changes))]:
        print(f"{number:6,} {name}", file=sys.stdout)


if __name__ == "__main__":
    main()

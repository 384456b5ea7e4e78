#!/usr/bin/env python3
"""One change in one place of real URDFs: of the packages example-robot-data and pybullet_data.

    python3 real.py SITE_PACKAGES FOLDER [COUNT]

Writes FOLDER/base with the changed files beside links to what they name, and FOLDER/real.jsonl for `run.py --real`.
`--table FOLDER/table.txt` then makes FOLDER one that URDD_PROGRAMS can name. Outside of the repository: the robots are not
ours.
"""

from __future__ import annotations

import collections
import json
import sys
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import attributes
import document
import elements
import facts
from change import Change, apply, mix

# Packages, and the folders of robots in them.
PACKAGES = {
    "cmeel.prefix/share/example-robot-data": "cmeel.prefix/share/example-robot-data/robots",
    "pybullet_data": "pybullet_data",
}
MOST_BYTES = 120_000
# Robots whose files are taken at most: of a package's folder.
OF_A_FOLDER = 4


def sources(site: Path) -> list[Path]:
    """URDFs that are not too large, at most some of each folder."""
    found: dict[Path, list[Path]] = collections.defaultdict(list)
    for top in (site / robots for robots in PACKAGES.values()):
        for path in sorted(top.rglob("*.urdf")):
            if path.stat().st_size <= MOST_BYTES and is_read(path.read_bytes()):
                found[top / path.relative_to(top).parts[0]].append(path)
    return [
        path
        for paths in found.values()
        for path in sorted(paths, key=lambda path: mix(str(path.relative_to(site))))[:OF_A_FOLDER]
    ]


def is_read(data: bytes) -> bool:
    try:
        document.parse(data)
        facts.meant(data)
    except (ValueError, TypeError, ET.ParseError, IndexError, AttributeError):
        return False
    return True


def mirror(path: Path, top: Path, folder: Path) -> Path:
    """The folder of `path` below `folder`, where all that is beside it, at any level up to `top`, is linked."""
    here, there = top, folder
    there.mkdir(parents=True, exist_ok=True)
    for part in [*path.relative_to(top).parts[:-1], None]:
        for other in here.iterdir():
            link = there / other.name
            if other.name != part and not link.exists() and not link.is_symlink():
                link.symlink_to(other)
        if part is None:
            break
        here, there = here / part, there / part
        if there.is_symlink():
            there.unlink()
        there.mkdir(exist_ok=True)
    return there


def name_package(folder: Path) -> None:
    """Gives a package the name that its URDFs call it by, which is its folder's: Drake looks into package.xml."""
    file = folder / "package.xml"
    file.unlink(missing_ok=True)
    file.write_text(f"<package><name>{folder.name}</name></package>\n", encoding="utf-8")


def link_meshes(data: bytes, place: Path, packages: Path) -> None:
    """Links to all meshes of a file in one folder below it, where the driver of MuJoCo 3.3 looks for them."""
    together = place / "together"
    together.mkdir(exist_ok=True)
    for mesh in ET.fromstring(data).iter("mesh"):
        name = mesh.get("filename", "")
        there = packages / name.removeprefix("package://") if name.startswith("package://") else place / name
        link = together / there.name
        if there.is_file() and not link.is_symlink():
            link.symlink_to(there)


def changes_of(path: Path, data: bytes, number: int, seed: str) -> list[Change]:
    """All changes of some elements."""
    below = [element for element in document.parse(data).all() if element.parent]
    found = []
    for i in range(number):
        element = below[mix(f"{seed} {i}") % len(below)]
        try:
            found += [change for change, _ in attributes.of_element(path.name, element)]
        except (ValueError, IndexError):
            continue  # a number that is none already
        found += elements.of_element(path.name, element, data)
    return sorted(found, key=lambda change: mix(f"{seed} {change.id}"))


def sample(site: Path, count: int) -> Iterator[tuple[Path, bytes, Change]]:
    """As many changes of each file, of as many kinds as there are: kinds that were taken seldom go first."""
    files = sources(site)
    each = -(-count * 11 // (10 * len(files)))  # some are left out
    taken: collections.Counter[str] = collections.Counter()
    for path in files:
        data = path.read_bytes()
        mixed = changes_of(path, data, 2 * each, str(path.relative_to(site)))
        for i in range(min(each, len(mixed), count)):
            of_element = mix(f"{path.relative_to(site)} {i}") % 5 < 2  # there are fewer kinds of these
            change = min(
                mixed, key=lambda change: (change.kind.startswith("element") != of_element, taken[change.kind])
            )
            mixed.remove(change)
            if not is_read(apply(data, change.meant)) or change.apply(data) == data:
                continue
            taken[change.kind] += 1
            count -= 1
            yield path, data, change


def main() -> None:
    site, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 1000
    lines, meant, packages = [], {}, folder / "base" / "packages"
    for number, (path, data, change) in enumerate(sample(site, count)):
        top = next(site / package for package in PACKAGES if path.is_relative_to(site / package))
        place = mirror(path, top, packages / top.name)
        name_package(packages / top.name)
        file, base_file = place / f"changed_{number:05}.urdf", place / path.name
        file.write_bytes(change.apply(data))
        if path not in meant:
            meant[path] = facts.meant(data)
            link_meshes(data, place, packages)
        base = str(base_file.relative_to(folder / "base"))
        edits = [[edit.start, edit.end, edit.text.decode("latin-1")] for edit in change.edits]
        one = {"id": f"{base}: {change.id}", "base": base, "kind": change.kind, "edits": edits}
        one |= {"means": change.means(data, meant[path]), "file": str(file), "base_file": str(base_file)}
        one["packages"] = str(packages)
        lines.append(json.dumps(one, ensure_ascii=False))
    (folder / "real.jsonl").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{len(lines)} changes of {len(meant)} files")


if __name__ == "__main__":
    main()

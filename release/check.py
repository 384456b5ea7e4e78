#!/usr/bin/env python3
"""Says whether this tree can be released: `release/check.py [--draft] [TAG]`.

Prints the version, or every reason why not, each with what to do. Exit status: 0 it can be released, 1 not, 2 wrong
usage.
`--draft` accepts a tree with changes, and a changelog that says "unreleased". Needs Python 3.11, git and cargo.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

# Besides Cargo.toml, the files that state the version of the program. The crates have another (docs/promises.md).
PACKAGES = ["python/Cargo.toml", "wasm/npm/package.json", "release/schemas/package.json", "editors/vscode/package.json"]


def output(root: Path, *command: str) -> str | None:
    """What a command prints; None if it fails."""
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else None


def stated(path: Path) -> str:
    """The version in a Cargo.toml or a package.json."""
    text = path.read_text(encoding="utf-8")
    return str(json.loads(text)["version"] if path.suffix == ".json" else tomllib.loads(text)["package"]["version"])


def faults(
    root: Path, version: str, workspace: dict[str, dict[str, object]], draft: bool, tag: str | None
) -> list[str]:
    """Every reason not to release."""
    found = []
    if not draft:
        changed = output(root, "git", "status", "--porcelain")
        if changed is None:
            found.append("this is not a git clone: release from a clone, so that others can build the same")
        elif changed:
            names = ", ".join(line[3:] for line in changed.splitlines()[:5])
            found.append(f"the tree has changes that are not committed ({names}): commit or remove them")
    crates = str(workspace["package"]["version"])
    for number in (version, crates):
        if re.fullmatch(r"\d+\.\d+\.\d+(-[0-9A-Za-z.]+)?", number) is None:
            found.append(f"Cargo.toml: the version `{number}` is not a semantic version, such as 1.2.3")
    for name, dependency in workspace["dependencies"].items():
        own = dependency.get("version") if name.startswith("urdd-") and isinstance(dependency, dict) else None
        if own is not None and own != crates:
            found.append(f"Cargo.toml: [workspace.dependencies] has {name} {own}, not {crates}: write {crates} there")
    for package in PACKAGES:
        own = stated(root / package)
        if own != version:
            found.append(f"{package}: the version is {own}, Cargo.toml has {version}: write {version} there")
    found += changelog(root, version, draft)
    if tag is not None and tag != f"v{version}":
        found.append(f"the tag is {tag}, and the version {version}: tag the commit of that version as v{version}")
    if output(root, "cargo", "metadata", "--locked", "--format-version", "1") is None:
        found.append("Cargo.lock does not fit Cargo.toml: run `cargo update --workspace`, and commit Cargo.lock")
    return found


def changelog(root: Path, version: str, draft: bool) -> list[str]:
    """What is wrong with the first section of CHANGELOG.md: it is `## 1.2.3, 2026-01-31`."""
    text = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    heading = re.search(r"^## (\S+?), (.+)$", text, re.MULTILINE)
    if heading is None:
        return ["CHANGELOG.md has no section: write `## VERSION, DATE` above what changed"]
    newest, date = heading.groups()
    is_day = re.fullmatch(r"\d{4}-\d{2}-\d{2}", date) is not None
    # The next version's section begins before its number is written everywhere.
    if draft and not is_day:
        return []
    if newest != version:
        return [f"CHANGELOG.md begins with {newest}, Cargo.toml has {version}: write a section `## {version}, DATE`"]
    if not is_day:
        return [f"CHANGELOG.md: {version} is `{date}`: write the day of the release there, such as 2026-01-31"]
    return []


def main(root: Path, words: list[str]) -> int:
    draft = "--draft" in words
    tags = [word for word in words if word != "--draft"]
    if len(tags) > 1 or any(tag.startswith("-") for tag in tags):
        print(__doc__, file=sys.stderr)
        return 2
    workspace = tomllib.loads((root / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]
    version = stated(root / "Cargo.toml")
    found = faults(root, version, workspace, draft, tags[0] if tags else None)
    for fault in found:
        print(f"error: {fault}", file=sys.stderr)
    if found:
        return 1
    print(version)
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(__file__).resolve().parents[1], sys.argv[1:]))

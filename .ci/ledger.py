#!/usr/bin/env python3
"""The weight of the repository, beside that of earlier landings: lines, seconds of tests, bytes of the program.

    .ci/ledger.py [--tests LOG] [--program FILE] [--keep NAME]

By crate: lines of Rust (with blanks and comments; tests apart: files in `tests` folders or of that name, and what stands
behind `#[cfg(test)]`), seconds of its test programs, summed
as `cargo test` prints them in LOG, and bytes of functions and data in FILE, a program with symbols (`nm`), by the first
crate of ours that a symbol names: a generic function counts for the crate whose types it is compiled for. What a crate
weighs is compared with the last entry of `benches/ledger.json`; `--keep` adds an entry. A growth by more than a tenth
is marked: the landing says why. Needs python3, git, and `nm` of binutils for FILE.
"""

from __future__ import annotations

import argparse
import collections
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FILE = ROOT / "benches/ledger.json"
COLUMNS = ("lines", "test_lines", "test_seconds", "bytes")
# Tests at the end of the file that they test.
TESTS = re.compile(r"\n#\[cfg\(test\)\]\n(?:#\[.*\]\n)*mod \w+ \{\n")
Weights = dict[str, dict[str, float]]


def crate_of(path: str) -> str:
    """The package that a file of this repository is in."""
    parts = path.split("/")
    if parts[0] == "crates":
        return parts[1]
    return "urdd" if parts[0] in ("src", "tests", "build.rs") else parts[0]


def listed(*patterns: str) -> list[str]:
    """The files that git tracks."""
    words = ["git", "ls-files", "--", *patterns]
    return subprocess.run(words, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()


def lines(weights: Weights) -> None:
    """Counts the lines of Rust by package, and those of other languages by folder."""
    # What this repository's own programs write is marked so in .gitattributes.
    generated = set(listed(":(attr:linguist-generated)"))
    for path in listed():
        suffix = pathlib.PurePath(path).suffix
        file = ROOT / path
        if suffix not in (".rs", ".py", ".pyi", ".ts", ".mjs", ".hpp", ".h", ".cpp") or not file.is_file():
            continue
        count = len(file.read_bytes().splitlines())
        if path in generated:
            weights["(generated)"]["lines"] += count
        elif suffix == ".rs":
            parts = pathlib.PurePath(path).parts
            inside = TESTS.split(file.read_text(), maxsplit=1)
            test = "tests" in parts[:-1] or parts[-1] == "tests.rs" or parts[0] == "testkit"
            own = 0 if test else len(inside[0].splitlines())
            weights[crate_of(path)]["lines"] += own
            weights[crate_of(path)]["test_lines"] += count - own
        else:
            weights[f"({path.split('/')[0]}, other languages)"]["lines"] += count


def seconds(weights: Weights, log: pathlib.Path) -> None:
    """Sums the seconds of each package's test programs."""
    owner: dict[str, str] = {}
    for manifest in [*ROOT.glob("*/Cargo.toml"), *ROOT.glob("crates/*/Cargo.toml")]:
        room = manifest.parent
        for name in (room.name.replace("-", "_"), "urdd_" + room.name, *(test.stem for test in room.glob("tests/*"))):
            owner[name] = room.name
    running = "urdd"
    for line in log.read_text(errors="replace").splitlines():
        if found := re.search(r"(?:Running .* \(\S*/([a-z0-9_]+)-[0-9a-f]{16}|Doc-tests (\S+))", line):
            running = owner.get(found[1] or found[2], "urdd")
        elif found := re.search(r"^test result: .* finished in ([0-9.]+)s", line):
            weights[running]["test_seconds"] += float(found[1])


def size(weights: Weights, program: pathlib.Path) -> None:
    """Sums the symbols of a program by the crate that they are compiled for."""
    names = {path.name.replace("-", "_"): path.name for path in ROOT.glob("crates/*")} | {"urdd": "urdd"}
    symbols = subprocess.run(["nm", "-C", "-S", str(program)], check=True, capture_output=True, text=True).stdout
    for line in symbols.splitlines():
        words = line.split(maxsplit=3)
        if len(words) < 4 or words[2] not in "tTrRdDbB":
            continue
        crates = re.findall(r"[A-Za-z_][A-Za-z0-9_]*(?=::)", words[3])
        crate = next((names[crate] for crate in crates if crate in names), "(other crates)")
        weights[crate]["bytes"] += int(words[1], 16)
    weights["(file)"]["bytes"] = program.stat().st_size


def shown(value: float | None) -> str:
    """A figure, or a dash where there is none."""
    return "-" if value is None else f"{value:,.1f}" if isinstance(value, float) and value < 1000 else f"{value:,.0f}"


def table(now: Weights, before: Weights) -> None:
    """Prints each figure that is not 0, with what it was."""
    print(f"{'':32}" + "".join(f"{column:>14}{'(before)':>14}" for column in COLUMNS))
    for crate in sorted(now | before):
        mine, other = now.get(crate, {}), before.get(crate, {})
        row = f"{crate:32}"
        grown = []
        for column in COLUMNS:
            a, b = mine.get(column), other.get(column)
            row += f"{shown(a):>14}{shown(b):>14}"
            if a and b and a > b * 1.1 and column != "test_seconds":
                grown.append(f"{column} +{(a / b - 1) * 100:.0f} %")
        print(row + ("  <- " + ", ".join(grown) if grown else ""))


def main() -> int:
    """Prints the ledger; with `--keep`, adds it to the file."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--tests", type=pathlib.Path, help="what `cargo test --workspace` printed")
    parser.add_argument("--program", type=pathlib.Path, help="a program with symbols")
    parser.add_argument("--keep", metavar="NAME", help="add an entry of this name to the file")
    words = parser.parse_args()

    weights: Weights = collections.defaultdict(lambda: collections.defaultdict(int))
    lines(weights)
    if words.tests:
        seconds(weights, words.tests)
    if words.program:
        size(weights, words.program)
    rust = [crate for crate in weights if crate == "urdd" or crate.startswith("urdd-")]
    weights["urdd and crates/"] = {column: sum(weights[crate].get(column, 0) for crate in rust) for column in COLUMNS}
    now = {crate: {column: round(x, 1) for column, x in row.items() if x} for crate, row in sorted(weights.items())}

    entries = json.loads(FILE.read_text()) if FILE.exists() else []
    name, weights_then = (entries[-1]["name"], entries[-1]["weights"]) if entries else ("no landing", {})
    print(f"beside {name}:")
    table(now, weights_then)
    if words.keep:
        entries.append({"name": words.keep, "weights": now})
        FILE.write_text(json.dumps(entries, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Counts the lines of this library in Rust that run before a robot's first pose.

`examples/forward_kinematics.rs` is built with LLVM's counters in this library alone, not in the crates below it
(serde_json among them), and run twice: until it knows the robot's links and DOFs, and with the poses. Needs
the component `llvm-tools` (`rustup component add llvm-tools`).
"""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

from robots import ROOT

Lines = set[tuple[str, int]]


def tool(name: str) -> Path:
    """A program of LLVM's, in the version of rustc."""
    root = subprocess.run(["rustc", "--print", "sysroot"], check=True, capture_output=True, text=True).stdout.strip()
    found = next(Path(root).glob(f"lib/rustlib/*/bin/{name}"), None)
    if found is None:
        raise SystemExit(f"there is no {name}: rustup component add llvm-tools")
    return found


def built(folder: Path) -> Path:
    """The example, with counters in this workspace's code. The wrapper stays where it is, so that cargo builds once."""
    wrapper = ROOT / "target" / "evaluation" / "counting_rustc"
    wrapper.parent.mkdir(parents=True, exist_ok=True)
    script = '#!/bin/sh\nexec "$@" -C instrument-coverage\n'
    if not wrapper.exists() or wrapper.read_text("utf-8") != script:
        wrapper.write_text(script, "utf-8")
        wrapper.chmod(0o755)
    environment = {**os.environ, "RUSTC_WORKSPACE_WRAPPER": str(wrapper), "LLVM_PROFILE_FILE": str(folder / "built")}
    command = ["cargo", "build", "--quiet", "--locked", "--no-default-features", "--example", "forward_kinematics"]
    subprocess.run([*command, "--target-dir", str(wrapper.parent)], cwd=ROOT, env=environment, check=True)
    return wrapper.parent / "debug" / "examples" / "forward_kinematics"


def ran(binary: Path, folder: Path, *arguments: str) -> tuple[Lines, str]:
    """The lines of `src/` that a run executes, and what it prints."""
    raw, merged = folder / "raw", folder / "merged"
    environment = {**os.environ, "LLVM_PROFILE_FILE": str(raw)}
    printed = subprocess.run([binary, *arguments], check=True, env=environment, capture_output=True, text=True).stdout
    subprocess.run([tool("llvm-profdata"), "merge", "-o", merged, raw], check=True)
    export = ["--format=lcov", f"--instr-profile={merged}", str(binary)]
    told = subprocess.run([tool("llvm-cov"), "export", *export], check=True, capture_output=True, text=True).stdout
    return set(executed(told)), printed


def executed(lcov: str) -> Iterator[tuple[str, int]]:
    """Lines of code that ran: file below `src/`, number. Blank lines and comments within a region are none."""
    name, text = "", []
    for line in lcov.splitlines():
        key, _, value = line.partition(":")
        if key == "SF":
            path = Path(value)
            inside = ROOT / "src" in path.parents
            name = str(path.relative_to(ROOT / "src")) if inside else ""
            text = path.read_text("utf-8").splitlines() if inside else []
        elif key == "DA" and name:
            number, count = (int(word) for word in value.split(",")[:2])
            code = text[number - 1].strip()
            if count > 0 and code and not code.startswith("//"):
                yield name, number


def rooms(lines: Lines) -> dict[str, int]:
    """How many lines each room has."""
    counts: dict[str, int] = {}
    for file, _ in lines:
        room = file.split("/")[0]
        counts[room] = counts.get(room, 0) + 1
    return counts


def count(urdd: Path, values: list[float], position: list[float]) -> tuple[Lines, Lines]:
    """Lines until the robot is known, and lines that the poses add. `position` is where the last link shall be."""
    with tempfile.TemporaryDirectory() as folder:
        binary = built(Path(folder))
        before, _ = ran(binary, Path(folder), str(urdd))
        after, printed = ran(binary, Path(folder), str(urdd), *(repr(value) for value in values))
    found = [float(word) for word in printed.splitlines()[-1].split()[1:4]]
    if max(abs(a - b) for a, b in zip(found, position, strict=True)) > 1e-4:
        raise SystemExit(f"the last link is at {found}, and should be at {position}")
    return before, after - before

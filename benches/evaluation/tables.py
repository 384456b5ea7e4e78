"""What the scripts beside this file share: the robots, and writing a table into `docs/evaluation.md`.

`tables.json` declares each table: its columns and its rows by their first cell. `write` refuses any other table, and
`tests/evaluation_doc.rs` says when the document does not hold the declared ones.
"""

from __future__ import annotations

import datetime
import json
import os
import platform
import shlex
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
DOCUMENT = ROOT / "docs" / "evaluation.md"
DECLARED: dict[str, dict[str, list[str]]] = json.loads((Path(__file__).parent / "tables.json").read_text("utf-8"))


@dataclass(frozen=True)
class Robot:
    """A robot of the paper's tables, and what others state of it."""

    name: str
    #: Below the folder of robots.
    urdf: str
    #: The paper's table of conversion times, seconds.
    paper_seconds: float
    #: The reference converter, measured on a machine of this kind (docs/evaluation.md says how), seconds.
    reference_seconds: float
    #: The paper's table of sizes, MB: URDF, URDF with meshes, URDD without meshes, URDD with meshes.
    paper_megabytes: tuple[float, float, float, float]


ROBOTS = [
    Robot("UR5", "ur5/robot.urdf", 25.6, 8.5, (0.013, 6.7, 7.5, 31.8)),
    Robot("xArm7", "xarm7/robot.urdf", 21.3, 7.0, (0.017, 2.1, 8.0, 17.3)),
    Robot("B1", "b1/robot_31links_apollo.urdf", 60.0, 21.9, (0.042, 39.6, 13.6, 109.8)),
    Robot("Orca hand", "orca/robot_55links_split.urdf", 90.5, 73.1, (0.049, 4.1, 43.8, 62.4)),
    Robot("H1", "h1/robot.urdf", 69.3, 28.4, (0.028, 33.1, 25.8, 112.8)),
]


def urdf_of(robot: Robot, folder: Path) -> Path:
    """The robot's URDF; ends the program where it is not there."""
    path = folder / robot.urdf
    if not path.is_file():
        sys.exit(f"there is no {path}: docs/evaluation.md says where the robots come from")
    return path


def program(given: Path | None) -> Path:
    """The program `urdd`: the one given, or one that is built of these sources."""
    if given is not None:
        return given.resolve()
    subprocess.run(["cargo", "build", "--release", "--locked", "--quiet"], cwd=ROOT, check=True)
    return ROOT / "target" / "release" / "urdd"


def version_of(urdd: Path, given: bool) -> str:
    """What the program says of itself, and whether it may be of other sources than these."""
    version = subprocess.run([urdd, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    return f"{version} (given, not built of this commit)" if given else version


def generated(urdd: Path, urdf: Path, target: Path, *options: str) -> Path:
    """A URDD of a URDF."""
    subprocess.run([urdd, "generate", urdf, "-o", target, *options], check=True, capture_output=True)
    return target


def document(urdd: Path, module: str) -> Any:
    """A module of a URDD, by its name."""
    modules = json.loads((urdd / "urdd.json").read_text("utf-8"))["modules"]
    path = next(one["path"] for one in modules if one["name"] == module)
    return json.loads((urdd / path / "module.json").read_text("utf-8"))


def processor() -> str:
    """The processor's name and number."""
    try:
        lines = Path("/proc/cpuinfo").read_text("utf-8").splitlines()
        name = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        name = platform.processor() or platform.machine()
    return f"{name}, {os.cpu_count()} processors"


def commit() -> str:
    """The commit of this repository, and whether its sources were changed since."""

    def git(*arguments: str) -> str:
        return subprocess.run(["git", *arguments], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()

    changed = git("status", "--porcelain", "--untracked-files=no", "--", "src", "Cargo.lock", "benches", "python")
    return git("rev-parse", "--short=10", "HEAD") + (" with changes" if changed else "")


def made_by(*versions: str) -> str:
    """Where figures come from: the line under a table."""
    command = shlex.join(["python", str(Path(sys.argv[0]).resolve().relative_to(ROOT)), "..."])
    load = f", load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    system = f"{platform.system()} {platform.machine()}, {processor()}{load}, Python {platform.python_version()}"
    today = datetime.datetime.now(datetime.timezone.utc).date().isoformat()
    return f"*`{command}`, {today}: {'; '.join([f'commit {commit()}', *versions, system])}.*"


def write(name: str, rows: list[list[str]], provenance: str) -> None:
    """Writes a table into the document between its markers, and prints it."""
    columns, first = DECLARED[name]["columns"], DECLARED[name]["rows"]
    if [row[0] for row in rows] != first or any(len(row) != len(columns) for row in rows):
        sys.exit(f"the table {name} is not the one that tables.json declares: {[row[0] for row in rows]}")
    table = [columns, ["---", *("---:" if numeric(rows, k) else "---" for k in range(1, len(columns)))], *rows]
    text = "\n".join(f"| {' | '.join(row)} |" for row in table)
    begin, end = f"<!-- table: {name} -->\n", f"<!-- end: {name} -->"
    before, found, rest = DOCUMENT.read_text("utf-8").partition(begin)
    _, ended, after = rest.partition(end)
    if not (found and ended):
        sys.exit(f"{DOCUMENT} has no lines {begin.strip()} and {end}")
    DOCUMENT.write_text(f"{before}{begin}{text}\n\n{provenance}\n{end}{after}", "utf-8")
    print(text, provenance, sep="\n\n")


def numeric(rows: list[list[str]], column: int) -> bool:
    """Whether most cells of a column begin with a digit."""
    return sum(row[column][:1].isdigit() for row in rows) * 2 > len(rows)

"""What the scripts beside this file share: the robots, the program, and the bench programs. `benches/results.py` writes."""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "benches"))


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
        sys.exit(f"{path} is missing: docs/evaluation.md says where the robots come from")
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


def without_visuals(urdf: Path, folder: Path) -> Path:
    """A copy of a URDF and the meshes beside it, without visual elements: links have the shapes that its authors check."""
    tree = ElementTree.parse(urdf)
    for link in tree.getroot().findall("link"):
        for visual in link.findall("visual"):
            link.remove(visual)
    shutil.copytree(urdf.parent / "meshes", folder / "meshes", dirs_exist_ok=True)
    tree.write(folder / urdf.name)
    return folder / urdf.name


def document(urdd: Path, module: str) -> Any:
    """A module of a URDD, by its name."""
    modules = json.loads((urdd / "urdd.json").read_text("utf-8"))["modules"]
    path = next(one["path"] for one in modules if one["name"] == module)
    return json.loads((urdd / path / "module.json").read_text("utf-8"))


def percent(hits: int, of: int, interval: list[float]) -> str:
    """A rate and its interval, as tables have them."""
    low, high = (100 * end for end in interval)
    return f"{100 * hits / max(of, 1):.2f} % ({low:.2f} to {high:.2f})"


def arguments(description: str | None, *, robots: bool = True) -> argparse.ArgumentParser:
    """The options that all scripts have."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    if robots:
        parser.add_argument("--robots", type=Path, required=True, help="the folder that docs/evaluation.md describes")
    parser.add_argument("--urdd", type=Path, help="instead of one that is built of these sources")
    return parser


def bench(name: str) -> Path:
    """A bench program of these sources (`benches/<name>.rs`), built where it is not there yet."""
    command = ["cargo", "bench", "--locked", "--no-run", "--bench", name, "--message-format", "json"]
    done = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    messages = [json.loads(line) for line in done.stdout.splitlines()]
    (path,) = [one["executable"] for one in messages if one.get("executable") and one["target"]["name"] == name]
    return Path(path)


def printed(command: list[str | Path]) -> str:
    """What a program prints; ends this one where it fails."""
    done = subprocess.run(command, cwd=ROOT, check=False, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} ended with {done.returncode}")
    return done.stdout


@dataclass(frozen=True)
class Use:
    """What a run of a program took."""

    #: Wall time and processor time, seconds.
    wall: float
    cpu: float
    #: The most memory that it had, MB.
    peak: float


def used(command: list[str | Path]) -> Use:
    """Runs a program in silence; ends this one where it fails."""
    begin = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, of_child = os.wait4(child.pid, 0)
    wall = time.perf_counter() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} ended with {child.returncode}")
    unit = 1e6 if sys.platform == "darwin" else 1e3  # bytes there, kB on Linux
    return Use(wall, of_child.ru_utime + of_child.ru_stime, of_child.ru_maxrss / unit)

"""Distances and collisions beside Pinocchio with coal, for the five robots of the paper.

    python benches/evaluation/proximity.py --robots FOLDER [--urdd PROGRAM]

For each robot a URDD is made. Ours: the package `urdd`, 1,000 sampled configurations as a batch on one thread. Coal:
`benches/proximity_coal.py`, 200 of them in a loop in Python, of which the loop's own time is taken off; it first holds
the answers of both to each other. Both: microseconds of processor time for a configuration, the poses included, median
of five rounds; coal's yes or no by its broad phase. Needs the packages `urdd` and `pin`.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import urdd
from tables import ROBOTS, ROOT, generated, made_by, program, urdf_of, write

CONFIGURATIONS = 1000
ROUNDS = 5


def clock(work: Callable[[Any], object], q: Any) -> float:
    """Microseconds of processor time for a configuration."""
    times: list[float] = []
    for _ in range(ROUNDS):
        begin = time.process_time()
        work(q)
        times.append(time.process_time() - begin)
    return 1e6 * statistics.median(times) / CONFIGURATIONS


def by_coal(command: list[str | Path]) -> dict[str, str]:
    """What it prints of hulls and of pieces. Where it crashes, what it did not come to is missing."""
    done = subprocess.run(command, cwd=ROOT, check=False, stdout=subprocess.PIPE, text=True)
    if done.returncode > 0:
        sys.exit(done.returncode)
    if done.returncode < 0:
        print(f"{command[-1]}: coal ended by signal {-done.returncode}", file=sys.stderr)
    parts = re.split(r"^\S.*, (hulls|pieces): ", done.stdout, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def number(pattern: str, text: str) -> float:
    found = re.search(pattern, text)
    if found is None:
        sys.exit(f"nothing like {pattern!r} in\n{text}")
    return float(found[1])


def rate(pairs: int, microseconds: float) -> str:
    """Distances per second."""
    return f"{pairs / microseconds:.1f} million"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=Path, required=True)
    parser.add_argument("--urdd", type=Path, help="instead of one that is built of these sources")
    arguments = parser.parse_args()
    binary = program(arguments.urdd)
    urdd.set_num_threads(1)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for robot in ROBOTS:
            target = generated(binary, urdf_of(robot, arguments.robots), Path(folder) / robot.name.replace(" ", "_"))
            coal = by_coal([sys.executable, "benches/proximity_coal.py", binary, target])
            loaded = urdd.load(target)
            q = loaded.sample(CONFIGURATIONS)
            for kind in ("hulls", "pieces"):
                proximity = loaded.proximity(kind)
                pairs = proximity.num_pairs
                ours = clock(proximity.distances, q), clock(proximity.in_collision, q)
                row = [robot.name, kind, f"{pairs:,}", f"{ours[0]:.1f}", "-", rate(pairs, ours[0]), "-"]
                row += [f"{ours[1]:.1f}", "-"]
                if theirs := coal.get(kind):
                    if int(number(r"^(\d+) pairs", theirs)) != pairs:
                        sys.exit(f"{robot.name}: coal has other pairs than the {pairs} of ours")
                    distances = number(r"  distances\s+([\d.]+) us", theirs)
                    row[4], row[6] = f"{distances:.1f}", rate(pairs, distances)
                    row[8] = f"{number(r'  collision, broad phase +([0-9.]+) us', theirs):.1f}"
                rows.append(row)
    versions = [
        f"urdd {urdd.__version__}",
        f"Pinocchio {importlib.metadata.version('pin')}",
        f"coal {importlib.metadata.version('coal')}",
    ]
    write("proximity", rows, made_by(*versions))


if __name__ == "__main__":
    main()

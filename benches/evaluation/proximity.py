"""Distances and collisions beside Pinocchio with coal, for the five robots of the paper.

    python benches/evaluation/proximity.py --robots FOLDER [--configurations 200] [--urdd PROGRAM]

For each robot a URDD is made. Ours: `benches/proximity.rs`, 200 sampled configurations as a batch on one thread and on two, and
parry on the same pairs. Coal: `benches/proximity_coal.py`, the same configurations in a loop in Python, of which the loop's own
time is taken off; it first holds the answers of both to each other. Both: microseconds for a configuration, the poses included,
medians of five rounds; coal's yes or no by its broad phase. Needs the package `pin`, which brings coal.
"""

from __future__ import annotations

import importlib.metadata
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from robots import ROBOTS, ROOT, arguments, bench, generated, printed, program, urdf_of, version_of
from results import Table, write

KINDS = ("hulls", "pieces")


def by_kind(text: str, title: str) -> dict[str, str]:
    """What a program prints of hulls and of pieces, each after a line that the pattern matches."""
    parts = re.split(title, text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def by_coal(command: list[str | Path]) -> dict[str, str]:
    """What it prints of hulls and of pieces. Where it crashes, what it did not come to is missing."""
    done = subprocess.run(command, cwd=ROOT, check=False, stdout=subprocess.PIPE, text=True)
    if done.returncode > 0:
        sys.exit(done.returncode)
    if done.returncode < 0:
        print(f"{command[-1]}: coal ended by signal {-done.returncode}", file=sys.stderr)
    return by_kind(done.stdout, r"^\S.*, (hulls|pieces): ")


def number(pattern: str, text: str) -> float:
    found = re.search(pattern, text)
    if found is None:
        sys.exit(f"nothing like {pattern!r} in\n{text}")
    return float(found[1])


def rate(pairs: int, microseconds: float) -> str:
    """Distances per second."""
    return f"{pairs / microseconds:.1f} million"


def span(ratios: list[float]) -> str:
    return f"{min(ratios):.1f} to {max(ratios):.1f}"


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--configurations", type=int, default=200, help="for coal")
    given = parser.parse_args()
    binary, ours_by = program(given.urdd), bench("proximity")
    rows: list[list[str]] = []
    short: list[list[str]] = []
    parry: list[float] = []
    points: list[float] = []
    worst = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for robot in ROBOTS:
            target = generated(binary, urdf_of(robot, given.robots), Path(folder) / robot.name.replace(" ", "_"))
            peers = [sys.executable, "benches/proximity_coal.py", "--configurations", str(given.configurations)]
            coal = by_coal([*peers, binary, target])
            ours = by_kind(printed([ours_by, target]), r"^  (hulls|pieces): ")
            for kind in KINDS:
                text = ours[kind]
                pairs = int(number(r"(\d+) pairs", text))
                distances, two, collides = (
                    number(rf"{what}\s+([\d.]+) us", text)
                    for what in ("distances, 1 threads", "distances, 2 threads", "collision, 1 threads")
                )
                parry.append(number(r"by parry, 1 thread\s+([\d.]+) us", text) / distances)
                points.append(number(r"with points, one by one\s+([\d.]+) us", text) / distances)
                row = [robot.name, kind, f"{pairs:,}", f"{distances:.1f}", f"{two:.1f}", "-", rate(pairs, distances), "-"]
                row += [f"{collides:.1f}", "-"]
                if theirs := coal.get(kind):
                    if int(number(r"^(\d+) pairs", theirs)) != pairs:
                        sys.exit(f"{robot.name}: coal has other pairs than the {pairs} of ours")
                    worst = max(worst, number(r"distances within (\S+) m", theirs))
                    by_them = number(r"  distances\s+([\d.]+) us", theirs)
                    row[5], row[7] = f"{by_them:.1f}", rate(pairs, by_them)
                    row[9] = f"{number(r'  collision, broad phase +([0-9.]+) us', theirs):.1f}"
                rows.append(row)
                if kind == "pieces" or robot == ROBOTS[0]:
                    short.append([row[k] for k in (0, 1, 2, 3, 5, 8, 9)])
    columns = [
        "robot", "shapes", "pairs", "all distances, µs", "on two threads", "by coal, µs", "distances per second", "by coal",
        "collides, µs", "by coal, µs",
    ]
    items: dict[str, Table | str] = {
        "all": {"columns": columns, "rows": rows},
        "short": {"columns": [columns[k] for k in (0, 1, 2, 3, 5, 8, 9)], "rows": short},
        "parry": f"{span(parry)} times",
        "points": f"{span(points)} times",
        "differ": f"{worst:.0e} m".replace("e-0", "e-"),
    }
    peers = [f"{name} {importlib.metadata.version(package)}" for name, package in (("Pinocchio", "pin"), ("coal", "coal"))]
    how = f"{given.configurations} configurations by coal"
    write("proximity", items, version_of(binary, given.urdd is not None), *peers, how=how)


if __name__ == "__main__":
    main()

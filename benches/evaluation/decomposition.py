"""Convex pieces beside CoACD and V-HACD, for four robots of the paper.

    python benches/evaluation/decomposition.py --robots FOLDER [--peers FOLDER] [--urdd PROGRAM]

Runs `tests/figures/geometry/decomposition_peers.py` (which says what is measured) on the links named here and sums up
its rows. CoACD takes a quarter of an hour for them; `--peers` keeps its pieces and V-HACD's for another run.
Needs the packages coacd, embreex, pin (for coal), scipy, trimesh and vhacdx.
"""

from __future__ import annotations

import importlib.metadata
import math
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from robots import ROBOTS, ROOT, arguments, generated, program, urdf_of, version_of
from results import Table, write

#: Links of each robot; none is all that have pieces.
LINKS = {
    "UR5": "base_link,shoulder_link,upper_arm_link,forearm_link,wrist_1_link,wrist_3_link",
    "xArm7": "",
    "Orca hand": "right_palm,right_thumb_dp,right_index_pp",
    "H1": "pelvis,left_knee_link,left_shoulder_roll_link",
}


def measured(line: str) -> list[float]:
    """Of a row: our mean, CoACD's mean and seconds, V-HACD's mean and seconds, the ratio."""
    _, _, ours, _, coacd, vhacd, ratio, _ = (cell.strip() for cell in line.split("|"))
    peers = [float(word) for cell in (coacd, vhacd) for word in re.findall(r"^([\d.]+) .* ([\d.]+) s$", cell)[0]]
    return [float(ours.split()[0]), *peers, float(ratio)]


def mean(ratios: list[float]) -> float:
    """Geometric mean."""
    return math.exp(statistics.mean(math.log(ratio) for ratio in ratios))


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--peers", type=Path, help="where pieces by others are kept")
    given = parser.parse_args()
    urdd = program(given.urdd)
    script = ROOT / "tests" / "figures" / "geometry" / "decomposition_peers.py"
    rows: list[list[str]] = []
    links: list[list[str]] = []
    every: list[float] = []
    with tempfile.TemporaryDirectory() as folder:
        peers = given.peers or Path(folder) / "peers"
        for robot in (one for one in ROBOTS if one.name in LINKS):
            target = generated(urdd, urdf_of(robot, given.robots), Path(folder) / robot.name.replace(" ", "_"))
            asked = f"{target}:{LINKS[robot.name]}" if LINKS[robot.name] else str(target)
            command = [sys.executable, script, "--peers", peers, "--samples", "3000", asked]
            # It exits with 1 where a goal is missed; a row is a row all the same.
            printed = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False).stdout
            lines = [line for line in printed.splitlines() if line.startswith("|")][2:]
            found = [measured(line) for line in lines]
            if not found:
                sys.exit(f"decomposition_peers.py prints no row of {robot.name}")
            links += [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
            ours, coacd, coacd_seconds, vhacd, vhacd_seconds = (
                statistics.mean(row[k] for row in found) for k in range(5)
            )
            ratios = [row[5] for row in found]
            every += ratios
            means = [f"{value:.2f}" for value in (ours, coacd, vhacd)]
            seconds = [f"{coacd_seconds:.0f}", f"{vhacd_seconds:.1f}"]
            rows.append([robot.name, str(len(found)), *means, f"{mean(ratios):.2f}", f"{max(ratios):.2f}", *seconds])
    items: dict[str, Table | str] = {
        "all": {
            "columns": [
                "robot", "links compared", "ours, mm", "CoACD, mm", "V-HACD, mm", "ratio to the better", "worst",
                "CoACD, CPU s a link", "V-HACD, CPU s a link",
            ],
            "rows": rows,
        },
        "links": {
            "columns": ["link", "ours: mean / max (pieces)", "outside", "CoACD", "V-HACD", "ratio"], "rows": links,
        },
        "compared": f"{len(every)} links",
        "ratio": f"{mean(every):.2f}",
        "worst": f"{max(every):.2f}",
    }
    versions = [f"{name} {importlib.metadata.version(name)}" for name in ("coacd", "vhacdx", "coal")]
    write("decomposition", items, version_of(urdd, given.urdd is not None), *versions)


if __name__ == "__main__":
    main()

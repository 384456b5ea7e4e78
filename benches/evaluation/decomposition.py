"""Convex pieces beside CoACD and V-HACD, for four robots of the paper.

    python benches/evaluation/decomposition.py --robots FOLDER [--peers FOLDER] [--urdd PROGRAM]

Runs `tests/figures/geometry/decomposition_peers.py` (which says what is measured) on the links named here and sums up
its rows. CoACD takes a quarter of an hour for them; `--peers` keeps its pieces and V-HACD's for another run.
Needs the packages coacd, vhacdx, scipy and trimesh.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import math
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from tables import ROBOTS, ROOT, generated, made_by, program, urdf_of, write

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


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=Path, required=True)
    parser.add_argument("--peers", type=Path, help="where pieces by others are kept")
    parser.add_argument("--urdd", type=Path, help="instead of one that is built of these sources")
    arguments = parser.parse_args()
    urdd = program(arguments.urdd)
    script = ROOT / "tests" / "figures" / "geometry" / "decomposition_peers.py"
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        peers = arguments.peers or Path(folder) / "peers"
        for robot in (one for one in ROBOTS if one.name in LINKS):
            target = generated(urdd, urdf_of(robot, arguments.robots), Path(folder) / robot.name.replace(" ", "_"))
            asked = f"{target}:{LINKS[robot.name]}" if LINKS[robot.name] else str(target)
            command = [sys.executable, script, "--peers", peers, "--samples", "3000", asked]
            # It exits with 1 where a goal is missed; a row is a row all the same.
            told = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False).stdout
            lines = [line for line in told.splitlines() if line.startswith("|")]
            found = [measured(line) for line in lines[2:]]
            if not found:
                sys.exit(f"decomposition_peers.py says nothing of {robot.name}")
            ours, coacd, coacd_seconds, vhacd, vhacd_seconds = (
                statistics.mean(row[k] for row in found) for k in range(5)
            )
            ratios = [row[5] for row in found]
            mean = math.exp(statistics.mean(math.log(ratio) for ratio in ratios))
            means = [f"{value:.2f}" for value in (ours, coacd, vhacd)]
            seconds = [f"{coacd_seconds:.0f}", f"{vhacd_seconds:.1f}"]
            rows.append([robot.name, str(len(found)), *means, f"{mean:.2f}", f"{max(ratios):.2f}", *seconds])
    write(
        "decomposition", rows, made_by(*(f"{name} {importlib.metadata.version(name)}" for name in ("coacd", "vhacdx")))
    )


if __name__ == "__main__":
    main()

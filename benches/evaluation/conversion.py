"""How long `urdd generate` takes for the five robots of the paper.

    python benches/evaluation/conversion.py --robots FOLDER [--runs 5] [--urdd PROGRAM]

Every module, meshes in every format, 1,000 samples: what `urdd generate ROBOT.urdf -o DIR` does of itself, each run
into a new folder. Wall time with all threads, processor time (of user and system) with one: medians. Run it on an idle
machine. Standard library alone; Linux or macOS.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

from tables import ROBOTS, document, made_by, program, urdf_of, version_of, write


def run(urdd: Path, urdf: Path, target: Path, *options: str) -> tuple[float, float]:
    """Wall time and processor time of one run, seconds."""
    begin = time.perf_counter()
    child = subprocess.Popen(
        [urdd, "generate", urdf, "-o", target, *options], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    _, status, used = os.wait4(child.pid, 0)
    wall = time.perf_counter() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"urdd generate {urdf} ended with {child.returncode}")
    return wall, used.ru_utime + used.ru_stime


def triangles(urdd: Path) -> int:
    """Triangles of the plain meshes that come from files: by the size of the binary STL files."""
    meshes = document(urdd, "plain_meshes_module")["link_meshes"]
    return sum(((urdd / mesh["files"]["stl"]).stat().st_size - 84) // 50 for mesh in meshes if mesh)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=Path, required=True)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--urdd", type=Path, help="instead of one that is built of these sources")
    arguments = parser.parse_args()
    urdd = program(arguments.urdd)
    version = version_of(urdd, arguments.urdd is not None)
    provenance = made_by(version, f"medians of {arguments.runs} runs")
    rows = []
    for robot in ROBOTS:
        urdf = urdf_of(robot, arguments.robots)
        with tempfile.TemporaryDirectory() as folder:
            made = Path(folder) / "0"
            run(urdd, urdf, made)  # fills the disk's cache
            every = [run(urdd, urdf, Path(folder) / f"all{k}")[0] for k in range(arguments.runs)]
            one = [run(urdd, urdf, Path(folder) / f"one{k}", "--threads", "1")[1] for k in range(arguments.runs)]
            links = len(document(made, "chain_module")["links_in_chain"])
            dofs = document(made, "dof_module")["num_dofs"]
            counts = [str(links), str(dofs), f"{triangles(made):,}"]
        times = [f"{statistics.median(every):.2f}", f"{statistics.median(one):.2f}"]
        rows.append([robot.name, *counts, f"{robot.paper_seconds}", f"{robot.reference_seconds}", *times])
    write("conversion", rows, provenance)


if __name__ == "__main__":
    main()

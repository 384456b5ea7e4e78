"""Self-collision models of six robots: what they miss and clear, what they cost, beside exact distances.

    python benches/evaluation/learned.py --robots FOLDER [--urdd PROGRAM --bench PROGRAM]

For each robot a URDD is made, then again with `self_collision_model`, which keeps the rest; the processor time of the
second run on one thread is that of training. The counts are those that the module states, which `urdd validate` counts
again. Times: `benches/learned.rs`, one thread, medians of five rounds over 5,000 configurations. Panda and Z1 come from
the package `example-robot-data`.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import os
import re
import resource
import subprocess
import tempfile
from pathlib import Path

from tables import ROOT, document, made_by, program, version_of, write

PAPER = {"UR5": "ur5", "xArm7": "xarm7", "H1": "h1", "Orca hand": "orca"}
DATA = {"Panda": "panda_description/urdf/panda.urdf", "Z1": "z1_description/urdf/z1.urdf"}


def data() -> Path:
    """The folder of packages of example-robot-data."""
    return Path(str(importlib.metadata.distribution("example-robot-data").locate_file("cmeel.prefix/share")))


def seconds(command: list[str | Path], environment: dict[str, str]) -> float:
    """Processor time of a program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=Path, required=True)
    parser.add_argument("--urdd", type=Path, help="instead of one that is built of these sources")
    parser.add_argument("--bench", type=Path, help="benches/learned.rs, built")
    arguments = parser.parse_args()
    urdd = program(arguments.urdd)
    bench = [arguments.bench] if arguments.bench else ["cargo", "bench", "--quiet", "--bench", "learned", "--"]
    share = data()
    environment = {**os.environ, "RAYON_NUM_THREADS": "1", "ROS_PACKAGE_PATH": str(share)}
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in ["UR5", "xArm7", "Panda", "Z1", "H1", "Orca hand"]:
            robot = PAPER.get(name)
            urdf = (
                arguments.robots / robot / "robot.urdf" if robot else share / "example-robot-data/robots" / DATA[name]
            )
            target = Path(folder) / name.replace(" ", "_")
            make: list[str | Path] = [urdd, "generate", urdf, "-o", target]
            seconds(make, environment)
            training = seconds([*make, "--modules", "all,self_collision_model"], environment)
            path = target / "link_shapes_modules/self_collision_model_module/module.json"
            dofs = str(document(target, "dof_module")["num_dofs"])
            if not path.exists():
                rows.append([name, dofs, "none is made", *["-"] * 9])
                continue
            subprocess.run([urdd, "validate", "--quiet", "--fail-on", "info", target], check=True)
            model = document(target, "self_collision_model_module")
            counts = model["held_out"]
            colliding = counts["num_colliding"]
            free = counts["num_configurations"] - colliding
            missed, cleared = counts["num_missed"], counts["num_cleared"]
            weights = sum(len(layer["biases"]) * (len(layer["weights"][0]) + 1) for layer in model["layers"])
            printed = subprocess.run([*bench, target], cwd=ROOT, check=True, capture_output=True, text=True).stdout
            times = re.findall(r": ([\d.]+) us", printed)
            rows.append(
                [
                    name,
                    dofs,
                    f"{len(model['pairs'])} of {len(model['pairs']) + len(model['other_pairs'])}",
                    f"{weights:,}",
                    f"{path.stat().st_size / 1000:.0f}",
                    f"{training:.1f}",
                    f"{missed} of {colliding:,} ({100 * missed / colliding:.2f} %)",
                    f"{100 * cleared / free:.1f} %",
                    *times,
                ]
            )
    write("learned", rows, made_by(version_of(urdd, arguments.urdd is not None)))


if __name__ == "__main__":
    main()

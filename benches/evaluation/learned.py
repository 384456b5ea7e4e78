"""Self-collision models of six robots: what they miss and clear, near contact too, and what they cost.

    python benches/evaluation/learned.py --robots FOLDER [--urdd PROGRAM] [--only NAME ...]

For each robot a URDD is made, then again with `self_collision_model`, which keeps the rest; the processor time of the
second run on one thread is that of training. `benches/learned.rs` counts on 200,000 configurations and takes times. With
`--only` the rows of the other robots stay as they are. Panda and Z1 come from the package `example-robot-data`.
"""

from __future__ import annotations

import importlib.metadata
import json
import os
import resource
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from robots import arguments, bench, document, printed, program, version_of
from results import FOLDER, Table, write

PAPER = {"UR5": "ur5", "xArm7": "xarm7", "H1": "h1", "Orca hand": "orca"}
DATA = {"Panda": "panda_description/urdf/panda.urdf", "Z1": "z1_description/urdf/z1.urdf"}
COLUMNS = [
    "robot", "DOFs", "pairs with an output", "weights", "kB", "training, CPU s", "collisions missed",
    "free cleared",
]
ORDER = ["UR5", "xArm7", "Panda", "Z1", "H1", "Orca hand"]


def data() -> Path:
    """The folder of packages of example-robot-data."""
    return Path(str(importlib.metadata.distribution("example-robot-data").locate_file("cmeel.prefix/share")))


def seconds(command: list[str | Path], environment: dict[str, str]) -> float:
    """Processor time of a program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, capture_output=True, env=environment)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(name: str, urdf: Path, urdd: Path, timed: Path, folder: Path) -> dict[str, Any]:
    """All figures of a robot."""
    environment = {**os.environ, "RAYON_NUM_THREADS": "1", "ROS_PACKAGE_PATH": str(data())}
    target = folder / name.replace(" ", "_")
    make: list[str | Path] = [urdd, "generate", urdf, "-o", target]
    seconds(make, environment)
    without = seconds([urdd, "validate", "--quiet", "--fail-on", "info", target], environment)
    training = seconds([*make, "--modules", "all,self_collision_model"], environment)
    path = target / "link_shapes_modules/self_collision_model_module/module.json"
    found: dict[str, Any] = {"robot": name, "dofs": document(target, "dof_module")["num_dofs"], "model": None}
    if not path.exists():
        return found
    validating = seconds([urdd, "validate", "--quiet", "--fail-on", "info", target], environment)
    model = document(target, "self_collision_model_module")
    found["model"] = {
        "pairs": len(model["pairs"]),
        "other_pairs": len(model["other_pairs"]),
        "weights": sum(len(layer["biases"]) * (len(layer["weights"][0]) + 1) for layer in model["layers"]),
        "kilobytes": path.stat().st_size / 1000,
        "training_seconds": training,
        "validating_seconds": validating - without,
        "measured": json.loads(printed([timed, target])),
    }
    return found


def percent(rate: dict[str, Any]) -> str:
    """A rate with its interval."""
    if rate["of"] == 0:
        return "-"
    share, lower, upper = (100 * x for x in (rate["count"] / rate["of"], rate["lower"], rate["upper"]))
    return f"{share:.2f} % ({lower:.2f} to {upper:.2f})"


def of(rate: dict[str, Any]) -> str:
    """The same, with the counts."""
    return f"{rate['count']:,} of {rate['of']:,}: {percent(rate)}"


def depth(found: dict[str, Any]) -> str:
    """Median and largest depth."""
    if found["median_mm"] is None:
        return "-"
    return f"{found['median_mm']:.1f} / {found['largest_mm']:.1f}"


def evaluation_rows(robots: list[dict[str, Any]]) -> list[list[str]]:
    """The rows of docs/evaluation.md."""
    rows = []
    for one in robots:
        model = one["model"]
        if model is None:
            rows.append([one["robot"], str(one["dofs"]), "none is made", *["-"] * 5])
            continue
        counts = model["measured"]["counts"]
        rows.append(
            [
                one["robot"],
                str(one["dofs"]),
                f"{model['pairs']} of {model['pairs'] + model['other_pairs']}",
                f"{model['weights']:,}",
                f"{model['kilobytes']:.0f}",
                f"{model['training_seconds']:.1f}",
                percent(counts["misses"]),
                percent(counts["clears"]),
            ]
        )
    return rows


def tables(robots: list[dict[str, Any]]) -> dict[str, list[list[str]]]:
    """The tables of docs/learned.md, and the one of docs/evaluation.md, by name: a row of columns, then rows."""
    made: dict[str, list[list[str]]] = {
        "all": [COLUMNS, *evaluation_rows(robots)],
        "rates": [["robot", "collisions missed", "free cleared", "depth of misses, mm: median / largest"]],
        "near-contact": [
            ["robot", "a step away (8.8.10)", "depth, mm", "noise of 0.05 rad away", "depth, mm", "at contact, by bisection"]
        ],
        "batches": [["robot", "batch", "model, µs", "exact yes or no, µs", "model, then exact, µs", "exact distances, µs"]],
        "obstacles": [["robot", "cleared that hit an obstacle", "exact, µs", "model, then exact, µs"]],
    }
    for one in robots:
        if one["model"] is None:
            continue
        name, measured = one["robot"], one["model"]["measured"]
        counts, obstacles = measured["counts"], measured["obstacles"]
        made["rates"].append([name, of(counts["misses"]), percent(counts["clears"]), depth(counts["depth"])])
        step, noise = counts["near_by_step"], counts["near_by_noise"]
        made["near-contact"].append(
            [
                name,
                of(step["misses"]),
                depth(step["depth"]),
                of(noise["misses"]),
                depth(noise["depth"]),
                of(counts["at_contact"]),
            ]
        )
        for row in measured["times"]:
            times = [f"{row[key]:.2f}" for key in ("model", "exact", "both", "distances")]
            made["batches"].append([name, f"{row['batch']:,}", *times])
        times = [f"{obstacles[key]:.2f}" for key in ("exact", "both")]
        made["obstacles"].append([name, of(obstacles["cleared_that_hit"]), *times])
    return made


def keep(part: str, name: str, made: list[list[str]]) -> Table:
    """A table with the rows of robots that were not measured now as they were."""
    path = FOLDER / f"{part}.json"
    before = json.loads(path.read_text("utf-8"))["items"].get(name) if path.is_file() else None
    columns, *rows = made
    measured = {row[0] for row in rows}
    if before and before["columns"] == columns:
        rows += [row for row in before["rows"] if row[0] not in measured]
    return {"columns": columns, "rows": sorted(rows, key=lambda row: ORDER.index(row[0]))}


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--only", nargs="+", choices=ORDER, default=ORDER, help="measure these robots alone")
    given = parser.parse_args()
    urdd, timed = program(given.urdd), bench("learned")
    share = data() / "example-robot-data/robots"
    found = []
    for name in given.only:
        urdf = given.robots / PAPER[name] / "robot.urdf" if name in PAPER else share / DATA[name]
        with tempfile.TemporaryDirectory() as folder:
            found.append(measure(name, urdf, urdd, timed, Path(folder)))
    made = tables(found)
    # Counts are the same on every machine; times are not.
    times = {name: made.pop(name) for name in ("batches", "obstacles")}
    parts = {"learned": (made, "counted on 200,000 configurations"), "learned_times": (times, "processor time on one thread")}
    for part, (items, how) in parts.items():
        kept = {name: keep(part, name, rows) for name, rows in items.items()}
        write(part, kept, version_of(urdd, given.urdd is not None), how=how)


if __name__ == "__main__":
    main()

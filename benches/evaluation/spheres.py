"""Spheres for planners: how many it takes to answer as the convex pieces do, for five robots.

    python benches/evaluation/spheres.py --robots FOLDER --panda panda.urdf [--package NAME=PATH] [--urdd PROGRAM]

For each robot a URDD is made, and `urdd export foam` with different numbers of spheres. The rates are those that the file
states: of 10,000 sampled configurations that had no part in the fit, judged by the spheres and the ignored pairs that are
written. `crates/urdd-export/tests/export/fitted_spheres.rs` counts them again with code of its own. Where hardly any configuration is free, rates
are those near the default configuration (docs/export.md). `--cover` is the option that covers every link.
"""

from __future__ import annotations

import json
import subprocess
import tempfile
from pathlib import Path

from robots import ROBOTS, arguments, generated, percent, program, urdf_of, used, version_of
from results import Table, write

NUMBERS = (30, 50, 75, 100, 150, 200)
NAMES = ("UR5", "Panda", "H1", "B1", "Orca hand")


def exported(binary: Path, urdd: Path, *options: str) -> tuple[list[str], int, float]:
    """The cells of a row after the number of spheres, the number, and processor seconds."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "spheres.json"
        cost = used([binary, "export", "foam", urdd, "-o", file, *options])
        found = json.loads(file.read_text("utf-8"))
    rates = found["measured"]["rates_near_default_configuration"] or found["measured"]["rates"]
    default = found["measured"]["default_configuration"]
    cells = [
        percent(rates["missed"], rates["colliding"], rates["missed_interval_95"]),
        percent(rates["false_contacts"], rates["free"], rates["false_contacts_interval_95"]),
        "in contact" if default["spheres_touch"] else "free",
    ]
    return cells, sum(len(link["spheres"]) for link in found["links"].values()), cost.cpu


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--panda", type=Path, required=True, help="panda.urdf of example-robot-data")
    parser.add_argument("--package", action="append", default=[], help="NAME=PATH, for its meshes")
    given = parser.parse_args()
    binary = program(given.urdd)
    urdfs = {robot.name: urdf_of(robot, given.robots) for robot in ROBOTS if robot.name in NAMES} | {"Panda": given.panda}
    packages = [word for package in given.package for word in ("--package", package)]
    default: list[list[str]] = []
    trade: list[list[str]] = []
    with tempfile.TemporaryDirectory() as folder:
        for name in NAMES:
            urdd = generated(binary, urdfs[name], Path(folder) / name.replace(" ", "_"), *packages)
            cells, number, seconds = exported(binary, urdd)
            default.append([name, str(number), *cells, f"{seconds:.1f}"])
            cells, number, seconds = exported(binary, urdd, "--cover")
            default.append([f"{name}, `--cover`", str(number), *cells, f"{seconds:.1f}"])
            for wanted in NUMBERS:
                cells, number, _ = exported(binary, urdd, "--total-spheres", str(wanted))
                trade.append([name, str(number), *cells])
            print(name, default[-2], flush=True)
    columns = ["robot", "spheres", "collisions missed", "false contacts", "default configuration"]
    items: dict[str, Table | str] = {
        "default": {"columns": [*columns, "CPU, s"], "rows": default},
        "trade": {"columns": columns, "rows": trade},
    }
    how = "rates of 10,000 configurations each, with 95 % intervals; those of the Orca hand near its default configuration"
    write("spheres", items, version_of(binary, given.urdd is not None), how=how)


main()

"""Where the time of `urdd generate` goes, and what `generate`, `validate` and `combine` take beside an earlier program.

    python benches/evaluation/stages.py --robots FOLDER [--before PROGRAM] [--corpus FOLDER] [--urdd PROGRAM] [--runs 5]

The stages are those of `benches/profile.rs`: processor time of one thread. With PROGRAM, an earlier `urdd`, both
programs do the same things by turns: processor time of user and system, medians; `generate` and `combine` with one
thread, `validate` as it is called. Each program validates and combines what it generated.
"""

from __future__ import annotations

import re
import shutil
import statistics
import tempfile
from pathlib import Path

from robots import ROBOTS, arguments, bench, printed, program, urdf_of, used, version_of
from results import Table, write

#: Columns of the table of stages: what the bench calls them.
STAGES = {
    "meshes": ["original_meshes", "plain_meshes", "convex_hull_meshes"],
    "pieces": ["convex_decomposition_meshes"],
    "boxes and spheres": ["link_shapes_approximations"],
    "distances": ["link_shapes_distance_statistics"],
}


def stages(folder: Path) -> Table:
    """Seconds of each robot's stages."""
    profile = bench("profile")
    rows = []
    for robot in ROBOTS:
        text = printed([profile, urdf_of(robot, folder).resolve()])
        found = re.findall(r"^ *([\d.]+) +[\d.]+  (\w+)", text, flags=re.MULTILINE)
        seconds = {name: float(value) for value, name in found}
        total = sum(seconds.values())
        parts = [sum(seconds.get(name, 0.0) for name in names) for names in STAGES.values()]
        rows.append([robot.name, *(f"{value:.2f}" for value in (total, *parts, total - sum(parts)))])
    return {"columns": ["robot", "all, s", *STAGES, "rest"], "rows": rows}


def beside(before: Path, now: Path, folder: Path, corpus: Path | None, runs: int) -> Table:
    """Medians of the processor time of both programs, and their ratio."""
    rows: list[list[str]] = []
    programs = {"before": before, "now": now}
    with tempfile.TemporaryDirectory() as scratch:
        made = {name: Path(scratch) / name for name in programs}

        def compare(what: str, commands: dict[str, list[str | Path]], target: Path | None = None) -> None:
            every: dict[str, list[float]] = {name: [] for name in programs}
            for _ in range(runs):
                for name, command in commands.items():
                    if target is not None:
                        shutil.rmtree(made[name] / target, ignore_errors=True)
                    every[name].append(used(command).cpu)
            old, new = (statistics.median(every[name]) for name in programs)
            rows.append([what, f"{old:.2f}", f"{new:.2f}", f"{new / old:.2f}"])

        def each(*arguments: str | Path) -> dict[str, list[str | Path]]:
            return {
                name: [
                    urdd,
                    *(
                        made[name] / one if isinstance(one, Path) and not one.is_absolute() else one
                        for one in arguments
                    ),
                ]
                for name, urdd in programs.items()
            }

        for robot in ROBOTS:
            urdd = Path(robot.name)
            urdf = urdf_of(robot, folder).resolve()
            compare(f"generate {robot.name}", each("generate", "--threads", "1", urdf, "-o", urdd), urdd)
            compare(f"validate {robot.name}", each("validate", urdd))
        arm, gripper = Path("arm"), Path("gripper")
        robots = Path(__file__).resolve().parents[2] / "conformance" / "robots"
        for part, name in ((arm, "six_axis_arm"), (gripper, "gripper")):
            for command in each("generate", robots / f"{name}.urdf", "-o", part).values():
                used(command)
        both: list[str | Path] = ["combine", "--threads", "1", arm, gripper, "--at", "tool0", "-o", Path("both")]
        compare("combine our arm and gripper", each(*both), Path("both"))
        if corpus is not None:
            # They have errors, so that the exit status is 1.
            script = '"$0" validate "$1"; [ $? -eq 1 ]'
            compare(
                "validate the published URDDs",
                {name: ["sh", "-c", script, urdd, corpus] for name, urdd in programs.items()},
            )
    return {"columns": ["what", "before, CPU s", "now, CPU s", "ratio"], "rows": rows}


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--before", type=Path, help="an earlier program")
    parser.add_argument("--corpus", type=Path, help="published URDDs")
    parser.add_argument("--runs", type=int, default=5)
    given = parser.parse_args()
    urdd = program(given.urdd)
    items = {"all": stages(given.robots)}
    versions = [version_of(urdd, given.urdd is not None)]
    if given.before is not None:
        corpus = given.corpus.resolve() if given.corpus else None
        items["before"] = beside(given.before.resolve(), urdd, given.robots, corpus, given.runs)
        versions.append(f"before: {version_of(given.before, given=False)}, given")
    write("stages", items, *versions, how=f"medians of {given.runs} runs")


if __name__ == "__main__":
    main()

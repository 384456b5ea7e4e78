"""Poses, Jacobians and inverse kinematics of the five robots of the paper, beside Pinocchio's C++.

    python benches/evaluation/kinematics.py --robots FOLDER [--urdd PROGRAM]

Ours: `benches/kinematics.rs`. Pinocchio: `benches/kinematics_pinocchio.cpp`, compiled here for this machine, with the headers of
the package `pin`. Both: 10,000 random configurations, one thread, medians of five rounds. Needs `pin`, g++ and Eigen's headers.
"""

from __future__ import annotations

import importlib.metadata
import re
import subprocess
import tempfile
from pathlib import Path

import pinocchio
from robots import ROBOTS, ROOT, arguments, bench, generated, printed, program, urdf_of, version_of
from results import Table, write


def compiled() -> Path:
    """Pinocchio's program; it is kept in `target`, and compiled again where its source is newer."""
    source, target = ROOT / "benches" / "kinematics_pinocchio.cpp", ROOT / "target" / "bench" / "kinematics_pinocchio"
    if target.exists() and target.stat().st_mtime > source.stat().st_mtime:
        return target
    target.parent.mkdir(parents=True, exist_ok=True)
    prefix = next(p for p in Path(pinocchio.__file__).parents if p.name == "cmeel.prefix")
    defines = ["-DNDEBUG", "-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS"]
    headers = [f"-I{prefix}/include", "-I/usr/include/eigen3"]
    libraries = [f"-L{prefix}/lib", f"-Wl,-rpath,{prefix}/lib", "-lboost_serialization"]
    command = ["g++", "-std=c++17", "-O3", "-march=native", *defines, *headers, str(source), *libraries, "-o", str(target)]
    subprocess.run(command, check=True)
    return target


def microseconds(text: str) -> list[float]:
    """The figures of the rows that both programs print."""
    return [float(one) for one in re.findall(r"([\d.]+) us$", text, flags=re.MULTILINE)]


def span(values: list[float], unit: str) -> str:
    return f"{min(values):.2g} to {max(values):.2g} {unit}"


def main() -> None:
    given = arguments(__doc__).parse_args()
    binary, ours_by, theirs_by = program(given.urdd), bench("kinematics"), compiled()
    rows: list[list[str]] = []
    poses: list[float] = []
    ratios: list[float] = []
    reached: list[int] = []
    inverse: list[float] = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for robot in ROBOTS:
            urdf = urdf_of(robot, given.robots)
            target = generated(binary, urdf, folder / robot.name.replace(" ", "_"), "--modules", "core")
            text = printed([ours_by, target])
            pose, jacobian = microseconds(text)[:2]
            link = re.search(r"Jacobian of (.*?)\s+[\d.]+ us$", text, flags=re.MULTILINE)
            found = re.search(r"(\d+) of 1000 poses reached, .* ([\d.]+) us each", text)
            if link is None or found is None:
                raise SystemExit(f"{robot.name}: the bench prints something else:\n{text}")
            reached.append(int(found[1]))
            inverse.append(float(found[2]))
            model = folder / "model.txt"
            pinocchio.buildModelFromUrdf(str(urdf), mimic=True).saveToText(str(model))
            joints, frames, theirs = microseconds(printed([theirs_by, link[1], model]))
            cells = [f"{value:.2f}" for value in (pose, frames, joints, jacobian, theirs)]
            rows.append([robot.name, *cells, f"{reached[-1]} of 1,000".replace("1000 of", "1,000 of"), f"{inverse[-1]:.1f}"])
            poses.append(pose)
            ratios.append(frames / pose)
    if min(reached) < 1000:
        print(f"inverse kinematics did not reach every pose: {reached}")
    items: dict[str, Table | str] = {
        "all": {
            "columns": [
                "robot", "poses, µs", "Pinocchio, joints and links", "joints alone", "Jacobian, µs", "Pinocchio",
                "poses reached", "inverse kinematics, µs",
            ],
            "rows": rows,
        },
        "poses": span(poses, "µs"),
        "ratio": f"{min(ratios):.1f} to {max(ratios):.1f} times",
        "inverse": f"{min(reached):,} of 1,000",
        "inverse_time": span(inverse, "µs"),
    }
    write(
        "kinematics", items, version_of(binary, given.urdd is not None), f"Pinocchio {importlib.metadata.version('pin')}"
    )


if __name__ == "__main__":
    main()

"""How many lines of a library run between a robot's description and its first pose.

    python benches/evaluation/lines.py [--sources FOLDER] [--urdd PROGRAM]

The robot is `conformance/robots/six_axis_arm.urdf` without its shapes (forward kinematics needs none), and the URDD
that is made of it. Each library is asked for the pose of a link in a sampled configuration, and must have the one
that the URDD states. Lines are distinct ones of the library's own files that run. docs/evaluation.md says what that
leaves out.

- Python: `lines_python.py`; the libraries of `requirements.txt`.
- This library in Rust: `lines_rust.py`, LLVM's counters.
- C++: `lines_cpp.py`, gcov's counters on the sources in FOLDER, which `fetch_sources.sh FOLDER` gets. Without FOLDER
  these rows say so.
"""

from __future__ import annotations

import importlib.metadata
import json
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import lines_cpp
import lines_rust
from robots import ROOT, arguments, document, generated, program
from results import Table, write

ROBOT = ROOT / "conformance" / "robots" / "six_axis_arm.urdf"
HERE = Path(__file__).resolve().parent
#: The rows of the table.
ROWS = [
    "a program by json and numpy",
    "urdd in Rust",
    "urdd in Python",
    "yourdfpy",
    "roboticstoolbox",
    "KDL",
    "PyBullet",
    "Pinocchio",
    "MuJoCo",
    "Klampt",
    "Drake",
    "Isaac Sim",
]
#: The paper's counts.
PAPER = {
    "a program by json and numpy": "0",
    "urdd in Rust": "0",
    "KDL": "730",
    "Klampt": "315",
    "Drake": "880",
    "MuJoCo": "3784 (MJCF)",
    "Isaac Sim": "1892",
}
#: What is not counted, and why.
WITHOUT = {
    "Klampt": "no: PyPI has wheels alone, without the sources",
    "Drake": "no: PyPI has wheels alone, without the sources",
    "Isaac Sim": "no: needs NVIDIA's GPU and program",
}


def without_shapes(folder: Path) -> Path:
    """The robot's URDF without visual and collision elements."""
    tree = ET.parse(ROBOT)
    for link in tree.getroot().iter("link"):
        for tag in ("visual", "collision"):
            for element in link.findall(tag):
                link.remove(element)
    path = folder / ROBOT.name
    tree.write(path)
    return path


def by_python(name: str, urdf: Path, urdd: Path) -> tuple[dict[str, int], dict[str, int]]:
    """Lines by package: until the robot is loaded, and those that the pose adds."""
    command = [sys.executable, str(HERE / "lines_python.py"), name, str(urdf), str(urdd)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{name}: {done.stderr[-2000:]}")
    counted: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    if counted["off"] > 1e-6:
        sys.exit(f"{name}: the pose is off by {counted['off']}")
    return counted["load"], counted["pose"]


def parts(counts: dict[str, int]) -> str:
    """A number, and of which parts it is the sum where there are several."""
    found = {part: count for part, count in sorted(counts.items(), key=lambda one: -one[1]) if count}
    said = f" ({', '.join(f'{part} {count}' for part, count in found.items())})" if len(found) > 1 else ""
    return f"{sum(found.values()):,}{said}"


def rows(sources: Path | None, flags: list[str], urdf: Path, urdd: Path) -> list[list[str]]:
    chain, dof = document(urdd, "chain_module"), document(urdd, "dof_module")
    sample = document(urdd, "kinematics_samples_module")["samples"][-1]
    names = [link["name"] for link in chain["links_in_chain"]]
    q = {one["joint_name"]: value for one, value in zip(dof["dofs"], sample["configuration"], strict=True)}
    position = {name: pose["position"] for name, pose in zip(names, sample["link_poses"], strict=True)}
    found = []
    for name in ROWS:
        if name in WITHOUT:
            reads, load, pose, how = "URDF" if name != "Isaac Sim" else "USD", "-", "-", WITHOUT[name]
        elif name == "urdd in Rust":
            before, after = lines_rust.count(urdd, sample["configuration"], position[names[-1]])
            reads, how = "URDD", "LLVM's counters"
            load, pose = parts(lines_rust.rooms(before)), parts(lines_rust.rooms(after))
        elif name in lines_cpp.WHOLE:
            reads, pose, how = "URDF", "-", f"whole files, {lines_cpp.WHOLE[name][0]}"
            load = "-" if sources is None else f"at most {lines_cpp.whole(name, sources):,}"
            how = how if sources else "no: run with --sources"
        elif name in lines_cpp.LIBRARIES:
            reads = "URDF"
            link = names[-2] if name == "MuJoCo" else names[-1]  # MuJoCo makes one body of what a fixed joint connects
            if sources is None:
                load, pose, how = "-", "-", "no: run with --sources"
            else:
                before, after = lines_cpp.count(name, sources, flags, urdf, link, q, position[link])
                load, pose = (parts(lines_cpp.rooms(lines, sources)) for lines in (before, after))
                how = f"gcov, {lines_cpp.LIBRARIES[name].versions}"
        else:
            loading, moving = by_python(name, urdf, urdd)
            reads = "URDD" if name.startswith(("a program", "urdd")) else "URDF"
            load, pose = parts(loading), parts(moving)
            package = {"urdd in Python": "urdd", "roboticstoolbox": "roboticstoolbox-python"}.get(name, name)
            how = "tracing" if name.startswith("a program") else f"tracing, {importlib.metadata.version(package)}"
            if name == "urdd in Python":
                load, pose = f"{load}, and those in Rust", f"{pose}, and those in Rust"
        found.append([name, reads, load, pose, PAPER.get(name, "-"), how])
    return found


def main() -> None:
    parser = arguments(__doc__, robots=False)
    parser.add_argument("--sources", type=Path)
    given = parser.parse_args()
    urdd = program(given.urdd)
    # Boost and Eigen of the wheel `pin`, where it is installed beside this Python.
    prefix = next((Path(path) / "cmeel.prefix" for path in sys.path if (Path(path) / "cmeel.prefix").is_dir()), None)
    flags = [f"-I{prefix}/include", f"-L{prefix}/lib", f"-Wl,-rpath,{prefix}/lib"] if prefix else []
    columns = ["what", "reads", "lines to FK", "FK itself", "paper", "counted"]
    with tempfile.TemporaryDirectory() as folder:
        urdf = without_shapes(Path(folder))
        made = generated(urdd, urdf, Path(folder) / "urdd", "--modules", "kinematics_samples")
        table: Table = {"columns": columns, "rows": rows(given.sources, flags, urdf, made)}
        write("lines", {"all": table})


if __name__ == "__main__":
    main()

"""Counts the lines of a C++ library that run before a robot's first pose.

The files named here, of a library's published sources, are compiled without optimisation and with gcov's counters, and
a program of a few lines (`cpp/`) runs them twice: until the robot is known, and with a pose. Lines count in the
library's own files, headers included; the XML parser, Eigen, Boost and the standard library stand elsewhere and do not.
`fetch_sources.sh` gets the sources. Needs g++ and gcov, and the libraries that `fetch_sources.sh` names.
"""

from __future__ import annotations

import gzip
import json
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

Lines = set[tuple[str, int]]


@dataclass(frozen=True)
class Library:
    """What is compiled of a library, by paths below the folder of sources."""

    program: str
    #: Of the sources that `fetch_sources.sh` gets.
    versions: str
    #: Patterns of the files that are compiled.
    files: tuple[str, ...]
    #: Folders of headers.
    include: tuple[str, ...]
    #: Folders whose files count.
    counted: tuple[str, ...]
    flags: tuple[str, ...] = ()
    links: tuple[str, ...] = ()


URDFDOM = (
    "urdfdom/urdf_parser/src/link.cpp",
    "urdfdom/urdf_parser/src/joint.cpp",
    "urdfdom/urdf_parser/src/model.cpp",
    "urdfdom/urdf_parser/src/pose.cpp",
    "urdfdom/urdf_parser/src/world.cpp",
)

LIBRARIES = {
    "KDL": Library(
        "kdl.cpp",
        "orocos_kdl 1.5.1, kdl_parser 1.14.2, urdfdom 6.0.0",
        (
            *URDFDOM,
            "kdl_parser/src/kdl_parser.cpp",
            *(
                f"orocos_kdl/src/{name}"
                for name in (
                    "frames.cpp",
                    "frames_io.cpp",
                    "jntarray.cpp",
                    "jntspaceinertiamatrix.cpp",
                    "jacobian.cpp",
                    "joint.cpp",
                    "kinfam_io.cpp",
                    "rigidbodyinertia.cpp",
                    "rotationalinertia.cpp",
                    "segment.cpp",
                    "chain.cpp",
                    "tree.cpp",
                    "treefksolverpos_recursive.cpp",
                    "utilities/utility.cxx",
                    "utilities/utility_io.cxx",
                    "utilities/error_stack.cxx",
                )
            ),
        ),
        ("kdl_parser/include", "kdl", "urdfdom/urdf_parser/include", "urdfdom_headers"),
        ("urdfdom", "urdfdom_headers", "kdl_parser", "orocos_kdl"),
        ("-I/usr/include/eigen3",),
        ("-ltinyxml2", "-ltinyxml", "-lconsole_bridge"),
    ),
    "Pinocchio": Library(
        "pinocchio.cpp",
        "Pinocchio 4.1.0, urdfdom 6.0.0",
        (*URDFDOM, "pinocchio/src/parsers/urdf/model.cpp", "pinocchio/src/parsers/urdf/utils.cpp"),
        ("pinocchio/include", "urdfdom/urdf_parser/include", "urdfdom_headers"),
        ("urdfdom", "urdfdom_headers", "pinocchio"),
        ("-I/usr/include/eigen3", "-DBOOST_MPL_LIMIT_LIST_SIZE=30", "-DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS"),
        ("-ltinyxml2", "-lconsole_bridge"),
    ),
    "MuJoCo": Library(
        "mujoco.cpp",
        "MuJoCo 2.2.2",
        ("mujoco/src/xml/*.cc", "mujoco/src/user/*.cc", "mujoco/src/engine/*.c"),
        ("mujoco/include", "mujoco/src"),
        ("mujoco",),
        ("-D_GNU_SOURCE", "-I/usr/include/libqhull_r"),
        ("-ltinyxml2", "-lqhull_r", "-lccd", "-llodepng", "-ltinyobjloader", "-lpthread", "-lm", "-ldl"),
    ),
}


#: Of libraries that are too large to be built for this: files that a URDF goes through until there is a robot.
WHOLE = {
    "PyBullet": (
        "PyBullet 3.2.7",
        *(
            f"pybullet/examples/Importers/ImportURDFDemo/{name}.cpp"
            for name in ("UrdfParser", "urdfStringSplit", "BulletUrdfImporter", "URDF2Bullet", "MyMultiBodyCreator")
        ),
        *(
            f"pybullet/src/BulletDynamics/Featherstone/{name}.cpp"
            for name in ("btMultiBody", "btMultiBodyJointLimitConstraint")
        ),
    ),
}


def whole(name: str, sources: Path) -> int:
    """Lines of code in the files of a library, whether they run or not: neither blank nor comment."""
    comment = re.compile(r"""//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')""", re.DOTALL)
    total = 0
    for file in WHOLE[name][1:]:
        text = comment.sub(lambda found: found[1] or "", (sources / file).read_text("utf-8", errors="replace"))
        total += sum(1 for line in text.splitlines() if line.strip())
    return total


def run(command: list[object], where: Path) -> str:
    done = subprocess.run([str(word) for word in command], cwd=where, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(word) for word in command)}\n{done.stderr[-3000:]}")
    return done.stdout


def built(library: Library, sources: Path, extra: list[str], build: Path) -> Path:
    """The program, and beside it gcov's notes."""
    include = [f"-I{sources / folder}" for folder in library.include]
    main = Path(__file__).parent / "cpp" / library.program
    files = [path for pattern in library.files for path in sorted(sources.glob(pattern))]
    objects = []
    for number, path in enumerate([main, *files]):
        target = build / f"{number}_{path.stem}.o"
        compiler = ["gcc", "-std=gnu11"] if path.suffix == ".c" else ["g++", "-std=c++17"]
        counters = ["--coverage"] if path != main or library.program == "pinocchio.cpp" else []
        command = [*compiler, "-O0", "-w", *counters, *include, *library.flags, *extra, "-c", path, "-o", target]
        run(command, build)
        objects.append(target)
    run(["g++", "--coverage", *objects, *extra, *library.links, "-o", build / "program"], build)
    return build / "program"


def executed(build: Path, counted: list[Path]) -> Lines:
    """Lines that the last run executed in files below the counted folders; gcov's counts are removed."""
    lines: Lines = set()
    for data in sorted(build.glob("*.gcda")):
        run(["gcov", "--json-format", data.name], build)
        data.unlink()
    for path in build.glob("*.gcov.json.gz"):
        for file in json.loads(gzip.decompress(path.read_bytes()))["files"]:
            name = (build / file["file"]).resolve()
            if any(folder in name.parents for folder in counted):
                lines.update((str(name), line["line_number"]) for line in file["lines"] if line["count"] > 0)
        path.unlink()
    return lines


def count(
    name: str, sources: Path, extra: list[str], urdf: Path, link: str, q: dict[str, float], position: list[float]
) -> tuple[Lines, Lines]:
    """Lines until the robot is known, and lines that a pose adds. `position` is where the link shall be."""
    library = LIBRARIES[name]
    counted = [(sources / folder).resolve() for folder in library.counted]
    with tempfile.TemporaryDirectory() as folder:
        build = Path(folder)
        program = built(library, sources.resolve(), extra, build)
        run([program, urdf.resolve()], build)
        before = executed(build, counted)
        printed = run([program, urdf.resolve(), link, *(f"{joint}={value!r}" for joint, value in q.items())], build)
        after = executed(build, counted)
    found = [float(word) for word in printed.splitlines()[-1].split()]
    if max(abs(a - b) for a, b in zip(found, position, strict=True)) > 1e-6:
        sys.exit(f"{name}: {link} is at {found}, and should be at {position}")
    return before, after - before


def rooms(lines: Lines, sources: Path) -> dict[str, int]:
    """How many lines each part of the sources has."""
    counts: dict[str, int] = {}
    for file, _ in lines:
        part = Path(file).relative_to(sources.resolve()).parts[0]
        counts[part] = counts.get(part, 0) + 1
    return counts

"""How large URDFs and URDDs are, for the five robots of the paper.

    python benches/evaluation/sizes.py --robots FOLDER [--urdd PROGRAM]

Bytes of files, MB of 1,000,000 bytes. The meshes of a URDF are the files that it names, each once, as the URDD's
`original_meshes_module` has them, with the files that these need. A URDD without meshes is all of its files but those
in the folders of `mesh_modules` that are no document. Standard library alone.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from tables import ROBOTS, generated, made_by, program, urdf_of, version_of, write

#: What is no mesh.
DOCUMENTS = {"VERSION", "module.json", "module.yaml"}


def sizes(urdf: Path, urdd: Path) -> list[float]:
    """URDF, URDF with meshes, URDD without meshes, URDD with meshes, in bytes."""
    meshes = urdd / "mesh_modules"
    total = without = named = 0
    for path in urdd.rglob("*"):
        if path.is_file():
            size = path.stat().st_size
            is_mesh = meshes in path.parents and path.name not in DOCUMENTS
            total += size
            without += 0 if is_mesh else size
            named += size if is_mesh and meshes / "original_meshes_module" in path.parents else 0
    own = urdf.stat().st_size
    return [own, own + named, without, total]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robots", type=Path, required=True)
    parser.add_argument("--urdd", type=Path, help="instead of one that is built of these sources")
    arguments = parser.parse_args()
    urdd = program(arguments.urdd)
    version = version_of(urdd, arguments.urdd is not None)
    rows = []
    for robot in ROBOTS:
        urdf = urdf_of(robot, arguments.robots)
        with tempfile.TemporaryDirectory() as folder:
            ours = sizes(urdf, generated(urdd, urdf, Path(folder) / "urdd"))
        megabytes = [f"{size / 1e6:.3f}" if k == 0 else f"{size / 1e6:.1f}" for k, size in enumerate(ours)]
        rows.append([robot.name, *megabytes, *(f"{size}" for size in robot.paper_megabytes)])
    write("sizes", rows, made_by(version))


if __name__ == "__main__":
    main()

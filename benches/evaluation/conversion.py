"""How long `urdd generate` takes for the five robots of the paper, what memory, and how large the result is.

    python benches/evaluation/conversion.py --robots FOLDER [--runs 5] [--urdd PROGRAM]

Every module, meshes in every format, 1,000 samples: what `urdd generate ROBOT.urdf -o DIR` does of itself, each run
into a new folder. Wall time with all threads, processor time (of user and system) with one: medians. Memory is the most
that a run had. Then the same for chains of links at the core class, and `urdd validate` of each URDD.

Sizes are bytes of files, MB of 1,000,000 bytes. The meshes of a URDF are the files that it names, each once, as the URDD's
`original_meshes_module` has them, with the files that these need. A URDD without meshes is all of its files but those
in the folders of `mesh_modules` that are no document. Standard library alone; Linux or macOS.
"""

from __future__ import annotations

import statistics
import tempfile
from pathlib import Path

from robots import ROBOTS, arguments, document, program, urdf_of, used, version_of
from results import Table, write

#: What is no mesh.
DOCUMENTS = {"VERSION", "module.json", "module.yaml"}
#: Links of the chains.
CHAINS = (100, 500, 2000)


def triangles(urdd: Path) -> int:
    """Triangles of the plain meshes that come from files: by the size of the binary STL files."""
    meshes = document(urdd, "plain_meshes_module")["link_meshes"]
    return sum(((urdd / mesh["files"]["stl"]).stat().st_size - 84) // 50 for mesh in meshes if mesh)


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


def chain(links: int) -> str:
    """A URDF of links in a line, each on a hinge."""
    joint = (
        '<joint name="joint_{0}" type="revolute"><parent link="link_{1}"/><child link="link_{0}"/><origin xyz="0.1 0 0.02" '
        'rpy="{2:.1f} 0.2 0.3"/><axis xyz="0 0 1"/><limit lower="-1" upper="1.5" effort="10" velocity="2"/></joint>\n'
    )
    lines = [f'<link name="link_{k}"/>\n' for k in range(links)]
    lines += [joint.format(k, k - 1, 0.1 * (k % 30)) for k in range(1, links)]
    return f'<robot name="chain">\n{"".join(lines)}</robot>\n'


def of_chain(urdd: Path, links: int, folder: Path, runs: int) -> str:
    """Time and memory of a chain, in words."""
    urdf = folder / f"chain_{links}.urdf"
    urdf.write_text(chain(links), "utf-8")
    every = [
        used([urdd, "generate", urdf, "-o", folder / f"{links}_{k}", "--modules", "core"]) for k in range(runs)
    ]
    wall = statistics.median(one.wall for one in every)
    return f"{links:,} links {wall:.2f} s and {max(one.peak for one in every):.0f} MB"


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--runs", type=int, default=5)
    given = parser.parse_args()
    urdd, runs = program(given.urdd), given.runs
    times: list[list[str]] = []
    short: list[list[str]] = []
    large: list[list[str]] = []
    for robot in ROBOTS:
        urdf = urdf_of(robot, given.robots)
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            make = lambda target, *options: used([urdd, "generate", urdf, "-o", folder / target, *options])
            made = folder / "0"
            make("0")  # fills the disk's cache
            every = [make(f"all{k}") for k in range(runs)]
            cpu = statistics.median(make(f"one{k}", "--threads", "1").cpu for k in range(runs))
            validate = statistics.median(used([urdd, "validate", made]).wall for _ in range(runs))
            links = str(len(document(made, "chain_module")["links_in_chain"]))
            dofs = str(document(made, "dof_module")["num_dofs"])
            corners = f"{triangles(made):,}"
            ours = sizes(urdf, made)
        wall, peak = statistics.median(one.wall for one in every), max(one.peak for one in every)
        published = f"{robot.reference_seconds}"
        taken = [f"{wall:.2f}", f"{cpu:.2f}"]
        times.append([robot.name, links, dofs, corners, f"{robot.paper_seconds}", published, *taken, f"{peak:.0f}", f"{validate:.2f}"])
        short.append([robot.name, links, corners, published, *taken, f"{peak:.0f}"])
        megabytes = [f"{size / 1e6:.3f}" if k == 0 else f"{size / 1e6:.1f}" for k, size in enumerate(ours)]
        large.append([robot.name, *megabytes, *(f"{size}" for size in robot.paper_megabytes)])
    with tempfile.TemporaryDirectory() as name:
        chains = ", ".join(of_chain(urdd, links, Path(name), runs) for links in CHAINS)
    validated = sorted(float(row[-1]) for row in times)
    items: dict[str, Table | str] = {
        "times": {
            "columns": [
                "robot", "links", "DOFs", "triangles", "paper, s", "reference converter, s", "urdd, s",
                "urdd, one thread, CPU s", "peak memory, MB", "`urdd validate`, s",
            ],
            "rows": times,
        },
        "short": {
            "columns": [
                "robot", "links", "triangles", "published converter, s", "`urdd generate`, s", "CPU, one thread, s",
                "peak memory, MB",
            ],
            "rows": short,
        },
        "sizes": {
            "columns": [
                "robot", "URDF, MB", "with meshes", "URDD without meshes", "with meshes",
                "paper: URDF, MB", "with meshes", "URDD without meshes", "with meshes",
            ],
            "rows": large,
        },
        "validate": f"{validated[0]:.1f} to {validated[-1]:.1f} s",
        "chains": chains,
    }
    write("conversion", items, version_of(urdd, given.urdd is not None), how=f"medians of {runs} runs")


if __name__ == "__main__":
    main()

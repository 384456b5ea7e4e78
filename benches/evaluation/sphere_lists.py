"""Published lists of spheres beside ours: how well they fit, and how often they are right, by the same exact pieces.

    python benches/evaluation/sphere_lists.py --vamp VAMP --foam FOAM --robometrics ROBOMETRICS [--urdd PROGRAM]

Each is a clone: github.com/KavrakiLab/vamp, CoMMALab/foam, fishbotics/robometrics. For each robot a URDD is made of the
collision elements of the URDF that the lists are of, with the pairs of its SRDF skipped. `urdd spheres import` puts a
list into a copy. The figures are those of `link_shapes_spheres_module` (SPEC 8.9): rates of 10,000 sampled
configurations with 95 % intervals, and of the links' fits the mean or the largest. A list of which a pair of links
touches in every configuration is measured again without these pairs. `ours` is the fitted level of `urdd generate`, and
below each list as many spheres, of `urdd export foam --total-spheres`. Foam's list of Panda is VAMP's, and left out.
"""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from robots import arguments, document, percent, program, version_of, without_visuals
from results import Table, write

#: Where a robot rests, if at zero links touch that its SRDF checks.
REST = {"Panda": [f"panda_joint{k}={q}" for k, q in ((2, -0.785), (4, -2.356), (6, 1.571), (7, 0.785))]}
LISTS = "VAMP f6de6a7, Foam 116928f, robometrics 81e3d1d"
COLUMNS = ["robot", "list", "spheres", "collisions missed", "false contacts", "pairs left out",
           "surface outside", "farthest outside, mm", "standoff mean, mm", "largest, mm"]


def ran(*words: object) -> str:
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, words))}: {done.stderr}")
    return done.stdout + done.stderr


def interval(hits: int, of: int) -> list[float]:
    """Wilson's, 95 %, as SPEC 8.8.11."""
    if of == 0:
        return [0.0, 1.0]
    z, p = 1.959963984540054, hits / of
    middle, half = p + z * z / (2 * of), z * (p * (1 - p) / of + z * z / (4 * of * of)) ** 0.5
    return [max(0.0, (middle - half) / (1 + z * z / of)), min(1.0, (middle + half) / (1 + z * z / of))]


def last_level(urdd: Path) -> dict[str, Any]:
    """The last level that does not cover."""
    return [one for one in document(urdd, "link_shapes_spheres_module")["levels"] if not one["covers"]][-1]


def figures(urdd: Path) -> list[str]:
    level = last_level(urdd)
    rates = level["evaluation"]
    fits = [fit for fit in level["fits"] if fit]
    missed, colliding, false, free = (
        rates[key] for key in ("num_missed", "num_colliding", "num_false_contacts", "num_free")
    )
    mean = lambda key: sum(fit[key] for fit in fits) / len(fits)
    return [
        str(sum(map(len, level["spheres"]))),
        percent(missed, colliding, interval(missed, colliding)),
        percent(false, free, interval(false, free)),
        str(len(level["ignored_pairs"])),
        f"{100 * mean('uncovered_fraction'):.1f} %",
        f"{1e3 * max(fit['max_uncovered'] for fit in fits):.1f}",
        f"{1e3 * mean('mean_standoff'):.1f}",
        f"{1e3 * max(fit['max_standoff'] for fit in fits):.1f}",
    ]


def always_touching(urdd: Path) -> list[tuple[str, str]]:
    """Pairs of links that are checked, and whose spheres touch in every sampled configuration."""
    names = [link["name"] for link in document(urdd, "urdf_module")["links"]]
    skips = document(urdd, "link_shapes_skips_module")
    matrix, pieces = skips["decomposition_convex_hulls_skips"], skips["decomposition_shapes"]
    of = lambda link: [k for k, piece in enumerate(pieces) if piece["link_idx"] == link]
    pairs = [(one["link_a_idx"], one["link_b_idx"]) for one in last_level(urdd)["always_pairs"]]
    return [(names[a], names[b]) for a, b in pairs if not all(matrix[i][j] for i in of(a) for j in of(b))]


class Robot:
    """A URDD of a robot's collision meshes, and a copy that takes one list after the other."""

    def __init__(self, binary: Path, title: str, urdf: Path, srdf: Path, rest: list[str], folder: Path) -> None:
        self.binary, self.title, self.folder, self.rows = binary, title, folder, list[list[str]]()
        self.own = folder / "own"
        for path in folder.iterdir():
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        self.make = [binary, "generate", without_visuals(urdf, folder), "--modules", "all,spheres", "-o"]
        ran(*self.make, self.own)
        print(ran(binary, "skips", "import", srdf, self.own))
        if rest:
            ran(binary, "configurations", "set", self.own, "rest", *rest)
            self.make[2:2] = ["--reference", "rest"]
        ran(*self.make, self.own)
        self.add("ours", self.own)

    def add(self, name: str, urdd: Path) -> None:
        self.rows.append([self.title, name, *figures(urdd)])
        print(self.rows[-1], flush=True)

    def take(self, name: str, file: Path) -> None:
        """A list, and then the same without the pairs that always touch."""
        copy = self.folder / "copy"
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(self.own, copy)
        print(ran(self.binary, "spheres", "import", file, copy))
        self.add(name, copy)
        if touching := always_touching(copy):
            print(f"{name} always touches: {touching}")
            srdf = self.folder / "more.srdf"
            lines = [f'<disable_collisions link1="{a}" link2="{b}" reason="Default"/>' for a, b in touching]
            robot = document(copy, "urdf_module")["name"]
            srdf.write_text(f'<robot name="{robot}">{"".join(lines)}</robot>', "utf-8")
            ran(self.binary, "skips", "import", srdf, copy)
            ran(*self.make, copy)
            self.add(name, copy)
            self.rows[-1][5] = str(len(touching))

    def measure(self, name: str, file: Path) -> None:
        """A list, and as many spheres of ours."""
        self.take(name, file)
        number = self.rows[-1][2]
        ours = self.folder / "ours.json"
        ran(self.binary, "export", "foam", self.own, "--total-spheres", number, "-o", ours, "--force")
        self.take("ours", ours)


def main() -> None:
    parser = arguments(__doc__, robots=False)
    for name in ("vamp", "foam", "robometrics"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--dry", action="store_true", help="writes no results")
    given = parser.parse_args()
    binary = program(given.urdd)
    of_vamp = lambda name, end: given.vamp / "resources" / name / f"{name}{end}"
    foam = given.foam / "assets"
    robots = {
        title: (of_vamp(name, ".urdf"), of_vamp(name, ".srdf"), {"VAMP": of_vamp(name, "_spherized.urdf")})
        for title, name in (("Panda", "panda"), ("UR5", "ur5"), ("Fetch", "fetch"), ("Baxter", "baxter"))
    }
    robots["Panda"][2]["cuRobo"] = given.robometrics / "robometrics/content/robot/franka_spheres.yml"
    lists = {f"Foam, {k}": foam / f"fetch/fetch_spherized_{k}.urdf" for k in (1, 6, 8)}
    robots["Fetch of Foam"] = (foam / "fetch/fetch_simple.urdf", of_vamp("fetch", ".srdf"), lists)
    lists = {f"Foam, {k}": foam / f"baxter/baxter_spherized_{k}.urdf" for k in (1, 8)}
    robots["Baxter of Foam"] = (foam / "baxter/baxter.urdf", of_vamp("baxter", ".srdf"), lists)
    rows: list[list[str]] = []
    with tempfile.TemporaryDirectory() as name:
        for title, (urdf, srdf, lists) in robots.items():
            robot = Robot(binary, title, urdf, srdf, REST.get(title, []), Path(name))
            for who, file in lists.items():
                robot.measure(who, file)
            rows += robot.rows
    items: dict[str, Table | str] = {"lists": {"columns": COLUMNS, "rows": rows}}
    if not given.dry:
        write("sphere_lists", items, version_of(binary, given.urdd is not None), LISTS)


if __name__ == "__main__":
    main()

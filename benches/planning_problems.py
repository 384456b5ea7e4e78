"""Planners on MotionBenchMaker's problems, as VAMP's repository has them: solved, time, and which paths are free.

    git clone https://github.com/KavrakiLab/vamp /tmp/vamp && git clone https://github.com/KavrakiLab/nigh /tmp/nigh
    apt-get install clang libeigen3-dev libompl-dev libfcl-dev
    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install numpy pyyaml pin target/wheels/urdd-*.whl
    /tmp/peers/bin/python benches/planning_problems.py --vamp /tmp/vamp --nigh /tmp/nigh --urdd target/release/urdd \\
        --folder /tmp/made [--ompl build/problems] [--robot panda] [--count 100] [--write]

All planners get the obstacles that VAMP's own script gives it: boxes, and capsules for cylinders (in `box`, boxes).
One thread; processor time of the search alone: the world is made before, and no path is made shorter. VAMP and
`plan_by_spheres.py` solve each problem three times with the same random numbers, and the least counts; OMPL once.
Pairs of links are those of the SRDF: the same for all, and those of VAMP's header.

- VAMP: RRT-Connect with its settings of that robot (range 1, dynamic domain, balanced trees), 32 configurations a
  radian.
- `plan_by_spheres.py` of python/examples, at 2 cm: by VAMP's list of spheres, by those of `urdd generate`, and by as
  many of ours as VAMP's list has. `proved` has the time of the exact proof too, and of new searches where it refuses a
  path.
- OMPL (--ompl is benches/planning, built): RRT-Connect in C++ with range 1, 32 configurations a radian, ten seconds, by
  urdd's exact check of the hulls, or FCL's.

Two judges look at each path. Urdd proves the motions of the convex pieces as a whole; a proof needs 0.1 mm. Coal, which
shares no code with urdd, checks the triangles of the URDF's meshes at RESOLUTION, and finely where urdd refuses.
"""

from __future__ import annotations

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import time

# One thread, before numpy is loaded.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np
import yaml

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE), str(HERE / "evaluation"), str(HERE.parent / "python" / "examples")]

import results  # noqa: E402
from robots import without_visuals  # noqa: E402

#: What a path is judged at: no joint turns farther between two configurations.
RESOLUTION = 0.02
LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


# The problems.


def read_problems(archive: pathlib.Path, count: int) -> list[dict]:
    """The first `count` problems of each scene: names, start and goal by joint, and obstacles."""
    parts: dict[tuple[str, int], dict] = {}
    with tarfile.open(archive) as tar:
        for member in tar:
            if member.isfile() and member.name.endswith(".yaml"):
                *_, scene, file = member.name.split("/")
                number = int(re.findall(r"\d+", file)[0])
                if number > count:
                    continue
                content = yaml.load(tar.extractfile(member), Loader=LOADER)
                parts.setdefault((scene.rsplit("_", 1)[0], number), {})[file[:5]] = content
    return [problem(scene, number, part) for (scene, number), part in sorted(parts.items())]


def problem(scene: str, number: int, part: dict) -> dict:
    request = part["reque"]
    state = request["start_state"]["joint_state"]
    goals = request["goal_constraints"][0]["joint_constraints"]
    obstacles = []
    for thing in part["scene"]["world"]["collision_objects"]:
        frame = pose(thing["pose"]) if "pose" in thing else np.eye(4)
        for one, at in zip(thing["primitives"], thing["primitive_poses"]):
            place, sizes = frame @ pose(at), one["dimensions"]
            if one["type"] == "box":
                obstacles.append(("box", place, [side / 2 for side in sizes]))
            elif one["type"] == "cylinder" and scene == "box":
                obstacles.append(("box", place, [sizes[1], sizes[1], sizes[0] / 2]))
            elif one["type"] == "cylinder":
                obstacles.append(("capsule", place, [sizes[1], sizes[0]]))
            else:
                sys.exit(f"{scene} {number}: an obstacle of the type {one['type']}")
            break  # VAMP takes the first of each object.
    return {
        "scene": scene,
        "number": number,
        "start": dict(zip(state["name"], state["position"])),
        "goal": {one["joint_name"]: one["position"] for one in goals},
        "obstacles": obstacles,
    }


def pose(at: dict) -> np.ndarray:
    x, y, z, w = np.array(at["orientation"]) / np.linalg.norm(at["orientation"])
    found = np.eye(4)
    found[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    found[:3, 3] = at["position"]
    return found


def rpy(place: np.ndarray) -> list[float]:
    return [
        float(np.arctan2(place[2, 1], place[2, 2])),
        float(np.arctan2(-place[2, 0], np.hypot(place[2, 1], place[2, 2]))),
        float(np.arctan2(place[1, 0], place[0, 0])),
    ]


def write_plain(problems: list[dict], joints: list[str], file: pathlib.Path) -> None:
    """Lines: problem, start, goal, box (centre, rpy, half extents), capsule (centre, rpy, radius, length), end."""
    lines = []
    for one in problems:
        lines.append(f"problem {one['scene']} {one['number']}")
        for end in ("start", "goal"):
            lines.append(" ".join([end, *(repr(float(one[end][joint])) for joint in joints)]))
        for kind, place, sizes in one["obstacles"]:
            lines.append(" ".join([kind, *(repr(float(x)) for x in [*place[:3, 3], *rpy(place), *sizes])]))
        lines.append("end")
    file.write_text("\n".join(lines) + "\n", "utf-8")


# The planners. Each gives, for each problem, milliseconds and a path (n, DOFs), empty where it found none.


def build_vamp(vamp: pathlib.Path, nigh: pathlib.Path, folder: pathlib.Path) -> pathlib.Path:
    from spheres_vamp import SORT

    (folder / "pdqsort.h").write_text(SORT)
    built = folder / "planning_vamp"
    includes = [f"-I{folder}", f"-I{vamp}/src/impl", f"-I{nigh}/src", "-I/usr/include/eigen3"]
    flags = ["-std=c++17", "-O3", "-mavx2", "-mfma", "-DNDEBUG", *includes]
    subprocess.run(["clang++", *flags, str(HERE / "planning_vamp.cpp"), "-o", str(built)], check=True)
    return built


def lines_of(file: pathlib.Path) -> list[dict]:
    return [json.loads(line) for line in file.read_text("utf-8").splitlines()]


def world_of(one: dict):
    import urdd

    world = urdd.World()
    for k, (kind, place, sizes) in enumerate(one["obstacles"]):
        if kind == "box":
            world.add_box(str(k), [2 * side for side in sizes], place)
        else:
            world.add_capsule(str(k), *sizes, place)
    return world


def plan_by_spheres(robot, problems: list[dict], proved: bool) -> list[dict]:
    """By spheres; `proved`, the exact shapes prove each path, and what they refuse is planned again."""
    import plan_by_spheres as planner

    checker, proximity = robot.sphere_checker(), robot.proximity("pieces")

    lower, upper = robot.bounds.T
    found = []
    for one in problems:
        ends = [np.array([one[end][joint] for joint in robot.dof_names]) for end in ("start", "goal")]
        world = world_of(one)
        around = checker.around(world)
        exact = [proximity, robot.world_proximity(world, proximity)] if proved else []
        if around.in_collision(ends).any() or any(check.in_collision(ends).any() for check in exact):
            found.append({"free": 0, "ms": 0.0, "path": []})
            continue
        least, path = np.inf, None
        for _ in range(3):
            random = np.random.default_rng(1)
            begin = time.process_time()
            path = planner.plan_proved(around, exact, lower, upper, *ends, random)
            least = min(least, 1e3 * (time.process_time() - begin))
        found.append({"free": 1, "ms": least, "path": [] if path is None else path.tolist()})
    return found


# The judges.


def between(path: np.ndarray) -> np.ndarray:
    parts = []
    for a, b in zip(path[:-1], path[1:]):
        steps = max(1, int(np.ceil(np.abs(b - a).max() / RESOLUTION)))
        parts.append(a + np.linspace(0, 1, steps, endpoint=False)[:, None] * (b - a))
    return np.concatenate([*parts, path[-1:]])


def refused_places(exact: tuple, path: np.ndarray) -> list[np.ndarray]:
    """Configurations around each place where urdd proves a path no further, in steps of 8e-5 rad."""
    found = []
    for check in exact:
        parts = check.blocked_edge(path[:-1], path[1:], resolution=None)
        for k in np.flatnonzero(~np.isnan(parts)):
            motion = path[k + 1] - path[k]
            around = parts[k] + np.linspace(-0.1, 1.5, 400) * RESOLUTION / np.abs(motion).max()
            found.append(path[k] + np.clip(around, 0, 1)[:, None] * motion)
    return found


class Coal:
    """Collisions by Pinocchio and coal, from the URDF and the SRDF alone: triangles of the meshes, no convex pieces."""

    def __init__(self, urdf: pathlib.Path, srdf: pathlib.Path, joints: list[str]) -> None:
        import coal
        import pinocchio

        self.coal, self.pinocchio = coal, pinocchio
        self.model = pinocchio.buildModelFromUrdf(str(urdf))
        kind = pinocchio.GeometryType.COLLISION
        self.geometry = pinocchio.buildGeomFromUrdf(self.model, str(urdf), kind, package_dirs=str(urdf.parent))
        self.geometry.addAllCollisionPairs()
        pinocchio.removeCollisionPairs(self.model, self.geometry, str(srdf), False)
        self.places = [self.model.joints[self.model.getJointId(joint)].idx_q for joint in joints]
        self.bodies = len(self.geometry.geometryObjects)
        self.data = self.model.createData()

    def among(self, one: dict):
        """The robot among the obstacles of a problem."""
        geometry = self.geometry.copy()
        for number, (kind, place, sizes) in enumerate(one["obstacles"]):
            shape = self.coal.Box(*(2 * side for side in sizes)) if kind == "box" else self.coal.Capsule(*sizes)
            at = self.pinocchio.SE3(place[:3, :3], place[:3, 3])
            index = geometry.addGeometryObject(self.pinocchio.GeometryObject(f"obstacle {number}", 0, 0, at, shape))
            for body in range(self.bodies):
                geometry.addCollisionPair(self.pinocchio.CollisionPair(body, index))
        return geometry, geometry.createData()

    def touches(self, path: np.ndarray, scene) -> str | None:
        """The first two that touch."""
        geometry, data = scene
        q = self.pinocchio.neutral(self.model)
        for row in path:
            q[self.places] = row
            self.pinocchio.updateGeometryPlacements(self.model, self.data, geometry, data, q)
            if self.pinocchio.computeCollisions(geometry, data, True):
                for pair, result in zip(geometry.collisionPairs, data.collisionResults):
                    if result.isCollision():
                        return " and ".join(geometry.geometryObjects[k].name for k in (pair.first, pair.second))
        return None


def judged(found: dict[str, list[dict]], problems: list[dict], robot, coal: Coal) -> dict[str, dict[str, list]]:
    """Of each planner, the problems whose path a judge refuses."""
    refused: dict[str, dict[str, list]] = {name: {"coal": [], "urdd": []} for name in found}
    proximity = robot.proximity("pieces")
    for k, one in enumerate(problems):
        scene = coal.among(one)
        world = robot.world_proximity(world_of(one), proximity)
        known: dict[bytes, tuple[bool, bool]] = {}
        for name, answers in found.items():
            path = np.array(answers[k]["path"])
            if len(path) < 2 or not answers[k]["free"]:
                continue
            if path.tobytes() not in known:
                places = refused_places((proximity, world), path)
                by_coal = any(coal.touches(rows, scene) for rows in [*places, between(path)])
                known[path.tobytes()] = by_coal, bool(places)
            for judge, refuses in zip(("coal", "urdd"), known[path.tobytes()]):
                if refuses:
                    refused[name][judge].append(k)
    return refused


def row(name: str, answers: list[dict], refused: dict[str, list]) -> list[str]:
    times = [one["ms"] for one in answers if one["free"] and one["path"]]
    ends = sum(1 - one["free"] for one in answers)
    return [
        name,
        f"{len(times)} of {len(answers)}",
        str(ends),
        *(f"{np.percentile(times, part):.3g}" for part in (50, 95)),
        str(len(refused["coal"])),
        str(len(refused["urdd"])),
    ]


COLUMNS = [
    "planner", "solved", "ends in contact", "median, ms", "95 %, ms", "paths in contact by coal", "not proved by urdd"
]


def make_urdds(program: pathlib.Path, source: pathlib.Path, name: str, rest: dict, folder: pathlib.Path) -> None:
    """A URDD of the collision meshes, with the SRDF's pairs, a copy with VAMP's spheres, and one with as many of ours.

    The robot rests at the first start: at zero, where it never is, links touch that would be skipped for that.
    """
    import urdd

    own, listed, as_many = folder / "own", folder / "listed", folder / "as_many"

    def do(*words: object) -> None:
        subprocess.run([str(program), *map(str, words)], check=True, stdout=subprocess.DEVNULL)

    urdf = without_visuals(source / f"{name}.urdf", own.parent)
    make = ["generate", urdf, "-o", own, "--modules", "all,spheres"]
    do(*make)
    dofs = urdd.load(own).dof_names
    do("configurations", "set", own, "rest", *(f"{dof}={rest[dof]}" for dof in dofs))
    do("skips", "import", source / f"{name}.srdf", own)
    do(*make, "--reference", "rest")
    shutil.copytree(own, listed)
    do("spheres", "import", source / f"{name}_spherized.urdf", listed)
    number = sphere_count(urdd.load(listed).sphere_checker())
    do("export", "foam", own, "--total-spheres", number, "-o", own.parent / "as_many.json", "--force")
    shutil.copytree(own, as_many)
    do("spheres", "import", own.parent / "as_many.json", as_many)


def sphere_count(checker) -> int:
    return int(re.findall(r"(\d+) (?:covering )?spheres", repr(checker))[0])


def solve_all(
    given: argparse.Namespace, name: str, robot, problems: list[dict], folder: pathlib.Path
) -> dict[str, list[dict]]:
    """What each planner finds."""
    import urdd

    joints = list(robot.dof_names)
    plain = folder / "problems.txt"
    write_plain(problems, joints, plain)
    found: dict[str, list[dict]] = {}

    answers = folder / "answers.json"
    subprocess.run([str(build_vamp(given.vamp, given.nigh, folder)), str(plain), name, str(answers)], check=True)
    found["VAMP"] = lines_of(answers)
    for kind, of in (("listed", "{} spheres of VAMP"), ("own", "{} of the URDD"), ("as_many", "{} of ours")):
        described = urdd.load(folder / kind)
        title = f"`plan_by_spheres.py`, {of.format(sphere_count(described.sphere_checker()))}"
        found[title] = plan_by_spheres(described, problems, False)
        if kind != "listed":
            found[f"{title}, proved"] = plan_by_spheres(described, problems, True)
    for checker in ("urdd", "fcl") if given.ompl else ():
        subprocess.run([str(given.ompl), str(plain), str(folder / "own"), str(answers), checker], check=True)
        found[f"OMPL, {'urdd (hulls)' if checker == 'urdd' else 'FCL (hulls)'}"] = lines_of(answers)
    return found


def run(given: argparse.Namespace, name: str, folder: pathlib.Path) -> results.Table:
    import urdd

    source = given.vamp / "resources" / name
    problems = read_problems(source / "problems.tar.bz2", given.count)
    if not (folder / "as_many" / "urdd.json").exists():
        make_urdds(given.urdd, source, name, problems[0]["start"], folder)
    robot = urdd.load(folder / "own")
    kept = folder / "found.json"
    if not kept.exists():
        kept.write_text(json.dumps(solve_all(given, name, robot, problems, folder)), "utf-8")
    found = json.loads(kept.read_text("utf-8"))
    coal = Coal(source / f"{name}.urdf", source / f"{name}.srdf", list(robot.dof_names))
    refused = judged(found, problems, robot, coal)
    (folder / "refused.json").write_text(json.dumps(refused), "utf-8")
    return {"columns": COLUMNS, "rows": [row(planner, own, refused[planner]) for planner, own in found.items()]}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vamp", type=pathlib.Path, required=True)
    parser.add_argument("--nigh", type=pathlib.Path, required=True)
    parser.add_argument("--urdd", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--ompl", type=pathlib.Path, help="benches/planning, built")
    parser.add_argument("--robot", default="panda", help="panda or fetch")
    parser.add_argument("--count", type=int, default=100, help="problems of each scene")
    parser.add_argument("--folder", type=pathlib.Path, required=True, help="for what is made, and is not made again")
    parser.add_argument("--write", action="store_true", help="writes benches/results/planning_ROBOT.json")
    given = parser.parse_args()
    folder = given.folder / given.robot
    folder.mkdir(parents=True, exist_ok=True)
    table = run(given, given.robot, folder)
    print(results.markdown(table))
    if given.write:
        version = subprocess.run([given.urdd, "--version"], check=True, capture_output=True, text=True).stdout.strip()
        programs = [version, "VAMP f6de6a7", *(["OMPL 1.5.2, FCL 0.7.0"] if given.ompl else []), "coal 3.0.3"]
        how = "processor time of one thread"
        results.write(f"planning_{given.robot}", {"problems": table}, *programs, how=how)


if __name__ == "__main__":
    main()

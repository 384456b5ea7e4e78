"""Measures this package and others, on the same robots, in one run.

    pip install ./python pin mujoco pybullet yourdfpy
    python python/benches/compare.py --readme

measures UR5 and H1 of `../shared/robots` and writes the tables into README.md; without `--readme` it prints them.
Other robots: `python python/benches/compare.py URDF...`. `--quick` does little of everything, to see that it runs:
its figures mean nothing. On a machine that does nothing else, of a build as `pip install` makes it.

For each URDF a URDD is made in a temporary folder. Then, one thread each, processor time:

- load: a fresh process imports the package, loads the robot, and has the pose of every link in one configuration;
- poses of all links, Jacobians of the link that most DOFs move, and whether the robot collides with itself, in 10,000
  random configurations: microseconds each. Ours as a batch; Pinocchio, yourdfpy, MuJoCo and PyBullet as a loop in
  Python, which is how they are used there. Collisions on the same convex pieces and pairs for all: Pinocchio by coal,
  each pair until the first that collides, and by its broad phase; PyBullet and MuJoCo by their own broad phases.

Peers that are not installed are left out, and said; so are wall times.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("RAYON_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np

import urdd

REPOSITORY = Path(__file__).resolve().parents[2]
README = REPOSITORY / "python" / "README.md"
USUAL = [REPOSITORY.parent / "shared" / "robots" / name / "robot.urdf" for name in ("ur5", "h1")]
#: Between these lines, README.md has the tables.
BEGIN, END = "<!-- benches/compare.py -->", "<!-- end of benches/compare.py -->"


class Effort:
    """The amount of work to measure."""

    configurations = 10_000
    #: For slow operations.
    fewer = 500
    rounds = 5
    fresh = 9


#: What a fresh process does. `{urdd}` and `{urdf}` are paths; `{dofs}` is a number.
LOADING = {
    "urdd": "import urdd\nrobot = urdd.load({urdd!r})\nrobot.link_poses(robot.zero)",
    "Pinocchio": (
        "import pinocchio as pin\nmodel = pin.buildModelFromUrdf({urdf!r})\ndata = model.createData()\n"
        "pin.framesForwardKinematics(model, data, pin.neutral(model))"
    ),
    "yourdfpy": (
        "import yourdfpy\nrobot = yourdfpy.URDF.load({urdf!r}, load_meshes=False, build_scene_graph=True)\n"
        "[robot.get_transform(link) for link in robot.link_map]"
    ),
    "MuJoCo": (
        "import mujoco\nmodel = mujoco.MjModel.from_xml_path({urdf!r})\ndata = mujoco.MjData(model)\n"
        "mujoco.mj_kinematics(model, data)"
    ),
    "PyBullet": (
        "import pybullet as p\np.connect(p.DIRECT)\nrobot = p.loadURDF({urdf!r}, useFixedBase=True)\n"
        "p.getLinkStates(robot, range(p.getNumJoints(robot)), computeForwardKinematics=True)"
    ),
}


def has(name: str) -> bool:
    """Whether another package is installed."""
    try:
        import_module(name)
    except ImportError:
        return False
    return True


def clock(work: Callable[[], object], rounds: int | None = None) -> float:
    """The median of the processor time of some rounds, seconds."""
    times: list[float] = []
    for _ in range(min(rounds or Effort.rounds, Effort.rounds)):
        begin = time.process_time()
        work()
        times.append(time.process_time() - begin)
    return statistics.median(times)


def quiet(work: Callable[[], dict[str, float]]) -> dict[str, float]:
    """The result of a function, without the output of C code."""
    sys.stdout.flush()
    kept = os.dup(1)
    nothing = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nothing, 1)
        return work()
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nothing)


def loading(code: str) -> tuple[float, float] | None:
    """The wall time and the processor time of a fresh process, seconds: medians. None if it fails."""
    walls, processors = [], []
    for _ in range(Effort.fresh):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        begin = time.perf_counter()
        ended = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
        walls.append(time.perf_counter() - begin)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        processors.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        if ended.returncode != 0:
            return None
    return statistics.median(walls), statistics.median(processors)


def farthest(robot: urdd.Robot) -> int:
    """The link that the most DOFs move."""
    moves = (robot.jacobian(robot.random(), link).any(axis=0).sum() for link in range(robot.num_links))
    return int(np.argmax(list(moves)))


def of_us(robot: urdd.Robot, q: Any) -> dict[str, float]:
    """Seconds for all configurations."""
    last = farthest(robot)
    proximity = robot.proximity()
    found = {
        "poses": clock(lambda: robot.link_poses(q)),
        "Jacobians": clock(lambda: robot.jacobian(q, last)),
        "collisions": clock(lambda: proximity.in_collision(q)),
    }

    def one_by_one() -> None:
        for row in q[: Effort.fewer]:
            robot.link_poses(row)

    found["poses, one by one"] = clock(one_by_one) / Effort.fewer * len(q)
    return found


def of_pinocchio(robot: urdd.Robot, q: Any) -> dict[str, float]:
    """The same; collisions by the faster of its two methods."""
    pin: Any = import_module("pinocchio")
    peer = robot.to_pinocchio()
    model, data, own = peer.model, peer.model.createData(), list(peer.q(q))
    frame = model.getFrameId(robot.link_names[farthest(robot)], pin.FrameType.BODY)
    geometry, places = peer.collision_model, pin.GeometryData(peer.collision_model)
    broad = pin.BroadPhaseManager_DynamicAABBTreeCollisionManager(model, geometry, places)

    def poses() -> None:
        for row in own:
            pin.framesForwardKinematics(model, data, row)

    def jacobians() -> None:
        for row in own:
            pin.computeFrameJacobian(model, data, row, frame, pin.LOCAL_WORLD_ALIGNED)

    def by_pairs() -> None:
        for row in own[: Effort.fewer]:
            pin.computeCollisions(model, data, geometry, places, row, True)

    def by_broad_phase() -> None:
        for row in own[: Effort.fewer]:
            pin.computeCollisions(model, data, broad, row, True)

    told = [pin.computeCollisions(model, data, geometry, places, row, True) for row in own[: Effort.fewer]]
    agree = np.array(told) == robot.in_collision(q[: Effort.fewer])
    if agree.mean() < 0.99:
        raise SystemExit(f"Pinocchio and we agree on {agree.mean():.1%} of configurations")
    slow = min(clock(by_pairs, 3), clock(by_broad_phase, 3))
    return {"poses": clock(poses), "Jacobians": clock(jacobians), "collisions": slow / Effort.fewer * len(q)}


def of_yourdfpy(urdf: Path, robot: urdd.Robot, q: Any) -> dict[str, float]:
    """Only poses: it has no Jacobians, and no collisions without python-fcl."""
    yourdfpy: Any = import_module("yourdfpy")
    model = yourdfpy.URDF.load(str(urdf), load_meshes=False, build_scene_graph=True)
    order = [robot.dof_names.index(name) for name in model.actuated_joint_names]

    def poses() -> None:
        for row in q[: Effort.fewer]:
            model.update_cfg(row[order])
            for link in model.link_map:
                model.get_transform(link)

    return {"poses": clock(poses, 3) / Effort.fewer * len(q)}


def of_mujoco(robot: urdd.Robot, q: Any) -> dict[str, float]:
    """The same."""
    mujoco: Any = import_module("mujoco")
    peer = robot.to_mujoco(visuals=False)
    model, data, own = peer.model, mujoco.MjData(peer.model), peer.q(q)
    body = model.body(robot.link_names[farthest(robot)]).id
    linear, angular = np.zeros((3, model.nv)), np.zeros((3, model.nv))

    def poses() -> None:
        for row in own:
            data.qpos[:] = row
            mujoco.mj_kinematics(model, data)

    def jacobians() -> None:
        for row in own:
            data.qpos[:] = row
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_jacBody(model, data, linear, angular, body)

    def collisions() -> None:
        for row in own[: Effort.fewer]:
            data.qpos[:] = row
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_collision(model, data)

    return {
        "poses": clock(poses),
        "Jacobians": clock(jacobians),
        "collisions": clock(collisions, 3) / Effort.fewer * len(q),
    }


def of_pybullet(robot: urdd.Robot, q: Any) -> dict[str, float]:
    """The same."""
    bullet: Any = import_module("pybullet")
    client = bullet.connect(bullet.DIRECT)
    peer = robot.to_pybullet(client)
    count = bullet.getNumJoints(peer.body)
    last = peer.links[robot.link_names[farthest(robot)]]
    moving = [k for k in range(count) if bullet.getJointInfo(peer.body, k)[2] != bullet.JOINT_FIXED]
    still = [0.0] * len(moving)

    def poses() -> None:
        for row in q[: Effort.fewer]:
            peer.set(row)
            bullet.getLinkStates(peer.body, range(count), computeForwardKinematics=True)

    def jacobians() -> None:
        for row in q[: Effort.fewer]:
            bullet.calculateJacobian(peer.body, last, [0.0, 0.0, 0.0], row.tolist(), still, still)

    def collisions() -> None:
        for row in q[: Effort.fewer]:
            peer.set(row)
            bullet.performCollisionDetection()
            bullet.getContactPoints(peer.body, peer.body)

    found = {"poses": clock(poses, 3), "collisions": clock(collisions, 3)}
    if len(moving) == robot.num_dofs:
        found["Jacobians"] = clock(jacobians, 3)
    bullet.disconnect(client)
    return {name: seconds / Effort.fewer * len(q) for name, seconds in found.items()}


#: The distribution of each compared package, and further text for its row.
PEERS = {
    "Pinocchio": ("pinocchio", ["pin", "coal"]),
    "MuJoCo": ("mujoco", ["mujoco"]),
    "PyBullet": ("pybullet", ["pybullet"]),
    "yourdfpy": ("yourdfpy", ["yourdfpy"]),
}


def title(name: str) -> str:
    """A compared package with its versions."""
    if name not in PEERS:
        return name
    first, *others = PEERS[name][1]
    words = [f"{name} {short_version(first)}", *(f"{other} {short_version(other)}" for other in others)]
    return " with ".join(words)


def short_version(package: str) -> str:
    try:
        full = importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        # Parts of other packages have no metadata under their own names.
        full = str(getattr(import_module(package), "__version__", ""))
    parts = full.split(".")
    return full if parts[0] == "0" else ".".join(parts[:2])


def compare(urdf: Path, folder: Path) -> str:
    """The table of a robot."""
    made = urdd.generate(urdf, folder)
    robot = made.load()
    q = robot.random(Effort.configurations)
    colliding = robot.in_collision(q).mean()
    pairs = robot.proximity().num_pairs
    found: dict[str, dict[str, float]] = {"urdd": of_us(robot, q)}
    missing = [name for name, (module, _) in PEERS.items() if not has(module)]
    if missing:
        print(f"not installed: {', '.join(missing)}", file=sys.stderr)
    measures: dict[str, Callable[[], dict[str, float]]] = {
        "Pinocchio": lambda: of_pinocchio(robot, q),
        "MuJoCo": lambda: of_mujoco(robot, q),
        "PyBullet": lambda: quiet(lambda: of_pybullet(robot, q)),
        "yourdfpy": lambda: of_yourdfpy(urdf, robot, q),
    }
    for name, measure in measures.items():
        if name in missing:
            continue
        try:
            found[name] = measure()
        except urdd.ExportError as error:
            print(f"{name}: {error}", file=sys.stderr)
    shown = robot.name.removesuffix("_description").upper()
    lines = [
        f"{shown}: {robot.num_links} links, {robot.num_dofs} DOFs, {pairs:,} pairs of pieces; "
        f"{100 * colliding:.0f} % of the configurations collide.",
        "",
        "| | load, ms | poses, µs | Jacobian, µs | collides, µs |",
        "|---|---:|---:|---:|---:|",
    ]
    walls: list[str] = []
    for name, times in found.items():
        load = loading(LOADING[name].format(urdd=str(folder), urdf=str(urdf)))
        words = ["-"] if load is None else [f"{1000 * load[1]:.0f}"]
        for what in ("poses", "Jacobians", "collisions"):
            words.append(three_digits(times[what] / len(q) * 1e6) if what in times else "-")
        lines.append(f"| {title(name)} | {' | '.join(words)} |")
        if load is not None:
            walls.append(f"{name} {1000 * load[0]:.0f}")
    print(f"{robot.name}: load, wall, ms: {', '.join(walls)}", file=sys.stderr)
    alone = found["urdd"]["poses, one by one"] / len(q) * 1e6
    print(f"{robot.name}: urdd.link_poses one by one: {alone:.2f} µs", file=sys.stderr)
    return "\n".join(lines)


def three_digits(number: float) -> str:
    return f"{number:.0f}" if number >= 100 else f"{number:.1f}" if number >= 10 else f"{number:.2f}"


def main() -> None:
    """Compares on every given URDF."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("urdfs", nargs="*", type=Path, default=USUAL, metavar="URDF")
    parser.add_argument("--readme", action="store_true", help="writes the tables into README.md")
    parser.add_argument("--quick", action="store_true", help="does little of everything")
    asked = parser.parse_args()
    if asked.quick:
        if asked.readme:
            parser.error("figures of --quick mean nothing, and do not go into README.md")
        Effort.configurations, Effort.fewer, Effort.rounds, Effort.fresh = 100, 10, 1, 1
    for path in asked.urdfs:
        if not path.is_file():
            parser.error(f"there is no {path}")
    tables: list[str] = []
    with tempfile.TemporaryDirectory() as folder:
        for number, path in enumerate(asked.urdfs):
            tables.append(compare(path, Path(folder) / f"robot_{number}"))
    text = "\n\n".join(tables)
    if not asked.readme:
        print(text)
        return
    readme = README.read_text(encoding="utf-8")
    block = re.compile(f"{re.escape(BEGIN)}.*?{re.escape(END)}", re.DOTALL)
    if len(block.findall(readme)) != 1:
        raise SystemExit(f"{README} has not one place for the tables: {BEGIN} ... {END}")
    README.write_text(block.sub(lambda _: f"{BEGIN}\n{text}\n{END}", readme), encoding="utf-8")
    print(f"wrote {README}", file=sys.stderr)


if __name__ == "__main__":
    main()

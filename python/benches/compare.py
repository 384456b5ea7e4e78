"""Measures this package beside others, on the same robots, in one run.

    python python/benches/compare.py URDF...

For each URDF a URDD is made in a temporary folder. Then, one thread each, processor time:

- load: a fresh process imports the package, loads the robot, and has the pose of every link in one configuration;
- poses of all links, Jacobians of the link that most DOFs move, and whether the robot collides with itself, in 10,000
  random configurations: microseconds each. Ours as a batch; Pinocchio, yourdfpy, MuJoCo and PyBullet as a loop in
  Python, which is how they are used there. Collisions on the same convex pieces and pairs for all: Pinocchio by coal,
  each pair until the first that collides, and by its broad phase; PyBullet and MuJoCo by their own broad phases.

It prints Markdown tables; those in README.md are a run of it. Peers that are not installed are left out, and said.
"""

from __future__ import annotations

import os
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

CONFIGURATIONS = 10_000
#: Of those that take long.
FEWER = 500
ROUNDS = 5

#: What a fresh process does. `{urdd}` and `{urdf}` are paths; `{dofs}` is a number.
LOADING = {
    "urdd": "import urdd\nrobot = urdd.load({urdd!r})\nrobot.fk(robot.zero)",
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
    """Whether a peer is installed."""
    try:
        import_module(name)
    except ImportError:
        return False
    return True


def clock(work: Callable[[], object], rounds: int = ROUNDS) -> float:
    """The median of the processor time of some rounds, seconds."""
    times: list[float] = []
    for _ in range(rounds):
        begin = time.process_time()
        work()
        times.append(time.process_time() - begin)
    return statistics.median(times)


def quiet(work: Callable[[], dict[str, float]]) -> dict[str, float]:
    """What work gives, without what C prints."""
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
    """The wall time and the processor time of a fresh process, seconds: medians. None where it fails."""
    walls, processors = [], []
    for _ in range(9):
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
    moves = (robot.jacobian(robot.sample(), link).any(axis=0).sum() for link in range(robot.num_links))
    return int(np.argmax(list(moves)))


def of_us(robot: urdd.Robot, q: Any) -> dict[str, float]:
    """Seconds for all configurations."""
    last = farthest(robot)
    proximity = robot.proximity()
    found = {
        "poses": clock(lambda: robot.fk(q)),
        "Jacobians": clock(lambda: robot.jacobian(q, last)),
        "collisions": clock(lambda: proximity.in_collision(q)),
    }

    def one_by_one() -> None:
        for row in q[:FEWER]:
            robot.fk(row)

    found["poses, one by one"] = clock(one_by_one) / FEWER * len(q)
    return found


def of_pinocchio(robot: urdd.Robot, q: Any) -> dict[str, float]:
    """The same; collisions by the faster of its two ways."""
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
        for row in own[:FEWER]:
            pin.computeCollisions(model, data, geometry, places, row, True)

    def by_broad_phase() -> None:
        for row in own[:FEWER]:
            pin.computeCollisions(model, data, broad, row, True)

    told = [pin.computeCollisions(model, data, geometry, places, row, True) for row in own[:FEWER]]
    agree = np.array(told) == robot.in_collision(q[:FEWER])
    if agree.mean() < 0.99:
        raise SystemExit(f"Pinocchio and we agree on {agree.mean():.1%} of configurations")
    slow = min(clock(by_pairs, 3), clock(by_broad_phase, 3))
    return {"poses": clock(poses), "Jacobians": clock(jacobians), "collisions": slow / FEWER * len(q)}


def of_yourdfpy(urdf: Path, robot: urdd.Robot, q: Any) -> dict[str, float]:
    """Poses alone: it has no Jacobians, and no collisions without python-fcl."""
    yourdfpy: Any = import_module("yourdfpy")
    model = yourdfpy.URDF.load(str(urdf), load_meshes=False, build_scene_graph=True)
    order = [robot.dof_names.index(name) for name in model.actuated_joint_names]

    def poses() -> None:
        for row in q[:FEWER]:
            model.update_cfg(row[order])
            for link in model.link_map:
                model.get_transform(link)

    return {"poses": clock(poses, 3) / FEWER * len(q)}


def of_mujoco(robot: urdd.Robot, q: Any) -> dict[str, float]:
    """The same."""
    mujoco: Any = import_module("mujoco")
    peer = robot.to_mujoco(visuals=False)
    model, data, own = peer.model, mujoco.MjData(peer.model), peer.qpos(q)
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
        for row in own[:FEWER]:
            data.qpos[:] = row
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            mujoco.mj_collision(model, data)

    return {
        "poses": clock(poses),
        "Jacobians": clock(jacobians),
        "collisions": clock(collisions, 3) / FEWER * len(q),
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
        for row in q[:FEWER]:
            peer.set(row)
            bullet.getLinkStates(peer.body, range(count), computeForwardKinematics=True)

    def jacobians() -> None:
        for row in q[:FEWER]:
            bullet.calculateJacobian(peer.body, last, [0.0, 0.0, 0.0], row.tolist(), still, still)

    def collisions() -> None:
        for row in q[:FEWER]:
            peer.set(row)
            bullet.performCollisionDetection()
            bullet.getContactPoints(peer.body, peer.body)

    found = {"poses": clock(poses, 3), "collisions": clock(collisions, 3)}
    if len(moving) == robot.num_dofs:
        found["Jacobians"] = clock(jacobians, 3)
    bullet.disconnect(client)
    return {name: seconds / FEWER * len(q) for name, seconds in found.items()}


def compare(urdf: Path, folder: Path) -> None:
    """Prints the tables of a robot."""
    made = urdd.generate(urdf, folder / urdf.stem)
    robot = made.load()
    q = robot.sample(CONFIGURATIONS)
    colliding = robot.in_collision(q).mean()
    pairs = robot.proximity().num_pairs
    print(
        f"\n{robot.name}: {robot.num_links} links, {robot.num_dofs} DOFs, {pairs} pairs of pieces, "
        f"{colliding:.0%} of the configurations collide\n"
    )
    peers = {"Pinocchio": "pinocchio", "yourdfpy": "yourdfpy", "MuJoCo": "mujoco", "PyBullet": "pybullet"}
    missing = [name for name, module in peers.items() if not has(module)]
    if missing:
        print(f"not installed: {', '.join(missing)}\n")
    found: dict[str, dict[str, float]] = {"urdd": of_us(robot, q)}
    if "Pinocchio" not in missing:
        found["Pinocchio"] = of_pinocchio(robot, q)
    if "yourdfpy" not in missing:
        found["yourdfpy"] = of_yourdfpy(urdf, robot, q)
    if "MuJoCo" not in missing:
        found["MuJoCo"] = of_mujoco(robot, q)
    if "PyBullet" not in missing:
        try:
            found["PyBullet"] = quiet(lambda: of_pybullet(robot, q))
        except urdd.ExportError as error:
            print(f"PyBullet: {error}\n")
    print("| | load, wall ms | load, CPU ms | poses, µs | Jacobian, µs | collides, µs |")
    print("|---|---:|---:|---:|---:|---:|")
    for name, times in found.items():
        code = LOADING[name].format(urdd=str(folder / urdf.stem), urdf=str(urdf))
        load = loading(code)
        words = ["-", "-"] if load is None else [f"{1000 * seconds:.0f}" for seconds in load]
        for what in ("poses", "Jacobians", "collisions"):
            words.append(f"{times[what] / len(q) * 1e6:.2f}" if what in times else "-")
        print(f"| {name} | {' | '.join(words)} |")
    print(f"\nurdd.fk one by one: {found['urdd']['poses, one by one'] / len(q) * 1e6:.2f} µs")


def main() -> None:
    """Compares on every URDF that is given."""
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        for path in sys.argv[1:]:
            compare(Path(path), Path(folder))


if __name__ == "__main__":
    main()

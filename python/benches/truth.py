"""Compares our numbers with Pinocchio's, on other people's robots.

    python python/benches/truth.py [COUNT]

For COUNT (20) robots of the package example-robot-data: a URDD of each is made in a temporary folder; the poses and
Jacobians of all links in 100 configurations are held to those that Pinocchio computes from the URDF by its own reader,
and the distances of all pieces to those of coal on the same pieces. Needs pin and example-robot-data.
"""

from __future__ import annotations

import os
import sys
import tempfile
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

import urdd
from urdd._joints import joints_of

CONFIGURATIONS = 100
#: For distances, which take longer.
FEWER = 20


def urdfs() -> list[Path]:
    """The URDFs of the package, smallest first, each robot once."""
    pin: Any = import_module("pinocchio")
    root = Path(pin.__file__).resolve().parents[4] / "share" / "example-robot-data" / "robots"
    return sorted(root.glob("**/*.urdf"), key=lambda path: (path.stat().st_size, path))


def motion(pin: Any, robot: urdd.Robot, path: Path) -> tuple[float, float] | None:
    """The worst differences of poses and Jacobians; None if Pinocchio reads a different robot from the URDF."""
    model = pin.buildModelFromUrdf(str(path))
    data = model.createData()
    joints = {joint.name: joint for joint in joints_of(robot.modules)}
    if any(joint.kind not in ("Fixed", "Revolute", "Continuous", "Prismatic") for joint in joints.values()):
        return None
    own = robot.to_pinocchio(shapes=None)
    worst = [0.0, 0.0]
    for q in robot.random(CONFIGURATIONS):
        theirs, tangent = pin.neutral(model), np.zeros((model.nv, robot.num_dofs))
        for number in range(1, model.njoints):
            joint, kind = joints[model.names[number]], model.joints[number]
            value = float(joint.position(q)[0])
            at = slice(kind.idx_q, kind.idx_q + kind.nq)
            theirs[at] = [np.cos(value), np.sin(value)] if kind.nq == 2 else [value]
            dof, factor = (joint.dofs[0], 1.0) if joint.mimic is None else (joint.mimic[0], joint.mimic[1])
            if dof is not None:
                tangent[kind.idx_v, dof] += factor
        pin.computeJointJacobians(model, data, theirs)
        pin.updateFramePlacements(model, data)
        poses = robot.link_poses(q)
        for link, name in enumerate(robot.link_names):
            frame = model.getFrameId(name, pin.FrameType.BODY)
            worst[0] = max(worst[0], float(np.abs(data.oMf[frame].homogeneous - poses[link]).max()))
            jacobian = pin.getFrameJacobian(model, data, frame, pin.LOCAL_WORLD_ALIGNED) @ tangent
            difference = np.abs(jacobian - robot.jacobian(q, link))
            worst[1] = max(worst[1], float(difference.max(initial=0.0)))
    assert own.model.nv >= robot.num_dofs
    return worst[0], worst[1]


def distances(pin: Any, robot: urdd.Robot) -> tuple[int, float]:
    """Number of pairs, and the worst difference of distances."""
    peer = robot.to_pinocchio("pieces")
    data, geometry = peer.model.createData(), pin.GeometryData(peer.collision_model)
    for request in geometry.distanceRequests:
        request.gjk_tolerance = 1e-9
    worst = 0.0
    for q in robot.random(FEWER):
        pin.computeDistances(peer.model, data, peer.collision_model, geometry, peer.q(q))
        theirs = np.array([max(result.min_distance, 0.0) for result in geometry.distanceResults])
        worst = max(worst, float(np.abs(robot.distances(q) - theirs).max(initial=0.0)))
    return robot.proximity().num_pairs, worst


def main() -> int:
    """Prints a row per robot, and the worst."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    pin: Any = import_module("pinocchio")
    worst, done = np.zeros(3), 0
    names: set[str] = set()
    root = urdfs()[0]
    while root.name != "robots":
        root = root.parent
    os.environ["ROS_PACKAGE_PATH"] = str(root.parents[1])
    print(f"{'robot':24} {'links':>5} {'DOFs':>5} {'poses':>9} {'Jacobians':>9} {'pairs':>6} {'distances':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for path in urdfs():
            if done == count:
                break
            try:
                made = urdd.generate(path, Path(folder) / path.stem, samples=200, mesh_formats=["glb", "stl"])
            except urdd.GenerateError as error:
                print(f"{path.stem:24} not made: {str(error)[:90]}")
                continue
            if made.robot_name in names or made.num_dofs == 0:
                continue
            robot = made.load()
            found = motion(pin, robot, path)
            if found is None:
                print(f"{path.stem:24} not compared: joints that Pinocchio's reader does not have")
                continue
            names.add(made.robot_name)
            pairs, apart = distances(pin, robot)
            row = np.array([*found, apart])
            size = f"{path.stem:24} {robot.num_links:5} {robot.num_dofs:5}"
            print(f"{size} {row[0]:9.1e} {row[1]:9.1e} {pairs:6} {row[2]:9.1e}", flush=True)
            worst, done = np.maximum(worst, row), done + 1
    print(f"{done} robots: poses {worst[0]:.1e}, Jacobians {worst[1]:.1e}, distances {worst[2]:.1e}")
    return int(not (worst[0] < 1e-9 and worst[1] < 1e-9 and worst[2] < 1e-6 and done == count))


if __name__ == "__main__":
    sys.exit(main())

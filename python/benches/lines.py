"""How many lines a user writes, here and with others, from a URDF with meshes (here: its URDD).

    python python/benches/lines.py URDF

Each snippet below is run on the URDF as it stands, so that nothing is left out, and its lines are counted. `target` is
a pose to reach, `q` a configuration. Skips are those that keep a robot at rest from colliding with itself: pairs of
links that a joint connects, and those in contact at rest. What a library does not have is `-`.
"""

from __future__ import annotations

import sys
import tempfile
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

import urdd

LOAD = {
    "urdd": "import urdd\nrobot = urdd.load(urdd_path)",
    "Pinocchio": ("import pinocchio as pin\nmodel = pin.buildModelFromUrdf(urdf_path)\ndata = model.createData()"),
    "yourdfpy": "import yourdfpy\nrobot = yourdfpy.URDF.load(urdf_path)",
    "MuJoCo": ("import mujoco\nmodel = mujoco.MjModel.from_xml_path(urdf_path)\ndata = mujoco.MjData(model)"),
    "PyBullet": (
        "import pybullet as p\np.connect(p.DIRECT)\n"
        "body = p.loadURDF(urdf_path, useFixedBase=True, flags=p.URDF_USE_SELF_COLLISION)"
    ),
}

POSES = {
    "urdd": "poses = robot.link_poses(q)",
    "Pinocchio": "pin.framesForwardKinematics(model, data, q)\nposes = [frame.homogeneous for frame in data.oMf]",
    "yourdfpy": "robot.update_cfg(q)\nposes = [robot.get_transform(link) for link in robot.link_map]",
    "MuJoCo": "data.qpos[:] = q\nmujoco.mj_kinematics(model, data)\nposes = data.xpos, data.xmat",
    "PyBullet": (
        "joints = [k for k in range(p.getNumJoints(body)) if p.getJointInfo(body, k)[2] != p.JOINT_FIXED]\n"
        "for joint, value in zip(joints, q):\n    p.resetJointState(body, joint, value)\n"
        "poses = p.getLinkStates(body, range(p.getNumJoints(body)), computeForwardKinematics=True)"
    ),
}

#: Damped least squares within limits; one restart fewer than `robot.ik`.
INVERSE = {
    "urdd": "found = robot.inverse_kinematics(tool, target).q",
    "Pinocchio": """frame = model.getFrameId(tool)
found = pin.neutral(model)
for _ in range(500):
    pin.framesForwardKinematics(model, data, found)
    error = pin.log6(data.oMf[frame].actInv(pin.SE3(target))).vector
    if np.linalg.norm(error) < 1e-6:
        break
    jacobian = pin.computeFrameJacobian(model, data, found, frame)
    step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-4 * np.eye(6), error)
    found = pin.integrate(model, found, step)
    found = np.clip(found, model.lowerPositionLimit, model.upperPositionLimit)""",
    "MuJoCo": """import pinocchio
link = model.body(tool).id
linear, angular = np.zeros((3, model.nv)), np.zeros((3, model.nv))
for _ in range(500):
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    turn = target[:3, :3] @ data.xmat[link].reshape(3, 3).T
    error = np.concatenate([target[:3, 3] - data.xpos[link], pinocchio.log3(turn)])
    if np.linalg.norm(error) < 1e-6:
        break
    mujoco.mj_jacBody(model, data, linear, angular, link)
    jacobian = np.concatenate([linear, angular])
    step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-4 * np.eye(6), error)
    data.qpos[:] = np.clip(data.qpos + step, *model.jnt_range.T)
found = data.qpos""",
    "PyBullet": """from scipy.spatial.transform import Rotation
link = next(k for k in range(p.getNumJoints(body)) if p.getJointInfo(body, k)[12].decode() == tool)
turn = Rotation.from_matrix(target[:3, :3]).as_quat()
found = p.calculateInverseKinematics(body, link, target[:3, 3], turn, maxNumIterations=500)""",
}

#: Whether the robot collides with itself, skips included, on the meshes that each reads.
COLLISION = {
    "urdd": "colliding = robot.in_collision(q)",
    "Pinocchio": """geometry = pin.buildGeomFromUrdf(model, urdf_path, pin.GeometryType.COLLISION, package_dirs)
geometry.addAllCollisionPairs()
places = pin.GeometryData(geometry)
pin.computeCollisions(model, data, geometry, places, pin.neutral(model), False)
for k in reversed(range(len(geometry.collisionPairs))):
    pair = geometry.collisionPairs[k]
    a, b = (geometry.geometryObjects[index].parentJoint for index in (pair.first, pair.second))
    if places.collisionResults[k].isCollision() or model.parents[a] == b or model.parents[b] == a:
        geometry.removeCollisionPair(pair)
places = pin.GeometryData(geometry)
colliding = pin.computeCollisions(model, data, geometry, places, q, True)""",
    "MuJoCo": """mujoco.mj_forward(model, data)
resting = {frozenset(model.geom_bodyid[contact.geom].tolist()) for contact in data.contact}
data.qpos[:] = q
mujoco.mj_forward(model, data)
colliding = any(frozenset(model.geom_bodyid[c.geom].tolist()) not in resting for c in data.contact)""",
    "PyBullet": """p.performCollisionDetection()
for contact in p.getContactPoints(body, body):
    p.setCollisionFilterPair(body, body, contact[3], contact[4], 0)
joints = [k for k in range(p.getNumJoints(body)) if p.getJointInfo(body, k)[2] != p.JOINT_FIXED]
for joint, value in zip(joints, q):
    p.resetJointState(body, joint, value)
p.performCollisionDetection()
colliding = bool(p.getContactPoints(body, body))""",
}


def main() -> None:
    """Runs and counts."""
    urdf = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        robot = urdd.generate(urdf, Path(folder) / "robot").load()
        free: Any = next(row for row in robot.random(1000, 1) if not robot.in_collision(row))
        moves = [int(robot.jacobian(free, link).any(axis=0).sum()) for link in range(robot.num_links)]
        tool = robot.link_names[int(np.argmax(moves))]
        given = {
            "np": np,
            "urdd_path": str(robot.path),
            "urdf_path": str(urdf),
            "package_dirs": [str(urdf.parent)],
            "tool": tool,
            "target": robot.link_pose(robot.middle, tool),
        }
        modules = {"urdd": "urdd", "Pinocchio": "pinocchio", "yourdfpy": "yourdfpy", "MuJoCo": "mujoco"}
        print("| | load and poses | inverse kinematics | self-collision with skips |")
        print("|---|---:|---:|---:|")
        for name in LOAD:
            import_module(modules.get(name, "pybullet"))
            cells: list[str] = []
            for task in (POSES, INVERSE, COLLISION):
                if name not in task:
                    cells.append("-")
                    continue
                names: dict[str, Any] = {**given, "q": free}
                code = f"{LOAD[name]}\n{task[name]}"
                try:
                    exec(compile(code, name, "exec"), names)
                    told = ""
                except Exception as error:
                    told = f" ({type(error).__name__} on this robot)"
                cells.append(f"{len(code.splitlines())}{told}")
            print(f"| {name} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()

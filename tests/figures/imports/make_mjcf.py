"""Writes `mjcf.json`: what MuJoCo's compiled model has of each fixture in `mjcf/`.

    pip install mujoco==4.0.0 numpy
    python3 tests/figures/imports/make_mjcf.py

Poses are in the root of the robot, in three configurations; quaternions have w first, and w >= 0. Shapes of meshes are the
box around their vertices, in the frame of the body.
"""

import json
import pathlib

import mujoco
import numpy as np

from kinematics import of_quaternion

HERE = pathlib.Path(__file__).resolve().parent
COUNT = 3
KINDS = ["free", "ball", "slide", "hinge"]
# Otherwise it writes MUJOCO_LOG.TXT where it is started.
mujoco.set_mju_user_warning(lambda _: None)
# What other processors compute differs by less.
ROUNDING = 1e-12
SHAPES = {2: "sphere", 3: "capsule", 4: "ellipsoid", 5: "cylinder", 6: "box", 7: "mesh"}


def plain(values):
    return [float(f"{value:.17g}") for value in np.asarray(values, float).ravel()]


def fixture(path):
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    random = np.random.default_rng(3)
    configurations = []
    for _ in range(COUNT):
        qpos = model.qpos0.copy()
        for joint in range(model.njnt):
            at = model.jnt_qposadr[joint]
            if model.jnt_type[joint] == 1:
                turn = random.normal(size=4)
                qpos[at:at + 4] = turn / np.linalg.norm(turn)
            elif model.jnt_type[joint] > 1:
                qpos[at] = random.uniform(-1, 1)
        data.qpos[:] = qpos
        mujoco.mj_kinematics(model, data)
        configurations.append((qpos, data.xpos.copy(), data.xquat.copy()))
    bodies = []
    for body in range(1, model.nbody):
        axes = of_quaternion(model.body_iquat[body])
        poses = [[*xpos[body], *(xquat[body] if xquat[body][0] >= 0 else -xquat[body])] for _, xpos, xquat in configurations]
        bodies.append({
            "name": model.body(body).name,
            "mass": float(model.body_mass[body]),
            "centre": plain(model.body_ipos[body]),
            "inertia": plain(axes @ np.diag(model.body_inertia[body]) @ axes.T),
            "poses": [plain(pose) for pose in poses],
            "joints": [joint_of(model, j, configurations) for j in range(model.njnt) if model.jnt_bodyid[j] == body],
            "shapes": [shape_of(model, g) for g in range(model.ngeom) if model.geom_bodyid[g] == body],
        })
    return {
        "bodies": bodies,
        "sites": [[of.name, plain(of.pos), plain(of.quat)] for of in map(model.site, range(model.nsite))],
    }


def joint_of(model, joint, configurations):
    kind, at = KINDS[model.jnt_type[joint]], model.jnt_qposadr[joint]
    width = {"free": 7, "ball": 4}.get(kind, 1)
    dof = model.jnt_dofadr[joint]
    limited = model.jnt_limited[joint] and kind in ("slide", "hinge")
    return {
        "name": model.joint(joint).name,
        "kind": kind,
        "range": plain(model.jnt_range[joint]) if limited else None,
        "damping": float(np.ravel(model.dof_damping[dof])[0]),
        "friction": float(model.dof_frictionloss[dof]),
        "values": [plain(qpos[at:at + width]) for qpos, _, _ in configurations],
        "keys": [plain(key[at:at + width]) for key in model.key_qpos],
    }


def shape_of(model, geom):
    kind = SHAPES[int(model.geom_type[geom])]
    rotation = of_quaternion(model.geom_quat[geom])
    found = {
        "kind": kind,
        "position": plain(model.geom_pos[geom]),
        "rotation": plain(rotation),
        "size": plain(model.geom_size[geom]),
    }
    if kind == "mesh":
        mesh = model.geom_dataid[geom]
        first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        points = np.asarray(model.mesh_vert[first:first + count], float) @ rotation.T + model.geom_pos[geom]
        found["box"] = plain([points.min(0), points.max(0)])
    return found


def settled(new, old):
    """What is new, but for numbers that differ from the old ones by rounding."""
    if isinstance(new, float) and isinstance(old, (int, float)):
        return old if abs(new - old) <= ROUNDING else new
    if isinstance(new, dict) and isinstance(old, dict):
        return {key: settled(value, old.get(key)) for key, value in new.items()}
    if isinstance(new, list) and isinstance(old, list) and len(new) == len(old):
        return [settled(*pair) for pair in zip(new, old)]
    return new


def main():
    fixtures = {path.stem: fixture(path) for path in sorted((HERE / "mjcf").glob("*.xml"))}
    fixtures = settled(fixtures, json.loads((HERE / "mjcf.json").read_text()))
    lines = [f"{json.dumps(name)}: {json.dumps(of)}" for name, of in fixtures.items()]
    text = "{\n" + ",\n".join(lines) + "\n}\n"
    (HERE / "mjcf.json").write_text(text)


if __name__ == "__main__":
    main()

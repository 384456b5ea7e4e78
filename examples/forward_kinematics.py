#!/usr/bin/env python3
"""Forward kinematics of a URDD by json and numpy alone: where each link is.

Two modules say all that is needed, and nothing is worked out of them beforehand. Numbers in brackets are clauses of
SPEC.md. To use it in a program of your own, copy `read` and `link_poses`.

    python3 examples/forward_kinematics.py URDD [VALUE...]

Values are those of the DOFs, rad or m; without them, every one is 0. `--check` instead holds every sample of
`kinematics_samples_module` against the poses computed here.
"""

import json
import sys
from pathlib import Path

import numpy as np


def read(urdd, module):
    return json.loads((Path(urdd) / module / "module.json").read_text("utf-8"))


def link_poses(chain, dof, q):
    """The pose of every link, (4, 4) in the frame of the root link, in the order of the links. [9.1]"""
    poses = [np.eye(4)] * len(chain["links_in_chain"])
    for level in chain["kinematic_hierarchy"][1:]:
        for link in level:
            index = chain["links_in_chain"][link]["parent_joint_idx"]
            joint, mimic = chain["joints_in_chain"][index], dof["joint_idx_to_mimic_mapping"][index]
            if mimic is None:
                values = [q[k] for k in dof["joint_idx_to_dof_idxs_mapping"][index]]
            else:
                driver = 0.0 if mimic["dof_idx"] is None else q[mimic["dof_idx"]]
                values = [mimic["multiplier"] * driver + mimic["offset"]]
            origin = transform(quaternion(joint["origin"]["quaternion_wxyz"]), joint["origin"]["position"])
            poses[link] = poses[joint["parent_link_idx"]] @ origin @ motion(joint, values)
    return poses


def motion(joint, values):
    kind, axis = joint["joint_type"], np.array(joint["axis"] or [0.0, 0.0, 0.0])
    if kind in ("Revolute", "Continuous"):
        return transform(turn(values[0] * axis))
    if kind == "Prismatic":
        return transform(np.eye(3), values[0] * axis)
    if kind == "Planar":
        x, y = in_plane(axis)
        return transform(turn(values[2] * axis), values[0] * x + values[1] * y)
    if kind == "Floating":
        return transform(turn(values[3:]), values[:3])
    if kind == "Spherical":
        return transform(turn(values))
    return np.eye(4)


def transform(rotation, position=(0.0, 0.0, 0.0)):
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, position
    return pose


def quaternion(wxyz):
    w, x, y, z = wxyz
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + 2.0 * (w * cross + cross @ cross)


def turn(vector):
    """The rotation about a vector by its length."""
    angle = np.linalg.norm(vector)
    axis = np.asarray(vector) / angle if angle > 0.0 else np.zeros(3)
    return quaternion([np.cos(angle / 2.0), *(np.sin(angle / 2.0) * axis)])


def in_plane(normal):
    """The two directions in which a planar joint slides. [5.9]"""
    sine = np.hypot(normal[0], normal[1])
    if sine < 1e-10:
        return np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0 if normal[2] > 0.0 else -1.0, 0.0])
    angle = np.arctan2(sine, normal[2])
    rotation = turn(angle / sine * np.array([-normal[1], normal[0], 0.0]))
    return rotation[:, 0], rotation[:, 1]


def check(urdd, chain, dof):
    """The largest difference from the poses that the URDD states, in metres and in elements of the rotation."""
    worst = 0.0
    for sample in read(urdd, "kinematics_samples_module")["samples"]:
        for pose, stated in zip(link_poses(chain, dof, sample["configuration"]), sample["link_poses"], strict=True):
            right = transform(quaternion(stated["quaternion_wxyz"]), stated["position"])
            worst = max(worst, float(np.abs(pose - right).max()))
    return worst


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    urdd, *given = sys.argv[1:]
    chain, dof = read(urdd, "chain_module"), read(urdd, "dof_module")
    if given == ["--check"]:
        worst = check(urdd, chain, dof)
        print(f"the poses differ from those of kinematics_samples_module by {worst:.1e} at most")
        sys.exit(worst > 1e-9)
    q = [float(value) for value in given] or [0.0] * dof["num_dofs"]
    if len(q) != dof["num_dofs"]:
        names = ", ".join(one["name"] for one in dof["dofs"])
        sys.exit(f"{len(q)} values for {dof['num_dofs']} DOFs: {names}")
    for link, pose in zip(chain["links_in_chain"], link_poses(chain, dof, q), strict=True):
        x, y, z = pose[:3, 3]
        print(f"{link['name']:24} {x:8.4f} {y:8.4f} {z:8.4f} m")

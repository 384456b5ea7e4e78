#!/usr/bin/env python3
"""Writes gravity_torques.json: for this repository's robots, what each DOF must give to hold the robot still, by Pinocchio's
computeGeneralizedGravity.

    python3 -m venv peers
    peers/bin/pip install pin==4.1.0 libpinocchio==4.1.0 cmeel-urdfdom==6.0.0 mujoco==4.0.0 mujoco-core==4.0.0 \
        yourdfpy==0.0.60 numpy==2.4.6 example-robot-data==6.0.0
    peers/bin/python tests/figures/make_gravity_torques.py

Last run: 2026-11-27, Linux x86-64.

Robots and configurations are those of make_forward_kinematics.py, and the models its models of Pinocchio's joints, with the
masses of the text. Mimic joints are joints of their own for Pinocchio: here, the torque of a follower is added to its leader's,
times the multiplier. Pinocchio has the velocity of floating, spherical and planar joints in the child's frame; the torques are
mapped to the derivatives of our coordinates by Pinocchio's exp3 and Jexp3.

The last configuration of each robot has another gravity, and a payload on the last link.
"""

import hashlib
import importlib.metadata
import json
import math
import sys

import make_forward_kinematics as kinematics
import numpy as np
import pinocchio as pin

GRAVITY = [0.0, 0.0, -9.81]
OTHER_GRAVITY = [1.5, -2.5, -9.0]
PAYLOAD = {"mass": 2.5, "point": [0.1, -0.2, 0.3]}


def inertial(link):
    """Mass and centre of mass."""
    found = link.find("inertial")
    if found is None:
        return 0.0, np.zeros(3)
    return float(found.find("mass").get("value")), kinematics.vector(found.find("origin"), "xyz", [0.0, 0.0, 0.0])


def loaded(robot, gravity, payload):
    model, at = kinematics.pinocchio_model(robot)
    bodies = [(link.get("name"), *inertial(link)) for link in robot.tree.findall("link")]
    if payload:
        bodies.append((robot.links[-1], payload["mass"], np.array(payload["point"])))
    for link, mass, centre in bodies:
        joint, place = at[link]
        # The tensor does nothing at rest.
        model.appendBodyToJoint(joint, pin.Inertia(mass, centre, mass * np.eye(3)), place)
    model.gravity.linear = np.array(gravity)
    return model


def of_joint(joint, values, torque):
    """For the derivatives of our coordinates."""
    if joint.type == "planar":
        c, s = math.cos(values[2]), math.sin(values[2])
        return np.array([c * torque[0] - s * torque[1], s * torque[0] + c * torque[1], torque[2]])
    if joint.type not in ("floating", "spherical"):
        return torque
    rotation = np.array(values[-3:])
    turn = pin.Jexp3(rotation).T @ torque[-3:]
    return np.concatenate([pin.exp3(rotation) @ torque[:-3], turn]) if joint.type == "floating" else turn


def torques(robot, listed, gravity, payload):
    values = kinematics.expanded(robot, listed)
    model = loaded(robot, gravity, payload)
    found = pin.computeGeneralizedGravity(model, model.createData(), kinematics.pinocchio_configuration(robot, model, values))
    joints = {joint.name: joint for joint in robot.joints}
    of_dofs = {}

    def add(joint, torque):
        if joint.mimic:
            driver, multiplier, _ = joint.mimic
            add(joints[driver], multiplier * torque)
        elif joint.type != "fixed":
            of_dofs[joint.name] = of_dofs.get(joint.name, 0.0) + torque

    for joint in robot.joints:
        if joint.type != "fixed":
            model_joint = model.joints[model.getJointId(joint.name)]
            torque = found[model_joint.idx_v:model_joint.idx_v + model_joint.nv]
            add(joint, of_joint(joint, values[joint.name], torque))
    return [float(one) + 0.0 for joint in robot.joints for one in of_dofs.get(joint.name, [])]


def main():
    robots = []
    for _, path in kinematics.OUR_ROBOTS:
        text = (kinematics.REPOSITORY / path).read_bytes()
        robot = kinematics.Robot(text)
        configurations = []
        named = list(kinematics.configurations(robot))
        for k, (_, listed) in enumerate([*named, named[-1]]):
            gravity, payload = (OTHER_GRAVITY, PAYLOAD) if k == len(named) else (GRAVITY, None)
            configurations.append({
                "configuration": [value for joint in robot.joints for value in listed.get(joint.name, [])],
                "gravity": gravity,
                "payload": payload and {"link": robot.links[-1], **payload},
                "torques": torques(robot, listed, gravity, payload),
            })
        robots.append({"path": path, "sha256": hashlib.sha256(text).hexdigest(), "configurations": configurations})
    packages = ["pin", "libpinocchio", "numpy"]
    document = {
        "made_by": "tests/figures/make_gravity_torques.py",
        "versions": {"python": sys.version.split()[0]} | {name: importlib.metadata.version(name) for name in packages},
        "robots": robots,
    }
    (kinematics.HERE / "gravity_torques.json").write_text(kinematics.lines(document, 0, 6) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

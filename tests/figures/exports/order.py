"""The order of joints and actuators in the programs that load exports: `order.py URDD_PROGRAM URDD...`.

What `urdd info --order` says of each URDD is compared with the programs themselves, each loading the export that it is for:

- MuJoCo (MJCF with motors): joints by their index, and that positions are in this order; actuators by their index.
- Pinocchio (URDF): `model.names`.
- PyBullet (URDF): the joints that are not fixed, by their index, and that positions are in this order.
- Drake (its URDF, and SDF): joints by the start of their positions; for its URDF, actuators by their index.
- libsdformat (SDF), where SDF_LOAD names the program of `sdf.cpp`: the joints of the model that are not fixed.
- Newton (USD): `joint_ordering="dfs"`; and "bfs", by which Isaac Lab finds PhysX' order.

A program that is not installed, or that refuses the robot, is named and left out; USD needs an environment of its own.
Prints how many joints were compared by each program, and exits with 1 where one has another order.
"""

import collections
import importlib.util
import json
import logging
import os
import pathlib
import subprocess
import sys
import tempfile

logging.disable(logging.WARNING)


def mujoco(file):
    import mujoco

    model = mujoco.MjModel.from_xml_path(str(file))
    joints = [model.joint(k) for k in range(model.njnt)]
    assert sorted(range(len(joints)), key=lambda k: joints[k].qposadr[0]) == list(range(len(joints)))
    return [joint.name for joint in joints], [model.actuator(k).name for k in range(model.nu)]


def pinocchio(file):
    import pinocchio

    return list(pinocchio.buildModelFromUrdf(str(file)).names)[1:], None


def pybullet(file):
    import pybullet

    pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(file), useFixedBase=True)
        joints = [pybullet.getJointInfo(body, k) for k in range(pybullet.getNumJoints(body))]
    finally:
        pybullet.disconnect()
    moving = [joint for joint in joints if joint[2] != pybullet.JOINT_FIXED]
    assert [joint[3] for joint in moving] == sorted(joint[3] for joint in moving)
    return [joint[1].decode() for joint in moving], None


def drake(file):
    from pydrake.all import MultibodyPlant, Parser

    plant = MultibodyPlant(0.0)
    (model,) = Parser(plant).AddModels(str(file))
    plant.Finalize()
    joints = [plant.get_joint(index) for index in plant.GetJointIndices(model)]
    # The joint that Drake adds for a base that moves comes first.
    added = {body.name() for body in (plant.get_body(k) for k in plant.GetBodyIndices(model))}
    moving = [joint for joint in joints if joint.num_positions() > 0 and not (
        joint.parent_body().name() == "world" and joint.name() in added)]
    moving.sort(key=lambda joint: joint.position_start())
    actuators = [plant.get_joint_actuator(index).name() for index in plant.GetJointActuatorIndices(model)]
    return [joint.name() for joint in moving], actuators


def libsdformat(file):
    asked = [os.environ["SDF_LOAD"], str(file), "joints"]
    return subprocess.run(asked, capture_output=True, text=True, check=True).stdout.splitlines(), None


def newton(ordering):
    def of(file):
        import newton_usd_schemas  # noqa: F401
        import newton

        builder = newton.ModelBuilder()
        resolvers = [newton.usd.SchemaResolverNewton(), newton.usd.SchemaResolverPhysx()]
        builder.add_usd(str(file), schema_resolvers=resolvers, joint_ordering=ordering)
        fixed = newton.JointType.FIXED
        labels = getattr(builder, "joint_label", None) or builder.joint_key
        moving = [label for label, kind in zip(labels, builder.joint_type) if kind != fixed]
        return [label.rsplit("/", 1)[-1] for label in moving], None

    return of


# Program, whose order, which export, with what, the module that it needs.
ASKED = [
    (mujoco, "mujoco", "mjcf", "robot.xml", ["--actuators", "motor"], "mujoco"),
    (pinocchio, "pinocchio", "urdf", "robot.urdf", [], "pinocchio"),
    (pybullet, "pybullet", "urdf", "robot.urdf", [], "pybullet"),
    (drake, "drake", "drake", "robot.urdf", [], "pydrake"),
    (libsdformat, "libsdformat", "sdf", "robot.sdf", [], None),
    (newton("dfs"), "newton", "usd", "robot.usda", [], "newton"),
    (newton("bfs"), "isaac", "usd", "robot.usda", [], "newton"),
]


def main():
    program, *urdds = sys.argv[1:]
    count, wrong, left = collections.Counter(), [], collections.Counter()
    for urdd in urdds:
        found = subprocess.run([program, "info", urdd, "--order", "--format", "json"], capture_output=True, text=True, check=True)
        orders = {order["program"]: order for order in json.loads(found.stdout)[0]["order"]}
        for ask, name, export, file, options, module in ASKED:
            if not (importlib.util.find_spec(module) if module else "SDF_LOAD" in os.environ):
                left[f"{name}: not here"] += 1
                continue
            with tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder) / file
                made = [program, "export", export, urdd, "-o", str(file), *options]
                try:
                    subprocess.run(made, capture_output=True, text=True, check=True)
                    joints, actuators = ask(file)
                except Exception as error:  # noqa: BLE001: programs raise what they like
                    left[f"{name}: {str(error).splitlines()[0][:80]}"] += 1
                    continue
            expected = orders[name]
            if joints != expected["joints"]:
                wrong.append((urdd, name, expected["joints"], joints))
            if actuators is not None and actuators != expected.get("actuators", []):
                wrong.append((urdd, f"{name}, actuators", expected.get("actuators"), actuators))
            count[name] += len(joints)
    for name, joints in sorted(count.items()):
        print(f"{name}: {joints} joints")
    for reason, robots in left.items():
        print(f"left out: {reason}: {robots} robots")
    for one in wrong:
        print(*one, sep="\n  ")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()

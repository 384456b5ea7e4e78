"""Uses what `urdd export` writes as a person would: simulates, loads packages, reads a launch file; and counts what it costs.

    pip install mujoco==4.0.0 drake==1.51.1 numpy pyyaml
    urdd generate ROBOT.urdf -o URDD            # for each robot
    urdd export init URDD
    python3 tests/figures/exports/whole.py target/release/urdd URDD... [--json FILE] [--panda FOLDER]

- MuJoCo: ten seconds under gravity. With position actuators, a robot that is fixed to the world holds its first
  configuration; one that floats by `NAME.export.toml` stands or falls on the floor of its scene, and comes to rest.
- Drake: two seconds under gravity, by the model directive in its package.
- MoveIt: the package's YAML, XML and Python are read; with `--panda`, the one of Panda is compared key by key with MoveIt's
  own (../shared/peers/panda_moveit_config).
- cuRobo: the keys of the robot file; Foam, spherized: read.

Exits with 1 where a program refuses a file, warns, or something explodes.
"""

import ast
import json
import pathlib
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import yaml

# A robot that stands on the floor is this far in it at most, m: MuJoCo's contacts are soft, g (0.02 s)^2 (1 - 0.9) = 0.4 mm.
SINK = 1e-3
# A robot that is held sags at most this far, rad or m: g / (l w^2) for a link of length l, 0.08 rad for a finger of 3 cm.
# One that floats moves at most this fast at the end, rad/s or m/s.
SAG = 0.1
SPEED = 0.5
# Configurations in which a robot is held, besides the keyframe.
HELD = 4

FORMATS = {
    "srdf": "r.srdf", "urdf": "urdf/r.urdf", "drake": "drake/r.urdf", "mjcf": "mjcf/r.xml", "sdf": "sdf/r.sdf",
    "curobo": "r.yml", "foam": "r.json", "spherized": "spherized/r.urdf", "moveit": "r_moveit_config",
}
MORE = {"mjcf": ["--actuators", "position", "--scene"], "drake": ["--package", "r_description"], "curobo": ["--config"]}


def export(program, urdd, folder):
    """Seconds and bytes of each format."""
    cost = {}
    for form, name in FORMATS.items():
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        begun = time.perf_counter()
        command = [program, "export", form, urdd, "-o", str(target), *MORE.get(form, [])]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            cost[form] = {"refused": done.stderr.splitlines()[-1]}
            continue
        files = [target] if target.parent == folder and target.is_file() else (target if target.is_dir() else target.parent).rglob("*")
        size = sum(file.stat().st_size for file in files if file.is_file())
        cost[form] = {"seconds": round(time.perf_counter() - begun, 2), "bytes": size}
    return cost


def starts(model, data, driven):
    """The first keyframe, and free configurations within the bounds; of robots whose joints follow others, the keyframe."""
    mujoco.mj_resetDataKeyframe(model, data, 0)
    yield data.qpos[driven].copy()
    random, found = np.random.default_rng(36), 0
    for _ in range(1000 if model.neq == 0 and model.actuator_ctrllimited.all() else 0):
        mujoco.mj_resetDataKeyframe(model, data, 0)
        data.qpos[driven] = data.ctrl[:] = random.uniform(*model.actuator_ctrlrange.T)
        mujoco.mj_forward(model, data)
        if data.ncon == 0:
            yield data.qpos[driven].copy()
            found += 1
        if found == HELD:
            return


def in_mujoco(file):
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    floats = model.njnt > 0 and model.jnt_type[0] == mujoco.mjtJoint.mjJNT_FREE
    driven = [model.jnt_qposadr[joint] for joint in model.actuator_trnid[:, 0]]
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    # What is pressed together moves apart.
    pressed = int(data.ncon)
    begun, sag, speed, warnings, count = time.perf_counter(), 0.0, 0.0, 0, 0
    for start in starts(model, data, driven):
        while data.time < 10:
            mujoco.mj_step(model, data)
        warnings += sum(int(warning.number) for warning in data.warning)
        speed = max(speed, float(np.abs(data.qvel).max()) if model.nv else 0.0)
        sag = max(sag, float(np.abs(data.qpos[driven] - start).max()) if driven else 0.0)
        count += 1
        if floats:
            break
    said = {"floats": bool(floats), "warnings": warnings, "speed": speed, "configurations": count, "seconds": round(time.perf_counter() - begun, 1)}
    said["failed"] = bool(warnings or not np.isfinite(data.qpos).all())
    if floats:
        said["height"] = float(data.qpos[2])
        said["failed"] |= speed > SPEED or said["height"] < -SINK
    elif driven:
        said["sag"] = sag
        said["contacts_at_start"] = pressed
        said["failed"] |= sag > SAG and not pressed
    return said


def in_drake(folder):
    from pydrake.all import AddMultibodyPlantSceneGraph, DiagramBuilder, Parser, Simulator

    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, 0.001)
    parser = Parser(plant)
    parser.package_map().AddPackageXml(str(folder / "package.xml"))
    parser.AddModels(str(folder / "r.dmd.yaml"))
    plant.Finalize()
    diagram = builder.Build()
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    plant.get_actuation_input_port().FixValue(context, np.zeros(plant.num_actuators()))
    begun = time.perf_counter()
    simulator.AdvanceTo(2.0)
    q = plant.GetPositions(context)
    said = {"positions": plant.num_positions(), "actuators": plant.num_actuators(), "seconds": round(time.perf_counter() - begun, 1)}
    return said | {"failed": not np.isfinite(q).all()}


def in_moveit(folder):
    for file in folder.glob("config/*.yaml"):
        yaml.safe_load(file.read_text())
    for file in [*folder.glob("config/*.urdf"), *folder.glob("config/*.srdf"), folder / "package.xml"]:
        ET.parse(file)
    ast.parse((folder / "launch/demo.launch.py").read_text())
    srdf = ET.parse(next(folder.glob("config/*.srdf"))).getroot()
    return {"groups": [group.get("name") for group in srdf.findall("group")], "failed": False}


# What Panda's own package has and ours has not, or otherwise, and why. Keys are those of `flat`.
REASONS = {
    "pairs": "theirs have pairs that were never in contact too: `--reasons always,adjacent,default,never`",
    "renamed": "our groups are called `arm` and `hand`, theirs `panda_arm` and `hand`",
    "acceleration": "the URDF has no limits of acceleration and jerk; theirs are from Franka's data sheet",
    "fingers": "ours are the limits of the URDF, and the joint that follows the other has none",
    "gripper": "theirs is deprecated in Jazzy, ours is its successor",
    "planners": "theirs lists every planner with OMPL's default parameters",
    "xacro": "theirs is a xacro of several hardware types; ours has simulated hardware in the URDF",
    "virtual": "theirs is `floating`, although the arm is fixed to the world by its launch file",
    "initial": "ours has the initial positions in the URDF",
    "pilz": "planners other than OMPL are not set up",
}


def flat(value, path=()):
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from flat(inner, (*path, str(key)))
    else:
        yield "/".join(path), value


def of_panda(ours, theirs):
    """The files and keys of MoveIt's own package that ours has not, or otherwise, each with its reason."""
    rename = lambda text: text.replace("panda_arm", "arm").replace("panda_hand", "hand")
    told, unexplained = {}, []

    def differ(what, reason):
        told[what] = REASONS.get(reason, reason)
        if reason is None:
            unexplained.append(what)

    for name in ("kinematics", "joint_limits", "moveit_controllers", "ros2_controllers", "ompl_planning"):
        found = dict(flat(yaml.safe_load((ours / f"config/{name}.yaml").read_text())))
        source = f"gripper_{name}" if name == "moveit_controllers" else name
        for key, value in flat(yaml.safe_load((theirs / f"config/{source}.yaml").read_text())):
            key = rename(key)
            if isinstance(value, str):
                value = rename(value)
            if isinstance(value, list):
                value = [rename(item) if isinstance(item, str) else item for item in value]
            if found.get(key) == value or (isinstance(value, float) and np.isclose(found.get(key) or 0, value)):
                continue
            reason = None
            if "acceleration" in key or "jerk" in key:
                reason = "acceleration"
            elif "panda_finger_joint" in key:
                reason = "fingers"
            elif "hand_controller" in key and key.endswith("/type"):
                reason = "gripper"
            elif name == "ompl_planning":
                reason = "planners"
            elif key.startswith("moveit_simple_controller_manager/controller_names"):
                reason = "renamed"
            differ(f"{name}: {key}", reason)
    srdf = [ET.parse(folder / "config/panda.srdf").getroot() for folder in (ours, theirs)]
    for tag in {element.tag for element in srdf[1]}:
        mine, other = (root.findall(tag) for root in srdf)
        if tag == "virtual_joint":
            differ("srdf: virtual_joint", "virtual")
        elif tag == "disable_collisions":
            pairs = [{frozenset((e.get("link1"), e.get("link2"))) for e in found} for found in (mine, other)]
            told["srdf: pairs"] = {"both": len(pairs[0] & pairs[1]), "ours": len(pairs[0] - pairs[1]), "theirs": len(pairs[1] - pairs[0]), "why": REASONS["pairs"]}
        elif tag in ("group", "passive_joint", "end_effector") and len(mine) < len(other) - 1:
            differ(f"srdf: {tag}", None)
    return {"differences": told, "unexplained": unexplained, "failed": bool(unexplained)}


def main():
    program, *urdds = sys.argv[1:]
    named = {}
    for option in ("--json", "--panda"):
        if option in urdds:
            at = urdds.index(option)
            named[option] = pathlib.Path(urdds[at + 1])
            del urdds[at : at + 2]
    results, failed = {}, False
    for urdd in urdds:
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            said = {"cost": export(program, urdd, folder)}
            tried = [("mujoco", in_mujoco, folder / "mjcf/r_scene.xml"), ("drake", in_drake, folder / "drake")]
            tried.append(("moveit", in_moveit, folder / "r_moveit_config"))
            for name, use, path in tried:
                if "refused" in said["cost"][{"mujoco": "mjcf"}.get(name, name)]:
                    continue
                try:
                    said[name] = use(path)
                except (ValueError, RuntimeError) as error:
                    said[name] = {"failed": True, "error": str(error).splitlines()[0]}
                failed |= said[name]["failed"]
            if "--panda" in named and pathlib.Path(urdd).name == "panda":
                said["panda"] = of_panda(folder / "r_moveit_config", named["--panda"])
                failed |= said["panda"]["failed"]
        results[pathlib.Path(urdd).name] = said
        print(pathlib.Path(urdd).name, json.dumps(said), flush=True)
    if "--json" in named:
        named["--json"].write_text(json.dumps(results, indent=1) + "\n")
    sys.exit(failed)


if __name__ == "__main__":
    main()

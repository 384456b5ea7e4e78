"""Loads what `urdd export` writes into the programs that it is for, and compares numbers.

    pip install mujoco==4.0.0 pin==4.1.0 pybullet==3.2.7 drake==1.51.1 numpy
    cargo build --release
    urdd generate ROBOT.urdf -o URDD            # for each robot
    python3 tests/figures/exports/peers.py target/release/urdd URDD...

For each URDD, at its own kinematics samples: the poses of all links by MuJoCo (MJCF) and Pinocchio (URDF) beside those
of the module; the pairs of links that MuJoCo finds in contact beside `urdd check-collisions`; the pairs that Drake
would check beside those that the SRDF leaves; the number of shapes that PyBullet loads. Exits with 1 where poses differ
by more than 1e-9, or a set of pairs differs.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import pinocchio as pin
import pybullet

POSE_TOLERANCE = 1e-9
# Contact within this of the surfaces is rounding of binary32 meshes.
CONTACT_TOLERANCE = 1e-6


def quaternion_of_vector(v):
    """Rotation vector to quaternion w, x, y, z."""
    angle = np.linalg.norm(v)
    if angle == 0.0:
        return np.array([1.0, 0.0, 0.0, 0.0])
    return np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * np.asarray(v) / angle])


class Urdd:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.paths = {m["name"]: m["path"] for m in json.loads((self.root / "urdd.json").read_text())["modules"]}
        self.dof = self.document("dof_module")
        self.samples = self.document("kinematics_samples_module")["samples"]
        self.names = [link["name"] for link in self.document("urdf_module")["links"]]
        self.joints = self.document("urdf_module")["joints"]

    def document(self, module):
        return json.loads((self.root / self.paths[module] / "module.json").read_text())

    def values(self, q):
        """The values of each joint by name: of one DOF with mimics followed, of several as a list."""
        by_dof = {dof["name"]: value for dof, value in zip(self.dof["dofs"], q)}
        values = {}
        pending = {joint["name"]: joint for joint in self.joints}
        while pending:
            before = len(pending)
            for name, joint in list(pending.items()):
                mimic = joint["mimic"] if joint["joint_type"] != "Fixed" else None
                if joint["joint_type"] == "Fixed":
                    values[name] = [0.0]
                elif mimic is None:
                    parts = [v for dof, v in by_dof.items() if dof == name or dof.startswith(name + "/")]
                    values[name] = parts
                elif mimic["joint"] in values:
                    factor = 1.0 if mimic["multiplier"] is None else mimic["multiplier"]
                    values[name] = [factor * values[mimic["joint"]][0] + (mimic["offset"] or 0.0)]
                else:
                    continue
                del pending[name]
            assert len(pending) < before, "mimics in a circle"
        return values


def worst(poses, expected):
    """The greatest difference of positions (m) and of rotation matrices."""
    position = rotation = 0.0
    for (p, r), pose in zip(poses, expected):
        w, x, y, z = pose["quaternion_wxyz"]
        matrix = pin.Quaternion(w, x, y, z).matrix()
        position = max(position, np.abs(p - np.array(pose["position"])).max())
        rotation = max(rotation, np.abs(r - matrix).max())
    return max(position, rotation)


def by_mujoco(program, urdd, folder):
    file = folder / "mujoco.xml"
    export(program, "mjcf", urdd, file)
    model = mujoco.MjModel.from_xml_path(str(file))
    data = mujoco.MjData(model)
    links = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name) for name in urdd.names]
    links = [0 if link < 0 else link for link in links]
    difference, missed, extra, seen = 0.0, set(), set(), 0
    touching = collisions(program, urdd)
    disabled = disabled_pairs(program, urdd, folder)
    for sample, expected_pairs in zip(urdd.samples, touching):
        values = urdd.values(sample["configuration"])
        for joint in range(model.njnt):
            name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_JOINT, joint)
            at, kind = model.jnt_qposadr[joint], model.jnt_type[joint]
            if kind == mujoco.mjtJoint.mjJNT_BALL:
                data.qpos[at : at + 4] = quaternion_of_vector(values[name][-3:])
            elif name in values:
                data.qpos[at] = values[name][0]
            else:
                owner, part = name.rsplit("/", 1)
                place = {"trans_x": 0, "trans_y": 1, "trans_z": 2, "rot": 2}[part]
                data.qpos[at] = values[owner][place]
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        poses = [(data.xpos[link], data.xmat[link].reshape(3, 3)) for link in links]
        difference = max(difference, worst(poses, sample["link_poses"]))
        mujoco.mj_collision(model, data)
        found = {}
        for contact in data.contact[: data.ncon]:
            a, b = (urdd.names[links.index(model.geom_bodyid[geom])] for geom in contact.geom)
            key = tuple(sorted((a, b)))
            found[key] = min(found.get(key, 0.0), contact.dist)
        seen += len(found)
        # Of a pair that is disabled as a whole, urdd checks some pieces.
        missed |= expected_pairs - found.keys() - disabled
        extra |= {pair for pair, dist in found.items() if pair not in expected_pairs and dist < -CONTACT_TOLERANCE}
    return difference, missed, extra, seen


def collisions(program, urdd):
    """Pairs of links in contact at each sample, by urdd."""
    lines = "\n".join(json.dumps(sample["configuration"]) for sample in urdd.samples)
    command = [program, "check-collisions", str(urdd.root), "-c", "-", "--format", "json"]
    done = subprocess.run(command, input=lines + "\n", capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    pairs = []
    for line in done.stdout.splitlines():
        touching = json.loads(line)["touching"]
        pairs.append({tuple(sorted(pair["links"])) for pair in touching})
    return pairs


def by_pinocchio(program, urdd, folder):
    file = folder / "robot.urdf"
    export(program, "urdf", urdd, file)
    model = pin.buildModelFromUrdf(str(file))
    geometry = pin.buildGeomFromUrdf(model, str(file), pin.GeometryType.COLLISION, str(folder))
    data = model.createData()
    difference = 0.0
    for sample in urdd.samples:
        values = urdd.values(sample["configuration"])
        q = pin.neutral(model)
        for idx in range(1, model.njoints):
            joint, value = model.joints[idx], values[model.names[idx]]
            if joint.nq == 1:
                q[joint.idx_q] = value[0]
            elif joint.nq == 2:
                q[joint.idx_q : joint.idx_q + 2] = [np.cos(value[0]), np.sin(value[0])]
            elif joint.nq == 7:
                w, x, y, z = quaternion_of_vector(value[3:])
                q[joint.idx_q : joint.idx_q + 7] = [*value[:3], x, y, z, w]
            else:
                return None, geometry.ngeoms
        pin.framesForwardKinematics(model, data, q)
        poses = []
        for name in urdd.names:
            frame = data.oMf[model.getFrameId(name, pin.FrameType.BODY)]
            poses.append((frame.translation, frame.rotation))
        difference = max(difference, worst(poses, sample["link_poses"]))
    return difference, geometry.ngeoms


def by_pybullet(folder):
    client = pybullet.connect(pybullet.DIRECT)
    body = pybullet.loadURDF(str(folder / "robot.urdf"), useFixedBase=True)
    links = range(-1, pybullet.getNumJoints(body))
    count = sum(len(pybullet.getCollisionShapeData(body, link)) for link in links)
    pybullet.disconnect(client)
    return count


def by_drake(program, urdd, folder):
    from pydrake.all import AddMultibodyPlantSceneGraph, DiagramBuilder, Parser

    file = folder / "drake.urdf"
    export(program, "drake", urdd, file)
    builder = DiagramBuilder()
    plant, scene = AddMultibodyPlantSceneGraph(builder, 0.0)
    Parser(plant).AddModels(str(file))
    plant.Finalize()
    inspector = scene.model_inspector()

    def name(geometry):
        return plant.GetBodyFromFrameId(inspector.GetFrameId(geometry)).name()

    candidates = {tuple(sorted((name(a), name(b)))) for a, b in inspector.GetCollisionCandidates()}
    return candidates


def export(program, kind, urdd, file):
    subprocess.run([program, "export", kind, str(urdd.root), "-o", str(file), "--force"], check=True, capture_output=True)


def disabled_pairs(program, urdd, folder):
    """Pairs of links that the SRDF disables."""
    export(program, "srdf", urdd, folder / "robot.srdf")
    pairs = ET.parse(folder / "robot.srdf").getroot().iter("disable_collisions")
    return {tuple(sorted((pair.get("link1"), pair.get("link2")))) for pair in pairs}


def checked_pairs(program, urdd, folder):
    """Pairs of links with shapes that the SRDF does not disable and that can move against each other."""
    disabled = disabled_pairs(program, urdd, folder)
    shaped = [urdd.names[link] for link in urdd.document("link_shapes_skips_module")["full_shapes"]]
    rigid = {name: name for name in urdd.names}
    for _ in urdd.joints:
        for joint in urdd.joints:
            if joint["joint_type"] == "Fixed":
                rigid[joint["child"]["link"]] = rigid[joint["parent"]["link"]]
    pairs = {tuple(sorted((a, b))) for a in shaped for b in shaped if rigid[a] != rigid[b]}
    return pairs - disabled, rigid


def main():
    program, paths = sys.argv[1], sys.argv[2:]
    failed = False
    print("| URDD | MuJoCo, poses | contacts (missed, more) | Pinocchio, poses | shapes (PyBullet) | Drake's pairs |")
    print("|---|---|---|---|---|---|")
    for path in paths:
        urdd = Urdd(path)
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            poses, missed, extra, seen = by_mujoco(program, urdd, folder)
            try:
                pinocchio, shapes = by_pinocchio(program, urdd, folder)
                bullet = by_pybullet(folder)
            except (ValueError, RuntimeError) as error:
                pinocchio, shapes, bullet = None, str(error).splitlines()[0], "-"
            try:
                drake = by_drake(program, urdd, folder)
                ours, rigid = checked_pairs(program, urdd, folder)
                drake = {pair for pair in drake if rigid[pair[0]] != rigid[pair[1]]}
                pairs = f"{len(drake)}, {len(drake ^ ours)} differ"
                failed |= drake != ours
            except RuntimeError as error:
                pairs = str(error).splitlines()[0][:60]
        failed |= poses > POSE_TOLERANCE or bool(missed or extra)
        failed |= pinocchio is not None and pinocchio > POSE_TOLERANCE
        shown = "-" if pinocchio is None else f"{pinocchio:.0e}"
        print(
            f"| {urdd.root.name} | {poses:.0e} | {seen} ({len(missed)}, {len(extra)}) | {shown} | {shapes} ({bullet}) | {pairs} |",
            flush=True,
        )
        for pair in sorted(missed | extra):
            print("   ", "missed" if pair in missed else "more", *pair, file=sys.stderr)
    sys.exit(failed)


if __name__ == "__main__":
    main()

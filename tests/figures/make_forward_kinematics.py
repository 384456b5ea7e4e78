#!/usr/bin/env python3
"""Writes both files forward_kinematics.json: link poses computed by peers (Pinocchio, MuJoCo, yourdfpy), never by urdd itself.
That in conformance/vectors is of this repository's robots, with every link; that beside this script of the others.

To reproduce, with Python 3.11:

    python3 -m venv peers
    peers/bin/pip install pin==4.1.0 libpinocchio==4.1.0 cmeel-urdfdom==6.0.0 mujoco==4.0.0 mujoco-core==4.0.0 \
        yourdfpy==0.0.60 numpy==2.4.6 example-robot-data==6.0.0
    peers/bin/python tests/figures/make_forward_kinematics.py --corpus CORPUS --robots ROBOTS

CORPUS is a folder of the published URDDs (ur5, robotiq_140, z1); ROBOTS is the folder of the robots of the paper's timing table
(b1, h1, orca, ur5, xarm7). Neither is part of this repository: a robot is known by source, path and SHA-256. Without them only
the file in conformance/vectors is written. Last run: 2026-11-20, Linux x86-64.

Conventions (SPEC's): a planar joint takes x, y, angle about its axis, x and y in the basis that the shortest arc from +z to the
axis makes of x and y (axis -z: half a turn about x); floating takes x, y, z and a rotation vector; spherical a rotation
vector. Axes are normalised here. A joint without <axis> has 1 0 0.

Mimic joints are expanded here, before any peer sees them: q = multiplier * q(driver) + offset, recursively through chains.
Peers get plain joint values for all joints and do not evaluate <mimic> (the elements are removed from the text).
"""

import argparse
import contextlib
import hashlib
import importlib.metadata
import io
import json
import math
import os
import pathlib
import random
import sys
import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import pinocchio as pin
import yourdfpy

HERE = pathlib.Path(__file__).resolve().parent
REPOSITORY = HERE.parent.parent
EXAMPLE_ROBOT_DATA = pathlib.Path(pin.__file__).resolve().parents[4] / "share" / "example-robot-data"
VECTORS = REPOSITORY / "conformance" / "vectors"
MAX_LINKS = 25

OUR_ROBOTS = [("urdd", f"conformance/robots/{path.name}") for path in sorted((REPOSITORY / "conformance" / "robots").glob("*.urdf"))]
# source, path below the source's folder
OTHER_ROBOTS = [
    ("corpus", "robotiq_140/robotiq_140.urdf"),
    ("corpus", "ur5/ur5.urdf"),
    ("corpus", "z1/z1.urdf"),
    ("robots", "b1/robot.urdf"),
    ("robots", "b1/robot_31links_apollo.urdf"),
    ("robots", "h1/robot.urdf"),
    ("robots", "orca/robot.urdf"),
    ("robots", "orca/robot_55links_split.urdf"),
    ("robots", "ur5/robot.urdf"),
    ("robots", "xarm7/robot.urdf"),
    ("example-robot-data", "robots/allegro_hand_description/urdf/allegro_right_hand.urdf"),
    ("example-robot-data", "robots/anymal_b_simple_description/robots/anymal.urdf"),
    ("example-robot-data", "robots/double_pendulum_description/urdf/double_pendulum_continuous.urdf"),
    ("example-robot-data", "robots/iris_description/robots/iris_simple.urdf"),
    ("example-robot-data", "robots/panda_description/urdf/panda.urdf"),
    ("example-robot-data", "robots/pr2_description/urdf/pr2.urdf"),
    ("example-robot-data", "robots/talos_data/robots/talos_full_v2.urdf"),
    ("example-robot-data", "robots/tiago_description/robots/tiago.urdf"),
]
COUNT = {"fixed": 0, "revolute": 1, "continuous": 1, "prismatic": 1, "planar": 3, "spherical": 3, "floating": 6}


# --- reading -------------------------------------------------------------------------------------------------------------

def vector(element, attribute, default):
    text = None if element is None else element.get(attribute)
    return np.array(default if text is None else [float(word) for word in text.split()])


class Joint:
    def __init__(self, element):
        self.name, self.type = element.get("name"), element.get("type")
        self.parent = element.find("parent").get("link")
        self.child = element.find("child").get("link")
        origin = element.find("origin")
        self.xyz = vector(origin, "xyz", [0.0, 0.0, 0.0])
        self.rpy = vector(origin, "rpy", [0.0, 0.0, 0.0])
        axis = vector(element.find("axis"), "xyz", [1.0, 0.0, 0.0])
        length = math.sqrt(math.fsum(axis * axis))
        self.axis = axis / length if length else axis
        limit = element.find("limit")
        self.limits = [None if limit is None or limit.get(end) is None else float(limit.get(end)) for end in ("lower", "upper")]
        mimic = element.find("mimic")
        self.mimic = None
        if mimic is not None:
            self.mimic = mimic.get("joint"), float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))


class Robot:
    def __init__(self, text):
        tree = ET.fromstring(text)
        self.tree, self.name = tree, tree.get("name")
        self.links = [link.get("name") for link in tree.findall("link")]
        self.joints = [Joint(joint) for joint in tree.findall("joint")]
        children = {joint.child for joint in self.joints}
        (self.root,) = [link for link in self.links if link not in children]
        below = {}
        for joint in self.joints:
            below.setdefault(joint.parent, []).append(joint)
        self.topological, front = [], [self.root]
        while front:
            found = below.get(front.pop(), [])
            self.topological += found
            front += [joint.child for joint in found]
        assert len(self.topological) == len(self.joints) == len(self.links) - 1

    def stripped(self):
        """What peers read: kinematics only. Meshes are not at hand, and MuJoCo wants a mass on whatever moves."""
        tree = ET.fromstring(ET.tostring(self.tree))
        for element in list(tree):
            if element.tag not in ("link", "joint"):
                tree.remove(element)
        for link in tree.findall("link"):
            for element in list(link):
                link.remove(element)
            inertial = ET.SubElement(link, "inertial")
            ET.SubElement(inertial, "mass", value="1")
            ET.SubElement(inertial, "inertia", ixx="1", ixy="0", ixz="0", iyy="1", iyz="0", izz="1")
        for joint in tree.findall("joint"):
            for mimic in joint.findall("mimic"):
                joint.remove(mimic)
        return tree


# --- configurations ------------------------------------------------------------------------------------------------------

def six_decimals(value, lower, upper):
    """Rounded to six decimals and still inside the limits."""
    rounded = round(value, 6)
    if rounded < lower:
        rounded = math.ceil(lower * 1e6) / 1e6
    if rounded > upper:
        rounded = math.floor(upper * 1e6) / 1e6
    return (rounded if lower <= rounded <= upper else lower) + 0.0


def drawn(joint, draw):
    if joint.type in ("revolute", "prismatic", "continuous"):
        lower, upper = joint.limits
        if joint.type == "continuous" or lower is None or upper is None:
            lower, upper = (-1.0, 1.0) if joint.type == "prismatic" else (-math.pi, math.pi)
        if lower > upper:
            lower, upper = upper, lower
        return [six_decimals(draw.uniform(lower, upper), lower, upper)]
    lengths = [round(draw.uniform(-1.0, 1.0), 6) for _ in range({"planar": 2, "floating": 3}.get(joint.type, 0))]
    if joint.type == "planar":
        return lengths + [six_decimals(draw.uniform(-math.pi, math.pi), -math.pi, math.pi)]
    while True:  # uniform in a ball a little smaller than pi: rounding stays inside
        rotation = [draw.uniform(-3.1415, 3.1415) for _ in range(3)]
        if math.hypot(*rotation) < 3.1415:
            return lengths + [round(value, 6) for value in rotation]


def configurations(robot):
    moving = [joint for joint in robot.joints if COUNT[joint.type] and joint.mimic is None]
    yield "zeros", {joint.name: [0.0] * COUNT[joint.type] for joint in moving}
    for k in (1, 2):
        draw = random.Random(f"{robot.name}/{k}")
        yield f"random_{k}", {joint.name: drawn(joint, draw) for joint in moving}


def expanded(robot, listed):
    """Joint values with mimics filled in, through chains."""
    joints = {joint.name: joint for joint in robot.joints}

    def value(name):
        joint = joints[name]
        if joint.mimic is None:
            return listed.get(name, [])
        driver, multiplier, offset = joint.mimic
        return [multiplier * q + offset for q in value(driver)]

    return {name: value(name) for name in joints}


# --- the closed forms ------------------------------------------------------------------------------------------------------

def rodrigues(axis, angle):
    x, y, z = axis
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * skew + 2 * math.sin(angle / 2) ** 2 * (skew @ skew)


def exponential(rotation):
    angle = math.hypot(*rotation)
    return rodrigues(np.array(rotation) / angle, angle) if angle else np.eye(3)


def fixed_axis(rpy):
    roll, pitch, yaw = rpy
    return rodrigues((0, 0, 1), yaw) @ rodrigues((0, 1, 0), pitch) @ rodrigues((1, 0, 0), roll)


def plane_basis(axis):
    """Columns x, y of the plane and its normal: the shortest arc that takes +z to the axis."""
    x, y, z = axis
    sine = math.hypot(x, y)
    if sine == 0:
        return np.eye(3) if z > 0 else np.diag([1.0, -1.0, -1.0])
    return rodrigues((-y / sine, x / sine, 0), math.atan2(sine, z))


def pose(rotation, position):
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation, position
    return matrix


def motion(joint, q):
    if joint.type == "fixed":
        return np.eye(4)
    if joint.type in ("revolute", "continuous"):
        return pose(rodrigues(joint.axis, q[0]), [0, 0, 0])
    if joint.type == "prismatic":
        return pose(np.eye(3), joint.axis * q[0])
    if joint.type == "planar":
        return pose(rodrigues(joint.axis, q[2]), plane_basis(joint.axis) @ [q[0], q[1], 0])
    if joint.type == "spherical":
        return pose(exponential(q), [0, 0, 0])
    return pose(exponential(q[3:]), q[:3])


def closed_forms(robot):
    def evaluate(values):
        poses = {robot.root: np.eye(4)}
        for joint in robot.topological:
            poses[joint.child] = poses[joint.parent] @ pose(fixed_axis(joint.rpy), joint.xyz) @ motion(joint, values[joint.name])
        return poses

    return evaluate


# --- peers: each returns a function from joint values to poses, or raises ---------------------------------------------------

def pinocchio_from_urdf(robot):
    """Pinocchio's own reading of the text."""
    for joint in robot.joints:
        if joint.type == "planar" and tuple(joint.axis) != (0, 0, 1):
            raise ValueError("reads a planar joint's axis as 0 0 1, whatever it is")
    model = pin.buildModelFromXML(ET.tostring(robot.stripped(), encoding="unicode"))
    return pinocchio_evaluator(robot, model, {link: model.getFrameId(link, pin.FrameType.BODY) for link in robot.links})


def pinocchio_evaluator(robot, model, frames):
    data = model.createData()

    def evaluate(values):
        pin.framesForwardKinematics(model, data, pinocchio_configuration(robot, model, values))
        return {link: data.oMf[frame].homogeneous.copy() for link, frame in frames.items()}

    return evaluate


def pinocchio_configuration(robot, model, values):
    q = pin.neutral(model)
    for joint in robot.joints:
        if joint.type == "fixed":
            continue
        index = model.getJointId(joint.name)
        at, size = model.joints[index].idx_q, model.joints[index].nq
        given = values[joint.name]
        if joint.type == "planar":
            given = [given[0], given[1], math.cos(given[2]), math.sin(given[2])]
        elif joint.type in ("floating", "spherical"):
            given = [*given[:-3], *pin.Quaternion(pin.exp3(np.array(given[-3:]))).coeffs()]
        elif size == 2:
            given = [math.cos(given[0]), math.sin(given[0])]
        assert len(given) == size
        q[at:at + size] = given
    return q


def pinocchio_by_api(robot):
    """Pinocchio's joint models, put together here: for the joints that its reader of URDF does not do."""
    model, at = pinocchio_model(robot)
    frames = {}
    for number, link in enumerate(robot.links):
        parent, place = at[link]
        frames[link] = model.addFrame(pin.Frame(f"link {number}", parent, place, pin.FrameType.OP_FRAME))
    return pinocchio_evaluator(robot, model, frames)


def pinocchio_model(robot):
    """A model without masses, and for each link the joint that carries it and the link's place on it."""
    model = pin.Model()
    at = {robot.root: (0, pin.SE3.Identity())}
    for joint in robot.topological:
        parent, place = at[joint.parent]
        place = place * pin.SE3(pin.rpy.rpyToMatrix(*joint.rpy), joint.xyz)
        if joint.type == "fixed":
            at[joint.child] = parent, place
            continue
        basis = pin.SE3.Identity()
        if joint.type == "planar":  # Pinocchio's plane has normal +z
            basis = pin.SE3(pin.Quaternion.FromTwoVectors(np.array([0.0, 0.0, 1.0]), joint.axis).matrix(), np.zeros(3))
            if tuple(joint.axis) == (0, 0, -1):
                basis = pin.SE3(np.diag([1.0, -1.0, -1.0]), np.zeros(3))
        kind = {
            "revolute": lambda: pin.JointModelRevoluteUnaligned(joint.axis),
            "continuous": lambda: pin.JointModelRevoluteUnaligned(joint.axis),  # the unbounded one cannot be given an axis in Python
            "prismatic": lambda: pin.JointModelPrismaticUnaligned(joint.axis),
            "planar": pin.JointModelPlanar,
            "spherical": pin.JointModelSpherical,
            "floating": pin.JointModelFreeFlyer,
        }[joint.type]()
        at[joint.child] = model.addJoint(parent, kind, place * basis, joint.name), basis.inverse()
    return model, at


def mujoco_from_urdf(robot):
    """MuJoCo's own reading of the text."""
    if any(joint.type == "floating" for joint in robot.joints):
        raise ValueError("allows a floating joint on a top-level body only")
    tree = robot.stripped()
    ET.SubElement(ET.SubElement(tree, "mujoco"), "compiler", fusestatic="false")
    for joint in tree.findall("joint"):
        if joint.get("type") in ("spherical", "planar"):
            for limit in joint.findall("limit"):
                joint.remove(limit)
    return mujoco_evaluator(robot, ET.tostring(tree, encoding="unicode"), {link: link for link in robot.links})


def mujoco_by_mjcf(robot):
    """The same robot written as MJCF: a floating joint becomes three slides and a ball, a planar one two slides and a hinge."""
    world = ET.Element("mujoco")
    ET.SubElement(world, "compiler", angle="radian", eulerseq="XYZ", autolimits="false")
    bodies = {robot.root: ET.SubElement(ET.SubElement(world, "worldbody"), "body", name="link 0")}
    names = {robot.root: "link 0"}  # a link may be called "world", which is taken

    def text(values):
        return " ".join(repr(float(value)) for value in values)

    for joint in robot.topological:
        names[joint.child] = f"link {len(names)}"
        body = ET.SubElement(bodies[joint.parent], "body", name=names[joint.child], pos=text(joint.xyz), euler=text(joint.rpy))
        bodies[joint.child] = body
        ET.SubElement(body, "inertial", pos="0 0 0", mass="1", diaginertia="1 1 1")
        if joint.type == "planar":
            quat = np.zeros(4)
            mujoco.mju_quatZ2Vec(quat, joint.axis)
            for suffix, direction in (("_TX", [1.0, 0, 0]), ("_TY", [0, 1.0, 0])):
                along = np.zeros(3)
                mujoco.mju_rotVecQuat(along, np.array(direction), quat)
                ET.SubElement(body, "joint", name=joint.name + suffix, type="slide", axis=text(along))
            ET.SubElement(body, "joint", name=joint.name + "_RZ", type="hinge", axis=text(joint.axis))
        elif joint.type in ("spherical", "floating"):
            if joint.type == "floating":
                for suffix, along in (("_TX", "1 0 0"), ("_TY", "0 1 0"), ("_TZ", "0 0 1")):
                    ET.SubElement(body, "joint", name=joint.name + suffix, type="slide", axis=along)
            ET.SubElement(body, "joint", name=joint.name, type="ball")
        elif joint.type != "fixed":
            kind = "slide" if joint.type == "prismatic" else "hinge"
            ET.SubElement(body, "joint", name=joint.name, type=kind, axis=text(joint.axis))
    return mujoco_evaluator(robot, ET.tostring(world, encoding="unicode"), names)


def mujoco_evaluator(robot, text, names):
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)

    def evaluate(values):
        mujoco.mj_resetData(model, data)

        def put(name, given):
            at = model.jnt_qposadr[model.joint(name).id]
            data.qpos[at:at + len(given)] = given

        for joint in robot.joints:
            given = values[joint.name]
            if joint.type == "planar":
                for suffix, value in zip(("_TX", "_TY", "_RZ"), given):
                    put(joint.name + suffix, [value])
            elif joint.type in ("spherical", "floating"):
                for suffix, value in zip(("_TX", "_TY", "_TZ"), given[:-3]):
                    put(joint.name + suffix, [value])
                quat, vector = np.zeros(4), np.array(given[-3:])
                angle = mujoco.mju_normalize3(vector)
                mujoco.mju_axisAngle2Quat(quat, vector, angle)
                put(joint.name, quat)
            elif joint.type != "fixed":
                put(joint.name, given)
        mujoco.mj_kinematics(model, data)
        root = data.body(names[robot.root])
        assert np.abs(root.xpos).max() == 0 and np.array_equal(root.xmat.reshape(3, 3), np.eye(3))
        return {link: pose(data.body(name).xmat.reshape(3, 3), data.body(name).xpos) for link, name in names.items()}

    return evaluate


def yourdfpy_from_urdf(robot):
    if any(COUNT[joint.type] > 1 for joint in robot.joints):
        raise ValueError("moves no joint with several DOFs")
    tree = robot.stripped()
    model = yourdfpy.URDF.load(io.BytesIO(ET.tostring(tree)), load_meshes=False, build_scene_graph=True)

    def evaluate(values):
        model.update_cfg({joint.name: values[joint.name][0] for joint in robot.joints if joint.type != "fixed"})
        return {link: model.get_transform(link, robot.root) for link in robot.links}

    return evaluate


PEERS = {
    "pinocchio (URDF)": pinocchio_from_urdf,
    "pinocchio (joint models)": pinocchio_by_api,
    "mujoco (URDF)": mujoco_from_urdf,
    "mujoco (MJCF)": mujoco_by_mjcf,
    "yourdfpy (URDF)": yourdfpy_from_urdf,
}


# --- writing ---------------------------------------------------------------------------------------------------------------

def quaternion_wxyz(rotation):
    """The column of the symmetric matrix 4 q q^T with the greatest diagonal: no cancellation at any angle."""
    r = rotation
    squares = [1 + r[0, 0] + r[1, 1] + r[2, 2], 1 + r[0, 0] - r[1, 1] - r[2, 2],
               1 - r[0, 0] + r[1, 1] - r[2, 2], 1 - r[0, 0] - r[1, 1] + r[2, 2]]
    a, b, c = r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
    d, e, f = r[1, 0] + r[0, 1], r[0, 2] + r[2, 0], r[2, 1] + r[1, 2]
    symmetric = np.array([[squares[0], a, b, c], [a, squares[1], d, e], [b, d, squares[2], f], [c, e, f, squares[3]]])
    column = symmetric[int(np.argmax(squares))]
    quaternion = column / math.sqrt(math.fsum(column * column))
    return -quaternion if quaternion[0] < 0 else quaternion


def numbers(values):
    return [float(value) + 0.0 for value in values]  # no negative zero


def difference(robot, poses, others):
    position = max(float(np.abs(poses[link][:3, 3] - others[link][:3, 3]).max()) for link in robot.links)
    rotation = max(float(np.linalg.norm(poses[link][:3, :3] - others[link][:3, :3])) / math.sqrt(2) for link in robot.links)
    return position, rotation


@contextlib.contextmanager
def quiet():
    """urdfdom writes to file descriptor 2 itself."""
    sys.stderr.flush()
    kept, null = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(null)


def figures(robot, most_links):
    evaluators, unavailable = {"closed forms": closed_forms(robot)}, {}
    for name, peer in PEERS.items():
        try:
            with quiet():
                evaluators[name] = peer(robot)
        except Exception as error:  # a peer that cannot read the robot is a fact to record
            unavailable[name] = " ".join(str(error).split())
    reference = "pinocchio (URDF)" if "pinocchio (URDF)" in evaluators else "closed forms"
    step = max(1.0, (len(robot.links) - 1) / (most_links - 1))
    shown = sorted({round(step * n) for n in range(most_links) if round(step * n) < len(robot.links)})
    agreement = {name: [0.0, 0.0] for name in evaluators if name != reference}
    written = []
    for label, listed in configurations(robot):
        values = expanded(robot, listed)
        poses = evaluators[reference](values)
        for name in agreement:
            agreement[name] = [max(pair) for pair in zip(agreement[name], difference(robot, poses, evaluators[name](values)))]
        written.append({
            "label": label,
            "joints": listed,
            "links": {robot.links[n]: {
                "position": numbers(poses[robot.links[n]][:3, 3]),
                "quaternion_wxyz": numbers(quaternion_wxyz(poses[robot.links[n]][:3, :3])),
            } for n in shown},
        })
    peers = {name: {"max_position_difference": p, "max_rotation_difference": r} for name, (p, r) in agreement.items()}
    peers |= {name: {"not_used": reason} for name, reason in unavailable.items()}
    return {"links_in_robot": len(robot.links), "root": robot.root, "reference": reference, "peers": peers, "configurations": written}


def lines(value, indent, depth):
    """JSON with `depth` levels of one item a line, and what is below on one line."""
    plain = isinstance(value, list) and not any(isinstance(item, (dict, list)) for item in value)
    if depth == 0 or plain or not isinstance(value, (dict, list)) or not value:
        return json.dumps(value, ensure_ascii=False)
    pad = "\n" + " " * (indent + 1)
    if isinstance(value, dict):
        items = [json.dumps(key, ensure_ascii=False) + ": " + lines(item, indent + 1, depth - 1) for key, item in value.items()]
        return "{" + pad + ("," + pad).join(items) + "\n" + " " * indent + "}"
    return "[" + pad + ("," + pad).join(lines(item, indent + 1, depth - 1) for item in value) + "\n" + " " * indent + "]"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--corpus", type=pathlib.Path)
    parser.add_argument("--robots", type=pathlib.Path)
    arguments = parser.parse_args()
    folders = {"urdd": REPOSITORY, "corpus": arguments.corpus, "robots": arguments.robots, "example-robot-data": EXAMPLE_ROBOT_DATA}
    write(VECTORS / "forward_kinematics.json", OUR_ROBOTS, folders, ["example-robot-data"])
    if arguments.corpus and arguments.robots:
        write(HERE / "forward_kinematics.json", OTHER_ROBOTS, folders, [])


def write(file, sources, folders, not_used):
    robots = []
    for source, path in sources:
        text = (folders[source] / path).read_bytes()
        robot = Robot(text)
        ours = source == "urdd"
        result = figures(robot, most_links=len(robot.links) + 1 if ours else MAX_LINKS)
        for configuration in result["configurations"] if ours else []:
            joints = configuration.pop("joints")
            in_dof_order = [value for joint in robot.joints for value in joints.get(joint.name, [])]
            configuration |= {"joints": joints, "configuration": in_dof_order, "links": configuration.pop("links")}
        robots.append({"source": source, "path": path, "sha256": hashlib.sha256(text).hexdigest(), **result})
        print(f"{source} {path}: {result['links_in_robot']} links, reference {result['reference']}")
        for peer, found in result["peers"].items():
            print("    ", peer, found.get("not_used") or "{max_position_difference:.1e} {max_rotation_difference:.1e}".format(**found))
    packages = ["pin", "libpinocchio", "cmeel-urdfdom", "mujoco", "yourdfpy", "numpy", "example-robot-data"]
    packages = [name for name in packages if name not in not_used]
    document = {
        "made_by": "tests/figures/make_forward_kinematics.py",
        "versions": {"python": sys.version.split()[0]} | {name: importlib.metadata.version(name) for name in packages},
        "robots": robots,
    }
    file.write_text(lines(document, 0, 6) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

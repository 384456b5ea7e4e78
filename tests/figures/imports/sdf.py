"""Holds imported SDFs to libsdformat 12: the URDF of `urdd import`, as Pinocchio and lxml read it, against the resolved model.

    g++ -O1 -o /tmp/sdf_truth sdf.cpp $(pkg-config --cflags --libs sdformat12)
    /work/peers/bin/python sdf.py --urdd target/debug/urdd --truth /tmp/sdf_truth [--json FILE] NAME=FOLDER ...

Poses of all links relative to the root in 100 random configurations (1e-9), masses, centres, inertias, limits, shapes.
"""
import argparse, json, os, subprocess, sys, tempfile, time
from collections import Counter, deque
from pathlib import Path

import numpy as np
import pinocchio as pin
from lxml import etree

BESIDE = {
    "closed chains",
    "joints of other kinds that close a chain",
    "gearboxes",
    "gearboxes about other axes than their joints turn, or seen from no link",
}
BALL, CONTINUOUS, FIXED, GEARBOX, PRISMATIC, REVOLUTE, REVOLUTE2, SCREW, UNIVERSAL = 1, 2, 3, 4, 5, 6, 7, 8, 9


def matrix(pose):
    x, y, z, w, i, j, k = pose
    made = np.eye(4)
    made[:3, :3] = pin.Quaternion(w, i, j, k).normalized().matrix()
    made[:3, 3] = x, y, z
    return made


def turn(axis, angle):
    made = np.eye(4)
    made[:3, :3] = pin.AngleAxis(angle, np.asarray(axis, float) / np.linalg.norm(axis)).toRotationMatrix()
    return made


def shift(axis, length):
    made = np.eye(4)
    made[:3, 3] = np.asarray(axis, float) * length
    return made


def motion(joint, name, values):
    """The pose of the child's joint frame in the parent's, at values by the URDF's joint names."""
    kind, axes = joint["type"], [axis["xyz"] for axis in joint["axes"]]
    if kind in (CONTINUOUS, REVOLUTE):
        return turn(axes[0] if axes else [0, 0, 1], values[name])
    if kind == PRISMATIC:
        return shift(axes[0], values[name])
    if kind == SCREW:
        return turn(axes[0], values[name]) @ shift(axes[0], values[name] * joint["pitch"] / (2 * np.pi))
    if kind in (REVOLUTE2, UNIVERSAL):
        second = axes[1] if len(axes) > 1 else [0, 0, 1]
        return turn(axes[0], values[name + "/axis"]) @ turn(second, values[name + "/axis2"])
    if kind == BALL:
        made = np.eye(4)
        for axis, suffix in ((np.eye(3)[n], "_" + "xyz"[n]) for n in range(3)):
            made = made @ turn(axis, values[name + suffix])
        return made
    return np.eye(4)


def truth_poses(truth, kept, root, values):
    """Poses of links relative to the root, by the joints that the import kept."""
    zero = {name: matrix(link["pose"]) for name, link in truth["links"].items()}
    zero["world"] = np.eye(4)
    around = {name: [] for name in zero}
    for name in kept:
        joint = truth["joints"][name]
        around[joint["parent"]].append((joint["child"], name, False))
        around[joint["child"]].append((joint["parent"], name, True))
    poses, open_ = {root: np.eye(4)}, deque([root])
    while open_:
        link = open_.popleft()
        for other, name, is_turned in around[link]:
            if other in poses:
                continue
            joint = truth["joints"][name]
            frame = matrix(joint["pose"])
            parent, child = (other, link) if is_turned else (link, other)
            before, after = np.linalg.inv(zero[parent]) @ frame, np.linalg.inv(frame) @ zero[child]
            moved = motion(joint, name, values)
            if is_turned and joint["type"] == BALL:  # its values are said to be those of the opposite rotation
                moved = np.linalg.inv(moved)
            step = before @ moved @ after
            poses[other] = poses[link] @ (np.linalg.inv(step) if is_turned else step)
            open_.append(other)
    for name, pose in zero.items():  # what no joint holds stays where it is to the root
        if name not in poses and name in truth["links"]:
            poses[name] = None
    return poses, zero


def origin(element):
    found = element.find("origin")
    xyz = [float(v) for v in (found.get("xyz") if found is not None and found.get("xyz") else "0 0 0").split()]
    rpy = [float(v) for v in (found.get("rpy") if found is not None and found.get("rpy") else "0 0 0").split()]
    made = np.eye(4)
    made[:3, :3], made[:3, 3] = pin.rpy.rpyToMatrix(*rpy), xyz
    return made


def shapes(link, kind):
    return [(origin(e), e.find("geometry")[0]) for e in link.findall(kind)]


def wanted_shapes(given):
    """A shape of SDF as shapes of a URDF: name, numbers, pose."""
    made = []
    for shape in given:
        name, numbers, pose = shape["geometry"][0], (shape["geometry"] + [[]])[1], matrix(shape["pose"])
        if name == "capsule":
            radius, length = numbers
            made += [("cylinder", numbers, pose), ("sphere", [radius], pose @ shift([0, 0, 1], length / 2)), ("sphere", [radius], pose @ shift([0, 0, 1], -length / 2))]
        elif name == "ellipsoid":
            made.append(("mesh", numbers, pose))
        elif name == "mesh" and shape["geometry"][3]:
            made.append(("mesh", numbers, None))  # where its middle is, libsdformat does not know
        elif name == "mesh":
            made.append(("mesh", numbers, pose))
        elif name in ("box", "cylinder", "sphere"):
            made.append((name, numbers, pose))
    return made


def found_shape(element):
    numbers = {"box": ["size"], "sphere": ["radius"], "cylinder": ["radius", "length"], "mesh": ["scale"]}[element.tag]
    texts = [element.get(key) or "1 1 1" for key in numbers]
    return element.tag, [float(v) for text in texts for v in text.split()]


def near(left, right, relative=1e-9):
    left, right = np.asarray(left, float), np.asarray(right, float)
    return left.shape == right.shape and bool(np.all(np.abs(left - right) <= relative * np.maximum(1.0, np.abs(right))))


def judge(truth, urdf_path, report):
    """What is wrong with an imported robot."""
    wrong = []
    document = etree.parse(str(urdf_path)).getroot()
    links = {e.get("name"): e for e in document.findall("link")}
    joints = {e.get("name"): e for e in document.findall("joint")}
    children = {e.find("child").get("link") for e in joints.values()}
    root = next(name for name in links if name not in children)
    truth["frames"] = {n: f for n, f in truth["frames"].items() if "_merged__" not in n}
    for name in list(truth["links"]) + list(truth["frames"]):
        if name not in links:
            wrong.append(f"no link {name}")
    if wrong:
        return wrong
    gears = [n for n, j in truth["joints"].items() if j["type"] == GEARBOX]
    kept = []
    names = {e for e in joints}
    # libsdformat renames joints of old files that are called like a link.
    for name in [n for n in truth["joints"] if n not in names and n.removesuffix("_joint") in names and n.endswith("_joint")]:
        truth["joints"][name.removesuffix("_joint")] = truth["joints"].pop(name)
    for name, joint in truth["joints"].items():
        if {name, name + "/axis", name + "_x"} & names:
            kept.append(name)
    lost = {part["what"]: part["count"] for part in report["lost"]}
    # What closes chains and couples joints is not a joint of the URDF.
    beside = [part for part in report["lost"] + report["otherwise"] if part["what"] in BESIDE]
    if len(truth["joints"]) - len(kept) != sum(part["count"] for part in beside):
        wrong.append(f"{len(truth['joints']) - len(kept)} joints are missing")
    # Masses, inertias and shapes.
    missing = lost.get("meshes and images that are not found or read", 0)
    for name, link in truth["links"].items():
        inertial = links[name].find("inertial")
        at, mass = origin(inertial), float(inertial.find("mass").get("value"))
        values = [float(inertial.find("inertia").get(key)) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")]
        if not near(mass, link["mass"]) or not near(at[:3, 3], link["centre"]):
            wrong.append(f"mass of {name}")
        if not np.all(np.abs(np.array(values) - link["inertia"]) <= 1e-9 * np.abs(link["inertia"]).max()):
            wrong.append(f"inertia of {name}: {values} {link['inertia']}")
        for kind in ("visual", "collision"):
            wanted = wanted_shapes(link[kind + "s"])
            found = [(*found_shape(e), pose) for pose, e in shapes(links[name], kind)]
            if len(found) != len(wanted):
                # Meshes that are not there are left out, and the report counts them.
                gone = len(wanted) - len(found)
                missing -= max(gone, 0)
                if missing < 0 or gone < 0:
                    wrong.append(f"{len(found)} {kind}s of {name}, not {len(wanted)}")
                continue
            for (a, b, c), (d, e, f) in zip(found, wanted):
                if a != d or not near(b, e) or (f is not None and not np.abs(c - f).max() < 1e-9):
                    wrong.append(f"{kind} of {name}: {a, b, c.tolist()} {d, e}")
    # Limits.
    for name in kept:
        joint = truth["joints"][name]
        for n, axis in enumerate(joint["axes"][:2 if joint["type"] in (REVOLUTE2, UNIVERSAL) else 1]):
            if joint["type"] in (FIXED, BALL):
                continue
            element = joints.get(name if joint["type"] not in (REVOLUTE2, UNIVERSAL) else name + ["/axis", "/axis2"][n])
            if element is None:
                continue
            limit = element.find("limit")
            get = lambda key: None if limit is None or limit.get(key) is None else float(limit.get(key))
            is_none = lambda value: value is None or abs(value) >= 1e16
            if joint["type"] != CONTINUOUS and not is_none(axis["lower"]) and not is_none(axis["upper"]):
                if not near([get("lower") or 0.0, get("upper") or 0.0], [axis["lower"], axis["upper"]]):
                    wrong.append(f"limits of {name}")
            for key in ("effort", "velocity"):
                if axis[key] is not None and 0 <= axis[key] < 1e16 and not near(get(key), axis[key]):
                    wrong.append(f"{key} of {name}")
            dynamics = element.find("dynamics")
            for key in ("damping", "friction"):
                value = 0.0 if dynamics is None else float(dynamics.get(key) or 0)
                if not near(value, axis[key]):
                    wrong.append(f"{key} of {name}")
    # Poses.
    model = pin.buildModelFromXML(etree.tostring(document).decode())
    data = model.createData()
    rng = np.random.default_rng(1)
    frames = {name: model.getFrameId(name, pin.BODY) for name in links}
    base = frames[root]
    worst = 0.0
    for trial in range(100):
        q, values = pin.neutral(model), {}
        for n, name in enumerate(model.names):
            if n == 0:
                continue
            value = 0.0 if trial == 0 else rng.uniform(-1.5, 1.5)
            values[name] = value
            joint, at = model.joints[n], model.joints[n].idx_q
            q[at:at + joint.nq] = [value] if joint.nq == 1 else [np.cos(value), np.sin(value)]
        for name, joint in truth["joints"].items():
            if joint["type"] == SCREW and name in kept:
                n = model.getJointId(name + "/thread")
                q[model.joints[n].idx_q] = values[name] * joint["pitch"] / (2 * np.pi)
        pin.framesForwardKinematics(model, data, q)
        inverse = data.oMf[base].inverse()
        poses, zero = truth_poses(truth, kept, root, values)
        for name in truth["links"]:
            found = (inverse * data.oMf[frames[name]]).homogeneous
            wanted = poses[name]
            if wanted is None:
                if trial:
                    continue
                wanted = np.linalg.inv(zero[root]) @ zero[name]
            worst = max(worst, np.abs(found - wanted).max())
        for name, frame in truth["frames"].items():
            held = frame["link"]
            if poses.get(held) is None:
                continue
            wanted = poses[held] @ np.linalg.inv(zero[held]) @ matrix(frame["pose"])
            worst = max(worst, np.abs((inverse * data.oMf[frames[name]]).homogeneous - wanted).max())
    if worst > 1e-9:
        wrong.append(f"poses are {worst:.3g} apart")
    return wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--urdd", required=True)
    parser.add_argument("--truth", required=True)
    parser.add_argument("--json")
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument("sets", nargs="+")
    arguments = parser.parse_args()
    rows = {}
    for one in arguments.sets:
        title, folder = one.split("=", 1)
        files = [Path(folder)] if Path(folder).is_file() else sorted(p for p in Path(folder).rglob("*") if p.suffix in (".sdf", ".world") and p.is_file())
        environment = {**os.environ, "SDF_PATH": folder, "GAZEBO_MODEL_PATH": folder}
        asked = "\n".join(map(str, files)) + "\n"
        answers = subprocess.run([arguments.truth], input=asked, capture_output=True, text=True, env=environment).stdout
        row, reasons = Counter(), Counter()
        lines = answers.splitlines()
        if len(lines) != len(files):
            print(f"{title}: libsdformat ended at {files[len(lines)]}", file=sys.stderr)
        for path, line in zip(files, lines):
            truth = json.loads(line.replace("::", "/"))  # as the import writes names of nested models
            row["files"] += 1
            # libsdformat 12 does not know what SDF 1.11 added: other tests have these.
            is_newer = any(mark in path.read_bytes() for mark in (b'auto="true"', b"<cone>"))
            loads = truth["error"] is None and bool(truth.get("links")) and not is_newer
            row["loads"] += loads
            with tempfile.TemporaryDirectory() as to:
                started = time.time()
                command = [arguments.urdd, "import", str(path), "-o", f"{to}/out", "--ball", "revolute", "--report", f"{to}/report.json"]
                done = subprocess.run(command, capture_output=True, text=True, env=environment)
                row["seconds"] += time.time() - started
                if done.returncode != 0:
                    if loads:
                        row["refused"] += 1
                        print(f"REFUSED {path}: {done.stderr.strip().splitlines()[0] if done.stderr.strip() else done.returncode}")
                    elif "panicked" in done.stderr:
                        print(f"PANIC {path}: {done.stderr}")
                    continue
                row["imported" if loads else "imported, refused by libsdformat"] += 1
                if not loads:
                    if arguments.verbose:
                        print(f"LAX {path}: {truth['error']}")
                    continue
                urdf = next(Path(f"{to}/out").glob("*.urdf"))
                try:
                    wrong = judge(truth, urdf, json.loads(Path(f"{to}/report.json").read_text()))
                except Exception as error:
                    wrong = [f"{type(error).__name__}: {error}"]
                if wrong:
                    row["wrong"] += 1
                    print(f"WRONG {path}: {wrong[:3]}")
        rows[title] = dict(row)
        print(title, dict(row))
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()

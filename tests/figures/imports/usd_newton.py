"""Imports USD files, and compares the URDF with what Newton's reader makes of the same file.

    python usd_newton.py URDD WORK FILE...

For each body that both have: its mass, where its centre of mass is and its inertia there, in 5 configurations, as seen from the
root; limits of joints. Frames of links may be elsewhere in a body than Newton's.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import warnings

import newton
import numpy as np
import warp as wp

from kinematics import Urdf

wp.config.quiet = True
warnings.filterwarnings("ignore")


def matrix(pose):
    x, y, z, w = pose[3:]
    made = np.eye(4)
    made[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    made[:3, 3] = pose[:3]
    return made


def last(label):
    return label.rsplit("/", 1)[-1]


def compare(path, folder, wrong):
    builder = newton.ModelBuilder()
    builder.add_usd(str(path))
    # It refuses joints of no articulation, whose bodies it would leave where the stage has them.
    model = builder.finalize(device="cpu")
    labels = [last(label) for label in model.body_label]
    urdf = Urdf(next(folder.glob("*.urdf")))
    types = model.joint_type.numpy()
    joint_labels = [last(label) for label in model.joint_label]
    child, starts, dofs = model.joint_child.numpy(), model.joint_q_start.numpy(), model.joint_qd_start.numpy()
    one = {int(newton.JointType.PRISMATIC), int(newton.JointType.REVOLUTE)}
    ours = {joint.get("name"): joint for joint in urdf.moving}
    mass, com, inertia = model.body_mass.numpy(), model.body_com.numpy(), model.body_inertia.numpy()
    common = [name for name in labels if name in urdf.links and labels.count(name) == 1]
    lower, upper = model.joint_limit_lower.numpy(), model.joint_limit_upper.numpy()
    for at, name in enumerate(joint_labels):
        if int(types[at]) in one and name in ours and joint_labels.count(name) == 1:
            limit = ours[name].find("limit")
            span = [lower[dofs[at]], upper[dofs[at]]]
            if limit is not None and limit.get("lower") and max(map(abs, span)) < 1e5:
                own = [float(limit.get("lower")), float(limit.get("upper"))]
                if np.abs(np.array(own) - span).max() > 1e-4 * max(1, *map(abs, span)):
                    wrong.append(f"joint {name}: {own} for {span}")
    rng = np.random.default_rng(0)
    compared = 0
    for step in range(5):
        q = model.joint_q.numpy().copy()
        none = {"spherical": np.eye(3)[None], "floating": np.eye(4)[None], "planar": np.zeros((1, 3))}
        values = {name: none.get(joint.get("type"), np.zeros(1)) for name, joint in ours.items()}
        for at, name in enumerate(joint_labels):
            if int(types[at]) in one:
                free = name in ours and ours[name].find("mimic") is None
                value = rng.uniform(-1, 1) if step and free else 0.0
                q[starts[at]] = value
                if name in values:
                    values[name] = np.array([value])
            elif int(types[at]) == int(newton.JointType.BALL):
                q[starts[at]:starts[at] + 4] = [0, 0, 0, 1]
            elif int(types[at]) == int(newton.JointType.D6):
                q[starts[at]:starts[at + 1]] = 0
        def value(name):
            mimic = ours[name].find("mimic")
            if mimic is None:
                return values[name][0]
            return float(mimic.get("multiplier", 1)) * value(mimic.get("joint")) + float(mimic.get("offset", 0))
        for at, name in enumerate(joint_labels):
            if int(types[at]) in one and name in ours:
                q[starts[at]] = value(name)
        state = model.state()
        newton.eval_fk(model, wp.array(q, dtype=wp.float32, device="cpu"), model.joint_qd, state)
        theirs = state.body_q.numpy()
        poses = urdf.poses(values, 1)
        root = urdf.root if urdf.root in common else (common[0] if common else None)
        if root is None:
            wrong.append("no body of one name")
            return 0
        # The rotation of the root, and its centre of mass.
        def seen(pose, centre, tensor):
            return pose[:3, :3] @ centre + pose[:3, 3], pose[:3, :3] @ tensor @ pose[:3, :3].T, pose[:3, :3]
        def theirs_of(name):
            at = labels.index(name)
            return mass[at], *seen(matrix(theirs[at]), com[at], inertia[at])
        def ours_of(name):
            weight, centre, tensor = urdf.inertial(name)
            return weight, *seen(poses[name][0], centre, tensor)
        _, from1, _, turn1 = theirs_of(root)
        _, from2, _, turn2 = ours_of(root)
        if mass[labels.index(root)] <= 0:
            from1, from2 = matrix(theirs[labels.index(root)])[:3, 3], poses[root][0][:3, 3]
        for name in common:
            (m1, c1, i1, r1), (m2, c2, i2, r2) = theirs_of(name), ours_of(name)
            compared += step == 0
            if m1 <= 1e-9 and m2 <= 2e-6:
                continue
            if abs(m1 - m2) > 1e-4 * max(m1, 1e-6):
                wrong.append(f"{name}: mass {m2} for {m1}")
                continue
            far = np.abs(turn1.T @ (c1 - from1) - turn2.T @ (c2 - from2)).max()
            if far > 2e-5 * max(1, np.abs(c1).max()):
                wrong.append(f"{name}: {far:.3g} m away in configuration {step}")
            turned = np.abs(turn1.T @ r1 - turn2.T @ r2).max()
            if turned > 2e-5:
                wrong.append(f"{name}: turned by {turned:.3g} in configuration {step}")
            one_, two_ = turn1.T @ i1 @ turn1, turn2.T @ i2 @ turn2
            if np.abs(one_ - two_).max() > 2e-3 * np.abs(one_).max():
                wrong.append(f"{name}: inertia {np.diag(two_)} for {np.diag(one_)}")
        if wrong:
            return compared
    return compared


def main():
    urdd, work = sys.argv[1], pathlib.Path(sys.argv[2])
    totals = dict(files=0, refused=0, unread=0, right=0, bodies=0)
    for path in map(pathlib.Path, sys.argv[3:]):
        totals["files"] += 1
        folder = work / f"{totals['files']}.{path.stem}"
        shutil.rmtree(folder, ignore_errors=True)
        done = subprocess.run([urdd, "import", str(path), "-o", str(folder)], capture_output=True, text=True)
        if done.returncode:
            totals["refused"] += 1
            print(f"{path}: {done.stderr.strip().splitlines()[-1][:200]}")
            continue
        wrong = []
        try:
            totals["bodies"] += compare(path, folder, wrong)
        except Exception as why:
            totals["unread"] += 1
            print(f"{path}: Newton: {type(why).__name__} {str(why)[:150]}")
            continue
        totals["right"] += not wrong
        for line in wrong[:5]:
            print(f"{path.name}: {line}")
    print(json.dumps(totals))


if __name__ == "__main__":
    main()

"""Takes MJCF to USD by mujoco-usd-converter of PyPI, imports that, and compares with MuJoCo's compiled model of the MJCF.

    python usd_mjcf.py URDD WORK FILE...

Of each body that has a name: masses, centres, inertias, the joints before it with types and limits, and its poses in 20
configurations, as seen from the root. Numbers of USD are binary32. Prints a line for each difference, and a count.
"""

import json
import pathlib
import shutil
import signal
import sys

import mujoco
import numpy as np

from compare import BALL, FREE, SLIDE, followers, robot
from kinematics import Urdf, floats, of_quaternion
from usd_round import limits, run

FAR, COUNT, SECONDS = 1e-4, 20, 120


def before(urdf, link, bodies):
    """The joints that move between a link and the body before it, the first one first; and that body."""
    found = []
    while link in urdf.into:
        joint = urdf.into[link]
        link = joint.find("parent").get("link")
        if joint.get("type") != "fixed":
            found.insert(0, joint)
        if link in bodies:
            break
    return found


def unsaid(path):
    """Bodies whose mass USD does not get: of 0, which is none there, of shapes that the
    converter leaves out or MuJoCo does not weigh, or of what has a total."""
    spec = mujoco.MjSpec.from_file(str(path))
    left = {mujoco.mjtGeom.mjGEOM_ELLIPSOID, mujoco.mjtGeom.mjGEOM_SDF, mujoco.mjtGeom.mjGEOM_HFIELD}
    low, high = spec.compiler.inertiagrouprange

    def is_unsaid(of):
        return of.mass == 0 or of.density == 0 or of.type in left or not low <= of.group <= high

    has_total = spec.compiler.settotalmass > 0
    return {body.name for body in spec.bodies if has_total or any(map(is_unsaid, body.geoms))}


def compare(model, urdf, without, wrong):
    links = set(urdf.bodies())
    bodies = robot(model, links)
    named = {model.body(body).name: body for body in bodies if model.body(body).name}
    if missing := sorted(set(named) - set(urdf.links)):
        wrong.append(f"bodies are missing: {missing[:5]} of {len(named)}")
        return 0
    if not named:
        return 0
    values, qpos = {}, np.tile(model.qpos0, (COUNT, 1))
    rng = np.random.default_rng(0)
    kinds = {BALL: ["spherical"], SLIDE: ["prismatic"]}
    joints = {}
    for name, body in named.items():
        first = model.body_jntadr[body]
        own = [j for j in range(first, first + model.body_jntnum[body]) if model.jnt_type[j] != FREE]
        ours = before(urdf, name, named)
        if len(ours) != len(own):
            wrong.append(f"body {name}: {len(ours)} joints for {len(own)}")
            return 0
        joints.update(zip(own, ours))
    for j, joint in joints.items():
        name, kind = joint.get("name"), joint.get("type")
        if kind not in kinds.get(model.jnt_type[j], ["revolute", "continuous"]):
            wrong.append(f"joint {name}: {kind} for {model.jnt_type[j]}")
            return 0
        at = model.jnt_qposadr[j]
        if model.jnt_type[j] == BALL:
            quaternions = rng.normal(size=(COUNT, 4))
            qpos[:, at:at + 4] = quaternions / np.linalg.norm(quaternions, axis=1)[:, None]
            values[name] = of_quaternion(qpos[:, at:at + 4])
            continue
        values[name] = qpos[:, at] = rng.uniform(-1, 1, COUNT)
        theirs, ours = model.jnt_range[j], limits(joint)
        if model.jnt_limited[j]:
            if ours is None or np.abs(theirs - ours).max() > FAR * max(1, np.abs(theirs).max()):
                wrong.append(f"joint {name}: limits {ours} for {theirs.tolist()}")
        elif kind == "revolute":
            wrong.append(f"joint {name}: limits {ours} for none")
    # What follows: as the URDF has it.
    following = {a: (b, data) for a, (b, data) in followers(model, joints).items()}
    for j, joint in joints.items():
        if (mimic := joint.find("mimic")) is not None:
            if j not in following:
                wrong.append(f"joint {joint.get('name')} follows")
                continue
            leader, data = following[j]
            own = [float(mimic.get("offset", 0)), float(mimic.get("multiplier", 1))]
            if joints[leader].get("name") != mimic.get("joint") or np.abs(data[:2] - own).max() > FAR:
                wrong.append(f"joint {joint.get('name')} follows by {own} for {data[:5].tolist()}")
    for _ in range(len(joints)):
        for j, joint in joints.items():
            if joint.find("mimic") is not None and j in following:
                leader, data = following[j]
                qpos[:, model.jnt_qposadr[j]] = values[joint.get("name")] = data[0] + data[1] * values[joints[leader].get("name")]
    # Those of bodies without names.
    for joint in urdf.moving:
        none = np.broadcast_to(np.eye(3), (COUNT, 3, 3)) if joint.get("type") == "spherical" else np.zeros(COUNT)
        values.setdefault(joint.get("name"), none)
    poses = urdf.poses(values, COUNT)
    theirs = np.zeros((COUNT, model.nbody, 4, 4))
    data = mujoco.MjData(model)
    for step in range(COUNT):
        data.qpos[:] = qpos[step]
        mujoco.mj_kinematics(model, data)
        theirs[step, :, 3, 3] = 1
        theirs[step, :, :3, :3] = data.xmat.reshape(-1, 3, 3)
        theirs[step, :, :3, 3] = data.xpos
    root = next(iter(named))
    ours_root = np.linalg.inv(poses[root])
    theirs_root = np.linalg.inv(theirs[:, named[root]])
    for name, body in named.items():
        # A link is where its joint turns.
        shift = np.linalg.inv(theirs_root @ theirs[:, body]) @ (ours_root @ poses[name])
        moved = shift[0, :3, 3]
        if np.abs(shift - shift[0]).max() > FAR or np.abs(shift[0, :3, :3] - np.eye(3)).max() > FAR:
            wrong.append(f"body {name} is {np.abs(shift - shift[0]).max():.3g} away")
            continue
        if name in without:
            continue
        mass, centre, inertia = urdf.inertial(name)
        axes = of_quaternion(model.body_iquat[body])
        expected = axes @ np.diag(model.body_inertia[body]) @ axes.T
        size = np.linalg.norm(model.body_ipos[body]) + np.sqrt(np.trace(expected) / max(model.body_mass[body], 1e-12))
        if abs(mass - model.body_mass[body]) > FAR * max(model.body_mass[body], 1e-9):
            wrong.append(f"body {name}: mass {mass} for {model.body_mass[body]}")
        elif mass > 0 and np.abs(centre + moved - model.body_ipos[body]).max() > FAR * max(size, 1):
            wrong.append(f"body {name}: centre {centre + moved} for {model.body_ipos[body]}")
        elif expected.any() and np.abs(inertia - expected).max() > 1e-3 * max(np.abs(expected).max(), 1e-12):
            wrong.append(f"body {name}: inertia {inertia.tolist()} for {expected.tolist()}")
    return len(named)


def late(*_):
    raise RuntimeError(f"more than {SECONDS} s")


def main():
    import mujoco_usd_converter

    urdd, work = sys.argv[1:3]
    signal.signal(signal.SIGALRM, late)
    totals = dict(models=0, compiled=0, converted=0, refused=0, right=0, bodies=0)
    for number, path in enumerate(map(pathlib.Path, sys.argv[3:])):
        totals["models"] += 1
        try:
            signal.alarm(SECONDS)
            model = mujoco.MjModel.from_xml_path(str(path))
            assert model.nbody > 1
        except Exception:
            continue
        totals["compiled"] += 1
        folder = pathlib.Path(work) / f"{number}_{path.stem}"
        shutil.rmtree(folder, ignore_errors=True)
        try:
            mujoco_usd_converter.Converter().convert(str(path), str(folder / "usd"))
            usd = sorted((folder / "usd").rglob("*.usd*"), key=lambda of: (len(of.parts), of))[0]
        except Exception as why:
            print(f"{path}: not converted: {(str(why).splitlines() or [repr(why)])[0][:200]}", flush=True)
            continue
        totals["converted"] += 1
        wrong = []
        try:
            run(urdd, "import", usd, "-o", folder / "back")
        except RuntimeError as why:
            totals["refused"] += 1
            print(f"{path}: refused: {why}", flush=True)
            continue
        try:
            totals["bodies"] += compare(model, Urdf(next((folder / "back").glob("*.urdf"))), unsaid(path), wrong)
        except Exception as why:
            wrong.append(f"not compared: {why!r}")
        totals["right"] += not wrong
        for line in wrong[:4]:
            print(f"{path}: {line}", flush=True)
        if not wrong:
            shutil.rmtree(folder, ignore_errors=True)
    signal.alarm(0)
    print(json.dumps(totals))


if __name__ == "__main__":
    main()

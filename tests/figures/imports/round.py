"""From MJCF to a URDD and back to MJCF: MuJoCo has the same poses, masses and contacts at rest.

    python3 tests/figures/imports/round.py target/release/urdd ROBOT.xml ...

Needs mujoco and numpy. For each file: `urdd import`, `urdd generate --geometry collision`, `urdd export mjcf`, and both models
in MuJoCo. Prints a line a robot: how far the poses of bodies are, relative to the root, in 20 random configurations (m, rad),
how far masses and inertias are (relative), and the pairs of bodies in contact at rest that only one of the two has. Exits
with 1 where a pose or a mass is off.
"""

import pathlib
import subprocess
import sys
import tempfile

import mujoco
import numpy as np

POSES = 1e-5  # Meshes and numbers of the second MJCF are of 32 bits in MuJoCo.
MASSES = 1e-5


def made(urdd, file, folder):
    """The MJCF that comes back."""
    run = lambda *words: subprocess.run([urdd, *words], check=True, capture_output=True, cwd=folder)  # noqa: E731
    run("import", str(file), "-o", "imported")
    (urdf,) = folder.glob("imported/*.urdf")
    run("generate", str(file), "-o", "robot", "--geometry", "collision")
    run("export", "mjcf", "robot", "-o", "back.xml")
    return urdf, folder / "back.xml"


def joints(model):
    kinds = (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE)
    return {model.joint(j).name: j for j in range(model.njnt) if model.jnt_type[j] in kinds}


def bodies(model):
    return {model.body(b).name: b for b in range(1, model.nbody)}


def inertia(model, body):
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, model.body_iquat[body])
    rotation = rotation.reshape(3, 3)
    return rotation @ np.diag(model.body_inertia[body]) @ rotation.T


def contacts(model, data, names):
    """Pairs of named bodies that touch; a shape of a body that the other model joined to its parent counts for that one."""

    def named(geom):
        body = model.geom_bodyid[geom]
        while body and model.body(body).name not in names:
            body = model.body_parentid[body]
        return model.body(body).name

    pairs = {frozenset((named(c.geom1), named(c.geom2))) for c in data.contact[: data.ncon]}
    return {pair for pair in pairs if len(pair) == 2 and "world" not in pair}


def compared(first, second, rng):
    datas = mujoco.MjData(first), mujoco.MjData(second)
    here, there = joints(first), joints(second)
    both = [name for name in bodies(first) if name in bodies(second)]
    root = both[0]
    worst = 0.0
    for turn in range(21):
        for name in (name for name in here if name in there):
            low, high = first.jnt_range[here[name]] if first.jnt_limited[here[name]] else (-1.0, 1.0)
            value = np.clip(0.0, low, high) if turn == 0 else rng.uniform(low, high)
            datas[0].qpos[first.jnt_qposadr[here[name]]] = value
            datas[1].qpos[second.jnt_qposadr[there[name]]] = value
        for model, data in zip((first, second), datas):
            mujoco.mj_forward(model, data)
        if turn == 0:
            names = set(both)
            touching = [contacts(model, data, names) for model, data in zip((first, second), datas)]
        for name in both:
            poses = []
            for model, data in zip((first, second), datas):
                at, of = data.body(root), data.body(name)
                turned = at.xmat.reshape(3, 3).T
                poses.append((turned @ (of.xpos - at.xpos), turned @ of.xmat.reshape(3, 3)))
            (p, r), (q, s) = poses
            cosine = np.clip((np.trace(r.T @ s) - 1) / 2, -1, 1)
            worst = max(worst, np.linalg.norm(p - q), np.arccos(cosine) if cosine < 1 - 1e-12 else 0.0)
    off = 0.0
    for name in both:
        a, b = bodies(first)[name], bodies(second)[name]
        if first.body_mass[a] < 1e-5 or set(children(first, a)) != set(children(second, b)):
            continue
        off = max(off, abs(first.body_mass[a] - second.body_mass[b]) / first.body_mass[a])
        one, two = inertia(first, a), inertia(second, b)
        off = max(off, np.abs(one - two).max() / max(np.abs(one).max(), 1e-9))
    return len(both), worst, off, touching


def children(model, body):
    return [model.body(b).name for b in range(model.nbody) if model.body_parentid[b] == body]


def main():
    urdd = str(pathlib.Path(sys.argv[1]).resolve())
    rng = np.random.default_rng(0)
    wrong = 0
    for file in map(pathlib.Path, sys.argv[2:]):
        with tempfile.TemporaryDirectory() as folder:
            try:
                _, back = made(urdd, file.resolve(), pathlib.Path(folder))
            except subprocess.CalledProcessError as error:
                print(f"{file}: {error.stderr.decode().splitlines()[-1][:200]}")
                wrong += 1
                continue
            first = mujoco.MjModel.from_xml_path(str(file))
            second = mujoco.MjModel.from_xml_path(str(back))
            count, poses, masses, (a, b) = compared(first, second, rng)
        is_wrong = poses > POSES or masses > MASSES
        wrong += is_wrong
        pairs = lambda of: ", ".join(sorted("-".join(sorted(pair)) for pair in of)) or "none"  # noqa: E731
        print(
            f"{'WRONG ' if is_wrong else ''}{file.parent.name}/{file.name}: {count} bodies, poses {poses:.1e}, "
            f"masses {masses:.1e}, contacts lost: {pairs(a - b)}; new: {pairs(b - a)}"
        )
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())

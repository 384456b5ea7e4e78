"""Converts MJCF models with converters of PyPI, and says how far the poses of bodies are from MuJoCo's.

    pip install mujoco==4.0.0 numpy scipy numpy-stl pybullet==3.2.7 mjcf-urdf-simple-converter==0.7.3 mjcf2urdf==0.0.1
    python3 tests/figures/imports/peers.py FOLDER [--only REGEX]

A model counts as right where all bodies that MuJoCo names are links, and their poses in 20 random configurations are MuJoCo's
to 1e-5 m and rad, seen from the first body; joints go by their names. mjcf2urdf is what PyBullet reads of an MJCF.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

import mujoco
import numpy as np

from kinematics import Urdf, of_quaternion
from mjcf import models

COUNT, NEAR, SECONDS = 20, 1e-5, 120
CALLS = {
    "mjcf-urdf-simple-converter": "from mjcf_urdf_simple_converter import convert; convert(sys.argv[1], sys.argv[2] + '/r.urdf')",
    "mjcf2urdf": "from mjcf2urdf.core import convert_mjcf_to_urdf; convert_mjcf_to_urdf(sys.argv[1], sys.argv[2])",
}


def far(model, folder):
    """The greatest difference of poses; None if bodies are missing."""
    urdfs = [Urdf(path) for path in sorted(folder.glob("*.urdf"))]
    named = {model.body(body).name: body for body in range(1, model.nbody) if model.body(body).name}
    greatest, seen = 0.0, set()
    random = np.random.default_rng(5)
    for urdf in urdfs:
        here = [name for name in named if name in urdf.links]
        seen.update(here)
        if not here:
            continue
        qpos = np.tile(model.qpos0, (COUNT, 1))
        values = {}
        for element in urdf.moving:
            values[element.get("name")] = np.zeros(COUNT)
        for joint in range(model.njnt):
            at, name = model.jnt_qposadr[joint], model.joint(joint).name
            if model.jnt_type[joint] in (2, 3):
                low, high = model.jnt_range[joint] if model.jnt_limited[joint] else (-1.0, 1.0)
                qpos[:, at] = random.uniform(low, high, COUNT)
                if name in values:
                    values[name] = qpos[:, at]
        found = urdf.poses(values, COUNT)
        data = mujoco.MjData(model)
        for turn in range(COUNT):
            data.qpos[:] = qpos[turn]
            mujoco.mj_kinematics(model, data)
            pose = {}
            for name in here:
                matrix = np.eye(4)
                matrix[:3, :3], matrix[:3, 3] = data.xmat[named[name]].reshape(3, 3), data.xpos[named[name]]
                pose[name] = matrix
            first = here[0]
            for name in here:
                a = np.linalg.inv(found[first][turn]) @ found[name][turn]
                b = np.linalg.inv(pose[first]) @ pose[name]
                greatest = max(greatest, np.abs(a - b).max())
    return greatest if seen == set(named) else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only")
    given = parser.parse_args()
    table = {name: collections.Counter() for name in CALLS}
    for path in models(given.folder, given.only):
        try:
            model = mujoco.MjModel.from_xml_path(str(path))
        except ValueError:
            continue
        if model.njnt == 0:
            continue
        for name, call in CALLS.items():
            with tempfile.TemporaryDirectory() as folder:
                command = [sys.executable, "-c", "import sys; " + call, str(path), folder]
                of = table[name]
                of["models"] += 1
                try:
                    run = subprocess.run(command, capture_output=True, timeout=SECONDS)
                    converts = run.returncode == 0 and any(pathlib.Path(folder).glob("*.urdf"))
                    found = far(model, pathlib.Path(folder)) if converts else None
                    state = "right" if found is not None and found <= NEAR else "far" if found is not None else "bodies missing"
                    of["converts"] += converts
                    if converts:
                        of[state] += 1
                except Exception as error:
                    of["no URDF that can be read"] += 1
                    state, found = repr(error)[:80], None
                print(json.dumps({"model": path.name, "peer": name, "state": state if run.returncode == 0 else "fails", "far": found}), flush=True)
    for name, of in table.items():
        print(name, dict(of))


if __name__ == "__main__":
    main()

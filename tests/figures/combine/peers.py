"""Holds robots that `urdd combine` puts together to Pinocchio, which reads the URDF that they carry, and times it.

    pip install pin==4.1.0 numpy
    cargo build --release
    python3 tests/figures/combine/peers.py target/release/urdd WORKPLACE ROBOT.urdf...

The URDFs become URDDs in WORKPLACE. Then each is put together with the next: on a base that floats, by a fixed, a
revolute, a continuous and a prismatic joint in turn. Poses of all links at the URDD's own kinematics samples beside
Pinocchio's: exits with 1 where one differs by more than 1e-9. Processor time of `urdd combine` beside that of
`urdd generate` of the URDF that was put together.
"""

import json
import pathlib
import resource
import shutil
import subprocess
import sys

import numpy as np
import pinocchio as pin

TOLERANCE = 1e-9
LIMIT = "limit = { lower = -1, upper = 1, effort = 1, velocity = 1 }"


def seconds(arguments):
    """Processor time of a program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def document(urdd, module):
    return json.loads((urdd / module / "module.json").read_text())


def configuration(model, urdd, q):
    """Pinocchio's configuration vector."""
    dof = document(urdd, "dof_module")
    theirs = pin.neutral(model)
    for index, joint in enumerate(document(urdd, "urdf_module")["joints"]):
        if not model.existJointName(joint["name"]):
            continue
        place = model.joints[model.getJointId(joint["name"])].idx_q
        dofs = dof["joint_idx_to_dof_idxs_mapping"][index]
        mimic = dof["joint_idx_to_mimic_mapping"][index]
        values = [q[d] for d in dofs]
        if mimic:
            driver = 0.0 if mimic["dof_idx"] is None else q[mimic["dof_idx"]]
            values = [mimic["multiplier"] * driver + mimic["offset"]]
        kind = joint["joint_type"]
        if kind in ("Revolute", "Prismatic"):
            theirs[place] = values[0]
        elif kind == "Continuous":
            theirs[place : place + 2] = np.cos(values[0]), np.sin(values[0])
        elif kind == "Floating":
            rotation = pin.Quaternion(pin.exp3(np.array(values[3:])))
            theirs[place : place + 7] = [*values[:3], *rotation.coeffs()]
        else:
            raise SystemExit(f"{joint['name']}: Pinocchio reads no {kind} joint")
    return theirs


def worst(urdd):
    name = json.loads((urdd / "urdd.json").read_text())["source"]["Urdf"]["path"]
    model = pin.buildModelFromUrdf(str(urdd / name))
    data = model.createData()
    links = [link["name"] for link in document(urdd, "urdf_module")["links"]]
    found = 0.0
    samples = document(urdd, "kinematics_samples_module")["samples"]
    for sample in samples:
        pin.framesForwardKinematics(model, data, configuration(model, urdd, sample["configuration"]))
        for link, pose in zip(links, sample["link_poses"]):
            theirs = data.oMf[model.getFrameId(link, pin.FrameType.BODY)]
            w, x, y, z = pose["quaternion_wxyz"]
            rotation = pin.Quaternion(w, x, y, z).toRotationMatrix()
            found = max(found, np.abs(theirs.rotation - rotation).max())
            found = max(found, np.abs(theirs.translation - pose["position"]).max())
    return len(links), len(samples), found


def main():
    program, workplace, *urdfs = sys.argv[1:]
    workplace = pathlib.Path(workplace)
    workplace.mkdir(parents=True, exist_ok=True)
    names = []
    for urdf in map(pathlib.Path, urdfs):
        names.append(urdf.stem)
        seconds([program, "generate", str(urdf), "-o", str(workplace / urdf.stem)])
    failed = False
    kinds = ["fixed", "revolute", "continuous", "prismatic"]
    for place, (holder, held) in enumerate(zip(names, names[1:] + names[:1])):
        link = document(workplace / holder, "urdf_module")["links"][-1]["name"]
        kind = kinds[place % len(kinds)]
        recipe = workplace / f"{holder}_and_{held}.toml"
        recipe.write_text(
            f'[base]\nlink = "the base of all"\njoint = "floating"\n[[part]]\nid = "a"\nsource = "{holder}"\nprefix = ""\n'
            f'[[part]]\nid = "b"\nsource = "{held}"\nattach = {{ to = {json.dumps("a/" + link)}, joint = "{kind}", '
            f"xyz = [0.1, 0.2, 0.3], rpy = [0.4, -0.5, 0.6], axis = [1, 2, 2], {LIMIT} }}\n"
        )
        target = workplace / recipe.stem
        again = workplace / f"{recipe.stem}_from_nothing"
        for folder in (target, again):
            shutil.rmtree(folder, ignore_errors=True)
        combined = seconds([program, "combine", str(recipe), "-o", str(target)])
        nothing = seconds([program, "generate", str(target / f"{recipe.stem}.urdf"), "-o", str(again)])
        links, samples, off = worst(target)
        failed |= not off < TOLERANCE
        print(
            f"{recipe.stem}: {links} links, {samples} configurations, worst {off:.1e}; "
            f"{combined:.2f} s beside {nothing:.2f} s from nothing: {combined / nothing:.2f}",
            flush=True,
        )
    sys.exit(failed)


if __name__ == "__main__":
    main()

"""Holds poses and Jacobians of all links, and gravity torques, to Pinocchio's, to 1e-9.

    python3 -m venv /tmp/peers && /tmp/peers/bin/pip install pin example-robot-data
    cargo build --release && cargo bench --bench kinematics --no-run     # prints the path of the bench
    /tmp/peers/bin/python tests/figures/kinematics_pinocchio.py target/release/urdd BENCH URDD...

A URDD may be `example-robot-data:NAME` too. Robots with joints of several degrees of freedom are left to the tests.
"""

import json
import os
import subprocess
import sys
import tempfile

import numpy
import pinocchio

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "benches"))
from proximity_coal import Robot, made  # noqa: E402

TOLERANCE = 1e-9


def main() -> None:
    program, bench, *urdds = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        for urdd in urdds:
            path = made(program, urdd, folder)
            command = [bench, "--json", path]
            lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            compare(Robot(path), [json.loads(line) for line in lines.splitlines()])


def compare(robot: Robot, answers) -> None:
    model, data = robot.model, robot.model.createData()
    columns = of_dofs(robot)
    worst = {"position": 0.0, "rotation": 0.0, "Jacobian": 0.0, "gravity": 0.0}
    assert answers
    for answer in answers:
        q = robot.configuration(answer["values"])
        expected = pinocchio.computeGeneralizedGravity(model, data, q) @ columns
        off = numpy.abs(answer["gravity_torques"] - expected).max(initial=0.0)
        worst["gravity"] = max(worst["gravity"], off / numpy.abs(expected).max(initial=1.0))
        pinocchio.computeJointJacobians(model, data, q)
        pinocchio.updateFramePlacements(model, data)
        for link in answer["links"]:
            frame = model.getFrameId(link["link"])
            theirs = data.oMf[frame]
            ours = pinocchio.XYZQUATToSE3(numpy.array(link["pose"]))
            off = numpy.abs(ours.translation - theirs.translation).max()
            worst["position"] = max(worst["position"], off)
            worst["rotation"] = max(worst["rotation"], numpy.abs(ours.rotation - theirs.rotation).max())
            along = pinocchio.ReferenceFrame.LOCAL_WORLD_ALIGNED
            expected = pinocchio.getFrameJacobian(model, data, frame, along) @ columns
            found = numpy.array(link["jacobian"]).reshape(-1, 6).T
            worst["Jacobian"] = max(worst["Jacobian"], numpy.abs(found - expected).max())
    links = len(answers[0]["links"])
    text = ", ".join(f"{what} {off:.1e}" for what, off in worst.items())
    print(f"{os.path.basename(robot.root)}: {links} links, {len(answers)} configurations; worst: {text}")
    assert max(worst.values()) < TOLERANCE, worst


def of_dofs(robot: Robot) -> numpy.ndarray:
    """How the velocities of Pinocchio's joints follow from those of our DOFs."""
    columns = numpy.zeros((robot.model.nv, robot.dof["num_dofs"]))
    for index, joint in enumerate(robot.chain["joints_in_chain"]):
        number = robot.model.getJointId(joint["joint_name"])
        dofs = robot.dof["joint_idx_to_dof_idxs_mapping"][index]
        mimic = robot.dof["joint_idx_to_mimic_mapping"][index]
        if number >= robot.model.njoints or not (dofs or mimic):
            continue
        row = robot.model.joints[number].idx_v
        if not mimic:
            (dof,) = dofs
            columns[row, dof] = 1.0
        elif mimic["dof_idx"] is not None:
            columns[row, mimic["dof_idx"]] = mimic["multiplier"]
    return columns


if __name__ == "__main__":
    main()

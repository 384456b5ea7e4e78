"""Inverse kinematics: damped least squares by the Jacobian, within joint limits, in a dozen lines; and `robot.ik`,
which also starts again where that is stuck.

    python inverse_kinematics.py URDD LINK        such as welding_arm tool_center_point
"""

import sys

import numpy as np

import urdd


def solve(robot, link, target, q, damping=1e-2, steps=500):
    """A configuration in which `link` is at `target` (4, 4), searched from `q`."""
    for _ in range(steps):
        pose = robot.link_pose(q, link)
        turn = target[:3, :3] @ pose[:3, :3].T
        axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
        error = np.concatenate([target[:3, 3] - pose[:3, 3], axis])
        if np.linalg.norm(error) < 1e-9:
            break
        jacobian = robot.jacobian(q, link)
        square = jacobian @ jacobian.T + damping**2 * np.linalg.norm(error) * np.eye(6)
        q = robot.clamp(q + jacobian.T @ np.linalg.solve(square, error))
    return q, float(np.linalg.norm(error))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    robot = urdd.load(sys.argv[1])
    link = sys.argv[2]
    wanted = robot.random(seed=3)
    target = robot.link_pose(wanted, link)
    nearby = robot.clamp(wanted + 0.1)

    q, error = solve(robot, link, target, nearby)
    print(f"a dozen lines: error {error:.1e}, q = {np.round(q, 4)}")

    found = robot.inverse_kinematics(link, target)
    print(f"robot.ik:      reached {found.reached}, {found.position_error:.1e} m, {found.rotation_error:.1e} rad")

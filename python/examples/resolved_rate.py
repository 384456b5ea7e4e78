"""Moves a link toward a position step by step, and keeps a distance from obstacles and between links by gradients.

python resolved_rate.py URDD LINK X Y Z [--show]

Each step is the velocity of the joints that moves the link straight to the position, as far as no distance shrinks
faster than it may. Prints the configurations as CSV. With --show, the page moves along.
"""

import sys
import time
from contextlib import nullcontext

import numpy as np

import urdd

STEP = 1 / 60  # s
SPEED = 0.5  # of the link, m/s
MARGIN = 0.02  # the distance that is kept, m; links that are nearer at first do not come nearer
NEAREST = 8  # pairs of each kind that are considered


def constraints(checks, q, margins):
    """Rows g and least values b of g @ dq >= b, for one step."""
    for check, margin in zip(checks, margins, strict=True):
        for found in check.gradients(q, NEAREST):
            if found.gradient is None:
                raise SystemExit("the robot collides")
            yield found.gradient, min(margin - found.distance, 0.0)


def step(robot, checks, margins, q, link, target):
    shift = target - robot.link_pose(q, link)[:3, 3]
    far = np.linalg.norm(shift)
    jacobian = robot.jacobian(q, link)[:3]
    damped = jacobian @ jacobian.T + 1e-6 * np.eye(3)
    change = jacobian.T @ np.linalg.solve(damped, shift * min(1, SPEED * STEP / far))
    rows = list(constraints(checks, q, margins))
    # Onto the half-space of each constraint that does not hold, in turn.
    for _ in range(100):
        left = [(gradient, least - gradient @ change) for gradient, least in rows]
        left = [(gradient, missing) for gradient, missing in left if missing > 1e-9 and gradient.any()]
        if not left:
            break
        for gradient, _ in left:
            missing = next(least for own, least in rows if own is gradient) - gradient @ change
            change = change + max(missing, 0) * gradient / (gradient @ gradient)
    else:
        change = 0 * change
    return np.clip(q + change, *robot.bounds.T)


def main():
    robot, link = urdd.load(sys.argv[1]), sys.argv[2]
    target = np.array([float(word) for word in sys.argv[3:6]])
    world = urdd.World()
    world.add_sphere("ball", radius=0.1, centre=(robot.link_pose(robot.zero, link)[:3, 3] + target) / 2)
    checks = [robot.proximity(), robot.world_proximity(world)]
    q = next(
        q for q in [robot.zero, *robot.random(1000)] if not any(check.is_within(q, MARGIN / 4) for check in checks)
    )
    # Neighbours may be nearer to each other than the margin.
    margins = [min(MARGIN, float(check.distances(q).min(initial=np.inf)) / 2) for check in checks]
    print(",".join(robot.dof_names))
    with robot.show(q) if "--show" in sys.argv else nullcontext() as shown:
        for _ in range(1200):
            before = q
            q = step(robot, checks, margins, q, link, target)
            print(",".join(f"{value:.9g}" for value in q))
            if shown:
                shown.set(q)
                time.sleep(STEP)
            if np.abs(q - before).max() < 1e-6:
                break
    left = np.linalg.norm(target - robot.link_pose(q, link)[:3, 3])
    print(f"{left:.3f} m from the target", file=sys.stderr)


if __name__ == "__main__":
    main()

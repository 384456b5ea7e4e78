"""Random configurations in which the robot does not collide with itself, as CSV.

python collision_free.py URDD [COUNT] > free.csv
"""

import sys

import numpy as np

import urdd

robot = urdd.load(sys.argv[1])
wanted = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
found = np.empty((0, robot.num_dofs))
for seed in range(100):
    q = robot.random(wanted, seed)
    found = np.concatenate([found, q[~robot.in_collision(q)]])[:wanted]
    if len(found) == wanted:
        break
np.savetxt(sys.stdout, found, delimiter=",", header=",".join(robot.dof_names), comments="", fmt="%.17g")
print(f"{len(found)} of {wanted} configurations, {seed + 1} batches", file=sys.stderr)

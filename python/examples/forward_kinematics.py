"""Where the links of a robot are.

python forward_kinematics.py URDD
"""

import sys

import urdd

robot = urdd.load(sys.argv[1])
for link, pose in zip(robot.link_names, robot.link_poses(robot.middle), strict=True):
    x, y, z = pose[:3, 3]
    print(f"{link:24} {x:8.4f} {y:8.4f} {z:8.4f} m")

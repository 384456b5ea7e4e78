"""Distances to obstacles: what is near a robot, and configurations without collisions with obstacles or with itself.

python obstacles.py URDD [COUNT]
"""

import sys

import numpy as np

import urdd

robot = urdd.load(sys.argv[1])
count = int(sys.argv[2]) if len(sys.argv) > 2 else 1000

world = urdd.World()
# The root link is mounted on the table.
world.add_box("table", size=[2.0, 2.0, 0.1], pose=[0.0, 0.0, -0.05], ignore=[robot.root_link])
world.add_capsule("lamp", radius=0.05, length=1.0, pose=[0.5, 0.5, 0.5])
world.add_sphere("ball", radius=0.1, centre=[0.6, 0.0, 0.4])
around = robot.world_proximity(world)

print(f"{'link':20} {'obstacle':10} {'distance, m':>12}   at")
for pair in around.nearest(robot.zero, 5):
    place = ", ".join(f"{x:.3f}" for x in pair.points[1])
    print(f"{pair.link:20} {pair.obstacle:10} {pair.distance:12.4f}   {place}")

q = robot.random(count)
hit, folded = around.in_collision(q), robot.in_collision(q)
print(f"{np.mean(hit):.1%} of {count} touch an obstacle, {np.mean(folded):.1%} the robot itself")
free = q[~(hit | folded)]
# Minimum distance to obstacles, and between the robot's own links.
clearance = np.minimum(around.min_distance(free), robot.self_distance(free))
print(f"{len(free)} are free; the one with most room has {clearance.max(initial=0.0):.3f} m")

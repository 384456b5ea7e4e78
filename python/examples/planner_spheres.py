"""Spheres for a planner: where the spheres about all pieces are in many configurations, and how far each configuration
is from an obstacle, a sphere too, by arrays alone.

    python planner_spheres.py URDD
"""

import sys

import numpy as np

import urdd

robot = urdd.load(sys.argv[1])
spheres = robot.spheres("pieces")
links = [robot.link(link) for link in spheres.links]

q = robot.random(1000)
poses = robot.link_poses(q)[:, links]  # (1000, spheres, 4, 4)
centres = (poses[..., :3, :3] @ spheres.centres[..., None])[..., 0] + poses[..., :3, 3]  # (1000, spheres, 3)

obstacle, radius = np.array([0.6, 0.0, 0.5]), 0.1
distances = np.linalg.norm(centres - obstacle, axis=-1) - spheres.radii - radius  # (1000, spheres)
print(f"{len(spheres.radii)} spheres; {(distances.min(axis=1) > 0).sum()} of {len(q)} configurations are clear")

#!/usr/bin/env python3
"""Compares the boxes and spheres of a generated URDD with trimesh's boxes and with certified smallest balls.

    /opt/peers/bin/python tests/figures/geometry/boxes_and_spheres.py URDD...

For every link with a plain mesh:
- box: its volume over that of trimesh's `bounding_box_oriented` of the plain mesh. Goal: at most 1.0001.
- sphere: its radius over a bound that no enclosing ball can be below. Weights w >= 0 of sum 1 on points p give the bound
  sum w |p|^2 - |sum w p|^2 <= r^2 (the Lagrangian dual of the smallest ball). Weights come from scipy's nnls on the
  points near the sphere; the better they are, the higher the bound, and a wrong one can only make it lower.
  Goal: at most 1 + 1e-6.
- both hold every vertex of the plain mesh, to 1e-6 of the mesh's size (vertices are binary32).
"""

import sys

import numpy as np
import trimesh
from scipy.optimize import nnls

from urdd import Urdd, indexed, rotation

BOX_GOAL, SPHERE_GOAL, OUTSIDE_GOAL = 1.0001, 1 + 1e-6, 1e-6


def least_radius(points, centre, radius):
    """A radius that every ball around the points has at least."""
    points = (points - centre) / radius
    distance = np.linalg.norm(points, axis=1)
    best = 0.0
    for window in (1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6):
        near = points[distance > distance.max() - window]
        weights, _ = nnls(np.vstack([near.T, np.ones(len(near))]), np.array([0, 0, 0, 1.0]))
        weights /= weights.sum()
        best = max(best, weights @ (near * near).sum(1) - ((weights @ near) ** 2).sum())
    return radius * np.sqrt(best)


def compare(root):
    urdd = Urdd(root)
    shapes = urdd.document("link_shapes_approximations_module")
    names = [link.get("name") for link in urdd.urdf().findall("link")]
    boxes, spheres = [], []
    out_of_box = out_of_sphere = (-np.inf, "")
    for idx, plain in enumerate(urdd.document("plain_meshes_module")["link_meshes"]):
        if plain is None:
            continue
        vertices, faces = indexed(urdd.triangles(plain["files"]["stl"]))
        size = np.ptp(vertices, axis=0).max()

        box = shapes["full_obbs"][idx]
        half = np.array(box["half_extents"])
        local = (vertices - box["offset_xyz"]) @ rotation(np.array(box["offset_rpy"]))
        out_of_box = max(out_of_box, ((np.abs(local) - half).max() / size, names[idx]))
        theirs = trimesh.Trimesh(vertices, faces, process=False).bounding_box_oriented.volume
        boxes.append((8 * half.prod() / theirs, names[idx]))

        sphere = shapes["full_bounding_spheres"][idx]
        centre, radius = np.array(sphere["offset_xyz"]), sphere["radius"]
        out_of_sphere = max(out_of_sphere, ((np.linalg.norm(vertices - centre, axis=1).max() - radius) / size, names[idx]))
        spheres.append((radius / least_radius(vertices, centre, radius), names[idx]))
    ratios = np.array([ratio for ratio, _ in boxes])
    good = (max(boxes)[0] <= BOX_GOAL and max(spheres)[0] <= SPHERE_GOAL
            and max(out_of_box[0], out_of_sphere[0]) <= OUTSIDE_GOAL)
    print(f"{urdd.metadata['robot_name']:16} links {len(boxes):3}  box / trimesh: worst {max(boxes)[0]:.6f} ({max(boxes)[1]}), mean {ratios.mean():.4f},"
          f" least {min(boxes)[0]:.4f}; sphere / bound - 1: worst {max(spheres)[0] - 1:.1e};"
          f" outside the box {out_of_box[0]:.1e}, the sphere {out_of_sphere[0]:.1e} of the size"
          f"  {'good' if good else 'NOT WITHIN THE GOALS'}", flush=True)
    return good


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(not all([compare(root) for root in sys.argv[1:]]))

#!/usr/bin/env python3
"""Measures the convex pieces of a generated URDD against its plain meshes: how many, whether they cover, how fat they are.

    /opt/peers/bin/python tests/figures/geometry/pieces.py URDD... [--samples N] [--legacy]

For every link with a plain mesh, in millimetres:
- outside: the farthest that a point of the link's surface (4 N by area, and up to 20,000 corners) lies outside the union of
  the pieces. Goal: at most the `surface_tolerance` that the module states.
- fat: N points on the pieces, by area; of those on the outer surface of the union, the distance to the link's surface; mean and
  95th percentile. Outer: lifted by 0.3 mm in no piece (a narrower gap is no outer surface), lifted by 0.01 mm not inside the
  link (pieces touch it nearly everywhere), and some ray of 60 gets out of the pieces. No goal; README.md compares peers.
Links count as solid where at least 0.6 of the pieces' volume is inside the link, else as hollow: fat means little on a shell that
is open. A URDD's figures are the largest `outside` and the means of `fat` over its solid and over its hollow links.

Inside a link: most of 7 rays leave through the back of a triangle (Embree by trimesh). Distances to surfaces are
coal's, of a point. --legacy reads published URDDs of versions 0.0.x, of which the paths are relative to the folder above.
"""

import argparse
import json
import pathlib
import sys

import coal
import numpy as np
import trimesh

from urdd import Urdd, indexed, planes

LIFT, TOUCH, SOLID = 3e-4, 1e-5, 0.6
DIRECTIONS = np.array([[1, 0.013, 0.027], [-1, 0.021, 0.017], [0.011, 1, 0.023], [0.017, -1, 0.029],
                       [0.019, 0.031, 1], [0.007, 0.037, -1], [0.6, 0.61, 0.57]])


class Surface:
    """Triangles, for the distance of points to the nearest of them."""

    POINT, HERE = coal.Sphere(0.0), coal.Transform3s.Identity()

    def __init__(self, triangles):
        vertices, faces = indexed(triangles)
        self.bvh = coal.BVHModelOBBRSS()
        self.bvh.beginModel(len(faces), len(vertices))
        self.bvh.addVertices(vertices)
        self.bvh.addTriangles(faces.astype(np.int64))
        self.bvh.endModel()
        self.request = coal.DistanceRequest()
        self.request.gjk_tolerance = 1e-9  # of itself 1e-6

    def distance(self, point):
        there = coal.Transform3s(np.eye(3), point)
        found = coal.distance(self.bvh, self.HERE, self.POINT, there, self.request, coal.DistanceResult())
        return max(found, 0.0)


class Link:
    """The link's closed surface, for `inside`."""

    def __init__(self, triangles):
        vertices, faces = indexed(triangles)
        self.mesh = trimesh.Trimesh(vertices, faces, process=False)
        corners = triangles - triangles[0, 0]
        self.turned = np.einsum("ij,ij->i", np.cross(corners[:, 0], corners[:, 1]), corners[:, 2]).sum() < 0

    def inside(self, points):
        votes = np.zeros(len(points), int)
        if not len(points):
            return votes > 3
        for direction in DIRECTIONS:
            direction = direction / np.linalg.norm(direction)
            first = self.mesh.ray.intersects_first(points, np.tile(direction, (len(points), 1)))
            normals = self.mesh.face_normals[first]
            votes += (first >= 0) & ((normals @ direction > 0) != self.turned)
        return votes > 3


def sample(triangles, count, rng):
    """Points by area, with unit normals."""
    a, ab, ac = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normals = np.cross(ab, ac)
    area = np.linalg.norm(normals, axis=1)
    k = np.searchsorted(np.cumsum(area) / area.sum(), rng.random(count)).clip(max=len(area) - 1)
    uv = rng.random((count, 2))
    uv = np.where(uv.sum(1, keepdims=True) > 1, 1 - uv, uv)
    return a[k] + ab[k] * uv[:, :1] + ac[k] * uv[:, 1:], normals[k] / np.maximum(area[k], 1e-300)[:, None]


def height(piece, points):
    """How far outside of the farthest plane; not above 0 inside."""
    normals, offsets = piece
    return np.concatenate([(part @ normals.T - offsets).max(1) for part in np.array_split(points, len(points) // 2000 + 1)])


def seen(pieces, points, rng):
    """Whether some ray of 60 gets out of the pieces."""
    direction = rng.normal(size=(60, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    blocked = np.zeros((len(points), 60), bool)
    for normals, offsets in pieces:
        h, s = points @ normals.T - offsets, direction @ normals.T
        for k in range(60):
            # A ray meets a convex body where it enters all half-spaces before it leaves one.
            with np.errstate(divide="ignore", invalid="ignore"):
                at = -h / s[k]
            enter = np.where(s[k] < 0, at, 0).max(1).clip(min=0)
            leave = np.where(s[k] > 0, at, np.inf).min(1)
            blocked[:, k] |= (enter <= leave) & ~((s[k] == 0) & (h > 0)).any(1)
    return ~blocked.all(1)


def distances(plain, pieces, samples, rng):
    """How far the link's surface lies outside of the pieces at most; how far points of their outer surface stand off it. Metres."""
    bodies = [planes(p) for p in pieces]
    surfaces = [Surface(p) for p in pieces]
    probes = np.concatenate([plain[:: len(plain) // 20000 + 1, 0], sample(plain, 4 * samples, rng)[0]])
    least = np.min([height(b, probes) for b in bodies], axis=0)
    outside = max([min(s.distance(p) for s in surfaces) for p in probes[least > 0]], default=0.0)

    link, points_of = Link(plain), Surface(plain)
    points, normals = sample(np.concatenate(pieces), samples, rng)
    lifted = points + LIFT * normals
    outer = np.min([height(b, lifted) for b in bodies], axis=0) >= 0
    points, lifted, normals = points[outer], lifted[outer], normals[outer]
    outer = ~link.inside(points + TOUCH * normals)
    points, lifted = points[outer], lifted[outer]
    points = points[seen(bodies, lifted, rng)]
    return outside, np.array([points_of.distance(p) for p in points]) if len(points) else np.zeros(1)


def measure(plain, pieces, samples, rng):
    """(outside, fat mean, fat p95, share of the pieces' volume inside the link); lengths in metres."""
    outside, fat = distances(plain, pieces, samples, rng)
    link, bodies = Link(plain), [planes(p) for p in pieces]
    within = solid = 0
    for triangles, body in zip(pieces, bodies):
        low, high = triangles.reshape(-1, 3).min(0), triangles.reshape(-1, 3).max(0)
        p = rng.uniform(low, high, (max(samples // 4 // len(pieces), 20), 3))
        p = p[height(body, p) < 0]
        within, solid = within + len(p), solid + link.inside(p).sum()
    return outside, fat.mean(), np.quantile(fat, 0.95), solid / max(within, 1)


def generated(root):
    """(name, tolerance, [(plain triangles, pieces' triangles)])"""
    urdd = Urdd(root)
    decomposition = urdd.document("convex_decomposition_meshes_module")
    rows = zip(urdd.document("plain_meshes_module")["link_meshes"], decomposition["link_pieces"], strict=True)
    links = [(urdd.triangles(m["files"]["stl"]), [urdd.triangles(p["stl"]) for p in ps]) for m, ps in rows if m]
    return urdd.metadata["robot_name"], decomposition["method"]["surface_tolerance"], links


def published(root):
    root = pathlib.Path(root)
    lists = []
    for module in ("plain_meshes_module", "convex_decomposition_meshes_module"):
        document = json.loads((root / "mesh_modules" / module / "module.json").read_text())
        lists.append(next(value for key, value in document.items() if key.startswith("stl_")))
    read = lambda path: trimesh.load(root.parent / path, process=False).triangles.view(np.ndarray).astype(float)
    links = [(read(m[0] if isinstance(m, list) else m), [read(p) for p in ps]) for m, ps in zip(*lists, strict=True) if m]
    return f"{root.name}, published", None, links


def compare(root, samples, legacy):
    name, tolerance, links = (published if legacy else generated)(root)
    rng = np.random.default_rng(7)
    rows = np.array([measure(plain, pieces, samples, rng) for plain, pieces in links])
    outside, solid = rows[:, 0].max(), rows[:, 3] >= SOLID
    mean = lambda some: "{:6.3f} {:6.3f}".format(*(1e3 * rows[some, 1:3].mean(0))) if some.any() else "     -      -"
    good = tolerance is None or outside <= tolerance * (1 + 1e-3)
    print(f"{name:16} pieces {sum(len(p) for _, p in links):4}  outside {1e3 * outside:6.3f} mm  fat mean, p95 (mm):"
          f" solid {solid.sum():2} links {mean(solid)}, hollow {(~solid).sum():2} {mean(~solid)}"
          f"  {'' if tolerance is None else 'good' if good else 'NOT WITHIN THE GOALS'}", flush=True)
    return good


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("urdds", nargs="+")
    parser.add_argument("--samples", type=int, default=2000)
    parser.add_argument("--legacy", action="store_true")
    arguments = parser.parse_args()
    sys.exit(not all([compare(root, arguments.samples, arguments.legacy) for root in arguments.urdds]))

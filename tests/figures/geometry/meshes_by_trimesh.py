#!/usr/bin/env python3
"""Compares the plain meshes of a generated URDD with trimesh's reading of the original files.

    /opt/peers/bin/python tests/figures/geometry/meshes_by_trimesh.py URDD...

For every link whose plain mesh was made from meshes only: each file that the carried URDF names is loaded by trimesh,
scaled, and placed by its `origin`; bounds and area of all of them together are compared with the link's plain .stl.
COLLADA lengths are multiplied by the file's `unit` and its `up_axis` is ignored, as src/geometry/read/mod.rs says
(trimesh does the second, and leaves the first out). Links with primitives are counted and not compared: how a cylinder
is cut into triangles is free.

Goals: bounds within 1e-6 of the link's size (binary32 files), area within 1e-5 of itself.
"""

import logging
import re
import sys
import warnings

import numpy as np
import trimesh

from urdd import Urdd, numbers, rotation

logging.disable(logging.CRITICAL)
warnings.simplefilter("ignore")
BOUNDS_GOAL, AREA_GOAL = 1e-6, 1e-5


def unit(path):
    """Metres for each unit of a COLLADA file; 1 for other formats."""
    if path.suffix.lower() != ".dae":
        return 1.0
    match = re.search(rb'<unit[^>]*meter="([^"]*)"', path.read_bytes()[:20000])
    return float(match.group(1)) if match else 1.0


def corners(path, cache={}):
    """All triangles of a file's scene, in metres: (n, 3, 3)."""
    if path not in cache:
        scene = trimesh.load(path, process=False, force="scene")
        parts = []
        for node in scene.graph.nodes_geometry:
            placement, name = scene.graph[node]
            mesh = scene.geometry[name]
            if isinstance(mesh, trimesh.Trimesh):
                parts.append(trimesh.transform_points(mesh.vertices, placement)[mesh.faces])
        cache[path] = np.concatenate(parts) * unit(path)
    return cache[path]


def area(triangles):
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def original(urdd, link_idx, link, kind, files):
    """The link's triangles as trimesh has them, or None where a primitive is among them."""
    parts = []
    for element_idx, element in enumerate(link.findall(kind.lower())):
        mesh = element.find("geometry/mesh")
        if mesh is None:
            return None
        triangles = corners(urdd.root / files[link_idx, kind, element_idx]) * numbers(mesh.get("scale"), [1, 1, 1])
        origin = element.find("origin")
        if origin is not None:
            triangles = triangles @ rotation(numbers(origin.get("rpy"), [0, 0, 0])).T + numbers(origin.get("xyz"), [0, 0, 0])
        parts.append(triangles)
    return np.concatenate(parts)


def compare(root):
    urdd = Urdd(root)
    references = urdd.document("original_meshes_module")["references"]
    files = {(r["link_idx"], r["geometry"], r["element_idx"]): r["path"] for r in references}
    links = urdd.urdf().findall("link")
    compared = primitives = elements = 0
    worst = {"bounds": (0.0, ""), "area": (0.0, "")}
    for link_idx, (link, plain) in enumerate(zip(links, urdd.document("plain_meshes_module")["link_meshes"], strict=True)):
        if plain is None:
            continue
        theirs = original(urdd, link_idx, link, plain["geometry"], files)
        if theirs is None:
            primitives += 1
            continue
        ours = urdd.triangles(plain["files"]["stl"])
        compared += 1
        elements += len(link.findall(plain["geometry"].lower()))
        box = [np.array([t.reshape(-1, 3).min(0), t.reshape(-1, 3).max(0)]) for t in (ours, theirs)]
        off = np.abs(box[0] - box[1]).max() / np.abs(box[1]).max()
        worst["bounds"] = max(worst["bounds"], (off, link.get("name")))
        worst["area"] = max(worst["area"], (abs(area(ours) / area(theirs) - 1), link.get("name")))
    good = worst["bounds"][0] <= BOUNDS_GOAL and worst["area"][0] <= AREA_GOAL
    print(f"{urdd.metadata['robot_name']:16} links {compared:3} (of {elements} meshes; {primitives} with primitives not compared)"
          f"  bounds {worst['bounds'][0]:.1e} of size ({worst['bounds'][1]})  area {worst['area'][0]:.1e} ({worst['area'][1]})"
          f"  {'good' if good else 'NOT WITHIN THE GOALS'}", flush=True)
    return good


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(not all([compare(root) for root in sys.argv[1:]]))

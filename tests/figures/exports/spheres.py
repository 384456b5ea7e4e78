"""How well spheres stand for links: what they hold of the links, and what they hold besides.

    pip install numpy trimesh
    urdd generate .../ur5/robot.urdf -o ur5 --geometry collision
    python3 tests/figures/exports/spheres.py target/release/urdd ur5 [--spheres 20 ...] [FOLDER ...]

Links are the plain meshes of the URDD. Each `--spheres N` is one export for Foam with `--cover`. Each FOLDER holds spheres by somebody
else in the form that MorphIt saves: LINK_0.json with `centers` and `radii`, metres, in the frame of the link.

Points are drawn evenly in the box about a link and its spheres; a point is in the link where the winding number of the
mesh is above a half (solid angles of all triangles), so that open meshes count too. Of all links that all sets have:

    volume    m³ of the links that the spheres hold, as a part of the links' own
    surface   points of the links' surface that are in a sphere
    excess    m³ of the spheres' union outside of the links, as a part of the links' own volume
    stand-off how far points of the union's surface outside of a link are from it, mean, mm
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy
import trimesh

POINTS = 20000


def winding(mesh, points):
    triangles = mesh.triangles
    found = numpy.zeros(len(points))
    for start in range(0, len(points), 200):
        part = points[start : start + 200]
        a, b, c = (triangles[None, :, k] - part[:, None] for k in range(3))
        la, lb, lc = (numpy.linalg.norm(v, axis=2) for v in (a, b, c))
        over = numpy.einsum("ijk,ijk->ij", a, numpy.cross(b, c))
        under = la * lb * lc
        under += numpy.einsum("ijk,ijk->ij", a, b) * lc
        under += numpy.einsum("ijk,ijk->ij", b, c) * la
        under += numpy.einsum("ijk,ijk->ij", c, a) * lb
        found[start : start + 200] = numpy.arctan2(over, under).sum(axis=1) / (2 * numpy.pi)
    return found


def held(points, spheres, but=None):
    inside = numpy.zeros(len(points), bool)
    for k, (centre, radius) in enumerate(spheres):
        if k != but:
            inside |= ((points - centre) ** 2).sum(axis=1) <= radius * radius
    return inside


def on_union(spheres, random):
    """Points of the surface of the union of spheres, about 2,000."""
    areas = numpy.array([radius**2 for _, radius in spheres])
    found = []
    for k, (centre, radius) in enumerate(spheres):
        count = max(1, round(2000 * areas[k] / areas.sum()))
        directions = random.normal(size=(count, 3))
        points = centre + radius * directions / numpy.linalg.norm(directions, axis=1)[:, None]
        found.append(points[~held(points, spheres, but=k)])
    return numpy.concatenate(found)


def measure(mesh, spheres):
    random = numpy.random.default_rng(1)
    low, high = mesh.bounds
    low = numpy.minimum(low, numpy.min([c - r for c, r in spheres], axis=0))
    high = numpy.maximum(high, numpy.max([c + r for c, r in spheres], axis=0))
    points = random.uniform(low, high, size=(POINTS, 3))
    box = numpy.prod(high - low) / POINTS
    in_spheres = held(points, spheres)
    in_link = winding(mesh, points) > 0.5
    surface, _ = trimesh.sample.sample_surface(mesh, POINTS, seed=1)
    beyond = on_union(spheres, random)
    beyond = beyond[winding(mesh, beyond) <= 0.5]
    distances = trimesh.proximity.closest_point(mesh, beyond)[1]
    return {
        "link": box * in_link.sum(),
        "held": box * (in_link & in_spheres).sum(),
        "excess": box * (in_spheres & ~in_link).sum(),
        "area": mesh.area,
        "surface": mesh.area * held(surface, spheres).mean(),
        "distances": distances,
    }


def main():
    program, urdd, *wanted = sys.argv[1:]
    urdd = pathlib.Path(urdd)
    links = json.loads((urdd / "chain_module/module.json").read_text())["links_in_chain"]
    plain = json.loads((urdd / "mesh_modules/plain_meshes_module/module.json").read_text())["link_meshes"]
    meshes = {}
    for link, of in zip(links, plain):
        if of:
            mesh = trimesh.load(urdd / of["files"]["stl"], process=True)
            meshes[link["name"]] = mesh
    sets = {}
    while wanted:
        first = wanted.pop(0)
        if first != "--spheres":
            lists = {}
            for file in pathlib.Path(first).glob("*_0.json"):
                of = json.loads(file.read_text())
                lists[file.name.removesuffix("_0.json")] = list(zip(numpy.array(of["centers"]), of["radii"]))
            sets[first] = lists
            continue
        count = wanted.pop(0)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "spheres.json"
            command = [program, "export", "foam", str(urdd), "-o", str(file), "--cover", "--spheres", count]
            subprocess.run(command, check=True, capture_output=True)
            found = json.loads(file.read_text())["links"]
        as_pairs = lambda of: [(numpy.array(s["origin"]), s["radius"]) for s in of["spheres"]]
        sets[f"urdd, --cover --spheres {count}"] = {link: as_pairs(of) for link, of in found.items()}
    common = [link for link in meshes if all(link in lists for lists in sets.values())]
    print(f"{len(common)} links: {', '.join(common)}")
    print("| spheres | number | volume held | surface held | excess | stand-off |")
    print("|---|---|---|---|---|---|")
    for name, lists in sets.items():
        each = [measure(meshes[link], lists[link]) for link in common]
        total = lambda key: sum(of[key] for of in each)
        count = sum(len(lists[link]) for link in common)
        distances = numpy.concatenate([of["distances"] for of in each])
        print(
            f"| {name} | {count} | {100 * total('held') / total('link'):.1f} % "
            f"| {100 * total('surface') / total('area'):.1f} % "
            f"| {100 * total('excess') / total('link'):.0f} % | {1000 * distances.mean():.1f} mm |",
            flush=True,
        )


main()

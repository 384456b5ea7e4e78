#!/usr/bin/env python3
"""Writes hulls.json, boxes_and_spheres.json and distances.json of conformance/vectors: geometry with known answers.

    PYTHON -m pip install numpy==2.4.6 scipy==1.17.1 trimesh==5.2.0 coal==3.0.3
    PYTHON tests/figures/make_solids.py

Corners of hulls are proven in rational arithmetic; smallest spheres are closed forms, or the best of all spheres through up to four
points; smallest boxes are closed forms, which no search here may beat; distances are closed forms, or that of the nearest
features of qhull's faces, proven by a plane between the bodies. Last run: CPython 3.11.7, Linux x86-64.
"""

import itertools
import math
import random
from fractions import Fraction

import coal
import numpy as np
import trimesh
from scipy.optimize import minimize
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from vectors import plain, write

MADE_BY = "tests/figures/make_solids.py"
TURN = Rotation.from_rotvec([0.7, -1.1, 0.4])


def cuboid(x, y, z):
    return [(sx * x / 2, sy * y / 2, sz * z / 2) for sx in (-1, 1) for sy in (-1, 1) for sz in (-1, 1)]


def prism(n, radius, length):
    ring = [(radius * math.cos(2 * math.pi * k / n), radius * math.sin(2 * math.pi * k / n)) for k in range(n)]
    return [(x, y, z) for z in (-length / 2, length / 2) for x, y in ring]


def turned(points, shift=(0.3, -0.2, 0.5)):
    return TURN.apply(np.array(points, float)) + shift


TETRAHEDRON = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
OCTAHEDRON = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]


# --- hulls ---------------------------------------------------------------------------------------------------------------------

def exact_corners(points):
    """Indices of the corners, and the volume. qhull proposes triangles that close a surface; that no point is beyond any of their
    planes is proven in rational arithmetic, and so are the corners of the polygon in each plane."""
    p = [tuple(Fraction(x) for x in point) for point in points]
    corners = set()
    hull = ConvexHull(np.array(points, float))
    for simplex in hull.simplices:
        a, b, c = (p[i] for i in simplex)
        n = cross(minus(b, a), minus(c, a))
        if not any(n):
            continue
        sides = [dot(n, minus(q, a)) for q in p]
        assert min(sides) >= 0 or max(sides) <= 0, "not a face of the hull"
        axis = max(range(3), key=lambda k: abs(n[k]))
        corners |= polygon_corners([(tuple(p[i][k] for k in range(3) if k != axis), i) for i, side in enumerate(sides) if side == 0])
    return sorted(corners), hull.volume


def polygon_corners(flat):
    """Strict corners of a polygon (Andrew's monotone chain), exactly."""
    flat = sorted(flat)
    found = set()
    for ordered in (flat, flat[::-1]):
        chain = []
        for q, i in ordered:
            while len(chain) > 1 and turn(chain[-2][0], chain[-1][0], q) <= 0:
                chain.pop()
            chain.append((q, i))
        found |= {i for _, i in chain}
    return found


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def hulls():
    draw = random.Random(3)
    lattice = sorted({tuple(draw.randint(-6, 6) / 8 for _ in range(3)) for _ in range(60)})
    draw.shuffle(lattice)
    cases = {
        "a cube, with its middle, a point on a face and one on an edge": cuboid(1, 1, 1) + [(0, 0, 0), (0.5, 0.25, 0), (0.5, 0.5, 0.125)],
        "all 27 points of a lattice of 3": list(itertools.product((-1, 0, 1), repeat=3)),
        "a regular tetrahedron and what is within": TETRAHEDRON + [(0.25, 0.25, 0.25), (0, 0, 1), (1, 0, 0)],
        "an octahedron": OCTAHEDRON,
        "60 points of a lattice": lattice,
        "200 points at random": [tuple(draw.gauss(0, 0.1) for _ in range(3)) for _ in range(200)],
        "40 points on a sphere of 1 m": [tuple(np.array(v) / np.linalg.norm(v)) for v in ([draw.gauss(0, 1) for _ in range(3)] for _ in range(40))],
        "a needle": [(x / 100, y / 1e5, z / 1e5) for x, y, z in ((draw.random(), draw.random(), draw.random()) for _ in range(30))],
    }
    known = {"a cube, with its middle, a point on a face and one on an edge": 1.0, "all 27 points of a lattice of 3": 8.0,
             "a regular tetrahedron and what is within": 8 / 3, "an octahedron": 4 / 3}
    written = []
    for name, points in cases.items():
        points = plain(points)
        corners, volume = exact_corners(points)
        again = ConvexHull(np.array(points)[corners])
        assert abs(again.volume - volume) <= 1e-12 * volume and len(again.vertices) == len(corners), name
        assert name not in known or abs(known[name] - volume) < 1e-12, name
        written.append({"name": name, "points": points, "corners": corners, "volume": known.get(name, float(volume))})
    write("hulls.json", MADE_BY, hulls=written)


# --- smallest spheres and boxes ---------------------------------------------------------------------------------------------------

def smallest_sphere(points):
    """The best of all spheres through two, three or four points: centre and radius."""
    p = np.array(points, float)
    best = None
    for n in (2, 3, 4):
        for chosen in itertools.combinations(range(len(p)), n):
            a = p[chosen[0]]
            edges = p[list(chosen[1:])] - a
            gram = 2 * edges @ edges.T
            if abs(np.linalg.det(gram)) < 1e-14 * np.prod(np.diag(gram)):
                continue
            centre = a + np.linalg.solve(gram, (edges**2).sum(1)) @ edges
            radius = np.linalg.norm(a - centre)
            if (best is None or radius < best[1]) and np.linalg.norm(p - centre, axis=1).max() <= radius * (1 + 1e-12):
                best = centre, radius
    return best


def searched_box(points):
    """The least volume that two searches come to: trimesh's, and downhill from many rotations."""
    p = np.array(points, float)

    def volume(v):
        q = Rotation.from_rotvec(v).apply(p)
        return float(np.prod(q.max(0) - q.min(0)))

    least = trimesh.PointCloud(p).bounding_box_oriented.volume
    draw = np.random.default_rng(1)
    for _ in range(150):
        found = minimize(volume, draw.normal(size=3), method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-15, "maxiter": 1200})
        least = min(least, found.fun)
    return least


def boxes_and_spheres():
    draw = random.Random(11)
    n = 24
    apothem = 2 * 0.05 * math.cos(math.pi / n)
    # The octahedron's box is a cube of 4/3, its axes (2, 2, 1)/3, (-2, 1, 2)/3, (1, -2, 2)/3: the octahedron reaches as far along a
    # direction as its largest component.
    # name: points, volume of the smallest box (None: as the searches find it), centre and radius of the smallest sphere (None: by trying all)
    bodies = {
        "a box of 0.1 x 0.2 x 0.4, turned": (turned(cuboid(0.1, 0.2, 0.4)), 0.008, ((0.3, -0.2, 0.5), math.sqrt(0.21) / 2)),
        "a cube of 1": (cuboid(1, 1, 1), 1.0, ((0, 0, 0), math.sqrt(3) / 2)),
        "a regular tetrahedron with edges of sqrt 8, turned": (turned(TETRAHEDRON), 8.0, ((0.3, -0.2, 0.5), math.sqrt(3))),
        "a regular octahedron with corners at 1, turned": (turned(OCTAHEDRON), 64 / 27, ((0.3, -0.2, 0.5), 1.0)),
        f"a cylinder of 0.05 x 0.4 as a prism of {n} sides, turned": (turned(prism(n, 0.05, 0.4)), apothem**2 * 0.4, ((0.3, -0.2, 0.5), math.hypot(0.05, 0.2))),
        "a tetrahedron with an obtuse face: two points carry the sphere": ([(0, 0, 0), (1, 0, 0), (0.4, 0.1, 0), (0.5, 0.05, 0.1)], None, ((0.5, 0, 0), 0.5)),
        "a right-angled corner": ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], None, ((1 / 3, 1 / 3, 1 / 3), math.sqrt(2 / 3))),
        "12 points at random": ([[draw.gauss(0, 0.1) for _ in range(3)] for _ in range(12)], None, None),
        "14 points at random, long": ([[draw.gauss(0, s) for s in (0.02, 0.03, 0.3)] for _ in range(14)], None, None),
    }
    written = []
    for name, (points, volume, sphere) in bodies.items():
        points = plain(points)
        least = searched_box(points)
        assert volume is None or abs(least - volume) < 1e-6 * volume, (name, least, volume)
        by_trying = smallest_sphere(points) if len(points) < 30 else None
        centre, radius = sphere or by_trying
        if by_trying:
            assert abs(by_trying[1] - radius) < 1e-12 and np.abs(by_trying[0] - centre).max() < 1e-12, (name, by_trying)
        assert np.linalg.norm(np.array(points) - centre, axis=1).max() <= radius * (1 + 1e-12)
        written.append({
            "name": name, "points": points,
            "smallest_box": {"volume": float(volume or least), "from": "closed form" if volume else "search"},
            "smallest_sphere": {"centre": plain(centre), "radius": float(radius), "from": "closed form" if sphere else "all spheres through 2, 3 and 4 points"},
        })
        print("   ", name, least, radius)
    write("boxes_and_spheres.json", MADE_BY, bodies=written)


# --- distances -----------------------------------------------------------------------------------------------------------------

def to_segment(p, a, b):
    t = np.clip(np.dot(p - a, b - a) / np.dot(b - a, b - a), 0, 1)
    return a + t * (b - a)


def of_edges(a, b, c, d):
    """Nearest points of two segments."""
    u, v, w = b - a, d - c, a - c
    uu, uv, vv = u @ u, u @ v, v @ v
    pairs = [(q, to_segment(q, c, d)) for q in (a, b)] + [(to_segment(q, a, b), q) for q in (c, d)]
    det = uu * vv - uv * uv
    if det > 1e-14 * uu * vv:
        s, t = (uv * (v @ w) - vv * (u @ w)) / det, (uu * (v @ w) - uv * (u @ w)) / det
        if 0 <= s <= 1 and 0 <= t <= 1:
            pairs.append((a + s * u, c + t * v))
    return min(pairs, key=lambda pair: np.linalg.norm(pair[0] - pair[1]))


def on_face(p, face):
    a, b, c = face
    u, v = b - a, c - a
    g = np.array([[u @ u, u @ v], [u @ v, v @ v]])
    s, t = np.linalg.solve(g, [u @ (p - a), v @ (p - a)])
    return a + s * u + t * v if s >= 0 and t >= 0 and s + t <= 1 else None


def hull_distance(p, q):
    """Least distance over all pairs of vertex and face, and of edges; proven by the plane across it."""
    faces = [np.array(points)[ConvexHull(points).simplices] for points in (p, q)]
    pairs = []
    for one, other, order in ((p, faces[1], 1), (q, faces[0], -1)):
        for point in one:
            for face in other:
                nearest = on_face(point, face)
                if nearest is not None:
                    pairs.append((point, nearest)[::order])
    for f in faces[0]:
        for g in faces[1]:
            pairs += [of_edges(f[i - 1], f[i], g[j - 1], g[j]) for i in range(3) for j in range(3)]
    a, b = min(pairs, key=lambda pair: np.linalg.norm(pair[0] - pair[1]))
    distance = np.linalg.norm(a - b)
    n = (b - a) / distance
    gap = (q @ n).min() - (p @ n).max()
    assert abs(gap - distance) < 1e-13, (gap, distance)
    return distance


def by_coal(p, q):
    shapes = []
    for points in (p, q):
        vertices = coal.StdVec_Vec3s()
        for point in points:
            vertices.append(np.array(point))
        shapes.append(coal.Convex.convexHull(vertices, False, "Qt"))
    result = coal.DistanceResult()
    coal.distance(shapes[0], coal.Transform3s(), shapes[1], coal.Transform3s(), coal.DistanceRequest(), result)
    return result.min_distance


def pose(position=(0, 0, 0), rotation=Rotation.identity()):
    x, y, z, w = rotation.as_quat(canonical=True)
    return {"position": plain(position), "quaternion_wxyz": plain((w, x, y, z))}


def placed(points, where):
    w, x, y, z = where["quaternion_wxyz"]
    return Rotation.from_quat([x, y, z, w]).apply(np.array(points, float)) + where["position"]


def distances():
    half = math.sqrt(0.5)
    eighth = Rotation.from_euler("z", math.pi / 4)
    spheres = [
        ("apart", (0, 0, 0), 0.1, (0.3, 0, 0), 0.05, pose(), 0.15),
        ("apart, by the pose", (0.1, 0, 0), 0.1, (0, 0.2, 0), 0.2, pose((1.1, -0.2, 0)), 0.7),
        ("apart, turned", (0, 0, 0), 0.5, (1, 0, 0), 0.25, pose((0, 1, 0), Rotation.from_euler("z", math.pi / 2)), 1.25),
        ("touching", (0, 0, 0), 0.25, (0.5, 0, 0), 0.25, pose(), 0.0),
        ("one in the other", (0, 0, 0), 1.0, (0.1, 0, 0), 0.1, pose(), 0.0),
    ]
    boxes = [
        ("face to face", (1, 1, 1), (0.5, 0.5, 0.5), pose((2, 0.1, -0.2)), 0.5),
        ("edge to edge, along each other", (0.5, 0.5, 2), (0.5, 0.5, 2), pose((1.3, 1.4, 0)), 0.5),
        ("corner to corner", (0.5, 0.5, 0.5), (0.5, 0.5, 0.5), pose((1.2, 1.3, 1.6)), 0.7),
        ("edge to face: turned by an eighth", (0.5, 0.5, 0.5), (0.5, 0.5, 0.5), pose((2, 0, 0), eighth), 2 - 0.5 - half),
        ("edge across edge", (0.5, 0.5, 5), (0.5, 5, 0.5), pose((2 * half + 0.25, 0, 0)), 2 * half + 0.25 - 1.0),
        ("touching", (0.5, 0.5, 0.5), (0.5, 0.5, 0.5), pose((1, 0.25, 0.25)), 0.0),
        ("overlapping", (0.5, 0.5, 0.5), (0.5, 0.5, 0.5), pose((0.9, 0.25, 0.25), eighth), 0.0),
        ("a plate in a box", (0.5, 0.5, 0.5), (0.25, 0.25, 0.0), pose((0, 0, 0.25)), 0.0),
    ]
    draw = random.Random(5)
    hulls = []
    for name, p, q, where in [
        ("tetrahedra, corner to corner", TETRAHEDRON, TETRAHEDRON, pose((4, 4, 4), Rotation.from_euler("z", math.pi))),
        ("octahedra, face to face", OCTAHEDRON, OCTAHEDRON, pose((1.5, 1.5, 1.5))),
        ("a cube and an octahedron", cuboid(1, 1, 1), OCTAHEDRON, pose((2, 1.7, -0.4), TURN)),
        *((f"at random {k}", [[draw.gauss(0, 0.2) for _ in range(3)] for _ in range(9 + k)], [[draw.gauss(0, 0.1) for _ in range(3)] for _ in range(12)],
           pose([draw.choice((-1, 1)) * draw.uniform(0.5, 0.9) for _ in range(3)], Rotation.from_rotvec([draw.uniform(-2, 2) for _ in range(3)]))) for k in range(6)),
        ("a hair's breadth", cuboid(1, 1, 1), cuboid(0.1, 0.1, 0.1), pose((0.55 + 1e-6, 0.2, 0.3))),
    ]:
        p, q = plain(p), plain(q)
        distance = hull_distance(np.array(p), placed(q, where))
        assert abs(by_coal(p, placed(q, where)) - distance) < 1e-6, name
        hulls.append((name, p, q, where, distance))
    closed = {"tetrahedra, corner to corner": None, "octahedra, face to face": (4.5 - 2) / math.sqrt(3)}
    for name, _, _, _, distance in hulls:
        assert closed.get(name) is None or abs(distance - closed[name]) < 1e-14, name
    overlap = cuboid(1, 1, 1)
    hulls += [("touching", plain(overlap), plain(overlap), pose((1, 0.25, 0)), 0.0), ("overlapping", plain(overlap), plain(TETRAHEDRON), pose((0.5, 0.5, 0.5), TURN), 0.0)]
    for name, x, y, where, distance in boxes:
        p, q = np.array(cuboid(*(2 * v for v in x))), placed(cuboid(*(2 * v for v in y)), where)
        if distance > 0:
            assert abs(hull_distance(p, q) - distance) < 1e-13, (name, hull_distance(p, q), distance)
    write(
        "distances.json", MADE_BY,
        spheres=[{"name": name, "a": {"centre": plain(c), "radius": r}, "b": {"centre": plain(d), "radius": s}, "b_in_a": where, "distance": distance}
                 for name, c, r, d, s, where, distance in spheres],
        boxes=[{"name": name, "a": {"half_extents": plain(x)}, "b": {"half_extents": plain(y)}, "b_in_a": where, "distance": float(distance)}
               for name, x, y, where, distance in boxes],
        hulls=[{"name": name, "a": {"points": p}, "b": {"points": q}, "b_in_a": where, "distance": float(distance)} for name, p, q, where, distance in hulls],
    )


if __name__ == "__main__":
    hulls()
    boxes_and_spheres()
    distances()

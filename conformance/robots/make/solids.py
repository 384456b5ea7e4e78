"""Bodies as triangle lists: the few shapes that our robots are made of.

A body is a list of triangles, each three points (x, y, z) in metres, wound so that normals point outward.
"""

import math

Point = tuple[float, float, float]
Triangle = tuple[Point, Point, Point]


def clean(value: float) -> float:
    """Rounded to a micrometre, so that the files are short and the same everywhere."""
    return round(value, 6) + 0.0


def turning(profile: list[tuple[float, float]], segments: int) -> tuple[list[list[Point]], list[Triangle]]:
    """The ring that each (radius, z) makes about z, and the surface between the rings."""
    turns = [2 * math.pi * k / segments for k in range(segments)]
    rings = [[(clean(radius * math.cos(t)), clean(radius * math.sin(t)), clean(z)) for t in turns] for radius, z in profile]
    triangles: list[Triangle] = []
    for low, high in zip(rings, rings[1:]):
        for k in range(segments):
            a, b = low[k], low[(k + 1) % segments]
            c, d = high[(k + 1) % segments], high[k]
            triangles += [(a, b, c), (a, c, d)]
    return rings, triangles


def lathe(profile: list[tuple[float, float]], segments: int = 20) -> list[Triangle]:
    """A body of revolution about z: `profile` is (radius, z) from bottom to top, closed on the axis."""
    rings, triangles = turning(profile, segments)
    for ring, outward in ((rings[0], False), (rings[-1], True)):
        centre = (0.0, 0.0, ring[0][2])
        for k in range(segments):
            edge = (ring[k], ring[(k + 1) % segments])
            triangles.append((centre, *edge) if outward else (centre, edge[1], edge[0]))
    return [t for t in triangles if len(set(t)) == 3]


def tube(inner: float, outer: float, length: float, segments: int = 20) -> list[Triangle]:
    """A pipe along z, centred."""
    half = length / 2
    outline = [(inner, -half), (outer, -half), (outer, half), (inner, half)]
    return turning(outline + outline[:1], segments)[1]


def prism(outline: list[tuple[float, float]], width: float) -> list[Triangle]:
    """A star-shaped outline (x, z), anticlockwise seen from -y, made `width` thick along y, centred."""
    half = clean(width / 2)
    near = [(clean(x), -half, clean(z)) for x, z in outline]
    far = [(clean(x), half, clean(z)) for x, z in outline]
    triangles: list[Triangle] = []
    count = len(outline)
    for k in range(count):
        n = (k + 1) % count
        triangles += [(near[k], far[n], near[n]), (near[k], far[k], far[n])]
    for a, b, c in ears(outline):
        triangles += [(near[a], near[b], near[c]), (far[a], far[c], far[b])]
    return triangles


def ears(outline: list[tuple[float, float]]) -> list[tuple[int, int, int]]:
    """Triangles of a simple polygon, anticlockwise, by cutting ears."""

    def turn(a: int, b: int, c: int) -> float:
        (ax, ay), (bx, by), (cx, cy) = outline[a], outline[b], outline[c]
        return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

    left = list(range(len(outline)))
    triangles = []
    while len(left) > 3:
        for k in range(len(left)):
            a, b, c = left[k - 1], left[k], left[(k + 1) % len(left)]
            if turn(a, b, c) <= 0:
                continue
            inside = lambda p: turn(a, b, p) >= 0 and turn(b, c, p) >= 0 and turn(c, a, p) >= 0
            if any(inside(p) for p in left if p not in (a, b, c)):
                continue
            triangles.append((a, b, c))
            del left[k]
            break
        else:
            raise ValueError("the outline is not a simple polygon, anticlockwise")
    return triangles + [tuple(left)]


def box(x: float, y: float, z: float) -> list[Triangle]:
    """A box about the origin."""
    return prism([(-x / 2, -z / 2), (x / 2, -z / 2), (x / 2, z / 2), (-x / 2, z / 2)], y)


def moved(body: list[Triangle], by: Point) -> list[Triangle]:
    """A body, shifted."""
    shift = lambda p: tuple(clean(a + b) for a, b in zip(p, by))
    return [tuple(shift(p) for p in t) for t in body]


def turned(body: list[Triangle], axes: str) -> list[Triangle]:
    """A body with its axes renamed: `turned(b, "yzx")` has x where y was, and so on (a rotation)."""
    assert axes in ("xyz", "yzx", "zxy")
    order = ["xyz".index(axis) for axis in axes]
    return [tuple(tuple(p[i] for i in order) for p in t) for t in body]


def scaled(body: list[Triangle], by: float) -> list[Triangle]:
    """A body in another unit of length."""
    return [tuple(tuple(round(a * by, 6) + 0.0 for a in p) for p in t) for t in body]


def indexed(body: list[Triangle]) -> tuple[list[Point], list[tuple[int, int, int]]]:
    """Points, each once, and the triangles as indices."""
    points: dict[Point, int] = {}
    triangles = [tuple(points.setdefault(p, len(points)) for p in t) for t in body]
    return list(points), triangles

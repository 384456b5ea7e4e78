"""Triangles: heights, planes, matching within a tolerance (7.6, 7.9)."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable

from .numeric import Vector, add, cross, distance, dot, norm, scaled, sub

Point = tuple[float, float, float]
Triangle = tuple[Point, Point, Point]
RESOLUTION = 8 * 2.0**-23  # 7.6
NEEDED = 5  # 7.6.1


def largest_coordinate(triangles: Iterable[Triangle]) -> float:
    return max((abs(part) for triangle in triangles for p in triangle for part in p), default=0.0)


def resolution(triangles: Iterable[Triangle]) -> float:
    """7.6: the resolution of a mesh."""
    return RESOLUTION * largest_coordinate(triangles)


def area(triangle: Triangle) -> float:
    a, b, c = triangle
    return norm(cross(sub(b, a), sub(c, a))) / 2


def longest_side(triangle: Triangle) -> float:
    a, b, c = triangle
    return max(distance(a, b), distance(b, c), distance(c, a))


def least_height(triangle: Triangle) -> float:
    longest = longest_side(triangle)
    return 2 * area(triangle) / longest if longest > 0 else 0.0


def normal(triangle: Triangle) -> Point:
    """The unit normal, or zeros."""
    a, b, c = triangle
    n = cross(sub(b, a), sub(c, a))
    length = norm(n)
    return scaled(n, 1 / length) if length > 0 else (0.0, 0.0, 0.0)


def diagonal(points: Iterable[Point]) -> float:
    """The diagonal of the axis-aligned box around points."""
    columns = list(zip(*points))
    return math.hypot(*(max(column) - min(column) for column in columns))


def rotations(triangle: Triangle) -> tuple[Triangle, Triangle, Triangle]:
    a, b, c = triangle
    return (a, b, c), (b, c, a), (c, a, b)


def close(a: Vector, b: Vector, tolerance: float) -> bool:
    """7.6: vertices agree when each coordinate is within the tolerance."""
    return all(abs(x - y) <= tolerance for x, y in zip(a, b))


class TriangleIndex:
    """Finds triangles of which all corners agree, in turn, with those of another."""

    def __init__(self, triangles: list[Triangle], tolerance: float) -> None:
        self.triangles = triangles
        self.tolerance = tolerance
        self.size = max(4 * tolerance, 1e-300)
        self.cells: dict[tuple[int, ...], list[int]] = {}
        for place, triangle in enumerate(triangles):
            self.cells.setdefault(self.cell(triangle[0]), []).append(place)

    def cell(self, point: Vector) -> tuple[int, ...]:
        return tuple(math.floor(part / self.size) for part in point)

    def near(self, triangle: Triangle) -> list[int]:
        """The places of the triangles that agree with one, facing the same way."""
        found = []
        for turned in rotations(triangle):
            low = self.cell([part - self.tolerance for part in turned[0]])
            high = self.cell([part + self.tolerance for part in turned[0]])
            cells = [
                (x, y, z)
                for x in range(low[0], high[0] + 1)
                for y in range(low[1], high[1] + 1)
                for z in range(low[2], high[2] + 1)
            ]
            for cell in cells:
                for place in self.cells.get(cell, []):
                    pairs = zip(turned, self.triangles[place])
                    if all(close(a, b, self.tolerance) for a, b in pairs):
                        found.append(place)
        return found


def needs_counterpart(triangle: Triangle, tolerance: float) -> bool:
    """7.6.1: whether it has to be in a mesh that is compared with its own."""
    return least_height(triangle) > NEEDED * tolerance


def same_triangles(one: list[Triangle], other: list[Triangle], tolerance: float) -> bool:
    """7.6: whether two files hold the same triangles, each as often; slivers may be left out."""
    return each_has_one(one, other, tolerance) and each_has_one(other, one, tolerance)


def each_has_one(mine: list[Triangle], theirs: list[Triangle], tolerance: float) -> bool:
    """Whether each triangle that needs a counterpart has one of its own."""
    index = TriangleIndex(theirs, tolerance)
    free = [True] * len(theirs)
    for triangle in mine:
        if needs_counterpart(triangle, tolerance):
            near = [place for place in index.near(triangle) if free[place]]
            if not near:
                return False
            free[near[0]] = False
    return True


def planes_of(triangles: list[Triangle], least: float) -> list[tuple[Point, float, float]]:
    """Normal, distance from zero and least height of each face that is higher than `least`."""
    found = []
    for triangle in triangles:
        height = least_height(triangle)
        if height > least:
            n = normal(triangle)
            found.append((n, dot(n, triangle[0]), height))
    return found


def outside(planes: list[tuple[Point, float, float]], point: Point) -> float:
    """7.9: the height of a point above the highest plane of a face."""
    return max((dot(n, point) - level for n, level, _ in planes), default=math.inf)


def is_closed(triangles: list[Triangle]) -> bool:
    """7.9: each edge is used equally often in both directions."""
    edges: Counter[tuple[Point, Point]] = Counter()
    for a, b, c in triangles:
        edges.update([(a, b), (b, c), (c, a)])
    return all(count == edges[end, start] for (start, end), count in list(edges.items()))


def closest_on_triangle(triangle: Triangle, p: Vector) -> Point:
    """The point of a triangle that is nearest to a point."""
    a, b, c = triangle
    ab, ac, ap = sub(b, a), sub(c, a), sub(p, a)
    n = cross(ab, ac)
    square = dot(n, n)
    if square > 0:
        v = dot(cross(ap, ac), n) / square
        w = dot(cross(ab, ap), n) / square
        if v >= 0 and w >= 0 and v + w <= 1:
            return add(a, add(scaled(ab, v), scaled(ac, w)))
    ends = [(a, b), (b, c), (c, a)]
    return min((closest_on_segment(s, e, p) for s, e in ends), key=lambda q: distance(q, p))


def closest_on_segment(start: Point, end: Point, p: Vector) -> Point:
    along = sub(end, start)
    square = dot(along, along)
    t = min(1.0, max(0.0, dot(sub(p, start), along) / square)) if square > 0 else 0.0
    return add(start, scaled(along, t))

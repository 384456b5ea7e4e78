"""Convex bodies of links, and the distance of two of them (8.2, 8.5)."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Any

from .geometry import Point
from .kinematics import Pose
from .numeric import add, cross, distance, dot, from_rpy, norm, scaled, sub, transposed, turned

MAX_STEPS = 100
NEARLY = 1e-9


@dataclass(frozen=True)
class Body:
    """The hull of some points in a link's frame, grown by a radius."""

    link: int
    points: tuple[Point, ...]
    radius: float = 0.0

    def farthest(self) -> float:
        """The distance of the farthest point from the link's origin."""
        return max(norm(point) for point in self.points) + self.radius


def box_corners(box: Any) -> tuple[Point, ...]:
    rotation = from_rpy(box["offset_rpy"])
    x, y, z = box["half_extents"]
    signs = [(a * x, b * y, c * z) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    return tuple(add(turned(rotation, corner), box["offset_xyz"]) for corner in signs)


def box_body(link: int, box: Any) -> Body:
    return Body(link, box_corners(box))


def sphere_body(link: int, sphere: Any) -> Body:
    return Body(link, (tuple(sphere["offset_xyz"]),), sphere["radius"])


def nearest_of_segment(a: Point, b: Point) -> tuple[Point, list[Point]]:
    """The point of a simplex that is nearest to zero, and the corners that hold it."""
    ab = sub(b, a)
    t = -dot(a, ab) / dot(ab, ab)
    if t <= 0:
        return a, [a]
    if t >= 1:
        return b, [b]
    return add(a, scaled(ab, t)), [a, b]


def nearest_of_triangle(a: Point, b: Point, c: Point) -> tuple[Point, list[Point]]:
    n = cross(sub(b, a), sub(c, a))
    u = dot(cross(b, c), n)
    v = dot(cross(c, a), n)
    w = dot(cross(a, b), n)
    if u > 0 and v > 0 and w > 0:
        return scaled(n, dot(a, n) / dot(n, n)), [a, b, c]
    sides = [nearest_of_segment(a, b), nearest_of_segment(b, c), nearest_of_segment(c, a)]
    return min(sides, key=lambda side: dot(side[0], side[0]))


def nearest_of_simplex(points: list[Point]) -> tuple[Point, list[Point]]:
    if len(points) == 1:
        return points[0], points
    if len(points) == 2:
        return nearest_of_segment(points[0], points[1])
    if len(points) == 3:
        return nearest_of_triangle(points[0], points[1], points[2])
    a, b, c, d = points
    faces = [(a, b, c, d), (a, c, d, b), (a, d, b, c), (b, d, c, a)]
    outside = []
    for p, q, r, opposite in faces:
        n = cross(sub(q, p), sub(r, p))
        if dot(p, n) * dot(sub(opposite, p), n) >= 0:
            outside.append(nearest_of_triangle(p, q, r))
    if not outside:
        return (0.0, 0.0, 0.0), points
    return min(outside, key=lambda face: dot(face[0], face[0]))


def farthest_along(points: tuple[Point, ...], direction: Point) -> Point:
    x, y, z = direction
    return max(points, key=lambda p: p[0] * x + p[1] * y + p[2] * z)


@functools.lru_cache(maxsize=500_000)
def distance_of(a: Body, b: Body, relative: Pose) -> float:
    """The distance of two bodies, 0 in contact; `relative` is the second link in the first."""
    rotation, shift = relative
    back = transposed(rotation)
    if len(a.points) == 1:  # a pair is of one kind of shape
        apart = distance(a.points[0], add(turned(rotation, b.points[0]), shift))
        return max(0.0, apart - a.radius - b.radius)
    v: Point = sub(a.points[0], add(turned(rotation, b.points[0]), shift))
    simplex: list[Point] = []
    for _ in range(MAX_STEPS):
        length = norm(v)
        on_a = farthest_along(a.points, scaled(v, -1.0))
        on_b = add(turned(rotation, farthest_along(b.points, turned(back, v))), shift)
        w = sub(on_a, on_b)
        scale = max(math.sqrt(max(dot(p, p) for p in simplex)) if simplex else 0.0, norm(w))
        if length <= NEARLY * scale or length - dot(v, w) / length <= NEARLY * scale:
            break
        if w in simplex:
            break
        v, simplex = nearest_of_simplex([*simplex, w])
    return norm(v) if norm(v) > 2 * NEARLY * scale else 0.0

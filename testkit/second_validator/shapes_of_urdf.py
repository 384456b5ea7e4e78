"""Boxes, cylinders, capsules and spheres of a URDF, and the triangles that may show them (7.8)."""

from __future__ import annotations

import math
from typing import Any

from .bodies import Body, distance_of
from .geometry import Point, Triangle, closest_on_segment, normal
from .kinematics import ORIGIN, position_of, rotation_of
from .numeric import distance, dot, norm, sub, transposed, turned

MAX_SAG = 0.02  # 7.8


class Shape:
    """A shape in its place."""

    def __init__(self, element: Any, version: tuple[int, int]) -> None:
        self.back = transposed(rotation_of(element["origin"], version))
        self.position = position_of(element["origin"])
        stated = element["geometry"].items()
        ((self.kind, inside),) = [pair for pair in stated if not pair[0].startswith("x_")]
        size = inside.get("size", (0.0, 0.0, 0.0))
        self.half = tuple(side / 2 for side in size)
        self.radius = inside.get("radius", 0.0)
        self.half_length = inside.get("length", 0.0) / 2
        self.ends = ((0.0, 0.0, -self.half_length), (0.0, 0.0, self.half_length))
        x, y, z = size
        curved = 4 * math.pi * self.radius * self.half_length
        areas = {
            "Box": 2 * (x * y + y * z + z * x),
            "Cylinder": curved + 2 * math.pi * self.radius**2,
            "Capsule": curved + 4 * math.pi * self.radius**2,
            "Sphere": 4 * math.pi * self.radius**2,
        }
        self.area = areas[self.kind]
        around = math.hypot(*self.half, self.half_length, self.radius)
        if self.kind == "Capsule":
            around = self.half_length + self.radius
        self.extent = norm(self.position) + around

    def has(self, triangle: Triangle, tolerance: float) -> bool:
        """7.8: corners on the surface, facing outward, and not too far inside."""
        a, b, c = (turned(self.back, sub(corner, self.position)) for corner in triangle)
        inside: Triangle = (a, b, c)
        if self.kind == "Box":
            return self.on_box(inside, tolerance)
        if not all(self.is_on_surface(p, tolerance) for p in inside):
            return False
        if self.kind == "Cylinder" and self.on_end(inside, tolerance):
            return True
        return self.on_round(inside, tolerance)

    def on_box(self, triangle: Triangle, tolerance: float) -> bool:
        """On one of the six sides, which are flat."""
        n = normal(triangle)
        for axis in range(3):
            level = math.copysign(self.half[axis], n[axis])
            on_side = all(abs(p[axis] - level) <= tolerance for p in triangle)
            if on_side and all(self.within_box(p, tolerance) for p in triangle):
                return True
        return False

    def within_box(self, p: Point, tolerance: float) -> bool:
        return all(abs(part) <= half + tolerance for part, half in zip(p, self.half))

    def is_on_surface(self, p: Point, tolerance: float) -> bool:
        """Whether a corner is on a cylinder, its ends included, a capsule or a sphere."""
        off = distance(p, self.on_axis(p)) - self.radius
        if self.kind != "Cylinder":
            return abs(off) <= tolerance
        out = abs(p[2]) - self.half_length
        return max(off, out) <= tolerance and min(-off, -out) <= tolerance

    def on_end(self, triangle: Triangle, tolerance: float) -> bool:
        """At one of the two ends of a cylinder, and not too far inside."""
        side = math.copysign(1.0, normal(triangle)[2])
        deepest = self.half_length - min(side * p[2] for p in triangle)
        return deepest <= MAX_SAG * self.radius + tolerance

    def on_round(self, triangle: Triangle, tolerance: float) -> bool:
        """Around the axis, or one of its ends, and not too far inside."""
        corner = triangle[0]
        if dot(normal(triangle), sub(corner, self.on_axis(corner))) <= 0:
            return False
        deepest = distance_of(Body(0, triangle), Body(0, self.ends), ORIGIN)
        return self.radius - deepest <= MAX_SAG * self.radius + tolerance

    def on_axis(self, p: Point) -> Point:
        """The nearest point of the axis."""
        return closest_on_segment(*self.ends, p)

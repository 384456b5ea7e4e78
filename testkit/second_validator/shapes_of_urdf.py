"""Boxes, cylinders, capsules and spheres of a URDF, and the triangles that may show them (7.8)."""

from __future__ import annotations

import math
from typing import Any

from .geometry import Point, Triangle, closest_on_segment, closest_on_triangle, normal
from .kinematics import position_of, rotation_of
from .numeric import add, distance, dot, norm, scaled, sub, transposed, turned

MAX_SAG = 0.02  # 7.8
STEPS = 40


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
        x, y, z = size
        curved = 4 * math.pi * self.radius * self.half_length
        areas = {
            "Box": 2 * (x * y + y * z + z * x),
            "Cylinder": curved + 2 * math.pi * self.radius**2,
            "Capsule": curved + 4 * math.pi * self.radius**2,
            "Sphere": 4 * math.pi * self.radius**2,
        }
        self.area = areas[self.kind]
        reach = self.half_length + (self.radius if self.kind == "Capsule" else 0.0)
        self.extent = norm(self.position) + max(*self.half, self.radius, reach)

    def has(self, triangle: Triangle, tolerance: float) -> bool:
        """7.8: corners on the surface, facing outward, and not too far inside."""
        a, b, c = (turned(self.back, sub(corner, self.position)) for corner in triangle)
        inside: Triangle = (a, b, c)
        if self.kind == "Box":
            return self.on_box(inside, tolerance)
        if self.kind == "Cylinder" and self.on_end(inside, tolerance):
            return True
        return self.on_round(inside, tolerance)

    def on_box(self, triangle: Triangle, tolerance: float) -> bool:
        """On one of the six sides, which are flat."""
        n = normal(triangle)
        for axis in range(3):
            if n[axis] == 0:
                continue
            level = math.copysign(self.half[axis], n[axis])
            on_side = all(abs(p[axis] - level) <= tolerance for p in triangle)
            if on_side and all(self.within_box(p, tolerance) for p in triangle):
                return True
        return False

    def within_box(self, p: Point, tolerance: float) -> bool:
        return all(abs(part) <= half + tolerance for part, half in zip(p, self.half))

    def on_end(self, triangle: Triangle, tolerance: float) -> bool:
        """On one of the two ends of a cylinder."""
        level = math.copysign(self.half_length, normal(triangle)[2])
        return all(
            abs(p[2] - level) <= tolerance and math.hypot(p[0], p[1]) <= self.radius + tolerance
            for p in triangle
        )

    def on_round(self, triangle: Triangle, tolerance: float) -> bool:
        """On a curved surface: at one distance from the axis, or from its ends."""
        for p in triangle:
            if self.kind == "Cylinder" and abs(p[2]) > self.half_length + tolerance:
                return False
            if abs(distance(p, self.on_axis(p)) - self.radius) > tolerance:
                return False
        middle = scaled(add(add(triangle[0], triangle[1]), triangle[2]), 1 / 3)
        if dot(normal(triangle), sub(middle, self.on_axis(middle))) <= 0:
            return False
        near = middle
        for _ in range(STEPS):
            near = closest_on_triangle(triangle, self.on_axis(near))
        sag = self.radius - distance(near, self.on_axis(near))
        return sag <= MAX_SAG * self.radius + tolerance

    def on_axis(self, p: Point) -> Point:
        """The nearest point of the axis."""
        return closest_on_segment((0.0, 0.0, -self.half_length), (0.0, 0.0, self.half_length), p)

"""Whether a plain mesh is its elements in the link's frame (7.8)."""

from __future__ import annotations

import itertools
import math
from typing import Any

from .faces import Face, Vertex, is_number, mirrors, placed
from .geometry import (
    NEEDED,
    RESOLUTION,
    Point,
    Triangle,
    TriangleIndex,
    area,
    close,
    largest_coordinate,
    least_height,
    longest_side,
    needs_counterpart,
    normal,
)
from .kinematics import position_of, rotation_of
from .numeric import Matrix, add, cross, distance, dot, norm, sub, turned
from .shapes_of_urdf import Shape

TURNS_BACK = -0.999e-6  # 7.8: up to 1.001e-6, a face may be taken either way
ONCE_ROUND = 1.5 * 2 * math.pi  # 7.8
MAX_CUT_CORNERS = 10_000  # 7.8
LARGE, SMALL = 1e-6, 1e-4  # 7.6
LEAST_AREA = 0.95  # 7.8


def newell(corners: list[Point]) -> Point:
    """7.8: the normal of a face, not of unit length."""
    total: Point = (0.0, 0.0, 0.0)
    for n in range(len(corners)):
        total = add(total, cross(sub(corners[n - 1], corners[0]), sub(corners[n], corners[0])))
    return total


def is_convex(corners: list[Point]) -> bool:
    """7.8: at no corner it turns back, and it goes round once."""
    n = newell(corners)
    length = norm(n)
    turns = 0.0
    for place in range(len(corners)):
        before = sub(corners[place - 1], corners[place - 2])
        after = sub(corners[place], corners[place - 1])
        sides = norm(before) * norm(after)
        product = cross(before, after)
        if dot(product, n) < TURNS_BACK * length * sides:
            return False
        turns += math.atan2(norm(product), dot(before, after))
    return len(corners) == 4 or turns < ONCE_ROUND


def crosses_itself(corners: list[Point]) -> bool:
    """Whether two sides of a face cross, seen along its normal."""
    n = newell(corners)
    axis = max(range(3), key=lambda k: abs(n[k]))
    flat = [tuple(part for k, part in enumerate(p) if k != axis) for p in corners]
    sides = [(a, b) for a, b in zip(flat, flat[1:] + flat[:1]) if a != b]

    def side(a: Any, b: Any, c: Any) -> float:
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    return any(
        side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0
        for (a, b), (c, d) in itertools.combinations(sides, 2)
    )


class MeshElement:
    """An element with a mesh: its triangles and polygons in the link's frame."""

    def __init__(
        self, faces: list[Face], element: Any, version: tuple[int, int], y_up: bool
    ) -> None:
        scale = element["geometry"]["Mesh"]["scale"] or (1.0, 1.0, 1.0)
        self.rotation: Matrix = rotation_of(element["origin"], version)
        self.position = position_of(element["origin"])
        self.scale = scale
        self.y_up = y_up
        self.triangles: list[Triangle] = []
        self.polygons: list[list[Point]] = []
        self.largest = norm(self.position)
        factor = max(abs(part) for part in scale)
        flips = scale[0] * scale[1] * scale[2] < 0
        for face in faces:
            turned_round = mirrors(face.place) != flips
            corners = [c if is_number(c) else None for c in face.corners]
            shown = [c and self.shown(face, c) for c in corners]
            for corner in shown:
                if corner:
                    self.largest = max(self.largest, factor * max(map(abs, corner)))
            self.add(corners, [c and self.moved(c) for c in shown], turned_round)
        self.largest = max(self.largest, largest_coordinate(self.triangles))

    def shown(self, face: Face, corner: Point) -> Point:
        """What URDF programs read: glTF has y up, and (x, y, z) becomes (x, -z, y)."""
        x, y, z = placed(face.place, corner)
        return (x, -z, y) if self.y_up else (x, y, z)

    def moved(self, corner: Point) -> Point:
        x, y, z = (part * factor for part, factor in zip(corner, self.scale))
        return add(turned(self.rotation, (x, y, z)), self.position)

    def add(self, corners: list[Vertex], moved: list[Vertex], turned_round: bool) -> None:
        """A convex face is a fan from its first corner; any other is kept as a polygon."""
        all_there = all(moved)
        points: list[Any] = list(moved)
        if all_there and not is_convex(corners):  # type: ignore[arg-type]
            self.polygons.append(points[::-1] if turned_round else points)
            if len(points) <= MAX_CUT_CORNERS:
                return
        for n in range(1, len(points) - 1):
            a, b, c = points[0], points[n], points[n + 1]
            if a and b and c:
                self.triangles.append((a, c, b) if turned_round else (a, b, c))


def is_cut(polygon: list[Point], found: list[Triangle], tolerance: float) -> bool:
    """7.8: whether triangles are a cut of a face into n - 2 triangles that do not overlap."""
    n = newell(polygon)
    edges: set[tuple[int, int]] = set()
    for triangle in found:
        places = [
            next(k for k, p in enumerate(polygon) if close(p, corner, tolerance))
            for corner in triangle
        ]
        if dot(normal(triangle), n) <= 0:
            return False
        for k in range(3):
            edge = (places[k], places[(k + 1) % 3])
            if edge in edges:
                return False
            edges.add(edge)
    inner = [edge for edge in edges if (edge[0] + 1) % len(polygon) != edge[1]]
    matched = all((end, start) in edges for start, end in inner)
    slivers = len(polygon) - 2 - len(found)
    if len(found) == len(polygon) - 2:
        return matched
    return slivers > 0 and covers(polygon, found, tolerance)


def covers(polygon: list[Point], found: list[Triangle], tolerance: float) -> bool:
    """Whether triangles have the area of a face, but for those that need not be there."""
    whole = norm(newell(polygon)) / 2
    left_out = [(polygon[0], b, c) for b, c in zip(polygon[1:], polygon[2:])]
    slack = NEEDED * tolerance / 2 * sum(longest_side(triangle) for triangle in left_out)
    return abs(sum(area(triangle) for triangle in found) - whole) <= 1e-6 * whole + slack


class PlainCheck:
    """Compares a plain mesh with its elements."""

    def __init__(
        self, plain: list[Triangle], meshes: list[MeshElement], shapes: list[Shape]
    ) -> None:
        largest = [largest_coordinate(plain)]
        largest += [mesh.largest for mesh in meshes] + [shape.extent for shape in shapes]
        extent = max(largest)
        self.tolerance = max(RESOLUTION * extent, min(LARGE, SMALL * extent))
        self.plain = plain
        self.meshes = meshes
        self.shapes = shapes

    def holds(self) -> bool:
        matched = [False] * len(self.plain)
        index = TriangleIndex(self.plain, self.tolerance)
        for mesh in self.meshes:
            for triangle in mesh.triangles:
                near = index.near(triangle)
                if not near and needs_counterpart(triangle, self.tolerance):
                    return False
                for place in near:
                    matched[place] = True
        for mesh in self.meshes:
            for polygon in mesh.polygons:
                if not self.polygon(polygon, matched):
                    return False
        return self.rest(matched)

    def polygon(self, polygon: list[Point], matched: list[bool]) -> bool:
        """Takes the triangles on the corners of a face that is not convex."""
        found = []
        for place, triangle in enumerate(self.plain):
            on = [any(close(p, corner, self.tolerance) for p in polygon) for corner in triangle]
            if all(on) and not matched[place]:
                matched[place] = True
                if least_height(triangle) > self.tolerance:
                    found.append(triangle)
        if crosses_itself(polygon) or len(polygon) > MAX_CUT_CORNERS:
            return True
        return is_cut(polygon, found, self.tolerance)

    def rest(self, matched: list[bool]) -> bool:
        """What is left are the triangles of boxes, cylinders, capsules and spheres."""
        left = [
            triangle
            for triangle, is_matched in zip(self.plain, matched)
            if not is_matched and needs_counterpart(triangle, self.tolerance)
        ]
        fits = [[shape.has(t, self.tolerance) for t in self.plain] for shape in self.shapes]
        if any(not any(shape.has(t, self.tolerance) for shape in self.shapes) for t in left):
            return False
        allowed = sum(shape.area for shape in self.shapes)
        slack = self.tolerance * sum(
            distance(a, b) + distance(b, c) + distance(c, a) for a, b, c in left
        )
        total = sum(area(triangle) for triangle in left)
        enough = all(
            sum(area(t) for t, is_on in zip(self.plain, on) if is_on)
            >= LEAST_AREA * shape.area - slack
            for shape, on in zip(self.shapes, fits)
        )
        return enough and total <= allowed * (1 + 1e-9) + slack

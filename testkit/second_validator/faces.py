"""Faces of mesh files, with the transform that places each (7.5, 7.8)."""

from __future__ import annotations

import math
from dataclasses import dataclass

MAX_TRIANGLES = 20_000_000  # 7.5
MAX_VISITS = 100_000  # 7.5
MAX_NODES_INSIDE = 200  # 7.5
Vertex = tuple[float, float, float] | None
Affine = tuple[tuple[float, float, float, float], ...]
UNPLACED: Affine = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0))


class NotMesh(Exception):
    """A file that is not a mesh (7.5)."""


@dataclass
class Face:
    """Corners as the file has them; None is a corner that is no number."""

    corners: list[Vertex]
    place: Affine = UNPLACED


class Shown(list[Face]):
    """The faces of a file; 7.5 leaves to the URDD whether some files are meshes."""

    may_be_refused = False


def count_triangles(faces: list[Face]) -> int:
    """7.5: each face is a fan, and nothing where it has fewer than three corners."""
    return sum(len(face.corners[2:]) for face in faces)


def then(outer: Affine, inner: Affine) -> Affine:
    """The transform that does `inner` first."""
    rows = []
    for row in outer:
        parts = [sum(row[k] * inner[k][c] for k in range(3)) for c in range(4)]
        rows.append((parts[0], parts[1], parts[2], parts[3] + row[3]))
    return tuple(rows)


def placed(place: Affine, corner: tuple[float, float, float]) -> tuple[float, float, float]:
    if place is UNPLACED:
        return corner
    x, y, z = corner
    a, b, c = (row[0] * x + row[1] * y + row[2] * z + row[3] for row in place)
    return a, b, c


def mirrors(place: Affine) -> bool:
    """Whether a transform turns left into right."""
    (a, b, c, _), (d, e, f, _), (g, h, i, _) = place
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0


def is_number(corner: Vertex) -> bool:
    return corner is not None and all(math.isfinite(part) for part in corner)


def triangles_of(face: Face) -> list[list[tuple[float, float, float]]]:
    """The fan of a face in its place, without what has a corner that is no number."""
    found = []
    corners = [c and placed(face.place, c) for c in face.corners]
    for n in range(1, len(corners) - 1):
        triangle = [corners[0], corners[n], corners[n + 1]]
        if all(is_number(corner) for corner in triangle):
            found.append(triangle)
    return found  # type: ignore[return-value]

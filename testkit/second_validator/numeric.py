"""Numbers: how they are written (6.1.8), when they agree (5.6), vectors and rotations (5.4)."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

NUMBER = re.compile(
    r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?|[+-]?(?:inf|infinity|nan)", re.IGNORECASE
)
RELATIVE = 1e-9  # 5.6
ABSOLUTE = 1e-12  # 5.6
Vector = Sequence[float]
Matrix = tuple[tuple[float, float, float], ...]
IDENTITY: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def number(word: str) -> float | None:
    """A number in the form of 6.1.8, which may be infinite or nan; None for any other word."""
    return float(word) if NUMBER.fullmatch(word) and word.isascii() else None


def agree(a: float, b: float) -> bool:
    """5.6: other numbers."""
    return a == b or abs(a - b) <= max(RELATIVE * max(abs(a), abs(b)), ABSOLUTE)


def component_agrees(a: float, b: float, bounds: Vector) -> bool:
    """5.6: a component of a configuration."""
    return agree(a, b) or abs(a - b) <= RELATIVE * max(abs(bounds[0]), abs(bounds[1]))


def add(a: Vector, b: Vector) -> tuple[float, float, float]:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a: Vector, b: Vector) -> tuple[float, float, float]:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scaled(a: Vector, factor: float) -> tuple[float, float, float]:
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> tuple[float, float, float]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a: Vector) -> float:
    return math.hypot(*a)


def distance(a: Vector, b: Vector) -> float:
    return math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2])


def turned(m: Matrix, a: Vector) -> tuple[float, float, float]:
    return (dot(m[0], a), dot(m[1], a), dot(m[2], a))


def product(a: Matrix, b: Matrix) -> Matrix:
    columns = list(zip(*b))
    return tuple((dot(row, columns[0]), dot(row, columns[1]), dot(row, columns[2])) for row in a)


def transposed(m: Matrix) -> Matrix:
    return tuple(zip(*m))  # type: ignore[return-value]


def from_rpy(rpy: Vector) -> Matrix:
    """5.4: R = Rz(yaw) Ry(pitch) Rx(roll)."""
    (cr, cp, cy), (sr, sp, sy) = [math.cos(a) for a in rpy], [math.sin(a) for a in rpy]
    return (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )


def from_quaternion(wxyz: Vector) -> Matrix:
    """The rotation of a quaternion, made a unit one first; none of one of zeros."""
    largest = max(abs(part) for part in wxyz)
    if largest == 0:
        return IDENTITY
    w, x, y, z = (part / largest for part in wxyz)
    length = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / length, x / length, y / length, z / length
    return (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )


def from_axis_angle(axis: Vector, angle: float) -> Matrix:
    half = angle / 2
    return from_quaternion((math.cos(half), *scaled(axis, math.sin(half))))


def from_rotation_vector(vector: Vector) -> Matrix:
    """5.4."""
    angle = norm(vector)
    return from_axis_angle(scaled(vector, 1 / angle), angle) if angle > 0 else IDENTITY


def rotation_distance(a: Matrix, b: Matrix) -> float:
    """5.6: the Frobenius norm of the difference over sqrt 2."""
    return math.hypot(*[a[i][j] - b[i][j] for i in range(3) for j in range(3)]) / math.sqrt(2)


def finite(values: Any) -> bool:
    return all(math.isfinite(value) for value in values)

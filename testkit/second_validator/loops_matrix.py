"""The matrix of 6.8.7, and its rank."""

from __future__ import annotations

import math
from operator import mul
from typing import Any

from .kinematics import ORIGIN, Pose, Robot, compose, in_plane, joint_position, moved
from .numeric import (
    IDENTITY,
    Vector,
    add,
    cross,
    finite,
    norm,
    scaled,
    sub,
    transposed,
    turned,
)

Row = dict[int | None, float]
EDGES = (1e-6, 1e-4)  # 6.8.7: a singular value between these may be counted or not
LEAST = 1e-9  # 6.8.7: singular values that are not above this do not count
SWEEPS = 12


def turning(vector: Vector) -> list[Vector]:
    """The angular velocities, in the frame before it, by the numbers of a rotation vector."""
    angle = norm(vector)
    if angle == 0:
        return list(IDENTITY)
    columns: list[Vector] = []
    for unit in IDENTITY:
        once = cross(scaled(vector, 1 / angle), unit)
        twice = cross(scaled(vector, 1 / angle), once)
        first, second = (1 - math.cos(angle)) / angle, 1 - math.sin(angle) / angle
        columns.append(add(unit, add(scaled(once, first), scaled(twice, second))))
    return columns


def twists(robot: Robot, joint: int, q: Vector) -> list[tuple[Vector, Vector]]:
    """For each number of a joint's position: how its child moves and turns, before the motion."""
    still = ORIGIN[1]
    kind, axis = robot.joints[joint]["joint_type"], robot.axes[joint]
    if kind == "Prismatic":
        return [(axis, still)]
    if kind in ("Revolute", "Continuous"):
        return [(still, axis)]
    if kind == "Planar":
        x, y = in_plane(axis)
        return [(x, still), (y, still), (still, axis)]
    slides = [(unit, still) for unit in IDENTITY] if kind == "Floating" else []
    return slides + [(still, column) for column in turning(q[-3:])]


def add_movement(
    found: Any, robot: Robot, joints: list[int], q: list[float], b: Pose, sign: float
) -> None:
    """Adds how frame B moves and turns relative to frame A, by the joints above one of them."""
    at: Pose = ORIGIN
    for joint in joints:
        position = joint_position(robot, joint, q)
        before = compose(at, robot.origins[joint])
        at = moved(robot, joint, at, position)
        mimic = robot.mimics[joint]
        dofs: Any = [mimic[0]] if mimic else robot.dofs_of[joint]
        factor = sign * mimic[1] if mimic else sign
        for dof, (slide, turn) in zip(dofs, twists(robot, joint, position)):
            turn = scaled(turned(before[0], turn), factor)
            slide = scaled(turned(before[0], slide), factor)
            speed = add(slide, cross(turn, sub(b[1], at[1])))
            known = found.setdefault(dof, (ORIGIN[1], ORIGIN[1]))
            found[dof] = (add(known[0], speed), add(known[1], turn))


def rows_of_loop(robot: Robot, loop: Any, q: list[float], reach: float) -> list[Row]:
    """The rows of a loop; columns of lengths are not multiplied yet."""
    a, b = loop.frames(robot, q)
    found: dict[int | None, tuple[Vector, Vector]] = {}  # None: of no DOF
    add_movement(found, robot, loop.joints_b, q, b, 1.0)
    add_movement(found, robot, loop.joints_a, q, b, -1.0)
    back = transposed(a[0])
    z = turned(back, turned(b[0], IDENTITY[2]))
    columns: dict[int | None, Vector] = {}
    for dof, (speed, turn) in found.items():
        speed, turn = scaled(turned(back, speed), 1 / reach), turned(back, turn)
        if loop.rotation in ("direction", "right angle"):
            turn = cross(turn, z)
        columns[dof] = (*speed, *turn)
    turns = {"all": [3, 4, 5], "direction": [3, 4, 5], "right angle": [5], "": []}
    places = (*loop.components, *turns[loop.rotation])
    return [{dof: column[place] for dof, column in columns.items()} for place in places]


def matrix(robot: Robot, loops: list[Any], couplings: list[Any], q: list[float]) -> list[Vector]:
    """6.8.7: the rows of M."""
    reach = robot.reach()
    unit = [reach if robot.is_length(dof) else 1.0 for dof in range(len(q))]
    rows: list[Vector] = [
        [row.get(dof, 0.0) * unit[dof] for dof in range(len(q))]
        for loop in loops
        for row in rows_of_loop(robot, loop, q, reach)
    ]
    for coupling in couplings:
        row, size = [0.0] * len(q), 0.0
        for term in coupling["terms"]:
            dof = term["dof_idx"]
            power = unit[dof]
            for number, coefficient in enumerate(term["coefficients"]):
                summand = (number + 1) * float(coefficient) * power
                row[dof] += summand
                size = max(size, abs(summand))
                power *= q[dof]
        if size > 0:
            rows.append([value / size for value in row])
    return rows


def singular_values(rows: list[Vector]) -> list[float]:
    """Jacobi's method on one side: turns pairs of rows until all are orthogonal."""
    rows = list(rows)
    for _ in range(SWEEPS):
        for i in range(len(rows)):
            for j in range(i):
                one, other = rows[i], rows[j]
                inner = sum(map(mul, one, other))
                squares = sum(map(mul, one, one)), sum(map(mul, other, other))
                angle = math.atan2(2 * inner, squares[0] - squares[1]) / 2
                c, s = math.cos(angle), math.sin(angle)
                rows[i] = [c * x + s * y for x, y in zip(one, other)]
                rows[j] = [c * y - s * x for x, y in zip(one, other)]
    return [norm(row) for row in rows]


def rank(values: list[float], largest: float, edge: float) -> int:
    """How many singular values are above an edge, by the largest one."""
    return len([value for value in values if value > max(LEAST, edge * largest)])


def independence(
    robot: Robot, loops: list[Any], couplings: list[Any], q: list[float], independent: list[int]
) -> str:
    """LOP009 or LOP010, where the independent DOFs break one of them, or nothing."""
    rows = matrix(robot, loops, couplings, q)
    values = singular_values(rows)
    if not finite(values):
        return ""
    others = [dof for dof in range(len(q)) if dof not in independent]
    largest = max(values, default=0.0)
    if not rank(values, largest, EDGES[1]) <= len(others) <= rank(values, largest, EDGES[0]):
        return "LOP009"
    rest = singular_values([[row[dof] for dof in others] for row in rows])
    return "LOP010" if rank(rest, largest, EDGES[0]) < len(others) else ""

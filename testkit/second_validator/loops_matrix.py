"""The matrix of 6.8.7, and its rank."""

from __future__ import annotations

import math
from operator import mul
from typing import Any

from .kinematics import ORIGIN, Pose, Robot, compose, in_plane, joint_position, moved
from .numeric import (
    IDENTITY,
    Matrix,
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

Row = dict[int, float]
EDGES = (1e-6, 1e-4)  # 6.8.7: a singular value between these may be counted or not
LEAST = 1e-9  # 6.8.7: singular values that are not above this do not count
SMALL_ANGLE = 0.02
NEARLY_ORTHOGONAL = 1e-14
NEGLIGIBLE = 1e-28
MAX_SWEEPS = 60
MAX_WORK = 20_000_000  # 13.5: columns squared times rows of what is decomposed
UNITS = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def turning(vector: Vector) -> Matrix:
    """The angular velocity, by the derivative of a rotation vector, in the frame before it."""
    angle = norm(vector)
    square = angle * angle
    if angle < SMALL_ANGLE:
        first = 1 / 2 - square / 24 + square * square / 720
        second = 1 / 6 - square / 120 + square * square / 5040
    else:
        first = (1 - math.cos(angle)) / square
        second = (angle - math.sin(angle)) / (square * angle)
    columns = []
    for unit in UNITS:
        once = cross(vector, unit)
        twice = cross(vector, once)
        columns.append(add(unit, add(scaled(once, first), scaled(twice, second))))
    return transposed(tuple(columns))


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
    slides = [(unit, still) for unit in UNITS] if kind == "Floating" else []
    if kind in ("Floating", "Spherical"):
        return slides + [(still, column) for column in transposed(turning(q[-3:]))]
    return []


def add_movement(found: Any, robot: Robot, loop: Any, q: list[float], b: Pose, sign: int) -> None:
    """Adds how frame B moves and turns relative to frame A, by the joints above one of them."""
    at: Pose = (IDENTITY, ORIGIN[1])
    for joint in loop.joints_b if sign > 0 else loop.joints_a:
        position = joint_position(robot, joint, q)
        before = compose(at, robot.origins[joint])
        at = moved(robot, joint, at, position)
        mimic = robot.mimics[joint]
        dofs = robot.dofs_of[joint]
        factor = float(sign)
        if mimic:
            dofs, factor = ([] if mimic[0] is None else [mimic[0]]), sign * mimic[1]
        for dof, (slide, turn) in zip(dofs, twists(robot, joint, position)):
            turn = scaled(turned(before[0], turn), factor)
            slide = scaled(turned(before[0], slide), factor)
            speed = add(slide, cross(turn, sub(b[1], at[1])))
            known = found.setdefault(dof, (ORIGIN[1], ORIGIN[1]))
            found[dof] = (add(known[0], speed), add(known[1], turn))


def rows_of_loop(robot: Robot, loop: Any, q: list[float], reach: float) -> list[Row]:
    """The rows of a loop; columns of lengths are not multiplied yet."""
    a, b = loop.frames(robot, q)
    found: dict[int, tuple[Vector, Vector]] = {}
    add_movement(found, robot, loop, q, b, 1)
    add_movement(found, robot, loop, q, b, -1)
    back = transposed(a[0])
    z = turned(back, turned(b[0], UNITS[2]))
    rows: list[Row] = [{} for _ in range(6)]
    for dof, (speed, turn) in found.items():
        speed, turn = scaled(turned(back, speed), 1 / reach), turned(back, turn)
        if loop.rotation in ("direction", "right angle"):
            turn = cross(turn, z)
        for part in range(3):
            rows[part][dof] = speed[part]
            rows[3 + part][dof] = turn[part]
    turns = {"all": [3, 4, 5], "direction": [3, 4, 5], "right angle": [5], "": []}
    return [rows[place] for place in (*loop.components, *turns[loop.rotation])]


def matrix(robot: Robot, loops: list[Any], couplings: list[Any], q: list[float]) -> list[Row]:
    """6.8.7: the rows of M."""
    reach = robot.reach()
    unit = [reach if robot.is_length(dof) else 1.0 for dof in range(len(q))]
    rows = [row for loop in loops for row in rows_of_loop(robot, loop, q, reach)]
    rows = [{dof: value * unit[dof] for dof, value in row.items()} for row in rows]
    for coupling in couplings:
        row, size = {}, 0.0
        for term in coupling["terms"]:
            dof = term["dof_idx"]
            power = unit[dof]
            row[dof] = 0.0
            for number, coefficient in enumerate(term["coefficients"]):
                summand = (number + 1) * float(coefficient) * power
                row[dof] += summand
                size = max(size, abs(summand))
                power *= q[dof]
        rows.append({dof: value / size if size > 0 else 0.0 for dof, value in row.items()})
    return rows


def parts_of(rows: list[Row]) -> list[list[Row]]:
    """The rows, parted so that no column has numbers other than 0 in two parts."""
    groups: list[tuple[set[int], list[Row]]] = []
    for row in rows:
        used = {dof: value for dof, value in row.items() if value != 0}
        if not used:
            continue
        columns, members = set(used), [used]
        apart = []
        for group in groups:
            if columns.isdisjoint(group[0]):
                apart.append(group)
            else:
                columns |= group[0]
                members = group[1] + members
        groups = [*apart, (columns, members)]
    return [members for _, members in groups]


def dense(part: list[Row]) -> list[list[float]]:
    """The rows or the columns of a part, whichever are fewer."""
    columns = sorted({dof for row in part for dof in row})
    if len(part) <= len(columns):
        return [[row.get(dof, 0.0) for dof in columns] for row in part]
    return [[row.get(dof, 0.0) for row in part] for dof in columns]


def singular_values(vectors: list[list[float]]) -> list[float]:
    """Jacobi's method on one side: turns pairs of vectors until all are orthogonal."""
    vectors = list(vectors)
    squares = [sum(map(mul, one, one)) for one in vectors]
    negligible = NEGLIGIBLE * sum(squares)
    for _ in range(MAX_SWEEPS):
        turned_any = False
        for i in range(len(vectors) - 1):
            for j in range(i + 1, len(vectors)):
                one, other = vectors[i], vectors[j]
                inner = sum(map(mul, one, other))
                limit = NEARLY_ORTHOGONAL * math.sqrt(squares[i] * squares[j])
                if abs(inner) <= max(limit, negligible):
                    continue
                turned_any = True
                half = (squares[j] - squares[i]) / (2 * inner)
                t = math.copysign(1.0, half) / (abs(half) + math.hypot(1.0, half))
                c = 1 / math.hypot(1.0, t)
                s = c * t
                vectors[i] = [c * x - s * y for x, y in zip(one, other)]
                vectors[j] = [s * x + c * y for x, y in zip(one, other)]
                squares[i] = sum(map(mul, vectors[i], vectors[i]))
                squares[j] = sum(map(mul, vectors[j], vectors[j]))
        if not turned_any:
            break
    return [math.sqrt(square) for square in squares]


def independence(
    robot: Robot, loops: list[Any], couplings: list[Any], q: list[float], independent: list[int]
) -> str:
    """LOP009 or LOP010, where the independent DOFs break one of them, or nothing."""
    rows = matrix(robot, loops, couplings, q)
    numbers = [value for row in rows for value in row.values()]
    if not finite([sum(map(mul, numbers, numbers))]):
        return ""
    others = set(range(len(q))) - set(independent)
    rest = [{dof: value for dof, value in row.items() if dof in others} for row in rows]
    whole = [dense(part) for part in parts_of(rows)]
    without = [dense(part) for part in parts_of(rest)]
    if sum(len(part) ** 2 * len(part[0]) for part in whole) > MAX_WORK:
        return "LOP009" if len(others) > sum(len(part) for part in whole) else ""
    values = [value for part in whole for value in singular_values(part)]
    largest = max(values, default=0.0)
    if not least_rank(values, largest) <= len(others) <= most_rank(values, largest):
        return "LOP009"
    values = [value for part in without for value in singular_values(part)]
    return "LOP010" if most_rank(values, largest) < len(others) else ""


def least_rank(values: list[float], largest: float) -> int:
    """The fewest singular values that may be counted."""
    return len([value for value in values if value > max(LEAST, EDGES[1] * largest)])


def most_rank(values: list[float], largest: float) -> int:
    """The most singular values that may be counted."""
    return len([value for value in values if value > LEAST and value >= EDGES[0] * largest])

"""Joints, mimics, configurations and poses (5.4 to 5.10, 6.5, 9)."""

from __future__ import annotations

import math
from typing import Any

from .numeric import (
    IDENTITY,
    Matrix,
    Vector,
    add,
    from_axis_angle,
    from_quaternion,
    from_rotation_vector,
    from_rpy,
    norm,
    product,
    scaled,
    turned,
)

NUM_DOFS = {"Revolute": 1, "Continuous": 1, "Prismatic": 1, "Planar": 3, "Floating": 6}
NUM_DOFS |= {"Spherical": 3, "Fixed": 0}
WITH_AXIS = ("Revolute", "Continuous", "Prismatic", "Planar")
SUFFIXES = {
    "Planar": ("/trans_x", "/trans_y", "/rot"),
    "Floating": ("/trans_x", "/trans_y", "/trans_z", "/rot_x", "/rot_y", "/rot_z"),
    "Spherical": ("/rot_x", "/rot_y", "/rot_z"),
}
LENGTHS = {"Prismatic": 1, "Planar": 2, "Floating": 3}  # 5.8: the first DOFs of these are lengths
NEARLY_Z = 1e-10  # 5.9
LEAST_REACH = 1e-3  # 5.6
MASK = 2**64 - 1
Pose = tuple[Matrix, tuple[float, float, float]]
ORIGIN: Pose = (IDENTITY, (0.0, 0.0, 0.0))


def is_mimic(joint: dict[str, Any]) -> bool:
    """6.1.5."""
    return joint["mimic"] is not None and joint["joint_type"] != "Fixed"


def rotation_of(origin: dict[str, Any] | None, version: tuple[int, int]) -> Matrix:
    """6.1.9: the rotation of an `origin`."""
    if origin and origin["quat_xyzw"] and version >= (1, 1):
        x, y, z, w = origin["quat_xyzw"]
        return from_quaternion((w, x, y, z))
    return from_rpy(origin["rpy"]) if origin and origin["rpy"] else IDENTITY


def position_of(origin: dict[str, Any] | None) -> tuple[float, float, float]:
    return tuple(origin["xyz"]) if origin and origin["xyz"] else (0.0, 0.0, 0.0)  # type: ignore


def unit_axis(joint: dict[str, Any]) -> tuple[float, float, float]:
    """5.7."""
    axis = joint["axis"] and joint["axis"]["xyz"]
    turns = axis and joint["joint_type"] in WITH_AXIS
    return scaled(axis, 1 / norm(axis)) if turns else (1.0, 0.0, 0.0)


def in_plane(n: Vector) -> tuple[Vector, Vector]:
    """5.9."""
    flat = n[0] * n[0] + n[1] * n[1]
    if math.sqrt(flat) < NEARLY_Z:
        return (1.0, 0.0, 0.0), (0.0, math.copysign(1.0, n[2]), 0.0)
    k = (1 - n[2]) / flat
    x = (1 - k * n[0] * n[0], -k * n[0] * n[1], -n[0])
    return x, (-k * n[0] * n[1], 1 - k * n[1] * n[1], -n[1])


class Robot:
    """What follows from the document of `urdf_module`, once 6.1.3 to 6.1.6 hold."""

    def __init__(self, document: dict[str, Any], version: tuple[int, int]) -> None:
        self.version = version
        self.links = document["links"]
        self.joints = document["joints"]
        self.link_place = {link["name"]: place for place, link in enumerate(self.links)}
        self.joint_place = {joint["name"]: place for place, joint in enumerate(self.joints)}
        self.parent = [self.link_place[joint["parent"]["link"]] for joint in self.joints]
        self.child = [self.link_place[joint["child"]["link"]] for joint in self.joints]
        self.above: list[int | None] = [None] * len(self.links)
        for place, child in enumerate(self.child):
            self.above[child] = place
        self.root = self.above.index(None)
        self.levels = [[self.root]]
        while self.levels[-1]:
            last = set(self.levels[-1])
            below = [c for c, p in zip(self.child, self.parent) if p in last]
            self.levels.append(sorted(below))
        self.levels.pop()
        self.dof_joint = [
            place
            for place, joint in enumerate(self.joints)
            if not is_mimic(joint)
            for _ in range(NUM_DOFS[joint["joint_type"]])
        ]
        self.dofs_of: list[list[int]] = [[] for _ in self.joints]
        for dof, place in enumerate(self.dof_joint):
            self.dofs_of[place].append(dof)
        self.origins: list[Pose] = [
            (rotation_of(joint["origin"], version), position_of(joint["origin"]))
            for joint in self.joints
        ]
        self.axes = [unit_axis(joint) for joint in self.joints]
        self.mimics = [self.resolved(place) for place in range(len(self.joints))]

    def resolved(self, place: int) -> tuple[int | None, float, float] | None:
        """5.10: the DOF, multiplier and offset of a mimic joint."""
        if not is_mimic(self.joints[place]):
            return None
        multiplier, offset = 1.0, 0.0
        at = place
        while is_mimic(self.joints[at]):
            mimic = self.joints[at]["mimic"]
            m = 1.0 if mimic["multiplier"] is None else float(mimic["multiplier"])
            o = 0.0 if mimic["offset"] is None else float(mimic["offset"])
            multiplier, offset = multiplier * m, multiplier * o + offset
            at = self.joint_place[mimic["joint"]]
        return (self.dofs_of[at][0] if self.dofs_of[at] else None), multiplier, offset

    def limited(self, place: int) -> tuple[float, float] | None:
        """6.5.2: the limits of a limited joint."""
        joint = self.joints[place]
        limit = joint["limit"]
        if joint["joint_type"] not in ("Revolute", "Prismatic") or not limit:
            return None
        if limit["lower"] is None and limit["upper"] is None:
            return None
        return float(limit["lower"] or 0.0), float(limit["upper"] or 0.0)

    def is_length(self, dof: int) -> bool:
        """5.8."""
        place = self.dof_joint[dof]
        first = self.dofs_of[place][0]
        return dof - first < LENGTHS.get(self.joints[place]["joint_type"], 0)

    def bounds(self, dof: int) -> tuple[float, float]:
        """6.5.2, 6.5.3."""
        limits = self.limited(self.dof_joint[dof])
        if limits:
            return limits
        return (-1.0, 1.0) if self.is_length(dof) else (-math.pi, math.pi)

    def rotation_vectors(self) -> list[int]:
        """The first DOF of each rotation vector."""
        found = []
        for joint, dofs in zip(self.joints, self.dofs_of):
            if joint["joint_type"] in ("Floating", "Spherical"):
                found.append(dofs[-3])
        return found

    def path(self, link: int) -> list[int]:
        """The joints from the root to a link."""
        found = []
        joint = self.above[link]
        while joint is not None:
            found.append(joint)
            joint = self.above[self.parent[joint]]
        return found[::-1]

    def reach(self) -> float:
        """5.6."""
        lengths = [0.0] * len(self.links)
        for level in self.levels[1:]:
            for link in level:
                joint = self.above[link]
                assert joint is not None
                travel = self.travel(joint)
                lengths[link] = lengths[self.parent[joint]] + travel + norm(self.origins[joint][1])
        return max(LEAST_REACH, *lengths)

    def travel(self, place: int) -> float:
        """5.6: how far a joint moves its child at most."""
        kind = self.joints[place]["joint_type"]
        limits = self.limited(place) if kind == "Prismatic" else None
        if limits:
            return max(abs(limits[0]), abs(limits[1]))
        return 1.0 if kind in LENGTHS else 0.0


def motion(kind: str, axis: Vector, q: Vector) -> Pose:
    """9.1: the motion of a joint."""
    if kind == "Prismatic":
        return IDENTITY, scaled(axis, q[0])
    if kind in ("Revolute", "Continuous"):
        return from_axis_angle(axis, q[0]), ORIGIN[1]
    if kind == "Planar":
        x, y = in_plane(axis)
        return from_axis_angle(axis, q[2]), add(scaled(x, q[0]), scaled(y, q[1]))
    if kind == "Floating":
        return from_rotation_vector(q[3:]), (q[0], q[1], q[2])
    return (from_rotation_vector(q), ORIGIN[1]) if kind == "Spherical" else ORIGIN


def compose(a: Pose, b: Pose) -> Pose:
    """5.5."""
    return product(a[0], b[0]), add(turned(a[0], b[1]), a[1])


def joint_position(robot: Robot, joint: int, configuration: Vector) -> list[float]:
    """9.1: a joint's q."""
    mimic = robot.mimics[joint]
    if mimic:
        dof, multiplier, offset = mimic
        return [offset if dof is None else multiplier * configuration[dof] + offset]
    return [configuration[dof] for dof in robot.dofs_of[joint]]


def moved(robot: Robot, joint: int, parent: Pose, q: Vector) -> Pose:
    """9.1: the pose of a joint's child link, from that of its parent link."""
    motion_of_q = motion(robot.joints[joint]["joint_type"], robot.axes[joint], q)
    return compose(compose(parent, robot.origins[joint]), motion_of_q)


def poses(robot: Robot, configuration: Vector) -> list[Pose]:
    """9.1: the poses of all links."""
    found = [ORIGIN] * len(robot.links)
    for level in robot.levels[1:]:
        for link in level:
            joint = robot.above[link]
            assert joint is not None
            q = joint_position(robot, joint, configuration)
            found[link] = moved(robot, joint, found[robot.parent[joint]], q)
    return found


def uniform(k: int, i: int) -> float:
    """9.3."""
    z = (k * 2**32 + i + 1) * 0x9E3779B97F4A7C15 & MASK
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9 & MASK
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB & MASK
    return ((z ^ (z >> 31)) >> 11) * 2.0**-53


def sampled(robot: Robot, k: int) -> list[float]:
    """9.3: a sampled configuration."""
    found = []
    for dof in range(len(robot.dof_joint)):
        lower, upper = robot.bounds(dof)
        u = uniform(k, dof)
        found.append(lower * (1 - u) + upper * u)
    for first in robot.rotation_vectors():
        u1, u2, u3 = (uniform(k, first + n) for n in range(3))
        w, z = (
            math.sqrt(u1) * math.cos(2 * math.pi * u3),
            math.sqrt(u1) * math.sin(2 * math.pi * u3),
        )
        x = math.sqrt(1 - u1) * math.sin(2 * math.pi * u2)
        y = math.sqrt(1 - u1) * math.cos(2 * math.pi * u2)
        sign = -1.0 if w < 0 else 1.0
        length = math.hypot(x, y, z)
        angle = 2 * math.atan2(length, abs(w))
        factor = sign * angle / length if length > 0 else 0.0
        found[first : first + 3] = [x * factor, y * factor, z * factor]
    return found


def named(robot: Robot, kind: str) -> list[float]:
    """9.4: one of the other configurations, or the default one."""
    found = []
    for dof in range(len(robot.dof_joint)):
        lower, upper = robot.bounds(dof)
        nearest = min(max(0.0, min(lower, upper)), max(lower, upper))
        values = {"Zero": 0.0, "Middle": lower / 2 + upper / 2, "Lower": lower, "Upper": upper}
        found.append(values.get(kind, nearest))
    for first in robot.rotation_vectors():
        turn = {"Lower": -math.pi, "Upper": math.pi}.get(kind, 0.0)
        found[first : first + 3] = [turn, 0.0, 0.0]
    return found

"""The rules of `loops_module` (6.8)."""

from __future__ import annotations

import math
from typing import Any

from .core_rules import signed
from .derived_rules import is_within
from .kinematics import ORIGIN, Pose, Robot, compose, joint_position, moved, sampled
from .loops_matrix import independence
from .modules import Urdd, file_of
from .numeric import (
    ABSOLUTE,
    IDENTITY,
    RELATIVE,
    component_agrees,
    distance,
    finite,
    from_quaternion,
    from_rotation_vector,
    norm,
    rotation_distance,
    sub,
    transposed,
    turned,
)

FILE = file_of("loops_module")
BEFORE = ("urdf_module", "dof_module", "chain_module", "bounds_module")
LONGEST = math.pi * (1 + RELATIVE)  # 6.8.6: of a rotation vector
# 6.8.3: of each kind, the held components of the position, and what it holds of the rotation
HELD: dict[str, tuple[tuple[int, ...], str]] = {
    "Fixed": ((0, 1, 2), "all"),
    "Revolute": ((0, 1, 2), "direction"),
    "Prismatic": ((0, 1), "all"),
    "Cylindrical": ((0, 1), "direction"),
    "Universal": ((0, 1, 2), "right angle"),
    "Spherical": ((0, 1, 2), ""),
    "Planar": ((2,), "direction"),
}


class Loop:
    """A loop, with the joints from the root to each of its frames."""

    def __init__(self, robot: Robot, stated: dict[str, Any]) -> None:
        self.joints_a = robot.path(stated["link_a_idx"])
        self.joints_b = robot.path(stated["link_b_idx"])
        self.frame_a, self.frame_b = pose_of(stated["frame_a"]), pose_of(stated["frame_b"])
        self.position_tolerance = float(stated["position_tolerance"])
        self.rotation_tolerance = float(stated["rotation_tolerance"])
        self.components, self.rotation = HELD[stated["kind"]]

    def frames(self, robot: Robot, q: list[float]) -> tuple[Pose, Pose]:
        """The poses of frames A and B in the root."""
        found = []
        for joints, frame in ((self.joints_a, self.frame_a), (self.joints_b, self.frame_b)):
            at: Pose = ORIGIN
            for joint in joints:
                at = moved(robot, joint, at, joint_position(robot, joint, q))
            found.append(compose(at, frame))
        return found[0], found[1]

    def gaps(self, robot: Robot, q: list[float]) -> tuple[float, float]:
        """6.8.3: the position gap and the rotation gap."""
        a, b = self.frames(robot, q)
        rotation, position = compose((transposed(a[0]), (0.0, 0.0, 0.0)), (b[0], sub(b[1], a[1])))
        apart = norm([position[component] for component in self.components])
        z = turned(rotation, IDENTITY[2])
        turns = {
            "all": rotation_distance(rotation, IDENTITY),
            "direction": distance(z, IDENTITY[2]),
            "right angle": abs(z[2]),
        }
        return apart, turns.get(self.rotation, 0.0)


def pose_of(stated: dict[str, Any]) -> Pose:
    """5.5."""
    x, y, z = stated["position"]
    return from_quaternion(stated["quaternion_wxyz"]), (float(x), float(y), float(z))


def check_frames(urdd: Urdd, robot: Robot, loops: list[Any]) -> None:
    """6.8.2, 6.8.4: what is stated of each loop."""
    for place, loop in enumerate(loops):
        links = (loop["link_a_idx"], loop["link_b_idx"])
        if links[0] == links[1] or max(links) >= len(robot.links):
            urdd.report.error("LOP001", FILE, f"/loops/{place}")
        for name in ("frame_a", "frame_b"):
            quaternion = loop[name]["quaternion_wxyz"]
            if abs(norm(quaternion) - 1) > RELATIVE or not signed(quaternion):
                pointer = f"/loops/{place}/{name}/quaternion_wxyz"
                urdd.report.error("LOP003", FILE, pointer)
        if loop["position_tolerance"] < 0 or loop["rotation_tolerance"] < 0:
            urdd.report.error("LOP011", FILE, f"/loops/{place}")


def check_couplings(urdd: Urdd, robot: Robot, couplings: list[Any]) -> None:
    """6.8.5: what is stated of each coupling."""
    for place, coupling in enumerate(couplings):
        terms = coupling["terms"]
        right = are_dofs(robot, [term["dof_idx"] for term in terms]) and all(
            any(term["coefficients"]) for term in terms
        )
        if not terms or not right:
            urdd.report.error("LOP004", FILE, f"/couplings/{place}/terms")


def are_dofs(robot: Robot, dofs: list[int]) -> bool:
    """6.8.5, 6.8.7: DOFs that are there, in ascending order, each once."""
    return dofs == sorted(set(dofs)) and all(dof < len(robot.dof_joint) for dof in dofs)


def holds(coupling: dict[str, Any], q: list[float]) -> bool:
    """6.8.5: whether a coupling holds."""
    summands = [float(coupling["constant"])]
    for term in coupling["terms"]:
        power = 1.0
        for coefficient in term["coefficients"]:
            power *= q[term["dof_idx"]]
            if coefficient:
                summands.append(float(coefficient) * power)
    total, size = sum(summands), sum(abs(one) for one in summands)
    return finite([size]) and abs(total) <= max(RELATIVE * size, ABSOLUTE)


def is_closed(robot: Robot, loops: list[Loop], couplings: list[Any], q: list[float]) -> bool:
    """6.8.4, 6.8.6. A pose that is not finite closes nothing."""
    near = RELATIVE * robot.reach()
    for loop in loops:
        try:
            apart, turn = loop.gaps(robot, q)
        except (OverflowError, ValueError):
            return False
        if not apart <= loop.position_tolerance + near:
            return False
        if not turn <= loop.rotation_tolerance + RELATIVE:
            return False
    return all(holds(coupling, q) for coupling in couplings)


def follows_sample(robot: Robot, independent: list[int], k: int, q: list[float]) -> bool:
    """6.8.8, 5.6: whether independent DOFs have the values of a sampled configuration."""
    right = sampled(robot, k)
    free = set(independent)
    for first in robot.rotation_vectors():
        vector = {first, first + 1, first + 2}
        stated, drawn = q[first : first + 3], right[first : first + 3]
        if free >= vector and norm(stated) <= math.pi * (1 + RELATIVE):
            turn = rotation_distance(from_rotation_vector(stated), from_rotation_vector(drawn))
            free -= vector if turn <= RELATIVE else set()
    return all(component_agrees(q[dof], right[dof], robot.bounds(dof)) for dof in free)


def check_loops(urdd: Urdd, robot: Robot) -> None:
    """6.8, where the modules that it is derived from are right."""
    report = urdd.report
    clean = report.clean("DOF", "CHN", "BND", "KIN001")
    if not clean or not urdd.have(*BEFORE, "loops_module"):
        return
    document = urdd.documents["loops_module"]
    names = [one["name"] for one in document["loops"] + document["couplings"]]
    if len(set(names)) != len(names):
        report.error("LOP002", FILE, "/loops")  # 6.8.2
    check_frames(urdd, robot, document["loops"])
    check_couplings(urdd, robot, document["couplings"])
    independent = document["independent_dof_idxs"]
    if not are_dofs(robot, independent):
        report.error("LOP005", FILE, "/independent_dof_idxs")  # 6.8.7
    check_configurations(urdd, robot, document)


def check_configurations(urdd: Urdd, robot: Robot, document: dict[str, Any]) -> None:
    """6.8.6 to 6.8.8."""
    report = urdd.report
    independent = document["independent_dof_idxs"]
    stated = [(None, document["reference_configuration"], "/reference_configuration")]
    for place, sample in enumerate(document["closed_samples"]):
        pointer = f"/closed_samples/{place}"
        if sample["sample_idx"] != place:
            report.error("LOP013", FILE, pointer + "/sample_idx")  # 6.8.8
        if sample["configuration"] is not None:
            stated.append((place, sample["configuration"], pointer + "/configuration"))
    known_dofs = report.clean("LOP005")
    can_close = report.clean("LOP001", "LOP003", "LOP004", "LOP011")
    loops = [Loop(robot, loop) for loop in document["loops"]] if can_close else []
    for k, values, pointer in stated:
        q = [float(value) for value in values]
        if len(q) != len(robot.dof_joint):
            report.error("LOP006", FILE, pointer)  # 6.8.6
        elif k is not None and known_dofs and not follows_sample(robot, independent, k, q):
            report.error("LOP013", FILE, pointer)  # 6.8.8
        elif not all(is_within(robot, dof, value) for dof, value in enumerate(q)):
            report.error("LOP007", FILE, pointer)  # 6.8.6
        elif any(norm(q[at : at + 3]) > LONGEST for at in robot.rotation_vectors()):
            report.error("LOP007", FILE, pointer)  # 6.8.6
        elif can_close and not is_closed(robot, loops, document["couplings"], q):
            report.error("LOP008", FILE, pointer)  # 6.8.6
        elif k is None and can_close and known_dofs:
            code = independence(robot, loops, document["couplings"], q, independent)
            if code:
                report.error(code, FILE, "/independent_dof_idxs")  # 6.8.7

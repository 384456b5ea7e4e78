"""The rules of `dof_module`, `chain_module` and `bounds_module` (6.2, 6.3, 6.5)."""

from __future__ import annotations

import math
from typing import Any

from .kinematics import NUM_DOFS, SUFFIXES, WITH_AXIS, Robot, is_mimic
from .modules import Urdd, file_of
from .numeric import (
    RELATIVE,
    agree,
    distance,
    from_quaternion,
    norm,
    rotation_distance,
)

DOF = file_of("dof_module")
CHAIN = file_of("chain_module")
BOUNDS = file_of("bounds_module")


def check_dofs(urdd: Urdd, robot: Robot, document: dict[str, Any]) -> None:
    """6.2."""
    error = urdd.report.error
    count = document["num_dofs"]
    joint_of, dofs = document["dof_idx_to_joint_idx_mapping"], document["dofs"]
    dofs_of = document["joint_idx_to_dof_idxs_mapping"]
    mimics = document["joint_idx_to_mimic_mapping"]
    if not count == len(joint_of) == len(dofs):
        error("DOF001", DOF, "/num_dofs")  # 6.2.1
    if not len(dofs_of) == len(mimics) == len(robot.joints):
        error("DOF002", DOF, "/joint_idx_to_dof_idxs_mapping")  # 6.2.1
    if not urdd.report.clean("DOF"):
        return
    for place, joint in enumerate(robot.joints):
        expected = 0 if is_mimic(joint) else NUM_DOFS[joint["joint_type"]]
        if len(dofs_of[place]) != expected:
            error("DOF004", DOF, f"/joint_idx_to_dof_idxs_mapping/{place}")  # 6.2.2
    if not urdd.report.clean("DOF"):
        return
    pairs = sorted((dof, place) for place, listed in enumerate(dofs_of) for dof in listed)
    if pairs != list(enumerate(joint_of)):
        error("DOF003", DOF, "/dof_idx_to_joint_idx_mapping")  # 6.2.3
    elif list(joint_of) != sorted(joint_of) or any(list(d) != sorted(d) for d in dofs_of):
        error("DOF005", DOF, "/dof_idx_to_joint_idx_mapping")  # 6.2.4
    if not urdd.report.clean("DOF"):
        return
    for place, dof in enumerate(dofs):
        joint = robot.dof_joint[place]
        name = robot.joints[joint]["name"]
        suffixes = SUFFIXES.get(robot.joints[joint]["joint_type"], ("",))
        expected_dof = {
            "name": name + suffixes[place - robot.dofs_of[joint][0]],
            "joint_idx": joint,
            "joint_name": name,
            "quantity": "Length" if robot.is_length(place) else "Angle",
        }
        if any(dof[key] != value for key, value in expected_dof.items()):
            error("DOF006", DOF, f"/dofs/{place}")  # 6.2.5
    for place, stated in enumerate(mimics):
        if not mimic_agrees(robot.mimics[place], stated):
            error("DOF007", DOF, f"/joint_idx_to_mimic_mapping/{place}")  # 6.2.6


def mimic_agrees(resolved: Any, stated: Any) -> bool:
    """6.2.6, 5.10: a product or sum that is not finite agrees with nothing."""
    if resolved is None or stated is None:
        return resolved is None and stated is None
    dof, multiplier, offset = resolved
    return (
        stated["dof_idx"] == dof
        and math.isfinite(multiplier)
        and math.isfinite(offset)
        and agree(multiplier, stated["multiplier"])
        and agree(offset, stated["offset"])
    )


def check_chain_links(urdd: Urdd, robot: Robot, links: list[Any]) -> None:
    """6.3.1, 6.3.2."""
    error = urdd.report.error
    names = [link["name"] for link in robot.links]
    if [link["name"] for link in links] != names:
        error("CHN001", CHAIN, "/links_in_chain")
    for place, link in enumerate(links[: len(names)]):
        pointer = f"/links_in_chain/{place}"
        if link["link_idx"] != place:
            error("CHN001", CHAIN, pointer + "/link_idx")
        joint = robot.above[place]
        parent = None if joint is None else robot.parent[joint]
        if (link["parent_joint_idx"], link["parent_link_idx"]) != (joint, parent):
            error("CHN003", CHAIN, pointer)
        below = [j for j, p in enumerate(robot.parent) if p == place]
        children = sorted(robot.child[j] for j in below)
        if link["children_joint_idxs"] != below or link["children_link_idxs"] != children:
            error("CHN004", CHAIN, pointer)


def check_chain_joints(urdd: Urdd, robot: Robot, joints: list[Any]) -> None:
    """6.3.1, 6.3.4."""
    error = urdd.report.error
    reach = robot.reach()
    if len(joints) != len(robot.joints):
        error("CHN002", CHAIN, "/joints_in_chain")
        return
    for place, (joint, urdf) in enumerate(zip(joints, robot.joints)):
        pointer = f"/joints_in_chain/{place}"
        expected = {
            "joint_name": urdf["name"],
            "joint_idx": place,
            "parent_link_name": urdf["parent"]["link"],
            "parent_link_idx": robot.parent[place],
            "child_link_name": urdf["child"]["link"],
            "child_link_idx": robot.child[place],
        }
        if any(joint[key] != value for key, value in expected.items()):
            error("CHN002", CHAIN, pointer)
        if joint["joint_type"] != urdf["joint_type"]:
            error("CHN007", CHAIN, pointer + "/joint_type")
        check_origin(urdd, robot, place, joint["origin"], reach)
        axis = joint["axis"]
        if urdf["joint_type"] not in WITH_AXIS:
            if axis is not None:
                error("CHN009", CHAIN, pointer + "/axis")
        elif axis is None or distance(axis, robot.axes[place]) > RELATIVE:
            error("CHN009", CHAIN, pointer + "/axis")


def check_origin(urdd: Urdd, robot: Robot, place: int, stated: Any, reach: float) -> None:
    """6.3.4: position and quaternion."""
    pointer = f"/joints_in_chain/{place}/origin"
    quaternion = stated["quaternion_wxyz"]
    rotation, position = robot.origins[place]
    if abs(norm(quaternion) - 1) > RELATIVE or not signed(quaternion):
        urdd.report.error("CHN010", CHAIN, pointer + "/quaternion_wxyz")
    turn = rotation_distance(from_quaternion(quaternion), rotation)
    apart = distance(stated["position"], position)
    if apart > RELATIVE * reach or turn > RELATIVE:
        urdd.report.error("CHN008", CHAIN, pointer)


def signed(quaternion: Any) -> bool:
    """5.4: w above 0, or else the first of x, y, z that is not 0."""
    return next((part > 0 for part in quaternion if part != 0), False)


def check_chain(urdd: Urdd, robot: Robot, document: dict[str, Any]) -> None:
    """6.3."""
    check_chain_links(urdd, robot, document["links_in_chain"])
    check_chain_joints(urdd, robot, document["joints_in_chain"])
    if document["kinematic_hierarchy"] != robot.levels:
        urdd.report.error("CHN005", CHAIN, "/kinematic_hierarchy")  # 6.3.3
    if document["root_idx"] != robot.root:
        urdd.report.error("CHN006", CHAIN, "/root_idx")  # 6.3.3


def check_bounds(urdd: Urdd, robot: Robot, document: dict[str, Any]) -> None:
    """6.5."""
    error = urdd.report.error
    count = len(robot.dof_joint)
    names = ("bounds", "dof_lower_bounds", "dof_upper_bounds", "dof_limited")
    names += ("dof_velocity_limits", "dof_effort_limits")
    for name in names:
        if len(document[name]) != count:
            error("BND001", BOUNDS, "/" + name)  # 6.5.1
    if not urdd.report.clean("BND"):
        return
    for dof, bounds in enumerate(document["bounds"]):
        columns = (document["dof_lower_bounds"][dof], document["dof_upper_bounds"][dof])
        if not (agree(bounds[0], columns[0]) and agree(bounds[1], columns[1])):
            error("BND002", BOUNDS, f"/bounds/{dof}")  # 6.5.1
        joint = robot.dof_joint[dof]
        limited = robot.limited(joint) is not None
        right = robot.bounds(dof)
        if not (agree(bounds[0], right[0]) and agree(bounds[1], right[1])):
            error("BND003" if limited else "BND006", BOUNDS, f"/bounds/{dof}")  # 6.5.2, 6.5.3
        if document["dof_limited"][dof] != limited:
            error("BND004", BOUNDS, f"/dof_limited/{dof}")  # 6.5.2
        limit = robot.joints[joint]["limit"] if len(robot.dofs_of[joint]) == 1 else None
        for key in ("velocity", "effort"):
            stated = document[f"dof_{key}_limits"][dof]
            of_urdf = limit and limit[key]
            if (stated is None) != (of_urdf is None) or not agree(stated, of_urdf):
                error("BND005", BOUNDS, f"/dof_{key}_limits/{dof}")  # 6.5.4

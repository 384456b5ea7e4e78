"""The rules of connections, samples, named configurations and poses (6.4, 6.7, 9.1, 9.2)."""

from __future__ import annotations

import math
from typing import Any

from .core_rules import check_bounds, check_chain, check_dofs
from .kinematics import Robot, named, poses, sampled
from .modules import Urdd, file_of
from .numeric import (
    RELATIVE,
    component_agrees,
    distance,
    finite,
    from_quaternion,
    from_rotation_vector,
    norm,
    rotation_distance,
)
from .urdf import VERSION

CONNECTIONS = file_of("connections_module")
SAMPLES = file_of("kinematics_samples_module")
CONFIGURATIONS = file_of("named_configurations_module")
MAX_EXPLICIT_LINKS = 300  # 6.4.6
MAX_EXPLICIT_PLACES = 2_000_000  # 6.4.6
KINDS = ("Zero", "Middle", "Lower", "Upper")


def check_connections(urdd: Urdd, robot: Robot, document: dict[str, Any]) -> None:
    """6.4."""
    error = urdd.report.error
    count = len(robot.links)
    tables = ("lowest_common_ancestors", "link_to_link_paths", "link_connection_paths")
    if len(document["root_paths"]) != count:
        error("CON001", CONNECTIONS, "/root_paths")  # 6.4.1
    for name in tables:
        table = document[name]
        if table is not None and not (
            len(table) == count and all(len(row) == count for row in table)
        ):
            error("CON001", CONNECTIONS, "/" + name)  # 6.4.1
    if not urdd.report.clean("CON"):
        return
    joints = [robot.path(link) for link in range(count)]
    links = [[robot.root, *(robot.child[joint] for joint in path)] for path in joints]
    for place, path in enumerate(document["root_paths"]):
        if path["links"] != links[place] or path["joints"] != joints[place]:
            error("CON002", CONNECTIONS, f"/root_paths/{place}")  # 6.4.2
    below = [len([path for path in joints if joint in path]) for joint in range(len(robot.joints))]
    places = count * count + 2 * sum(s * (count - s) for s in below)
    explicit = count <= MAX_EXPLICIT_LINKS and places <= MAX_EXPLICIT_PLACES
    for name in tables[1:]:
        if document[name] is None and explicit:
            error("CON006", CONNECTIONS, "/" + name)  # 6.4.6
    for i in range(count):
        for j in range(count):
            check_pair(urdd, document, joints, links, i, j)


def check_pair(urdd: Urdd, document: Any, joints: Any, links: Any, i: int, j: int) -> None:
    """6.4.3 to 6.4.5: what is stated of two links."""
    shared = 0
    while shared < min(len(joints[i]), len(joints[j])) and joints[i][shared] == joints[j][shared]:
        shared += 1
    if document["lowest_common_ancestors"][i][j] != links[i][shared]:
        urdd.report.error("CON003", CONNECTIONS, f"/lowest_common_ancestors/{i}/{j}")
    if document["link_to_link_paths"] is not None:
        path = document["link_to_link_paths"][i][j]
        right_links = links[i][shared:][::-1] + links[j][shared + 1 :]
        right_joints = joints[i][shared:][::-1] + joints[j][shared:]
        if path["links"] != right_links or path["joints"] != right_joints:
            urdd.report.error("CON004", CONNECTIONS, f"/link_to_link_paths/{i}/{j}")
    if document["link_connection_paths"] is not None:
        descends = shared == len(joints[i])
        right = ([i] if i == j else links[j][shared + 1 :]) if descends else None
        if document["link_connection_paths"][i][j] != right:
            urdd.report.error("CON005", CONNECTIONS, f"/link_connection_paths/{i}/{j}")


def check_poses(urdd: Urdd, robot: Robot) -> None:
    """9.1: all poses that `chain_module` and `dof_module` give are finite, and the URDF's.

    The rules of both documents compare each number of them; small differences may still add up.
    """
    chain = urdd.documents["chain_module"]
    stated = Robot.__new__(Robot)
    stated.__dict__.update(robot.__dict__)
    stated.origins = [
        (from_quaternion(joint["origin"]["quaternion_wxyz"]), tuple(joint["origin"]["position"]))
        for joint in chain["joints_in_chain"]
    ]
    stated.axes = [
        joint["axis"] or axis for joint, axis in zip(chain["joints_in_chain"], robot.axes)
    ]
    mimics = urdd.documents["dof_module"]["joint_idx_to_mimic_mapping"]
    stated.mimics = [m and (m["dof_idx"], m["multiplier"], m["offset"]) for m in mimics]
    tolerance = RELATIVE * robot.reach()
    for configuration in [named(robot, kind) for kind in KINDS] + [sampled(robot, 0)]:
        for one, other in zip(poses(robot, configuration), poses(stated, configuration)):
            numbers = [*one[1], *other[1]]
            same = finite(numbers) and distance(one[1], other[1]) <= tolerance
            if not same or rotation_distance(one[0], other[0]) > RELATIVE:
                urdd.report.error("KIN001", file_of("chain_module"), "/joints_in_chain")
                return


def check_samples(urdd: Urdd, robot: Robot, document: dict[str, Any]) -> None:
    """9.2."""
    error = urdd.report.error
    samples = document["samples"]
    order = [(sample["kind"], sample["sample_idx"]) for sample in samples]
    count = max(0, len(samples) - len(KINDS))
    if order != [(kind, None) for kind in KINDS] + [("Sampled", k) for k in range(count)]:
        error("KIN004", SAMPLES, "/samples")
        return
    tolerance = RELATIVE * robot.reach()
    for place, sample in enumerate(samples):
        pointer = f"/samples/{place}"
        q = sample["configuration"]
        if len(q) != len(robot.dof_joint) or len(sample["link_poses"]) != len(robot.links):
            error("KIN004", SAMPLES, pointer)
            continue
        k = sample["sample_idx"]
        right = named(robot, sample["kind"]) if k is None else sampled(robot, k)
        if not configuration_agrees(robot, q, right, k is not None):
            error("KIN002", SAMPLES, pointer + "/configuration")
            continue
        for link, (rotation, position) in enumerate(poses(robot, right)):
            stated = sample["link_poses"][link]
            quaternion = stated["quaternion_wxyz"]
            unit = abs(norm(quaternion) - 1) <= RELATIVE and quaternion[0] >= -RELATIVE
            near = distance(stated["position"], position) <= tolerance
            turn = rotation_distance(from_quaternion(quaternion), rotation)
            if not unit or not near or turn > RELATIVE:
                error("KIN003", SAMPLES, f"{pointer}/link_poses/{link}")


def configuration_agrees(robot: Robot, stated: Any, right: Any, drawn: bool) -> bool:
    """5.6: components, and the rotations of sampled rotation vectors."""
    vectors = robot.rotation_vectors() if drawn else []
    in_vectors = {first + n for first in vectors for n in range(3)}
    for dof, (a, b) in enumerate(zip(stated, right)):
        if dof not in in_vectors and not component_agrees(a, b, robot.bounds(dof)):
            return False
    for first in vectors:
        one, other = stated[first : first + 3], right[first : first + 3]
        turn = rotation_distance(from_rotation_vector(one), from_rotation_vector(other))
        if turn > RELATIVE or norm(one) > math.pi * (1 + RELATIVE):
            return False
    return True


def check_configurations(urdd: Urdd, robot: Robot, document: dict[str, Any]) -> None:
    """6.7."""
    error = urdd.report.error
    names = [one["name"] for one in document["configurations"]]
    if len(set(names)) != len(names):
        error("CNF001", CONFIGURATIONS, "/configurations")  # 6.7.2
    dof_names = [dof["name"] for dof in urdd.documents["dof_module"]["dofs"]]
    for place, one in enumerate(document["configurations"]):
        pointer = f"/configurations/{place}"
        named_dofs = [position["dof_name"] for position in one["positions"]]
        if not all(name in dof_names for name in named_dofs):
            error("CNF002", CONFIGURATIONS, pointer + "/positions")  # 6.7.3
            continue
        dofs = [dof_names.index(name) for name in named_dofs]
        if dofs != sorted(set(dofs)):
            error("CNF002", CONFIGURATIONS, pointer + "/positions")  # 6.7.3
            continue
        right = list(named(robot, "Default"))
        for dof, position in zip(dofs, one["positions"]):
            right[dof] = position["position"]
            if not is_within(robot, dof, position["position"]):
                error("CNF003", CONFIGURATIONS, pointer + "/positions")  # 6.7.4
        q = one["configuration"]
        if len(q) != len(right) or not all(
            component_agrees(a, b, robot.bounds(dof)) for dof, (a, b) in enumerate(zip(q, right))
        ):
            error("CNF004", CONFIGURATIONS, pointer + "/configuration")  # 6.7.5


def is_within(robot: Robot, dof: int, position: float) -> bool:
    """6.7.4: whether a position of a limited DOF is between its bounds."""
    bounds = robot.bounds(dof)
    if robot.limited(robot.dof_joint[dof]) is None or min(bounds) <= position <= max(bounds):
        return True
    return any(component_agrees(position, bound, bounds) for bound in bounds)


def robot_of(document: dict[str, Any]) -> Robot:
    version = VERSION.fullmatch(document["version"] or "")
    return Robot(document, (int(version[1]), int(version[2])) if version else (1, 0))


def check_core(urdd: Urdd) -> Robot | None:
    """6.2 to 6.5, 6.7 and 9, where `urdf_module` is right; gives the robot."""
    if not urdd.have("urdf_module") or not urdd.report.clean("URD"):
        return None
    robot = robot_of(urdd.documents["urdf_module"])
    checks = (
        ("dof_module", check_dofs),
        ("chain_module", check_chain),
        ("connections_module", check_connections),
        ("bounds_module", check_bounds),
    )
    for name, check in checks:
        if urdd.have(name):
            check(urdd, robot, urdd.documents[name])
    if urdd.have("dof_module", "chain_module") and urdd.report.clean("DOF", "CHN"):
        check_poses(urdd, robot)
    if not urdd.report.clean("DOF", "BND", "KIN"):
        return robot
    if urdd.have("kinematics_samples_module"):
        check_samples(urdd, robot, urdd.documents["kinematics_samples_module"])
    if urdd.have("named_configurations_module"):
        check_configurations(urdd, robot, urdd.documents["named_configurations_module"])
    return robot

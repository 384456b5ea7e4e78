"""Joints, and their positions in the configurations of other programs (SPEC 5.11)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ._arrays import Floats

if TYPE_CHECKING:
    from .modules import JointType, Modules


@dataclass(frozen=True)
class Joint:
    """A joint."""

    name: str
    """Its name."""
    kind: JointType
    """Its type."""
    parent: int
    """Its parent link."""
    child: int
    """Its child link."""
    origin: Floats
    """(4, 4): the joint's frame in the parent link's frame."""
    axis: Floats
    """(3,): its axis, of length 1; zeros if it has none."""
    dofs: tuple[int, ...]
    """Its DOFs."""
    mimic: tuple[int | None, float, float] | None
    """For a mimic joint: the DOF that it follows, the multiplier and the offset."""

    def position(self, q: Floats) -> Floats:
        """(..., 1): the position of a joint that rotates about an axis or slides along it, including mimic joints."""
        if self.mimic is None:
            return q[..., list(self.dofs)]
        dof, multiplier, offset = self.mimic
        driver: Floats = np.zeros_like(q[..., :1]) if dof is None else q[..., dof : dof + 1]
        return multiplier * driver + offset


def joints_of(modules: Modules) -> list[Joint]:
    """The joints, each after the joint that moves its parent link."""
    chain, dof = modules.chain, modules.dof
    found: list[Joint] = []
    waiting = [chain.root_idx]
    while waiting:
        for index in chain.links_in_chain[waiting.pop(0)].children_joint_idxs:
            joint = chain.joints_in_chain[index]
            mimic = dof.joint_idx_to_mimic_mapping[index]
            found.append(
                Joint(
                    name=joint.joint_name,
                    kind=joint.joint_type,
                    parent=joint.parent_link_idx,
                    child=joint.child_link_idx,
                    origin=pose(joint.origin.position, joint.origin.quaternion_wxyz),
                    axis=np.array(joint.axis if joint.axis is not None else [0.0, 0.0, 0.0], dtype=np.float64),
                    dofs=tuple(dof.joint_idx_to_dof_idxs_mapping[index]),
                    mimic=None if mimic is None else (mimic.dof_idx, mimic.multiplier, mimic.offset),
                )
            )
            waiting.append(joint.child_link_idx)
    return found


def pose(position: list[float], wxyz: list[float]) -> Floats:
    """The matrix (4, 4) of a position and a quaternion."""
    w, x, y, z = np.array(wxyz, dtype=np.float64) / np.linalg.norm(wxyz)
    found = np.eye(4)
    found[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    found[:3, 3] = position
    return found


def quaternion_of(rotation_vector: Floats) -> Floats:
    """(..., 4): the quaternion w, x, y, z of a rotation vector (..., 3)."""
    angle = np.linalg.norm(rotation_vector, axis=-1, keepdims=True)
    # numpy's sinc(x) is sin(pi x) / (pi x), and 1 at 0.
    return np.concatenate([np.cos(angle / 2), 0.5 * np.sinc(angle / (2 * np.pi)) * rotation_vector], axis=-1)


def rotation_vector_of(wxyz: Floats) -> Floats:
    """(..., 3): the rotation vector, at most pi long, of a quaternion w, x, y, z (..., 4)."""
    unit = wxyz / np.linalg.norm(wxyz, axis=-1, keepdims=True)
    unit = np.where(unit[..., :1] < 0, -unit, unit)
    sine = np.linalg.norm(unit[..., 1:], axis=-1, keepdims=True)
    angle = 2 * np.arctan2(sine, unit[..., :1])
    safe = np.where(sine > 0, sine, 1.0)
    found: Floats = np.where(sine > 0, angle / safe, 2.0) * unit[..., 1:]
    return found


def in_plane_basis(axis: Floats) -> Floats:
    """(3, 3): as columns, the directions x and y of a planar joint's plane, and its axis. The shortest arc turns z to
    the axis; for -z it is half a turn about x."""
    x, y, z = axis
    if z <= -1.0 + 1e-15 and abs(x) + abs(y) < 1e-15:
        return np.diag([1.0, -1.0, -1.0])
    turn = np.array([[0.0, 0.0, x], [0.0, 0.0, y], [-x, -y, 0.0]])
    # 1 + z, without cancellation.
    above = 1.0 + z if z > 0 else (x * x + y * y) / (1.0 - z)
    found: Floats = np.eye(3) + turn + turn @ turn / above
    return found


def right_jacobian(rotation_vector: Floats) -> Floats:
    """(3, 3): maps the derivative of a rotation vector to the angular velocity in the rotated frame."""
    angle = float(np.linalg.norm(rotation_vector))
    x, y, z = rotation_vector
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    if angle < 1e-4:
        a, b = 0.5 - angle**2 / 24, 1 / 6 - angle**2 / 120
    else:
        a, b = (1 - np.cos(angle)) / angle**2, (angle - np.sin(angle)) / angle**3
    found: Floats = np.eye(3) - a * cross + b * cross @ cross
    return found


def quaternion_of_matrix(rotation: Floats) -> Floats:
    """(4,): the quaternion w, x, y, z, w >= 0, of a rotation (3, 3)."""
    r = rotation
    # The formula of the largest component avoids cancellation.
    four = np.array(
        [
            [1 + r[0, 0] + r[1, 1] + r[2, 2], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
            [r[2, 1] - r[1, 2], 1 + r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]],
            [r[0, 2] - r[2, 0], r[0, 1] + r[1, 0], 1 - r[0, 0] + r[1, 1] - r[2, 2], r[1, 2] + r[2, 1]],
            [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], 1 - r[0, 0] - r[1, 1] + r[2, 2]],
        ]
    )
    best: Floats = four[np.argmax(np.diagonal(four))]
    found: Floats = best / np.linalg.norm(best)
    return -found if found[0] < 0 else found

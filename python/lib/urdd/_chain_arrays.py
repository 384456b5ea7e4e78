"""A robot's frames as arrays, for programs that compute poses themselves, in batches on GPUs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ._arrays import Floats
from ._joints import Joint, in_plane_basis, joints_of
from .errors import ExportError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .modules import Modules


@dataclass(frozen=True)
class ChainArrays:
    """The frames of a robot, each after its parent. Frame ``k`` has the pose ``T[parent[k]] @ origin[k] @ M``, with the
    identity for parent -1, and the motion ``M`` by ``p = multiplier[k] * q[dof[k]] + offset[k]`` (``offset[k]`` alone
    for DOF -1): a rotation about ``axis[k]`` by ``p`` where ``turns[k]``, otherwise a translation by ``p * axis[k]``.
    """

    parent: NDArray[np.int64]
    """(frames,): the parent frame; -1 is that of the root link."""
    origin: Floats
    """(frames, 4, 4): the frame in its parent at position 0, metres."""
    axis: Floats
    """(frames, 3): of length 1, or 0 for a frame that does not move."""
    turns: NDArray[np.bool_]
    """(frames,): whether it turns."""
    dof: NDArray[np.int64]
    """(frames,): the DOF that moves it; -1 if none does."""
    multiplier: Floats
    """(frames,): of a mimic joint; 1 for others, 0 for a frame that does not move."""
    offset: Floats
    """(frames,): of a mimic joint, rad or m; 0 for others."""
    link_frame: NDArray[np.int64]
    """(links,): the frame of each link; -1 for the root link."""


def chain_arrays(modules: Modules) -> ChainArrays:
    """The frames of a robot."""
    rows: list[tuple[int, Floats, Floats, bool, int, float, float]] = []
    frames = {modules.chain.root_idx: -1}
    for joint in joints_of(modules):
        parent = frames[joint.parent]
        for motion in _motions(joint):
            # The second and third frame of a planar joint have no origin of their own.
            origin = joint.origin if parent == frames[joint.parent] else np.eye(4)
            rows.append((parent, origin, *motion))
            parent = len(rows) - 1
        frames[joint.child] = parent
    parents, origins, axes, turns, dofs, multipliers, offsets = zip(*rows, strict=True) if rows else ((),) * 7
    return ChainArrays(
        parent=np.array(parents, dtype=np.int64),
        origin=np.array(origins, dtype=np.float64).reshape(-1, 4, 4),
        axis=np.array(axes, dtype=np.float64).reshape(-1, 3),
        turns=np.array(turns, dtype=np.bool_),
        dof=np.array(dofs, dtype=np.int64),
        multiplier=np.array(multipliers, dtype=np.float64),
        offset=np.array(offsets, dtype=np.float64),
        link_frame=np.array([frames[link] for link in range(len(frames))], dtype=np.int64),
    )


def _motions(joint: Joint) -> list[tuple[Floats, bool, int, float, float]]:
    """The motions of a joint, one after another: axis, whether it turns, DOF, multiplier, offset."""
    match joint.kind:
        case "Fixed":
            return [(np.zeros(3), False, -1, 0.0, 0.0)]
        case "Revolute" | "Continuous" | "Prismatic":
            dof, multiplier, offset = joint.mimic or (joint.dofs[0], 1.0, 0.0)
            return [(joint.axis, joint.kind != "Prismatic", -1 if dof is None else dof, multiplier, offset)]
        case "Planar":
            x, y, _ = in_plane_basis(joint.axis).T
            axes = zip((x, y, joint.axis), (False, False, True), joint.dofs, strict=True)
            return [(axis, turns, dof, 1.0, 0.0) for axis, turns, dof in axes]
        case other:
            raise ExportError(
                f"joint `{joint.name}` is {other}: its rotation is a vector, which no sequence of axes has. "
                "Fix it, or compute its pose apart"
            )

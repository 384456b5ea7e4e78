"""Newton's model of a robot."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import Floats, configurations, positions
from ._export import exported_with
from ._joints import Joint, joints_of, pose, quaternion_of, quaternion_of_matrix, rotation_vector_of
from ._kinematics import RobotKinematics
from ._need import need
from ._start import brief, start_of


@dataclass(frozen=True, repr=False)
class NewtonRobot:
    """A robot for Newton. Its ``joint_q`` is in Newton's own order: :meth:`q` and :meth:`dofs` map configurations.

    A floating joint is three slides and turns about x, y and z, each about the axis that the one before turned. Mimic
    joints are separate joints with constraints; :meth:`q` sets them. A free base is none of our DOFs: :meth:`q` leaves
    it where it is. Newton's numbers are binary32.
    """

    model: Any
    """``newton.Model``, at the start, which is the target of position drives too."""
    builder: Any
    """``newton.ModelBuilder`` that it was made by: for a ground, or many worlds."""
    dof_names: tuple[str, ...]
    """The DOFs here."""
    notes: list[str]
    """What USD cannot express, or expresses differently."""
    joint_names: tuple[str, ...]
    """The joints of the model, in the order of its ``joint_q``; a free base is ``floating_base``."""
    start: Floats
    """(joint_coord_count,): the ``joint_q`` of the start, a free base included."""
    _zero: Floats
    _places: tuple[tuple[Joint, slice], ...]

    @property
    def drive_names(self) -> tuple[str, ...]:
        """The joints with a drive, in the order of :attr:`joint_names`."""
        modes, starts = self.builder.joint_target_mode, [*self.builder.joint_qd_start, len(self.builder.joint_qd)]
        each = zip(self.joint_names, starts[:-1], starts[1:], strict=True)
        return tuple(name for name, at, end in each if any(modes[at:end]))

    def __repr__(self) -> str:
        return brief(self, dofs=self.dof_names, joints=self.joint_names, drives=self.drive_names, notes=len(self.notes))

    def q(self, q: ArrayLike) -> Floats:
        """(..., joint_coord_count): Newton's ``joint_q`` of one of our configurations (..., dofs)."""
        rows, batch = configurations(q, self.dof_names)
        found = np.tile(self.start, (len(rows), 1))
        for joint, at in self._places:
            if joint.kind in ("Spherical", "Floating"):
                quaternions = quaternion_of(rows[:, joint.dofs[-3:]])
                turns = quaternions[:, [1, 2, 3, 0]]
                if joint.kind == "Floating":
                    turns = np.array([_turns(one) for one in quaternions]).reshape(-1, 3)
                found[:, at] = np.concatenate([rows[:, joint.dofs[:-3]], turns], axis=1)
            else:
                found[:, at] = rows[:, joint.dofs] if joint.kind == "Planar" else joint.position(rows)
        return found.reshape(*batch, len(self.start))

    def dofs(self, q: ArrayLike) -> Floats:
        """(..., dofs): our configuration of Newton's ``joint_q``. Ignores the values of mimic joints."""
        rows, batch = positions(q, len(self.start), "Newton's")
        # A joint that its limits hold is fixed here.
        found = np.tile(self._zero, (len(rows), 1))
        for joint, at in self._places:
            values = rows[:, at]
            if joint.mimic is not None:
                continue
            if joint.kind == "Spherical":
                values = rotation_vector_of(values[:, [3, 0, 1, 2]])
            elif joint.kind == "Floating":
                turned = np.array([quaternion_of_matrix(_turned(one)) for one in values[:, 3:]]).reshape(-1, 4)
                values = np.concatenate([values[:, :3], rotation_vector_of(turned)], axis=1)
            found[:, joint.dofs] = values
        return found.reshape(*batch, len(self.dof_names))


def _turns(wxyz: Floats) -> Floats:
    """(3,): turns about x, about the y that was turned, and about the z that was."""
    r = pose([0.0, 0.0, 0.0], list(wxyz))
    return np.array(
        [np.arctan2(-r[1, 2], r[2, 2]), np.arctan2(r[0, 2], np.hypot(r[0, 0], r[0, 1])), np.arctan2(-r[0, 1], r[0, 0])]
    )


def _turned(turns: Floats) -> Floats:
    """(3, 3): the rotation of :func:`_turns`."""
    found: Floats = np.eye(3)
    for axis, turn in zip(np.eye(3), turns, strict=True):
        found = found @ pose([0.0, 0.0, 0.0], [float(np.cos(turn / 2)), *(float(np.sin(turn / 2)) * axis)])[:3, :3]
    return found


def to_newton(robot: RobotKinematics, options: dict[str, object], start: str | ArrayLike | None) -> NewtonRobot:
    """As :meth:`urdd.Robot.to_newton`."""
    newton = need("newton", "newton", "to_newton")
    pxr = need("pxr.Usd", "newton", "to_newton")
    configuration, base = start_of(robot, "usd", options, start)
    exported = exported_with(robot, "usd", options)
    builder = newton.ModelBuilder()
    # The attributes of MuJoCo's solver are those of the builder, and a model without them is refused there.
    newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
    with tempfile.TemporaryDirectory() as folder:
        file = exported.write(Path(folder) / "robot.usda")
        stage = pxr.Stage.Open(str(file))
        builder.add_usd(stage)
        starts = [*builder.joint_q_start, len(builder.joint_q)]
        at = {
            prim.GetDisplayName() or prim.GetName(): slice(start, end)
            for label, start, end in zip(builder.joint_label, starts[:-1], starts[1:], strict=True)
            if (prim := stage.GetPrimAtPath(label))
        }
    places = tuple(
        (joint, at[joint.name])
        for joint in joints_of(robot.modules)
        if joint.kind != "Fixed" and at[joint.name].stop > at[joint.name].start
    )
    names = [""] * len(builder.joint_label)
    for name, place in at.items():
        names[builder.joint_q_start.index(place.start)] = name
    joint_q = np.array(builder.joint_q, dtype=np.float64)
    found = NewtonRobot(None, builder, robot.dof_names, exported.notes, tuple(names), joint_q, robot.zero, places)
    joint_q[:] = found.q(configuration)
    free = [
        at for at, kind in zip(builder.joint_q_start, builder.joint_type, strict=True) if kind == newton.JointType.FREE
    ]
    if base is not None and free:
        x, y, z, *turn = base
        joint_q[free[0] : free[0] + 7] = [x, y, z, *turn[1:], turn[0]]
    builder.joint_q[:] = joint_q.tolist()
    if options["actuators"] == "position":
        builder.joint_target_q[:] = joint_q.tolist()
    return replace(found, model=builder.finalize(), start=joint_q)

"""MuJoCo's model of a robot."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import Floats, configurations, positions
from ._export import exported_with
from ._joints import Joint, joints_of, quaternion_of, rotation_vector_of
from ._kinematics import RobotKinematics
from ._need import need
from ._start import brief, start_of


@dataclass(frozen=True, repr=False)
class MujocoRobot:
    """A robot for MuJoCo. Its ``qpos`` is in MuJoCo's own order: :meth:`q` and :meth:`dofs` map configurations.

    A floating joint is three slides and a ball, a planar joint two slides and a hinge. Mimic joints are separate joints
    with equality constraints; :meth:`q` sets them. A free base is none of our DOFs: :meth:`q` leaves it where it is.
    """

    model: Any
    """``mujoco.MjModel``. Each link is a body of its name."""
    dof_names: tuple[str, ...]
    """The DOFs here."""
    notes: list[str]
    """What MuJoCo's format cannot express, or expresses differently."""
    start: Floats
    """(nq,): the ``qpos`` of the start, a free base included."""
    targets: Floats
    """(nu,): the controls that hold the start: the positions of position actuators, 0 of others."""
    _places: tuple[tuple[Joint, tuple[int, ...]], ...]

    def data(self) -> Any:
        """``mujoco.MjData`` at the start: :attr:`start`, and the controls are :attr:`targets`."""
        import mujoco as module

        # Its types are incomplete.
        mujoco: Any = module
        data = mujoco.MjData(self.model)
        data.qpos[:] = self.start
        data.ctrl[:] = self.targets
        mujoco.mj_forward(self.model, data)
        return data

    @property
    def joint_names(self) -> tuple[str, ...]:
        """The joints of the model, in the order of its ``qpos``."""
        return tuple(self.model.joint(joint).name for joint in range(self.model.njnt))

    @property
    def actuator_names(self) -> tuple[str, ...]:
        """The actuators of the model, in the order of its ``ctrl``."""
        return tuple(self.model.actuator(actuator).name for actuator in range(self.model.nu))

    def __repr__(self) -> str:
        return brief(
            self, dofs=self.dof_names, joints=self.joint_names, actuators=self.actuator_names, notes=len(self.notes)
        )

    def q(self, q: ArrayLike) -> Floats:
        """(..., nq): MuJoCo's ``qpos`` of one of our configurations (..., dofs)."""
        rows, batch = configurations(q, self.dof_names)
        # A free base is where the model has it.
        found = np.tile(self.model.qpos0, (len(rows), 1))
        for joint, at in self._places:
            if joint.mimic is not None or len(joint.dofs) == 1:
                found[:, at[0]] = joint.position(rows)[:, 0]
                continue
            slides = len(joint.dofs) if joint.kind == "Planar" else len(joint.dofs) - 3
            found[:, at[:slides]] = rows[:, joint.dofs[:slides]]
            if joint.kind != "Planar":
                found[:, at[slides] : at[slides] + 4] = quaternion_of(rows[:, joint.dofs[slides:]])
        return found.reshape(*batch, self.model.nq)

    def dofs(self, q: ArrayLike) -> Floats:
        """(..., dofs): our configuration of MuJoCo's ``qpos`` (..., nq). Ignores the values of mimic joints."""
        rows, batch = positions(q, self.model.nq, "MuJoCo's")
        found = np.zeros((len(rows), len(self.dof_names)))
        for joint, at in self._places:
            if joint.mimic is not None:
                continue
            slides = len(joint.dofs) - (3 if joint.kind in ("Spherical", "Floating") else 0)
            found[:, joint.dofs[:slides]] = rows[:, at[:slides]]
            if slides < len(joint.dofs):
                found[:, joint.dofs[slides:]] = rotation_vector_of(rows[:, at[slides] : at[slides] + 4])
        return found.reshape(*batch, len(self.dof_names))


def to_mujoco(robot: RobotKinematics, options: dict[str, object], start: str | ArrayLike | None) -> MujocoRobot:
    """As :meth:`urdd.Robot.to_mujoco`."""
    mujoco = need("mujoco", "mujoco", "to_mujoco")
    q, base = start_of(robot, "mjcf", options, start)
    exported = exported_with(robot, "mjcf", options)
    model = mujoco.MjModel.from_xml_string(exported.text, exported.files)

    def at(name: str) -> int:
        return int(model.jnt_qposadr[model.joint(name).id])

    places: list[tuple[Joint, tuple[int, ...]]] = []
    for joint in joints_of(robot.modules):
        if joint.kind == "Fixed":
            continue
        names = [joint.name]
        if joint.kind == "Planar":
            names = [f"{joint.name}/{part}" for part in ("trans_x", "trans_y", "rot")]
        if joint.kind == "Floating":
            names = [*(f"{joint.name}/trans_{part}" for part in "xyz"), joint.name]
        places.append((joint, tuple(at(name) for name in names)))
    nothing = np.zeros(0)
    found = MujocoRobot(model, robot.dof_names, exported.notes, nothing, nothing, tuple(places))
    qpos = found.q(q)
    if base is not None:
        qpos[:7] = base
    targets = np.zeros(model.nu)
    if options["actuators"] == "position":
        held = qpos[model.jnt_qposadr[model.actuator_trnid[:, 0]]]
        # A servo of speed stands still: one of positions alone has a bias by the position.
        targets = np.where(model.actuator_biasprm[:, 1] != 0, held, 0.0)
    return replace(found, start=qpos, targets=targets)

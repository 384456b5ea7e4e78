"""PyBullet's body of a robot."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ._answers import ShapeKind
from ._arrays import Floats, one_configuration
from ._joints import Joint, joints_of
from ._need import need
from .errors import ExportError

if TYPE_CHECKING:
    from ._robot import Robot


@dataclass(frozen=True)
class PybulletRobot:
    """A robot in PyBullet. :meth:`set` moves it, mimic joints included."""

    body: int
    """The body's number."""
    client: int
    """The client's number."""
    links: dict[str, int]
    """The number of each link, by name; -1 for the root."""
    dof_names: tuple[str, ...]
    """The DOFs here."""
    _places: tuple[tuple[Joint, int], ...]

    def set(self, q: ArrayLike) -> None:
        """Puts the robot into a configuration (dofs,), at rest."""
        bullet = need("pybullet", "pybullet", "to_pybullet")
        row = one_configuration(q, self.dof_names)[0]
        for joint, number in self._places:
            bullet.resetJointState(self.body, number, float(joint.position(row)[0]), physicsClientId=self.client)

    def q(self) -> Floats:
        """(dofs,): the configuration that it is in. What mimic joints say is not looked at."""
        bullet = need("pybullet", "pybullet", "to_pybullet")
        found = np.zeros(len(self.dof_names))
        for joint, number in self._places:
            if joint.mimic is None:
                found[joint.dofs[0]] = bullet.getJointState(self.body, number, physicsClientId=self.client)[0]
        return found


def to_pybullet(robot: Robot, client: int = 0, shapes: ShapeKind = "pieces", *, visuals: bool = False) -> PybulletRobot:
    """As :meth:`urdd.Robot.to_pybullet`."""
    from ._export import export

    bullet = need("pybullet", "pybullet", "to_pybullet")
    joints = [joint for joint in joints_of(robot.modules) if joint.kind != "Fixed"]
    for joint in joints:
        if joint.kind not in ("Revolute", "Continuous", "Prismatic"):
            raise ExportError(
                f"joint `{joint.name}` is {joint.kind.lower()}: PyBullet reads joints of one DOF only; use MuJoCo or "
                f"Pinocchio"
            )
    with tempfile.TemporaryDirectory(prefix="urdd-") as folder:
        file = Path(folder) / "robot.urdf"
        export(robot, "urdf", file, shapes=shapes, visuals=visuals)
        flags = bullet.URDF_USE_SELF_COLLISION | bullet.URDF_USE_INERTIA_FROM_FILE
        body = bullet.loadURDF(os.fspath(file), useFixedBase=True, flags=flags, physicsClientId=client)
    numbers: dict[str, int] = {}
    links = {robot.link_names[robot.modules.chain.root_idx]: -1}
    for number in range(bullet.getNumJoints(body, physicsClientId=client)):
        told: Any = bullet.getJointInfo(body, number, physicsClientId=client)
        numbers[told[1].decode()] = number
        links[told[12].decode()] = number
    for a, b in (sorted(pair) for pair in robot.skips(shapes).pairs_of_links()):
        bullet.setCollisionFilterPair(body, body, links[a], links[b], 0, physicsClientId=client)
    return PybulletRobot(body, client, links, robot.dof_names, tuple((joint, numbers[joint.name]) for joint in joints))

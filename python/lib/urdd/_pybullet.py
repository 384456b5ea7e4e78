"""PyBullet's body of a robot."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._answers import ShapeKind
from ._arrays import Floats, configurations, one_configuration, positions
from ._export import export
from ._joints import Joint, joints_of
from ._kinematics import RobotKinematics
from ._need import need
from ._proximity import Proximity
from ._shapes import skips
from ._start import brief
from .errors import ExportError

#: Reasons of skipped pieces that touch always, or often at rest.
_TOUCHING = {"always", "adjacent", "default"}
#: Number of configurations in which lost collisions are counted.
_SAMPLES = 1000


@dataclass(frozen=True, repr=False)
class PybulletRobot:
    """A robot in PyBullet. Its joints are in PyBullet's own order: :meth:`q` and :meth:`dofs` map configurations.

    Mimic joints are separate joints here. :meth:`q` and :meth:`set` place them, but PyBullet does not keep them in
    place.
    """

    body: int
    """The body's number."""
    client: int
    """The client's number."""
    links: dict[str, int]
    """The number of each link, by name; -1 for the root."""
    joints: tuple[int, ...]
    """The numbers of the joints that move, in the order of :meth:`q`: for ``setJointMotorControlArray``."""
    dof_names: tuple[str, ...]
    """The DOFs here."""
    notes: list[str]
    """What PyBullet cannot express: the pairs of links of which only some pieces are skipped."""
    _moving: tuple[Joint, ...]

    def __repr__(self) -> str:
        joints = tuple(joint.name for joint in self._moving)
        return brief(self, body=self.body, dofs=self.dof_names, joints=joints, notes=len(self.notes))

    def q(self, q: ArrayLike) -> Floats:
        """(..., joints): PyBullet's positions, one for each of :attr:`joints`, of one of our configurations
        (..., dofs)."""
        rows, batch = configurations(q, self.dof_names)
        found = np.zeros((len(rows), len(self.joints)))
        for at, joint in enumerate(self._moving):
            found[:, at] = joint.position(rows)[:, 0]
        return found.reshape(*batch, len(self.joints))

    def dofs(self, q: ArrayLike) -> Floats:
        """(..., dofs): our configuration of PyBullet's positions (..., joints). Ignores the values of mimic
        joints."""
        rows, batch = positions(q, len(self.joints), "PyBullet's")
        found = np.zeros((len(rows), len(self.dof_names)))
        for at, joint in enumerate(self._moving):
            if joint.mimic is None:
                found[:, joint.dofs[0]] = rows[:, at]
        return found.reshape(*batch, len(self.dof_names))

    def set(self, q: ArrayLike) -> None:
        """Puts the robot into a configuration (dofs,), at rest."""
        bullet = need("pybullet", "pybullet", "to_pybullet")
        row = one_configuration(q, self.dof_names)[0]
        for number, position in zip(self.joints, self.q(row).tolist(), strict=True):
            bullet.resetJointState(self.body, number, position, physicsClientId=self.client)

    def get(self) -> Floats:
        """(dofs,): the present configuration. Ignores the values of mimic joints."""
        bullet = need("pybullet", "pybullet", "to_pybullet")
        states = [bullet.getJointState(self.body, number, physicsClientId=self.client) for number in self.joints]
        return self.dofs(np.array([state[0] for state in states], dtype=np.float64))


def to_pybullet(
    robot: RobotKinematics,
    client: int = 0,
    shapes: ShapeKind = "pieces",
    *,
    visuals: bool = False,
    keep_pairs: bool = False,
) -> PybulletRobot:
    """As :meth:`urdd.Robot.to_pybullet`."""
    bullet = need("pybullet", "pybullet", "to_pybullet")
    moving = [joint for joint in joints_of(robot.modules) if joint.kind != "Fixed"]
    for joint in moving:
        if joint.kind not in ("Revolute", "Continuous", "Prismatic"):
            raise ExportError(
                f"joint `{joint.name}` is {joint.kind.lower()}: PyBullet reads joints of one DOF only; use MuJoCo or "
                f"Pinocchio"
            )
    apart, notes = _apart(robot, shapes, keep_pairs)
    with tempfile.TemporaryDirectory(prefix="urdd-") as folder:
        file = Path(folder) / "robot.urdf"
        export(robot, "urdf", file, shapes=shapes, visuals=visuals)
        flags = bullet.URDF_USE_SELF_COLLISION | bullet.URDF_USE_INERTIA_FROM_FILE
        body = bullet.loadURDF(os.fspath(file), useFixedBase=True, flags=flags, physicsClientId=client)
    numbers: dict[str, int] = {}
    links = {robot.root_link: -1}
    for number in range(bullet.getNumJoints(body, physicsClientId=client)):
        info: Any = bullet.getJointInfo(body, number, physicsClientId=client)
        numbers[info[1].decode()] = number
        links[info[12].decode()] = number
    for a, b in apart:
        bullet.setCollisionFilterPair(body, body, links[a], links[b], 0, physicsClientId=client)
    joints = tuple(numbers[joint.name] for joint in moving)
    return PybulletRobot(body, client, links, joints, robot.dof_names, notes, tuple(moving))


def _apart(robot: RobotKinematics, shapes: ShapeKind, keep_pairs: bool) -> tuple[list[tuple[str, str]], list[str]]:
    """The pairs of links that do not collide in PyBullet, and the collisions lost by that."""
    skipping = skips(robot, shapes)
    names = sorted(set(skipping.links))
    rows = {name: [k for k, link in enumerate(skipping.links) if link == name] for name in names}
    apart: list[tuple[str, str]] = []
    mixed: dict[tuple[str, str], tuple[int, int]] = {}
    for k, a in enumerate(names):
        for b in names[k + 1 :]:
            skipped = skipping.skipped[np.ix_(rows[a], rows[b])]
            if skipped.all():
                apart.append((a, b))
            elif any(
                skipping.reasons is not None and skipping.reasons[rows[a][i]][rows[b][j]] in _TOUCHING
                for i, j in np.argwhere(skipped).tolist()
            ):
                mixed[a, b] = (int(skipped.sum()), skipped.size)
    if not mixed:
        return apart, []
    if keep_pairs:
        return apart, [
            f"links `{a}` and `{b}` collide with all of their pieces, though {skipped} of {count} pairs of these are "
            f"skipped: they may always touch"
            for (a, b), (skipped, count) in mixed.items()
        ]
    lost = _lost(robot, shapes, list(mixed))
    return [*apart, *mixed], [
        f"links `{a}` and `{b}` do not collide: {skipped} of {count} pairs of their pieces are skipped, and PyBullet "
        f"knows links only; in {lost[a, b]} of {_SAMPLES} sampled configurations the others touch"
        for (a, b), (skipped, count) in mixed.items()
    ]


def _lost(robot: RobotKinematics, shapes: ShapeKind, pairs: list[tuple[str, str]]) -> dict[tuple[str, str], int]:
    """For each pair of links, the number of random configurations in which pieces that are not skipped touch."""
    proximity = Proximity(robot, shapes)
    links = np.sort(proximity.pair_indices[:, :, 0], axis=1)
    q = robot.random(_SAMPLES)
    found = dict.fromkeys(pairs, 0)
    of = {pair: (links == sorted(robot.link(name) for name in pair)).all(axis=1) for pair in pairs}
    for some in np.array_split(q[proximity.in_collision(q)], 20):
        touching = proximity.distances(some) == 0
        for pair, own in of.items():
            found[pair] += int(touching[:, own].any(axis=1).sum())
    return found

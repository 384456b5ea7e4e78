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
from ._arrays import Floats, configurations, one_configuration, positions
from ._joints import Joint, joints_of
from ._need import need
from .errors import ExportError

if TYPE_CHECKING:
    from ._robot import Robot

#: Reasons for which pieces are skipped that touch at all times, or often where the robot is at rest.
_TOUCHING = {"always", "adjacent", "default"}
#: Configurations in which it is counted what is lost.
_SAMPLES = 1000


@dataclass(frozen=True)
class PybulletRobot:
    """A robot in PyBullet. Its joints are in PyBullet's own order: :meth:`q` and :meth:`dofs` map configurations.

    Mimic joints are joints of their own here, which :meth:`q` and :meth:`set` put where they belong; PyBullet does not
    hold them there.
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
    """What PyBullet could not be told: the pairs of links of which only some pieces are skipped."""
    _moving: tuple[Joint, ...]

    def q(self, q: ArrayLike) -> Floats:
        """(..., joints): PyBullet's positions, one for each of :attr:`joints`, of one of our configurations
        (..., dofs)."""
        rows, batch = configurations(q, self.dof_names)
        found = np.zeros((len(rows), len(self.joints)))
        for at, joint in enumerate(self._moving):
            found[:, at] = joint.position(rows)[:, 0]
        return found.reshape(*batch, len(self.joints))

    def dofs(self, q: ArrayLike) -> Floats:
        """(..., dofs): our configuration of PyBullet's positions (..., joints). What mimic joints say is not looked
        at."""
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
        """(dofs,): the configuration that the robot is in. What mimic joints say is not looked at."""
        bullet = need("pybullet", "pybullet", "to_pybullet")
        states = [bullet.getJointState(self.body, number, physicsClientId=self.client) for number in self.joints]
        return self.dofs(np.array([state[0] for state in states], dtype=np.float64))


def to_pybullet(
    robot: Robot, client: int = 0, shapes: ShapeKind = "pieces", *, visuals: bool = False, keep_pairs: bool = False
) -> PybulletRobot:
    """As :meth:`urdd.Robot.to_pybullet`."""
    from ._export import export

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
        told: Any = bullet.getJointInfo(body, number, physicsClientId=client)
        numbers[told[1].decode()] = number
        links[told[12].decode()] = number
    for a, b in apart:
        bullet.setCollisionFilterPair(body, body, links[a], links[b], 0, physicsClientId=client)
    joints = tuple(numbers[joint.name] for joint in moving)
    return PybulletRobot(body, client, links, joints, robot.dof_names, notes, tuple(moving))


def _apart(robot: Robot, shapes: ShapeKind, keep_pairs: bool) -> tuple[list[tuple[str, str]], list[str]]:
    """The pairs of links that do not collide in PyBullet, and what is lost by that."""
    skips = robot.skips(shapes)
    names = sorted(set(skips.links))
    rows = {name: [k for k, link in enumerate(skips.links) if link == name] for name in names}
    apart: list[tuple[str, str]] = []
    mixed: dict[tuple[str, str], tuple[int, int]] = {}
    for k, a in enumerate(names):
        for b in names[k + 1 :]:
            skipped = skips.skipped[np.ix_(rows[a], rows[b])]
            if skipped.all():
                apart.append((a, b))
            elif any(
                skips.reasons is not None and skips.reasons[rows[a][i]][rows[b][j]] in _TOUCHING
                for i, j in np.argwhere(skipped).tolist()
            ):
                mixed[a, b] = (int(skipped.sum()), skipped.size)
    if not mixed:
        return apart, []
    if keep_pairs:
        return apart, [
            f"links `{a}` and `{b}` collide with all of their pieces, though {skipped} of {count} pairs of these are "
            f"skipped: they may touch at all times"
            for (a, b), (skipped, count) in mixed.items()
        ]
    lost = _lost(robot, shapes, list(mixed))
    return [*apart, *mixed], [
        f"links `{a}` and `{b}` do not collide: {skipped} of {count} pairs of their pieces are skipped, and PyBullet "
        f"knows links only; in {lost[a, b]} of {_SAMPLES} sampled configurations the others touch"
        for (a, b), (skipped, count) in mixed.items()
    ]


def _lost(robot: Robot, shapes: ShapeKind, pairs: list[tuple[str, str]]) -> dict[tuple[str, str], int]:
    """In how many sampled configurations pieces of two links touch that are not skipped."""
    proximity = robot.proximity(shapes)
    links = np.sort(proximity.pair_indices[:, :, 0], axis=1)
    q = robot.sample(_SAMPLES)
    found = dict.fromkeys(pairs, 0)
    of = {pair: (links == sorted(robot.link(name) for name in pair)).all(axis=1) for pair in pairs}
    for some in np.array_split(q[proximity.in_collision(q)], 20):
        touching = proximity.distances(some) == 0
        for pair, own in of.items():
            found[pair] += int(touching[:, own].any(axis=1).sum())
    return found

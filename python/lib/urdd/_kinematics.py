"""A robot's kinematics: configurations, poses, Jacobians, inverse kinematics."""

from __future__ import annotations

from collections.abc import Iterable
from operator import index
from sys import maxsize
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ._answers import InverseSolution, ObstacleDistance, PairDistance
from ._arrays import (
    Bools,
    Floats,
    Indices,
    batched,
    configurations,
    numbers,
    one_configuration,
    poses,
    scalar,
    six,
    three,
)
from ._loops import RobotLoops
from ._options import InverseOptions, whole, words
from ._proximity import Proximity
from ._world_proximity import WorldProximity
from .errors import ConfigurationError

#: Period of the sequence of random configurations (SPEC 9.3).
_CONFIGURATIONS = 2**32
#: Distance between the first configurations of two seeds: by the golden ratio, so that those of many seeds are far
#: apart.
_SEED_STRIDE = 0x9E3779B9

#: As the compiled part numbers them.
_VERDICTS = np.array(["reached", "refused", "limits", "out of reach", "unknown", "loops"])

Shapes: TypeAlias = Proximity | WorldProximity


def _too_near(shapes: list[Shapes], q: Floats, margin: float) -> PairDistance | ObstacleDistance | None:
    """The nearest pair of the first shapes that are not farther apart than they have to be."""
    for one in shapes:
        # Links among themselves keep no margin.
        least = margin if isinstance(one, WorldProximity) else 0.0
        nearest: list[PairDistance] | list[ObstacleDistance] = one.nearest(q, 1)
        if nearest and nearest[0].distance <= least:
            return nearest[0]
    return None


class RobotKinematics(RobotLoops):
    """The kinematics of a :class:`urdd.Robot`."""

    # Configurations.

    @property
    def bounds(self) -> Floats:
        """(dofs, 2): the lower and the upper bound of each DOF; always finite. Those of a DOF that is not limited
        (:attr:`dof_is_limited`) are a range to sample from, [-pi, pi] or [-1, 1], which it may leave."""
        return self._core.bounds()

    @property
    def dof_is_limited(self) -> Bools:
        """(dofs,): whether the source limits each DOF: false for continuous, planar, floating and spherical joints."""
        return np.array(self._core.dof_is_limited(), dtype=np.bool_)

    @property
    def velocity_limits(self) -> Floats:
        """(dofs,): the largest speed of each DOF, rad/s or m/s, as the source states it; infinite where it states
        none."""
        return self._core.limits()[0]

    @property
    def effort_limits(self) -> Floats:
        """(dofs,): the largest effort of each DOF, N m or N, as the source states it; infinite where it states none."""
        return self._core.limits()[1]

    @property
    def zero(self) -> Floats:
        """(dofs,): every DOF at 0, or at the bound nearest to 0 if 0 is out of bounds. Pinocchio's *neutral
        configuration* is the same, without the clamping."""
        return self._core.configuration("zero")

    @property
    def middle(self) -> Floats:
        """(dofs,): every DOF half-way between its bounds."""
        return self._core.configuration("middle")

    @property
    def lower(self) -> Floats:
        """(dofs,): every DOF at its lower bound."""
        return self._core.configuration("lower")

    @property
    def upper(self) -> Floats:
        """(dofs,): every DOF at its upper bound."""
        return self._core.configuration("upper")

    @property
    def named_configurations(self) -> dict[str, Floats]:
        """(dofs,) for each configuration that a person named, such as ``home``, in the order in which they were added.
        Empty without ``named_configurations_module``."""
        return dict(self._core.named_configurations())

    def random(self, n: int | None = None, seed: int = 0) -> Floats:
        """Random configurations, uniform within the bounds: (dofs,), or (n, dofs).

        The specification defines the sequence (SPEC 9.3), so it is the same in every program, on every machine and for
        every ``n``. It begins at number 0, or with a seed at number ``seed * 0x9E3779B9 % 2**32``.

        Raises:
            MemoryError: if there is not enough memory, as in every method that returns an array.
        """
        count = 1 if n is None else index(n)
        if count < 0:
            raise ValueError(f"the number of configurations must not be negative, but is {count}")
        if count > maxsize:
            raise MemoryError(f"{count} configurations are more than any memory holds: ask for fewer at once")
        start = whole(seed, "a seed", 0, _CONFIGURATIONS - 1)
        found = self._core.random(count, start * _SEED_STRIDE % _CONFIGURATIONS)
        return found[0] if n is None else found

    def clamp(self, q: ArrayLike) -> Floats:
        """``q`` with each value clamped to its bounds, those of DOFs that are not limited too. Rotation vectors are
        unchanged."""
        return batched(q, self.dof_names, self._core.clamp)

    def is_within_bounds(self, q: ArrayLike) -> Bools:
        """(...): whether each value is within its bounds, which a DOF that is not limited may leave."""
        return batched(q, self.dof_names, lambda rows: (self._core.clamp(rows) == rows).all(axis=1))

    # Poses.

    def link_poses(self, q: ArrayLike) -> Floats:
        """(..., links, 4, 4): forward kinematics, the pose of each link.

        Raises:
            ConfigurationError: for a wrong shape, or a value that is not finite.
        """
        return batched(q, self.dof_names, self._core.link_poses)

    def link_pose(self, q: ArrayLike, link: str | int, *, relative_to: str | int | None = None) -> Floats:
        """(..., 4, 4): forward kinematics, the pose of one link, in the frame of the root link or of another one.

        Raises:
            ConfigurationError: for a wrong shape, or a value that is not finite.
            UnknownNameError: for an unknown link.
        """

        def pose(rows: Floats, of: str | int) -> Floats:
            found: Floats = self._core.link_poses(rows, self.link(of))[:, 0]
            return found

        def relative(rows: Floats) -> Floats:
            if relative_to is None:
                return pose(rows, link)
            base, found = pose(rows, relative_to), pose(rows, link)
            turn = base[:, :3, :3].swapaxes(1, 2)
            found[:, :3, 3:] = turn @ (found[:, :3, 3:] - base[:, :3, 3:])
            found[:, :3, :3] = turn @ found[:, :3, :3]
            return found

        return batched(q, self.dof_names, relative)

    def dofs_between(self, base: str | int, tip: str | int) -> Indices:
        """The indices of the DOFs that move one of two links against the other, ascending: those of an arm, from its
        base and its tip. Joints that mimic others count for the DOF that they follow."""
        return np.array(self._core.dofs_between(self.link(base), self.link(tip)), dtype=np.uintp)

    # Masses.

    @property
    def link_masses(self) -> Floats:
        """(links,): the mass of each link, kg; 0 where the source states none."""
        found: Floats = self._core.masses()[:, 0].copy()
        return found

    @property
    def link_centres_of_mass(self) -> Floats:
        """(links, 3): the centre of mass of each link, in the link's frame, metres."""
        found: Floats = self._core.masses()[:, 1:].copy()
        return found

    def centre_of_mass(self, q: ArrayLike) -> Floats:
        """(..., 3): the centre of mass of the robot, in the root link's frame, metres; NaN if it has no mass."""
        masses = self._core.masses()
        mass, centres = masses[:, :1], masses[:, 1:, None]

        def centre(rows: Floats) -> Floats:
            poses = self._core.link_poses(rows)
            places = (poses[:, :, :3, :3] @ centres + poses[:, :, :3, 3:])[..., 0]
            with np.errstate(invalid="ignore"):
                found: Floats = (mass * places).sum(axis=1) / mass.sum()
            return found

        return batched(q, self.dof_names, centre)

    def gravity_torques(
        self,
        q: ArrayLike,
        *,
        payload: float = 0.0,
        link: str | int | None = None,
        point: ArrayLike = (0.0, 0.0, 0.0),
        gravity: ArrayLike = (0.0, 0.0, -9.81),
    ) -> Floats:
        """(..., dofs): the torque (N m) or force (N) of each DOF that holds the robot still against gravity.

        It is what the motors must give, as Pinocchio's ``computeGeneralizedGravity``: positive where the DOF must push
        toward larger values. A mimic joint counts for the DOF that it follows, times its multiplier. The values of a
        rotation vector (floating and spherical joints) are derivatives with respect to its components.

        Args:
            q: a configuration, or many.
            payload: a mass that ``link`` carries, kg.
            link: the link that carries the payload.
            point: the centre of mass of the payload, in the link's frame, metres.
            gravity: the acceleration due to gravity, in the root link's frame, m/s².

        Raises:
            ConfigurationError: for a wrong shape, a number that is not finite, a payload below 0 or without a link.
            UnknownNameError: for an unknown link.
        """
        carried = None
        if link is not None:
            carried = (self.link(link), float(payload), three(point, "a point"))
        elif payload != 0.0:
            raise ConfigurationError("a payload needs a link that carries it")
        down = three(gravity, "gravity")
        return batched(q, self.dof_names, lambda rows: self._core.gravity_torques(rows, down, carried))

    def jacobian(self, q: ArrayLike, link: str | int, point: ArrayLike | None = None) -> Floats:
        """(..., 6, dofs): the geometric Jacobian of a link.

        Rows 0 to 2 are the linear velocity of the origin of the link's frame (or of ``point``, (3,), metres in the
        link's frame), rows 3 to 5 the angular velocity, both expressed in the root link's frame. A mimic joint
        contributes to the column of the DOF that it follows.
        """
        at = None if point is None else three(point, "a point")
        return batched(q, self.dof_names, lambda rows: self._core.jacobians(rows, self.link(link), at))

    def inverse_kinematics(
        self,
        link: str | int,
        target: ArrayLike,
        start: ArrayLike | None = None,
        *,
        point: ArrayLike = (0.0, 0.0, 0.0),
        position_tolerance: float = 1e-6,
        rotation_tolerance: float = 1e-6,
        iterations: int = 100,
        restarts: int = 100,
        seed: int = 0,
        bounds: ArrayLike | None = None,
        weights: ArrayLike | None = None,
        locked: Iterable[str | int] = (),
        posture: ArrayLike | None = None,
        free_of: Shapes | Iterable[Shapes] = (),
        margin: float = 0.0,
        open_loops: bool = False,
    ) -> InverseSolution:
        """Inverse kinematics: a configuration within the bounds in which a link reaches a target.

        Searches by damped least squares from ``start``, then from random configurations. Supports mimic joints. The
        same arguments give the same result. Many targets run on all threads.

        A DOF that is not limited (:attr:`dof_is_limited`) may also move as far from ``start``, and from ``posture``, as
        its bounds are from 0, unless ``bounds`` are given: an angle half a turn either way, a length one metre. So a
        continuous joint that follows a path does not jump by a turn, and its value may leave [-pi, pi]. Of values a
        whole turn apart that are within the bounds, the result has the nearest to ``posture``, or to ``start`` without
        one.

        Args:
            link: the link.
            target: a pose (4, 4), or a position (3,) if the link's rotation is free; or many of them, (..., 4, 4) or
                (..., 3).
            start: a configuration, or one for each target; :attr:`zero` by default.
            point: the point of the link that reaches the target position, in the link's frame, metres.
            position_tolerance: maximum distance of the point from its target, metres.
            rotation_tolerance: maximum angle of the link to its target rotation, radians.
            iterations: maximum number of steps of each descent, at least 1.
            restarts: maximum number of descents from random configurations.
            seed: selects the random configurations.
            bounds: (dofs, 2), instead of :attr:`bounds`, for all DOFs, limited or not.
            weights: (6,), factors of the errors before they are compared with the tolerances: of the position along x,
                y, z, then of the rotation about x, y, z, along the axes of the target pose, or of the root link's frame
                for a position. A factor of 0 leaves a direction free: ``[0, 0, 0, 1, 1, 1]`` is a rotation alone,
                ``[1, 1, 1, 1, 1, 0]`` leaves a tool free to turn about its own z axis.
            locked: the DOFs that keep their start value, by name or index.
            posture: (dofs,): the solution should be near this configuration. Each solution is moved toward it as far as
                the target allows, and the nearest one counts; the search ends when 12 restarts in a row bring no nearer
                one.
            free_of: shapes of this robot, such as ``robot.proximity()`` and ``robot.world_proximity(world)``, that must
                not collide: the search goes on until a solution is free.
            margin: the distance that a solution keeps from the obstacles of ``free_of``, metres. Links may be nearer to
                one another.
            open_loops: whether the kinematic loops of the robot may be open in the solution; otherwise it is closed.

        Raises:
            ConfigurationError: for a wrong shape, a number that is not finite, or one that makes no sense: tolerances,
                weights or a margin below 0, crossed bounds, weights that leave nothing to reach.
            ValueError: for a number of iterations or restarts, or a seed, that is out of range.
            UnknownNameError: for an unknown link or DOF.
        """
        targets = poses(target, "a target")
        is_pose = targets.shape[-1] == 4
        batch = targets.shape[: -2 if is_pose else -1]
        starts, start_batch = configurations(self.zero if start is None else start, self.dof_names)
        if len(starts) != 1 and start_batch != batch:
            raise ConfigurationError(
                f"start must be one configuration, or one for each target: expected the shape "
                f"{(*batch, self.num_dofs)}, found {(*start_batch, self.num_dofs)}"
            )
        limits = None
        if bounds is not None:
            limits = numbers(bounds, "bounds")
            if limits.shape != (self.num_dofs, 2):
                raise ConfigurationError(f"bounds must have the shape ({self.num_dofs}, 2), not {limits.shape}")
        given: list[object] = [free_of] if isinstance(free_of, Proximity | WorldProximity) else [*free_of]
        shapes = [one for one in given if isinstance(one, Proximity | WorldProximity)]
        if len(shapes) != len(given):
            raise ConfigurationError("free_of must be results of robot.proximity() or robot.world_proximity()")
        if any(one.dof_names != self.dof_names for one in shapes):
            raise ConfigurationError("free_of has shapes of another robot")
        options = InverseOptions(
            point=three(point, "a point"),
            position_tolerance=float(position_tolerance),
            rotation_tolerance=float(rotation_tolerance),
            iterations=whole(iterations, "iterations", 1, maxsize),
            restarts=whole(restarts, "restarts", 0, maxsize),
            seed=whole(seed, "a seed", 0, 2**64 - 1),
            bounds=limits,
            weights=None if weights is None else six(weights, "weights"),
            locked=[self.dof(dof) for dof in words(locked, "locked")],
            posture=None if posture is None else one_configuration(posture, self.dof_names)[0].tolist(),
            free_of=[one.core for one in shapes],
            margin=float(margin),
            open_loops=bool(open_loops),
        )
        rows = targets.reshape(-1, *((4, 4) if is_pose else (1, 3)))
        found = self._core.inverse_kinematics(self.link(link), rows, starts, options)
        configuration, rest = found[:, : self.num_dofs], found[:, self.num_dofs :].T.reshape(5, *batch)
        verdict = _VERDICTS[rest[0].astype(np.intp)]
        refused_by = np.full(batch, None, dtype=np.object_)
        for place in np.argwhere(verdict == "refused"):
            refused_by[tuple(place)] = _too_near(shapes, configuration.reshape(*batch, -1)[tuple(place)], margin)
        return InverseSolution(
            q=configuration.reshape(*batch, self.num_dofs),
            reached=scalar(rest[0] == 0),
            verdict=verdict,
            position_error=scalar(rest[1].copy()),
            rotation_error=scalar(rest[2].copy()),
            restarts=scalar(rest[3].astype(np.uintp)),
            iterations=scalar(rest[4].astype(np.uintp)),
            refused_by=refused_by if batch else refused_by.item(),
        )

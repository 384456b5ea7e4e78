"""How a robot moves: configurations, poses, Jacobians, inverse kinematics."""

from __future__ import annotations

from operator import index
from sys import maxsize

from numpy.typing import ArrayLike

from ._answers import InverseSolution, InverseSolutions
from ._arrays import Bools, Floats, configurations, scalar
from ._description import Described
from ._inverse import as_targets, solve, three
from ._options import whole

#: The sequence of configurations repeats itself after so many (SPEC 9.3).
_CONFIGURATIONS = 2**32
#: How far apart the configurations of two seeds begin: by the golden ratio, so that those of many seeds are far apart.
_SEED_STRIDE = 0x9E3779B9


class Moving(Described):
    """How a robot moves, of :class:`urdd.Robot`."""

    # Configurations.

    @property
    def bounds(self) -> Floats:
        """(dofs, 2): the lower and the upper bound of each DOF; always finite."""
        return self._core.bounds()

    @property
    def zero(self) -> Floats:
        """(dofs,): every DOF 0, or the bound nearest to 0 where 0 is out of bounds."""
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

    def sample(self, n: int | None = None, seed: int = 0) -> Floats:
        """Random configurations, uniform within the bounds: (dofs,), or (n, dofs).

        They are those that the specification defines (SPEC 9.3), the same in every program, on every machine and for
        every ``n``: from number 0 on, and with a seed from ``seed * 0x9E3779B9 % 2**32`` on.

        Raises:
            MemoryError: where there is not enough memory, as of everything that gives an array.
        """
        count = 1 if n is None else index(n)
        if count < 0:
            raise ValueError(f"the number of configurations must not be negative, and is {count}")
        if count > maxsize:
            raise MemoryError(f"{count} configurations are more than any memory holds: ask for fewer at once")
        start = whole(seed, "a seed", 0, _CONFIGURATIONS - 1)
        found = self._core.sample(count, start * _SEED_STRIDE % _CONFIGURATIONS)
        return found[0] if n is None else found

    def clamp(self, q: ArrayLike) -> Floats:
        """``q`` with each value moved to the nearest bound where it is out of bounds. Rotation vectors stay."""
        rows, batch = configurations(q, self.dof_names)
        return self._core.clamp(rows).reshape(*batch, self.num_dofs)

    def within_bounds(self, q: ArrayLike) -> Bools:
        """(...): whether each value is within its bounds."""
        rows, batch = configurations(q, self.dof_names)
        return scalar((self._core.clamp(rows) == rows).all(axis=1).reshape(batch))

    # Motion.

    def fk(self, q: ArrayLike, link: str | int | None = None) -> Floats:
        """Forward kinematics: the pose of each link, (..., links, 4, 4); of one link (..., 4, 4).

        Raises:
            ConfigurationError: for another shape, or a value that is not finite.
            UnknownNameError: for a link that is not there.
        """
        rows, batch = configurations(q, self.dof_names)
        if link is None:
            return self._core.poses(rows).reshape(*batch, self.num_links, 4, 4)
        return self._core.poses(rows, self.index(link)).reshape(*batch, 4, 4)

    def link_poses(self, q: ArrayLike) -> dict[str, Floats]:
        """Forward kinematics by name: for each link its pose, (..., 4, 4)."""
        poses = self.fk(q)
        return {name: poses[..., link, :, :] for link, name in enumerate(self.link_names)}

    def jacobian(self, q: ArrayLike, link: str | int, point: ArrayLike | None = None) -> Floats:
        """The geometric Jacobian of a link: (..., 6, dofs).

        Rows 0 to 2 are the velocity of the origin of the link's frame (or of ``point``, (3,), metres in the link's
        frame), rows 3 to 5 its angular velocity, along the axes of the root link's frame. Mimic joints count into the
        column of the DOF that they follow.
        """
        rows, batch = configurations(q, self.dof_names)
        at = None if point is None else three(point, "a point")
        return self._core.jacobians(rows, self.index(link), at).reshape(*batch, 6, self.num_dofs)

    def ik(
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
    ) -> InverseSolution:
        """Inverse kinematics: a configuration, within bounds, in which a link is where it should be.

        By damped least squares from ``start`` (:attr:`zero` unless you say otherwise), then from random configurations.
        Mimic joints follow. Collisions are not looked at. The same question has the same answer. Many targets are
        answered on all threads by :meth:`ik_batch`.

        Args:
            link: the link.
            target: a pose (4, 4), or a place (3,) where it does not matter how the link is turned.
            start: a configuration.
            point: the point of the link that should be there, in its frame, metres.
            position_tolerance: metres that the point may be off.
            rotation_tolerance: radians that the link may be turned.
            iterations: steps of each descent, at most.
            restarts: descents from random configurations, at most.
            seed: which random configurations.
            bounds: (dofs, 2), in place of :attr:`bounds`.
        """
        goal = as_targets(target, (3,), (4, 4))
        found = solve(
            self,
            link,
            goal[None],
            start,
            point,
            position_tolerance,
            rotation_tolerance,
            iterations,
            restarts,
            seed,
            bounds,
        )
        return InverseSolution(
            q=found.q[0],
            reached=bool(found.reached[0]),
            position_error=float(found.position_error[0]),
            rotation_error=float(found.rotation_error[0]),
            restarts=int(found.restarts[0]),
            iterations=int(found.iterations[0]),
        )

    def ik_batch(
        self,
        link: str | int,
        targets: ArrayLike,
        start: ArrayLike | None = None,
        *,
        point: ArrayLike = (0.0, 0.0, 0.0),
        position_tolerance: float = 1e-6,
        rotation_tolerance: float = 1e-6,
        iterations: int = 100,
        restarts: int = 100,
        seed: int = 0,
        bounds: ArrayLike | None = None,
    ) -> InverseSolutions:
        """As :meth:`ik`, for many targets, on all threads: poses (n, 4, 4) or places (n, 3). ``start`` is one
        configuration, or one for each target (n, dofs)."""
        goals = as_targets(targets, (None, 3), (None, 4, 4))
        return solve(
            self, link, goals, start, point, position_tolerance, rotation_tolerance, iterations, restarts, seed, bounds
        )

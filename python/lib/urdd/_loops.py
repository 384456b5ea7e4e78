"""A robot's kinematic loops: how far they are from closed, closed configurations, velocities that keep them closed."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike

from ._answers import Closed, FreeDofs, LoopErrors
from ._arrays import Floats, Indices, batched, configurations, numbers, one_configuration, scalar
from ._description import RobotDescription
from ._options import words
from .errors import ConfigurationError


class RobotLoops(RobotDescription):
    """The kinematic loops of a :class:`urdd.Robot`. A robot without ``loops_module`` is a tree: it has no equations,
    every configuration is closed, and all DOFs move freely."""

    @property
    def loop_names(self) -> tuple[str, ...]:
        """The names of the loops, in the order of :meth:`loop_errors`. Empty for a tree."""
        return tuple(self._core.loop_names()[0])

    @property
    def coupling_names(self) -> tuple[str, ...]:
        """The names of the couplings between DOFs, in the order of :meth:`loop_errors`."""
        return tuple(self._core.loop_names()[1])

    @property
    def num_loop_equations(self) -> int:
        """The number of equations of all loops and couplings: 0 for a tree."""
        return self._core.num_loop_equations()

    @property
    def reference_configuration(self) -> Floats:
        """(dofs,): a configuration in which all loops are closed, to begin with: that of ``loops_module``. For a tree,
        the default one, :attr:`urdd.Robot.zero`."""
        return self._core.reference_configuration()

    def loop_errors(self, q: ArrayLike) -> LoopErrors:
        """How far each loop is from closed, and each coupling from what it holds.

        Raises:
            ConfigurationError: for a wrong shape, or a value that is not finite, as in all methods here.
        """
        rows, batch = configurations(q, self.dof_names)
        found = self._core.loop_errors(rows)
        loops, couplings = len(self.loop_names), len(self.coupling_names)
        return LoopErrors(
            position=found[:, :loops].reshape(*batch, loops),
            rotation=found[:, loops : 2 * loops].reshape(*batch, loops),
            sums=found[:, 2 * loops : -1].reshape(*batch, couplings),
            is_closed=scalar((found[:, -1] == 1).reshape(batch)),
        )

    def close(self, q: ArrayLike, *, held: Iterable[str | int] = (), bounds: ArrayLike | None = None) -> Closed:
        """The closed configuration near another one, within the bounds; for each of many, on all threads.

        Start near what is wanted, such as from the last configuration of a motion: the result is on the branch of
        closed configurations that is near. Values out of bounds are first moved to the nearest bound.

        Args:
            q: a configuration, or many.
            held: the DOFs that keep their value, by name or index.
            bounds: (dofs, 2), which may be infinite, instead of :attr:`bounds`; by default a DOF that is not limited
                has none.

        Raises:
            ConfigurationError: also for bounds of another shape, or crossed ones.
            UnknownNameError: for an unknown DOF.
        """
        rows, batch = configurations(q, self.dof_names)
        limits = None
        if bounds is not None:
            limits = numbers(bounds, "bounds")
            if limits.shape != (self.num_dofs, 2) or not (limits[:, 0] <= limits[:, 1]).all():
                raise ConfigurationError(
                    f"bounds must have the shape ({self.num_dofs}, 2), the lower ones first; theirs is {limits.shape}"
                )
        found = self._core.close(rows, [self.dof(dof) for dof in words(held, "held")], limits)
        return Closed(
            configuration=found[:, :-1].reshape(*batch, self.num_dofs),
            is_closed=scalar((found[:, -1] == 1).reshape(batch)),
        )

    @property
    def independent_dofs(self) -> Indices:
        """The indices of the DOFs that move freely, ascending, as ``loops_module`` states them; the others follow from
        them near its reference configuration. All DOFs for a tree."""
        return np.array(self._core.independent_dofs(), dtype=np.uintp)

    def free_dofs(self, q: ArrayLike) -> FreeDofs:
        """Which DOFs move freely in one closed configuration, and which follow: as :attr:`independent_dofs`, as far as
        the others follow from these there."""
        independent, dependent = self._core.free_dofs(one_configuration(q, self.dof_names))
        return FreeDofs(np.array(independent, dtype=np.uintp), np.array(dependent, dtype=np.uintp))

    def loop_residuals(self, q: ArrayLike) -> Floats:
        """(..., equations): the left-hand side of each equation, which is 0 where it holds: for each loop those of its
        kind, then the sum of each coupling.

        With the pose of frame B in frame A, of position p and rotation R, a loop has the components of p that it holds,
        m; then the rotation vector of R if it holds the rotation, the x and y components of R ez if it holds the
        direction of z, or the z component of R ez if it holds the right angle. ``Fixed`` has 6; ``Revolute`` and
        ``Prismatic`` 5; ``Cylindrical`` and ``Universal`` 4; ``Spherical`` and ``Planar`` 3.
        """
        return batched(q, self.dof_names, self._core.loop_residuals)

    def loop_jacobian(self, q: ArrayLike) -> Floats:
        """(..., equations, dofs): the derivatives of :meth:`loop_residuals` by each DOF. Velocities keep the loops
        closed where this matrix times them is 0. The rows of a rotation that a loop holds are the angular velocity of
        frame B relative to frame A, in the axes of frame A. Rows that say the same as others are normal: of the five of
        a planar four-bar, three."""
        return batched(q, self.dof_names, self._core.loop_jacobian)

    def loop_velocities(self, q: ArrayLike, independent: ArrayLike) -> Floats:
        """(..., dofs): the velocities of all DOFs, rad/s or m/s, that keep the loops closed, for those of the
        :attr:`independent_dofs`, (..., independent), in their order. NaN where the others do not follow from these: at
        a dead point, or where parts are in a line.

        Raises:
            ConfigurationError: also for velocities of another shape, or that are not finite.
        """
        rows, batch = configurations(q, self.dof_names)
        count = len(self.independent_dofs)
        given = numbers(independent, "velocities")
        try:
            given = np.ascontiguousarray(np.broadcast_to(given, (*batch, count)).reshape(-1, count))
        except ValueError:
            raise ConfigurationError(
                f"velocities have one value for each of the {count} independent DOFs: expected the shape "
                f"{(*batch, count)}, found {given.shape}"
            ) from None
        if not np.isfinite(given).all():
            raise ConfigurationError("velocities must be finite")
        return scalar(self._core.loop_velocities(rows, given).reshape(*batch, self.num_dofs))

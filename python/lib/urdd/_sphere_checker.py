"""Spheres in the place of a robot's shapes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from copy import copy

import numpy as np
from numpy.typing import ArrayLike

from . import _urdd
from ._arrays import Bools, Floats, batched, edges, numbers, scalar
from ._description import RobotDescription
from ._world import World
from .errors import ConfigurationError

__all__ = ["SphereChecker"]


class SphereChecker:
    """The spheres of a robot's links, prepared for yes or no: :meth:`Robot.sphere_checker`. Eight configurations are
    checked at once, by the vector instructions of the processor.

    If the spheres cover the shapes (``covers``), a configuration without a contact is certainly free, as what is
    rounded is added to the radii; where spheres touch, the shapes may be apart. Otherwise nothing is certain.

    Pickled as its robot, spheres, pairs, and world.
    """

    def __init__(
        self,
        robot: RobotDescription,
        levels: Sequence[Mapping[str, ArrayLike]],
        pairs: Iterable[tuple[str, str]],
        covers: bool = False,
        world: World | None = None,
    ) -> None:
        self._robot = robot
        self._levels = [{link: _spheres(link, own) for link, own in level.items()} for level in levels]
        self._pairs = [(str(first), str(second)) for first, second in pairs]
        self._covers = bool(covers)
        # Later changes of the world have no effect.
        self._world = World() if world is None else copy(world)
        alone = _urdd.SphereChecker(
            robot.core,
            [[(robot.link(link), own) for link, own in level.items()] for level in self._levels],
            [(robot.link(first), robot.link(second)) for first, second in self._pairs],
            self._covers,
        )
        self._core = alone.around(self._world.obstacles())
        self._alone = alone
        self._dof_names = robot.dof_names

    @property
    def covers(self) -> bool:
        """Whether the spheres cover the shapes, so that a configuration without a contact is certainly free."""
        return self._covers

    @property
    def dof_names(self) -> tuple[str, ...]:
        """The names of the DOFs."""
        return self._dof_names

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """The pairs of links that are checked."""
        return list(self._pairs)

    def around(self, world: World) -> SphereChecker:
        """The same spheres among the obstacles of a world. Each query then asks for both: contacts of links with each
        other and with obstacles. Nothing else is prepared again. Later changes of the world have no effect.

        Raises:
            UnknownNameError: if an obstacle ignores an unknown link, with the nearest known name.
        """
        found = copy(self)
        found._world = copy(world)
        found._core = self._alone.around(found._world.obstacles())
        return found

    def in_collision(self, q: ArrayLike) -> Bools:
        """(...): whether spheres touch."""
        return self.is_within(q, 0.0)

    def is_within(self, q: ArrayLike, margin: float) -> Bools:
        """(...): whether spheres are at most ``margin`` metres apart. With a margin above 0, those pairs of links count
        that can move against each other."""
        return batched(q, self._dof_names, lambda rows: self._core.is_within(rows, margin))

    def blocked_edge(
        self,
        start: ArrayLike,
        end: ArrayLike,
        *,
        margin: float = 0.0,
        resolution: float = 0.01,
        open_loops: bool = False,
    ) -> Floats:
        """(...): where spheres touch on the straight motion from ``start`` to ``end``, as a part of it from 0 to 1; NaN
        where it is free. As :meth:`Proximity.blocked_edge` with a resolution, in metres: between two configurations
        that are checked no sphere travels farther.

        Raises:
            ValueError: for a margin below 0, a resolution that is not above 0, or a motion that needs more than a
                million configurations; for a robot with kinematic loops, without ``open_loops``.
        """
        starts, ends, batch = edges(start, end, self._dof_names)
        return scalar(self._core.blocked_edge(starts, ends, margin, resolution, bool(open_loops)).reshape(batch))

    def first_contact(
        self,
        start: ArrayLike,
        end: ArrayLike,
        *,
        margin: float = 0.0,
        resolution: float = 0.01,
        open_loops: bool = False,
    ) -> Floats:
        """(..., 2): the last part of the straight motion from ``start`` to ``end`` in which no spheres touch (0 if they
        do at the start), and the first in which some do; both NaN where the motion is free. As
        :meth:`Proximity.first_contact`.

        Raises:
            ValueError: as :meth:`blocked_edge`.
        """
        starts, ends, batch = edges(start, end, self._dof_names)
        found = self._core.first_contact(starts, ends, margin, resolution, bool(open_loops))
        return found.reshape(*batch, 2)

    def __reduce__(
        self,
    ) -> tuple[
        type[SphereChecker], tuple[RobotDescription, list[dict[str, Floats]], list[tuple[str, str]], bool, World]
    ]:
        return type(self), (self._robot, self._levels, self._pairs, self._covers, self._world)

    def __copy__(self) -> SphereChecker:
        found = object.__new__(type(self))
        found.__dict__.update(self.__dict__)
        return found

    def __repr__(self) -> str:
        count = sum(len(own) for own in self._levels[-1].values())
        covers = "covering " if self._covers else ""
        return f"<urdd.SphereChecker: {count} {covers}spheres, {len(self._pairs)} pairs, {len(self._world)} obstacles>"


def _spheres(link: str, given: ArrayLike) -> Floats:
    found = numbers(given, f"the spheres of `{link}`")
    if found.ndim != 2 or found.shape[1] != 4:
        raise ConfigurationError(
            f"the spheres of `{link}` must have the shape (n, 4), centres and radii, not {found.shape}"
        )
    return np.array(found)

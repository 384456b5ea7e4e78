"""A robot's distances to obstacles."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from . import _urdd
from ._answers import ObstacleDistance, ObstacleGradient, ObstacleOverlap, ObstaclePair, ShapeKind
from ._arrays import (
    Bools,
    Floats,
    Indices,
    batched,
    edges,
    number_of_pairs,
    one_configuration,
    optional_array,
    scalar,
)
from ._proximity import Proximity
from ._world import World

__all__ = ["WorldProximity"]


class WorldProximity:
    """A robot's shapes of one kind and the obstacles of a world, prepared for distances:
    ``robot.world_proximity(world)``.

    Skips do not apply: every shape is tested against every obstacle, except for links that the obstacle ignores.
    Distances are 0 for shapes that touch or overlap: :meth:`penetrations` says how far.

    Pickled as its robot, world, kind, and what links carry.
    """

    def __init__(self, proximity: Proximity, world: World) -> None:
        self._proximity = proximity
        # Later changes of the world have no effect.
        self._world = copy(world)
        self._core = _urdd.WorldProximity(proximity.core, world.obstacles())
        self._dof_names = proximity.dof_names

    def move(self, name: str | Sequence[str], pose: ArrayLike) -> None:
        """Moves obstacles: one, or several by their names, as :meth:`World.move`. Nothing is prepared again; the world
        that this was made of stays as it is.

        >>> import urdd
        >>> robot = urdd.load("welding_arm")
        >>> world = urdd.World()
        >>> for k in range(20):
        ...     world.add_box(f"box_{k}", size=[0.1, 0.1, 0.1], pose=[1, 0, 0.1 * k])
        >>> proximity = robot.world_proximity(world)
        >>> proximity.move(world.names, [[1 + 0.1 * k, 0.5, 0.2] for k in range(20)])
        """
        self._world.move(name, pose)
        self._core = _urdd.WorldProximity(self._proximity.core, self._world.obstacles())

    @property
    def kind(self) -> ShapeKind:
        """The kind of the robot's shapes."""
        return self._proximity.kind

    @property
    def obstacle_names(self) -> tuple[str, ...]:
        """The names of the obstacles."""
        return self._world.names

    @cached_property
    def pair_indices(self) -> Indices:
        """(pairs, 3): the link, the piece and the obstacle of each pair."""
        return self._core.pairs()

    @cached_property
    def pair_bodies(self) -> Indices:
        """(pairs,): the body of each pair, as in :attr:`Proximity.bodies`: a link, or an attached object."""
        return self._core.pair_bodies()

    @property
    def num_pairs(self) -> int:
        """Number of pairs of a shape and an obstacle."""
        return len(self.pair_indices)

    @cached_property
    def pairs(self) -> list[ObstaclePair]:
        """The pairs of a shape and an obstacle, in the order of :meth:`distances`."""
        return [
            ObstaclePair(name, piece, self.obstacle_names[obstacle])
            for name, (_, piece, obstacle) in zip(self._core.pair_names(), self.pair_indices.tolist(), strict=True)
        ]

    def distances(self, q: ArrayLike) -> Floats:
        """(..., pairs): the distance of each pair of a shape and an obstacle, metres."""
        return batched(q, self._dof_names, self._core.distances)

    def min_distance(self, q: ArrayLike) -> Floats:
        """(...): the minimum distance of the robot to any obstacle, metres; infinite if there are no pairs."""
        return batched(q, self._dof_names, self._core.min_distance)

    def in_collision(self, q: ArrayLike) -> Bools:
        """(...): whether the robot touches or overlaps any obstacle. Does not check for self-collision."""
        return batched(q, self._dof_names, self._core.in_collision)

    def is_within(self, q: ArrayLike, margin: float) -> Bools:
        """(...): whether the robot is at most ``margin`` metres from any obstacle. Stops at the first such pair."""
        return batched(q, self._dof_names, lambda rows: self._core.is_within(rows, margin))

    def blocked_edge(
        self, start: ArrayLike, end: ArrayLike, *, margin: float = 0.0, resolution: float | None = 0.01
    ) -> Floats:
        """(...): where the straight motion from ``start`` to ``end`` is blocked, as a part of it from 0 to 1; NaN where
        it is free. Does not check for self-collision.

        With a ``resolution`` (metres), configurations are checked between which no point of the robot travels farther,
        the end and the halves first: the answer is one that is blocked, and need not be the first, which
        :meth:`first_contact` has. With ``None``, the motion is proved free by conservative advancement: it then needs
        0.1 mm more than the ``margin``, and the answer is the first part where it has less.

        Raises:
            ValueError: for a margin below 0, a resolution that is not above 0, or a motion that needs more than a
                million configurations, or 100,000 steps of a proof.
        """
        starts, ends, batch = edges(start, end, self._dof_names)
        both = np.concatenate([starts, ends], axis=1)
        return scalar(self._core.blocked_edge(both, margin, resolution).reshape(batch))

    def first_contact(
        self, start: ArrayLike, end: ArrayLike, *, margin: float = 0.0, resolution: float | None = 0.01
    ) -> Floats:
        """(..., 2): the last part of the straight motion from ``start`` to ``end`` that is known to be free (0 if the
        start is not), and the first that is blocked; both NaN where the motion is free.

        With a ``resolution``, configurations are checked in order, and the part between the first that is blocked and
        the one before is halved ten times: between the two no point of the robot travels farther than a thousandth of
        the resolution. A contact that begins and ends between two configurations can be missed. With ``None``, all up
        to the first part is proved free.

        Raises:
            ValueError: as :meth:`blocked_edge`.
        """
        starts, ends, batch = edges(start, end, self._dof_names)
        both = np.concatenate([starts, ends], axis=1)
        return self._core.first_contact(both, margin, resolution).reshape((*batch, 2))

    def nearest(self, q: ArrayLike, k: int = 1) -> list[ObstacleDistance]:
        """The ``k`` nearest pairs in one configuration, with their closest points, nearest first; all pairs if there
        are fewer. Each convex piece of a mesh counts as an obstacle."""
        return [
            ObstacleDistance(*self._answer(near))
            for near in self._core.nearest(one_configuration(q, self._dof_names), number_of_pairs(k))
        ]

    def gradients(self, q: ArrayLike, k: int = 1) -> list[ObstacleGradient]:
        """The ``k`` nearest pairs in one configuration, nearest first, with the gradients of their distances."""
        return [
            ObstacleGradient(*self._answer(near), optional_array(gradient))
            for near, gradient in self._core.gradients(one_configuration(q, self._dof_names), number_of_pairs(k))
        ]

    def penetrations(self, q: ArrayLike) -> list[ObstacleOverlap]:
        """The pairs that touch or overlap in one configuration, with the least translation that separates them."""
        return [
            ObstacleOverlap(*self._answer(near), depth, np.array(direction), np.array(gradient, dtype=np.float64))
            for near, depth, direction, gradient in self._core.penetrations(one_configuration(q, self._dof_names))
        ]

    @property
    def core(self) -> _urdd.WorldProximity:
        """The native shapes and obstacles, for the other files of this package."""
        return self._core

    @property
    def dof_names(self) -> tuple[str, ...]:
        """The names of the DOFs."""
        return self._dof_names

    def _answer(self, near: _urdd._NearObstacle) -> tuple[str, int, str, float, Floats]:
        name, piece, obstacle, distance, points = near
        return name, piece, self.obstacle_names[obstacle], distance, np.array(points, dtype=np.float64)

    def __reduce__(self) -> tuple[type[WorldProximity], tuple[Proximity, World]]:
        return type(self), (self._proximity, self._world)

    def __repr__(self) -> str:
        return f"<urdd.WorldProximity: {self.kind} and {len(self.obstacle_names)} obstacles, {self.num_pairs} pairs>"

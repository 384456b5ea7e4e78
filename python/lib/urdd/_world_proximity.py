"""A robot's distances to obstacles."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from . import _urdd
from ._answers import ObstacleDistance, ObstacleGradient, ObstacleOverlap, ObstaclePair, ShapeKind
from ._arrays import Floats, Indices, batched
from ._proximity import Proximity
from ._queries import Queries
from ._world import World

__all__ = ["WorldProximity"]


class WorldProximity(Queries["_urdd._NearObstacle", ObstacleDistance, ObstacleGradient, ObstacleOverlap]):
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
        self._places = {name: place for place, name in enumerate(world.names)}
        # The last move, if the world does not have it yet: in a control loop, nobody asks the world.
        self._later: tuple[list[str], Floats] | None = None
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
        names = [name] if isinstance(name, str) else list(name)
        places = [self._places[one] for one in names]
        if isinstance(pose, np.ndarray) and pose.dtype == np.float64 and pose.shape == (len(names), 4, 4):
            placed = np.array(pose, order="C")
            core = self._core.moved(places, placed)
            if core is not None:
                if self._later is not None and self._later[0] != names:
                    self._caught_up()
                self._later = (names, placed)
                self._core = core
                return
        # Other forms of poses, and what is wrong with them.
        world = copy(self._caught_up())
        world.move(name, pose)
        self._core = _urdd.WorldProximity(self._proximity.core, world.obstacles())
        self._world = world

    def _caught_up(self) -> World:
        """The world, with the obstacles where they are now."""
        if self._later is not None:
            self._world.move(*self._later)
            self._later = None
        return self._world

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

    def min_distance(self, q: ArrayLike) -> Floats:
        """(...): the minimum distance of the robot to any obstacle, metres; infinite if there are no pairs."""
        return batched(q, self._dof_names, self._core.min_distance)

    @property
    def core(self) -> _urdd.WorldProximity:
        """The native shapes and obstacles, for the other files of this package."""
        return self._core

    def _distance(self, near: _urdd._NearObstacle) -> ObstacleDistance:
        return ObstacleDistance(*self._answer(near))

    def _gradient(self, near: _urdd._NearObstacle, gradient: Floats | None) -> ObstacleGradient:
        return ObstacleGradient(*self._answer(near), gradient)

    def _overlap(self, near: _urdd._NearObstacle, depth: float, direction: Floats, gradient: Floats) -> ObstacleOverlap:
        return ObstacleOverlap(*self._answer(near), depth, direction, gradient)

    def _answer(self, near: _urdd._NearObstacle) -> tuple[str, int, str, float, Floats]:
        name, piece, obstacle, distance, points = near
        return name, piece, self.obstacle_names[obstacle], distance, np.array(points, dtype=np.float64)

    def __reduce__(self) -> tuple[type[WorldProximity], tuple[Proximity, World]]:
        return type(self), (self._proximity, self._caught_up())

    def __repr__(self) -> str:
        return f"<urdd.WorldProximity: {self.kind} and {len(self.obstacle_names)} obstacles, {self.num_pairs} pairs>"

"""Distances and collisions between the links of a robot."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ._answers import Pair, PairDistance, ShapeKind
from ._arrays import Bools, Floats, Indices, batched, one_configuration
from ._description import RobotDescription

if TYPE_CHECKING:
    from . import _urdd


class Proximity:
    """The shapes of one kind, prepared for distances: ``robot.proximity("pieces")``.

    Distances are accurate to 1e-9 m, and 0 for shapes that touch or overlap: penetration depths are not computed.

    Pickled as its robot and kind.
    """

    def __init__(self, robot: RobotDescription, kind: ShapeKind) -> None:
        self._robot = robot
        self._core = robot.core.proximity(kind)
        self._link_names = robot.link_names
        self._dof_names = robot.dof_names

    @property
    def kind(self) -> ShapeKind:
        """The kind of the shapes."""
        return self._core.kind

    @property
    def num_shapes(self) -> int:
        """Number of shapes."""
        return self._core.num_shapes

    @property
    def num_pairs(self) -> int:
        """Number of pairs that are not skipped."""
        return self._core.num_pairs

    @cached_property
    def pair_indices(self) -> Indices:
        """(pairs, 2, 2): the link and the piece of both shapes of each pair that is not skipped."""
        return self._core.pairs()

    @cached_property
    def pairs(self) -> list[Pair]:
        """The pairs that are not skipped, in the order of :meth:`distances`."""
        return [
            Pair((self._link_names[a], self._link_names[b]), (i, j)) for (a, i), (b, j) in self.pair_indices.tolist()
        ]

    def distances(self, q: ArrayLike) -> Floats:
        """(..., pairs): the distance of each pair that is not skipped, metres."""
        return batched(q, self._dof_names, self._core.distances)

    def self_distance(self, q: ArrayLike) -> Floats:
        """(...): the minimum distance over all pairs, metres; infinite if there are no pairs."""
        return batched(q, self._dof_names, self._core.self_distance)

    def in_collision(self, q: ArrayLike) -> Bools:
        """(...): whether any pair touches or overlaps. The fastest query: it stops at the first collision."""
        return batched(q, self._dof_names, self._core.in_collision)

    def nearest(self, q: ArrayLike, k: int = 1) -> list[PairDistance]:
        """The ``k`` nearest pairs in one configuration, nearest first; all pairs if there are fewer."""
        if k < 0:
            raise ValueError(f"the number of pairs must not be negative, but is {k}")
        return self._answers(self._core.nearest(one_configuration(q, self._dof_names), min(k, self.num_pairs)))

    def collisions(self, q: ArrayLike) -> list[PairDistance]:
        """The pairs that touch or overlap in one configuration."""
        return self._answers(self._core.collisions(one_configuration(q, self._dof_names)))

    def _answers(self, found: list[_urdd._Near]) -> list[PairDistance]:
        return [
            PairDistance(
                links=(self._link_names[links[0]], self._link_names[links[1]]),
                pieces=(pieces[0], pieces[1]),
                distance=distance,
                relative=relative,
                points=np.array(points, dtype=np.float64),
            )
            for links, pieces, distance, relative, points in found
        ]

    def __reduce__(self) -> tuple[type[Proximity], tuple[RobotDescription, ShapeKind]]:
        return type(self), (self._robot, self.kind)

    def __repr__(self) -> str:
        return f"<urdd.Proximity of {self.kind}: {self.num_shapes} shapes, {self.num_pairs} pairs that are not skipped>"

"""Distances and collisions between the links of a robot."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from copy import copy
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ._answers import Pair, PairDistance, PairGradient, PairOverlap, ShapeKind
from ._arrays import Floats, Indices, batched, one_configuration
from ._description import RobotDescription
from ._options import words
from ._queries import Queries
from ._world import World

if TYPE_CHECKING:
    from . import _urdd


class Proximity(Queries["_urdd._Near", PairDistance, PairGradient, PairOverlap]):
    """The shapes of one kind, prepared for distances: ``robot.proximity("pieces")``.

    Distances are accurate to 1e-9 m, and 0 for shapes that touch or overlap: :meth:`penetrations` says how far.

    Pickled as its robot and kind, what links carry, and what is left out.
    """

    def __init__(self, robot: RobotDescription, kind: ShapeKind, changes: Sequence[tuple[Any, ...]] = ()) -> None:
        self._robot = robot
        self._dof_names = robot.dof_names
        self._core = robot.core.proximity(kind)
        self._changes: list[tuple[Any, ...]] = []
        for change in changes:
            self._apply(*change)

    def _apply(self, what: str, *given: Any) -> None:
        if what == "attach":
            link, objects = given
            self._core = self._core.attach(self._robot.link(link), objects.obstacles())
            # Later changes of the objects have no effect.
            given = (link, copy(objects))
        else:
            self._core = getattr(self._core, what)(*given)
        self._changes.append((what, *given))

    def _changed(self, what: str, *given: Any) -> Proximity:
        found = object.__new__(type(self))
        found._robot, found._dof_names, found._core = self._robot, self._dof_names, self._core
        found._changes = list(self._changes)
        found._apply(what, *given)
        return found

    def attach(self, link: str, objects: World) -> Proximity:
        """These shapes and objects that a link carries, such as a tool or what a gripper holds: every query then
        includes them. Poses of ``objects`` are in the frame of the link. To release them, use these shapes again.

        The objects are tested against the shapes of all links that move against them, except those that they
        ``ignore``: the links that may touch them. Skips do not apply. In answers, an object has its name, and stands
        where links do. ``robot.world_proximity(world, shapes)`` tests them against obstacles too; an obstacle that
        ignores the link does not thereby ignore an object: it can name the object.

        Raises:
            UnknownNameError: for an unknown link, with the nearest known name.
            ObstacleError: if a link or an attached object has the name of an object.

        >>> import urdd
        >>> robot = urdd.load("welding_arm")
        >>> tool = urdd.World()
        >>> tool.add_capsule("brush", radius=0.02, length=0.2, pose=[0, 0, 0.1], ignore=["wrist"])
        >>> with_brush = robot.proximity().attach("torch", tool)
        >>> with_brush.self_distance(robot.random(100)).shape
        (100,)
        """
        return self._changed("attach", link, objects)

    def without(self, pairs: Iterable[tuple[str, str]]) -> Proximity:
        """These shapes without some pairs of bodies, which are links or attached objects, by their names: MoveIt's
        *allowed collision matrix* at run time, such as for two links that are always nearer than a margin. The shapes
        are shared. Obstacles are still tested: an obstacle can ``ignore`` a link.

        Raises:
            UnknownNameError: for an unknown name, with the nearest known name.

        >>> import urdd
        >>> robot = urdd.load("welding_arm")
        >>> proximity = robot.proximity().without([("base", "wrist")])
        """
        return self._changed("without", [tuple(words(pair, "a pair")) for pair in pairs])

    def without_bodies(self, names: Iterable[str]) -> Proximity:
        """These shapes without all that belong to some bodies, links or attached objects, among obstacles too.

        Raises:
            UnknownNameError: for an unknown name, with the nearest known name.
        """
        return self._changed("without_bodies", words(names, "names"))

    @property
    def core(self) -> _urdd.Proximity:
        """The native shapes, for the other files of this package."""
        return self._core

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

    @property
    def bodies(self) -> tuple[str, ...]:
        """The names of the bodies: of the links, then of attached objects in the order in which they were attached."""
        return tuple(self._core.bodies())

    @cached_property
    def pair_bodies(self) -> Indices:
        """(pairs, 2): the two bodies of each pair, in :attr:`bodies`. In :attr:`pair_indices`, an attached object has
        the index of its link."""
        return self._core.pair_bodies()

    @cached_property
    def pairs(self) -> list[Pair]:
        """The pairs that are not skipped, in the order of :meth:`distances`."""
        return [
            Pair((first, second), (i, j))
            for (first, second), ((_, i), (_, j)) in zip(
                self._core.pair_names(), self.pair_indices.tolist(), strict=True
            )
        ]

    def self_distance(self, q: ArrayLike) -> Floats:
        """(...): the minimum distance over all pairs, metres; infinite if there are no pairs."""
        return batched(q, self._dof_names, self._core.min_distance)

    def collisions(self, q: ArrayLike) -> list[PairDistance]:
        """The pairs that touch or overlap in one configuration."""
        found = self._core.collisions(one_configuration(q, self._dof_names))
        return [self._distance(near) for near in found]

    def _distance(self, near: _urdd._Near) -> PairDistance:
        return PairDistance(*_answer(near))

    def _gradient(self, near: _urdd._Near, gradient: Floats | None) -> PairGradient:
        return PairGradient(*_answer(near), gradient)

    def _overlap(self, near: _urdd._Near, depth: float, direction: Floats, gradient: Floats) -> PairOverlap:
        return PairOverlap(*_answer(near), depth, direction, gradient)

    def __reduce__(self) -> tuple[type[Proximity], tuple[RobotDescription, ShapeKind, list[tuple[Any, ...]]]]:
        return type(self), (self._robot, self.kind, self._changes)

    def __repr__(self) -> str:
        return f"<urdd.Proximity of {self.kind}: {self.num_shapes} shapes, {self.num_pairs} pairs that are not skipped>"


def _answer(
    near: _urdd._Near,
) -> tuple[tuple[str, str], tuple[int, int], float, float | None, Floats]:
    (a, b), (i, j), distance, relative, points = near
    return (a, b), (i, j), distance, relative, np.array(points, dtype=np.float64)

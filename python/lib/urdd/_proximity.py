"""Distances and collisions between the links of a robot."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from copy import copy
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ._answers import Pair, PairDistance, PairGradient, PairOverlap, ShapeKind
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
from ._description import RobotDescription
from ._options import words
from ._world import World

if TYPE_CHECKING:
    from . import _urdd


class Proximity:
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
    def dof_names(self) -> tuple[str, ...]:
        """The names of the DOFs."""
        return self._dof_names

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

    def distances(self, q: ArrayLike) -> Floats:
        """(..., pairs): the distance of each pair that is not skipped, metres."""
        return batched(q, self._dof_names, self._core.distances)

    def self_distance(self, q: ArrayLike) -> Floats:
        """(...): the minimum distance over all pairs, metres; infinite if there are no pairs."""
        return batched(q, self._dof_names, self._core.self_distance)

    def in_collision(self, q: ArrayLike) -> Bools:
        """(...): whether any pair touches or overlaps. The fastest query: it stops at the first collision."""
        return batched(q, self._dof_names, self._core.in_collision)

    def is_within(self, q: ArrayLike, margin: float) -> Bools:
        """(...): whether any pair is at most ``margin`` metres apart. Stops at the first such pair. With a margin above
        0, pairs count whose links can move against each other."""
        return batched(q, self._dof_names, lambda rows: self._core.is_within(rows, margin))

    def blocked_edge(
        self, start: ArrayLike, end: ArrayLike, *, margin: float = 0.0, resolution: float | None = 0.01
    ) -> Floats:
        """(...): where the straight motion from ``start`` to ``end`` is blocked, as a part of it from 0 to 1; NaN where
        it is free. Only collisions of the robot with itself count.

        With a ``resolution`` (metres), configurations are checked between which no point of the robot travels farther,
        the end and the halves first: the answer is one that is blocked, and need not be the first, which
        :meth:`first_contact` has. With ``None``, the motion is proved free by conservative advancement: it then needs
        0.1 mm more than the ``margin``, and the answer is the first part where it has less.

        Raises:
            ValueError: for a margin below 0, a resolution that is not above 0, or a motion that needs more than a
                million configurations, or 100,000 steps of a proof.
        """
        starts, ends, batch = edges(start, end, self._dof_names)
        return scalar(self._core.blocked_edge(starts, ends, margin, resolution).reshape(batch))

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
        return self._core.first_contact(starts, ends, margin, resolution).reshape((*batch, 2))

    def gradients(self, q: ArrayLike, k: int = 1) -> list[PairGradient]:
        """The ``k`` nearest pairs in one configuration, nearest first, with the gradients of their distances."""
        return [
            PairGradient(*_answer(near), optional_array(gradient))
            for near, gradient in self._core.gradients(one_configuration(q, self._dof_names), number_of_pairs(k))
        ]

    def penetrations(self, q: ArrayLike) -> list[PairOverlap]:
        """The pairs that touch or overlap in one configuration, with the least translation that separates them."""
        found = self._core.penetrations(one_configuration(q, self._dof_names))
        return [
            PairOverlap(*_answer(near), depth, np.array(direction), np.array(gradient, dtype=np.float64))
            for near, depth, direction, gradient in found
        ]

    def nearest(self, q: ArrayLike, k: int = 1) -> list[PairDistance]:
        """The ``k`` nearest pairs in one configuration, nearest first; all pairs if there are fewer."""
        found = self._core.nearest(one_configuration(q, self._dof_names), number_of_pairs(k))
        return [PairDistance(*_answer(near)) for near in found]

    def collisions(self, q: ArrayLike) -> list[PairDistance]:
        """The pairs that touch or overlap in one configuration."""
        found = self._core.collisions(one_configuration(q, self._dof_names))
        return [PairDistance(*_answer(near)) for near in found]

    def __reduce__(self) -> tuple[type[Proximity], tuple[RobotDescription, ShapeKind, list[tuple[Any, ...]]]]:
        return type(self), (self._robot, self.kind, self._changes)

    def __repr__(self) -> str:
        return f"<urdd.Proximity of {self.kind}: {self.num_shapes} shapes, {self.num_pairs} pairs that are not skipped>"


def _answer(
    near: _urdd._Near,
) -> tuple[tuple[str, str], tuple[int, int], float, float | None, Floats]:
    (a, b), (i, j), distance, relative, points = near
    return (a, b), (i, j), distance, relative, np.array(points, dtype=np.float64)

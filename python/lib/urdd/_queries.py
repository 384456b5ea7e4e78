"""What is asked of a robot's own pairs, and of those with obstacles."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._arrays import (
    Bools,
    Floats,
    batched,
    edges,
    number_of_pairs,
    one_configuration,
    optional_array,
    scalar,
)

#: As the compiled part numbers them.
_OBSTRUCTIONS = np.array(["nothing", "contact", "open", "branch"])

_Near = TypeVar("_Near")
_Distance = TypeVar("_Distance")
_Gradient = TypeVar("_Gradient")
_Overlap = TypeVar("_Overlap")


class Core(Protocol[_Near]):
    """The native class behind. A pair is a tuple."""

    def distances(self, configurations: Floats) -> Floats: ...
    def min_distance(self, configurations: Floats) -> Floats: ...
    def in_collision(self, configurations: Floats) -> Bools: ...
    def is_within(self, configurations: Floats, margin: float) -> Bools: ...
    def blocked_edge(
        self, starts: Floats, ends: Floats, margin: float, resolution: float | None, open_loops: bool
    ) -> Floats: ...
    def first_contact(
        self, starts: Floats, ends: Floats, margin: float, resolution: float | None, open_loops: bool
    ) -> Floats: ...
    def obstruction(
        self, starts: Floats, ends: Floats, margin: float, resolution: float | None, open_loops: bool
    ) -> NDArray[np.uint8]: ...
    def gradients(self, configuration: Floats, k: int) -> list[tuple[_Near, list[float] | None]]: ...
    def penetrations(self, configuration: Floats) -> list[tuple[_Near, float, list[float], list[float]]]: ...
    def nearest(self, configuration: Floats, k: int) -> list[_Near]: ...


class Queries(ABC, Generic[_Near, _Distance, _Gradient, _Overlap]):
    """What is asked of pairs of shapes: a robot's own, or a shape of the robot and an obstacle. The two are separate:
    the one does not check for obstacles, the other not for self-collision."""

    _dof_names: tuple[str, ...]

    @property
    @abstractmethod
    def core(self) -> Core[_Near]:
        """The native class, for the other files of this package."""

    @abstractmethod
    def _distance(self, near: _Near) -> _Distance: ...

    @abstractmethod
    def _gradient(self, near: _Near, gradient: Floats | None) -> _Gradient: ...

    @abstractmethod
    def _overlap(self, near: _Near, depth: float, direction: Floats, gradient: Floats) -> _Overlap: ...

    @property
    def dof_names(self) -> tuple[str, ...]:
        """The names of the DOFs."""
        return self._dof_names

    def distances(self, q: ArrayLike) -> Floats:
        """(..., pairs): the distance of each pair, metres, in the order of ``pairs``."""
        return batched(q, self._dof_names, self.core.distances)

    def in_collision(self, q: ArrayLike) -> Bools:
        """(...): whether any pair touches or overlaps. The fastest query: it stops at the first collision."""
        return batched(q, self._dof_names, self.core.in_collision)

    def is_within(self, q: ArrayLike, margin: float) -> Bools:
        """(...): whether any pair is at most ``margin`` metres apart. Stops at the first such pair. With a margin above
        0, those of the robot's own pairs count whose links can move against each other."""
        return batched(q, self._dof_names, lambda rows: self.core.is_within(rows, margin))

    def blocked_edge(
        self,
        start: ArrayLike,
        end: ArrayLike,
        *,
        margin: float = 0.0,
        resolution: float | None = 0.01,
        open_loops: bool = False,
    ) -> Floats:
        """(...): where the straight motion from ``start`` to ``end`` is blocked, as a part of it from 0 to 1; NaN where
        it is free.

        With a ``resolution`` (metres), configurations are checked between which no point of the robot travels farther,
        the end and the halves first: the answer is one that is blocked, and need not be the first, which
        :meth:`first_contact` has. With ``None``, the motion is proved free by conservative advancement: it then needs
        0.1 mm more than the ``margin``, and the answer is the first part where it has less.

        Where the robot has kinematic loops, the motion is the one in which they stay closed: the independent DOFs go
        straight, the others follow. It is blocked where no closed configuration is found within the bounds, and at its
        end where the others arrive elsewhere than at ``end``. It has no proof. With ``open_loops``, it is the straight
        motion of the spanning tree.

        Raises:
            ValueError: for a margin below 0, a resolution that is not above 0, or a motion that needs more than a
                million configurations (with loops 100,000), or 100,000 steps of a proof; for a robot with loops also
                without a resolution, and where ``start`` or ``end`` is not closed.
        """
        starts, ends, batch = edges(start, end, self._dof_names)
        return scalar(self.core.blocked_edge(starts, ends, margin, resolution, bool(open_loops)).reshape(batch))

    def first_contact(
        self,
        start: ArrayLike,
        end: ArrayLike,
        *,
        margin: float = 0.0,
        resolution: float | None = 0.01,
        open_loops: bool = False,
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
        return self.core.first_contact(starts, ends, margin, resolution, bool(open_loops)).reshape((*batch, 2))

    def obstruction(
        self,
        start: ArrayLike,
        end: ArrayLike,
        *,
        margin: float = 0.0,
        resolution: float | None = 0.01,
        open_loops: bool = False,
    ) -> NDArray[np.str_]:
        """(...): what stops the motion of :meth:`first_contact`: ``nothing``; ``contact``: a pair is at most ``margin``
        apart; ``open``: no configuration was found there in which the loops of the robot are closed, within its bounds;
        ``branch``: the DOFs that follow would have to jump, or arrive elsewhere than at ``end``.

        Raises:
            ValueError: as :meth:`blocked_edge`.
        """
        starts, ends, batch = edges(start, end, self._dof_names)
        found = self.core.obstruction(starts, ends, margin, resolution, bool(open_loops))
        answer: NDArray[np.str_] = _OBSTRUCTIONS[found].reshape(batch)[()]
        return answer

    def nearest(self, q: ArrayLike, k: int = 1) -> list[_Distance]:
        """The ``k`` nearest pairs in one configuration, with their closest points, nearest first; all pairs if there
        are fewer. Each convex piece of a mesh counts as an obstacle."""
        found = self.core.nearest(one_configuration(q, self._dof_names), number_of_pairs(k))
        return [self._distance(near) for near in found]

    def gradients(self, q: ArrayLike, k: int = 1) -> list[_Gradient]:
        """The ``k`` nearest pairs in one configuration, nearest first, with the gradients of their distances."""
        found = self.core.gradients(one_configuration(q, self._dof_names), number_of_pairs(k))
        return [self._gradient(near, optional_array(gradient)) for near, gradient in found]

    def penetrations(self, q: ArrayLike) -> list[_Overlap]:
        """The pairs that touch or overlap in one configuration, with the least translation that separates them."""
        found = self.core.penetrations(one_configuration(q, self._dof_names))
        return [
            self._overlap(near, depth, np.array(direction), np.array(gradient, dtype=np.float64))
            for near, depth, direction, gradient in found
        ]

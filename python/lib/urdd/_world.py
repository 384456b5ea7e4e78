"""Obstacles, and how near a robot is to them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from sys import maxsize
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from . import _urdd
from ._answers import ObstacleDistance, ObstaclePair, ShapeKind
from ._arrays import Bools, Floats, Indices, configurations, numbers, one_configuration, scalar
from ._inverse import as_targets, three
from ._options import words
from .errors import ConfigurationError, ObstacleError

if TYPE_CHECKING:
    from ._robot import Robot

__all__ = ["Among", "World"]

_ORIGIN = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class _Made:
    """An obstacle, and what it was made of."""

    core: _urdd.Obstacle
    shape: str
    what: tuple[Any, ...]
    ignore: list[str]


class World:
    """Obstacles around a robot, by name, in the frame of the root link: boxes, spheres, capsules, cylinders, hulls and
    meshes. Lengths are metres.

    A ``pose`` is a matrix (4, 4), or the place (3,) of an obstacle that is not turned. Links that an obstacle should
    ``ignore`` may touch it: the base that stands on it, the gripper that holds it. To move the robot's base, move the
    world the other way.

    >>> import urdd
    >>> robot = urdd.load("welding_arm")
    >>> world = urdd.World()
    >>> world.add_box("table", size=[2, 2, 0.1], pose=[0, 0, -0.05], ignore=["base"])
    >>> world.add_sphere("ball", radius=0.1, centre=[0.6, 0, 0.4])
    >>> around = robot.among(world)
    >>> around.distance(robot.sample(100)).shape
    (100,)
    """

    def __init__(self) -> None:
        self._made: dict[str, _Made] = {}

    def add_box(self, name: str, size: ArrayLike, pose: ArrayLike = _ORIGIN, *, ignore: Iterable[str] = ()) -> None:
        """Adds a box of the ``size`` (3,), whole sides, about the origin of its frame.

        Raises:
            ObstacleError: for numbers that are not finite, below 0, or larger than 1e9; as all of these.
            ValueError: where an obstacle has this name already.
        """
        half = tuple(side / 2 for side in self._three(name, size, "size"))
        self._add(name, "cuboid", (self._pose(name, pose), half), ignore)

    def add_sphere(self, name: str, radius: float, centre: ArrayLike = _ORIGIN, *, ignore: Iterable[str] = ()) -> None:
        """Adds a ball. ``centre`` is (3,)."""
        self._add(name, "sphere", (self._three(name, centre, "centre"), float(radius)), ignore)

    def add_capsule(
        self, name: str, radius: float, length: float, pose: ArrayLike = _ORIGIN, *, ignore: Iterable[str] = ()
    ) -> None:
        """Adds all points within ``radius`` of a line of this ``length`` along z, about the origin of its frame."""
        self._add(name, "capsule", (self._pose(name, pose), float(radius), float(length) / 2), ignore)

    def add_cylinder(
        self, name: str, radius: float, length: float, pose: ArrayLike = _ORIGIN, *, ignore: Iterable[str] = ()
    ) -> None:
        """Adds a cylinder along z, about the origin of its frame. A prism of 64 sides about it stands for it, which is
        larger by up to 0.13 % of the radius."""
        self._add(name, "cylinder", (self._pose(name, pose), float(radius), float(length) / 2), ignore)

    def add_hull(self, name: str, points: ArrayLike, pose: ArrayLike = _ORIGIN, *, ignore: Iterable[str] = ()) -> None:
        """Adds the convex hull of points (n, 3)."""
        self._add(name, "hull", (self._pose(name, pose), self._rows(name, points, "points")), ignore)

    def add_mesh(
        self,
        name: str,
        vertices: ArrayLike,
        faces: ArrayLike,
        pose: ArrayLike = _ORIGIN,
        *,
        ignore: Iterable[str] = (),
    ) -> None:
        """Adds a mesh of ``vertices`` (v, 3) and triangles ``faces`` (f, 3), as trimesh has them. Convex pieces are
        made of it, as :func:`generate` makes them of links, and take as long as there; :meth:`add_hull` is soon done,
        and fills cavities."""
        corners = self._rows(name, vertices, "vertices")
        given: Any = np.asarray(faces)
        if given.ndim != 2 or given.shape[1] != 3 or given.dtype.kind not in "iu":
            raise ObstacleError(
                f"obstacle `{name}`: faces must be whole numbers, (f, 3), and are {given.dtype} of {given.shape}",
                name,
            )
        if given.size and not (given.min() >= 0 and given.max() < len(corners)):
            raise ObstacleError(f"obstacle `{name}`: a face names a vertex that is not there", name)
        triangles = np.ascontiguousarray(given, dtype=np.uint32)
        self._add(name, "mesh", (self._pose(name, pose), corners, triangles), ignore)

    def remove(self, name: str) -> None:
        """Removes an obstacle.

        Raises:
            KeyError: where there is none of this name.
        """
        del self._made[name]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the obstacles, in the order in which they were added."""
        return tuple(self._made)

    def obstacles(self) -> list[tuple[_urdd.Obstacle, list[str]]]:
        """The obstacles, each with the links that it ignores, for other files of this package."""
        return [(made.core, made.ignore) for made in self._made.values()]

    def num_parts(self, name: str) -> int:
        """Number of convex shapes that stand for an obstacle."""
        return self._made[name].core.num_parts

    def __len__(self) -> int:
        return len(self._made)

    def __iter__(self) -> Iterator[str]:
        return iter(self._made)

    def __contains__(self, name: object) -> bool:
        return name in self._made

    def __repr__(self) -> str:
        return f"<urdd.World: {', '.join(f'{name} ({made.shape})' for name, made in self._made.items()) or 'empty'}>"

    def __copy__(self) -> World:
        # Obstacles do not change: both worlds hold the same ones.
        found = type(self)()
        found._made = dict(self._made)
        return found

    def __getstate__(self) -> list[tuple[str, str, tuple[Any, ...], list[str]]]:
        return [(name, made.shape, made.what, made.ignore) for name, made in self._made.items()]

    def __setstate__(self, state: list[tuple[str, str, tuple[Any, ...], list[str]]]) -> None:
        self._made = {}
        for obstacle in state:
            self._add(*obstacle)

    def _add(self, name: str, shape: str, what: tuple[Any, ...], ignore: Iterable[str]) -> None:
        if name in self._made:
            raise ValueError(f"there is an obstacle `{name}` already; remove it first, or name this one otherwise")
        ignored = words(ignore, "ignore")
        core: _urdd.Obstacle = getattr(_urdd.Obstacle, shape)(name, *what)
        self._made[name] = _Made(core, shape, what, ignored)

    @staticmethod
    def _three(name: str, values: ArrayLike, what: str) -> tuple[float, float, float]:
        try:
            return three(values, what)
        except ConfigurationError as error:
            raise ObstacleError(f"obstacle `{name}`: {error}", name) from None

    @staticmethod
    def _pose(name: str, pose: ArrayLike) -> Floats:
        try:
            given = as_targets(pose, (3,), (4, 4), "a pose")
        except ConfigurationError as error:
            raise ObstacleError(f"obstacle `{name}`: {error}", name) from None
        if given.ndim == 2:
            # Its own: the state of a world is nobody else's.
            return np.array(given)
        found = np.eye(4)
        found[:3, 3] = given
        return found

    @staticmethod
    def _rows(name: str, values: ArrayLike, what: str) -> Floats:
        try:
            given = numbers(values, what)
        except ConfigurationError as error:
            raise ObstacleError(f"obstacle `{name}`: {error}", name) from None
        if given.ndim != 2 or given.shape[1] != 3:
            raise ObstacleError(f"obstacle `{name}`: {what} must be of shape (n, 3), and are of {given.shape}", name)
        return np.array(given)


class Among:
    """A robot's shapes of one kind among the obstacles of a world: ``robot.among(world)``.

    Skips do not count: every shape is tested against every obstacle, but for links that the obstacle ignores. Distances
    are 0 for what touches or overlaps: depths of penetration are not given.

    It is pickled as its robot, which is its path, its kind, and the world.
    """

    def __init__(self, robot: Robot, world: World, kind: ShapeKind) -> None:
        self._robot = robot
        # What is added to the world afterwards does not count.
        self._world = copy(world)
        self._kind: ShapeKind = kind
        self._core = _urdd.Among(robot.core.proximity(kind), world.obstacles())
        self._link_names = robot.link_names
        self._dof_names = robot.dof_names

    @property
    def kind(self) -> ShapeKind:
        """Of which kind the robot's shapes are."""
        return self._kind

    @property
    def obstacle_names(self) -> tuple[str, ...]:
        """The names of the obstacles."""
        return self._world.names

    @cached_property
    def pair_indices(self) -> Indices:
        """(pairs, 3): of each pair the link, the piece and the obstacle."""
        return self._core.pairs()

    @property
    def num_pairs(self) -> int:
        """Number of pairs of a shape and an obstacle."""
        return len(self.pair_indices)

    @cached_property
    def pairs(self) -> list[ObstaclePair]:
        """The pairs of a shape and an obstacle, in the order of :meth:`distances`."""
        return [
            ObstaclePair(self._link_names[link], piece, self.obstacle_names[obstacle])
            for link, piece, obstacle in self.pair_indices.tolist()
        ]

    def distances(self, q: ArrayLike) -> Floats:
        """(..., pairs): the distance of each pair of a shape and an obstacle, metres."""
        rows, batch = configurations(q, self._dof_names)
        return self._core.distances(rows).reshape(*batch, self.num_pairs)

    def distance(self, q: ArrayLike) -> Floats:
        """(...): the least distance of the robot to any obstacle, metres; infinite where there is none."""
        rows, batch = configurations(q, self._dof_names)
        return scalar(self._core.distance(rows).reshape(batch))

    def in_collision(self, q: ArrayLike) -> Bools:
        """(...): whether the robot touches or overlaps any obstacle; with itself it is not tested here."""
        rows, batch = configurations(q, self._dof_names)
        return scalar(self._core.in_collision(rows).reshape(batch))

    def nearest(self, q: ArrayLike, k: int = 1) -> list[ObstacleDistance]:
        """The ``k`` nearest pairs in one configuration, with their points, nearest first; fewer where there are fewer.
        Each convex piece of a mesh counts for itself."""
        if k < 0:
            raise ValueError(f"the number of pairs must not be negative, and is {k}")
        # More than there are would be no number for the compiled part.
        k = min(k, maxsize)
        return [
            ObstacleDistance(
                self._link_names[link],
                piece,
                self.obstacle_names[obstacle],
                distance,
                np.array(points, dtype=np.float64),
            )
            for (link, piece), obstacle, distance, points in self._core.nearest(
                one_configuration(q, self._dof_names), k
            )
        ]

    def __reduce__(self) -> tuple[type[Among], tuple[Robot, World, ShapeKind]]:
        return type(self), (self._robot, self._world, self._kind)

    def __repr__(self) -> str:
        return f"<urdd.Among: {self.kind} and {len(self.obstacle_names)} obstacles, {self.num_pairs} pairs>"

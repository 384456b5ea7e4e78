"""Bodies that a robot must not touch, or that its links carry."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _urdd
from ._arrays import Floats, numbers, poses, three
from ._options import words
from .errors import ConfigurationError, ObstacleError

__all__ = ["World"]

_ORIGIN = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class _Obstacle:
    """An obstacle, and the arguments that create it."""

    core: _urdd.Obstacle
    shape: str
    arguments: tuple[Any, ...]
    ignore: list[str]


class World:
    """Obstacles around a robot, by name, in the frame of the root link: boxes, spheres, capsules, cylinders, hulls,
    meshes, clouds of points and fields of heights. Lengths are metres. A world can also be what a link carries:
    :meth:`Proximity.attach`.

    A ``pose`` is a matrix (4, 4), or a position (3,) without a rotation. Links that an obstacle should ``ignore`` may
    touch it, such as the base mounted on it or the gripper that holds it. To move the robot's base, apply the inverse
    motion to the world.

    >>> import urdd
    >>> robot = urdd.load("welding_arm")
    >>> world = urdd.World()
    >>> world.add_box("table", size=[2, 2, 0.1], pose=[0, 0, -0.05], ignore=["base"])
    >>> world.add_sphere("ball", radius=0.1, centre=[0.6, 0, 0.4])
    >>> proximity = robot.world_proximity(world)
    >>> proximity.min_distance(robot.random(100)).shape
    (100,)
    """

    def __init__(self) -> None:
        self._obstacles: dict[str, _Obstacle] = {}

    def add_box(self, name: str, size: ArrayLike, pose: ArrayLike = _ORIGIN, *, ignore: Iterable[str] = ()) -> None:
        """Adds a box, centred at the origin of its frame. ``size`` (3,) is the length of its sides.

        Raises:
            ObstacleError: for a number that is not finite, negative or larger than 1e9; as all of these methods.
            ValueError: if the name is taken.
        """
        half = tuple(side / 2 for side in self._three(name, size, "size"))
        self._add(name, "cuboid", (self._pose(name, pose), half), ignore)

    def add_sphere(self, name: str, radius: float, centre: ArrayLike = _ORIGIN, *, ignore: Iterable[str] = ()) -> None:
        """Adds a sphere. ``centre`` is (3,)."""
        self._add(name, "sphere", (self._three(name, centre, "centre"), float(radius)), ignore)

    def add_capsule(
        self, name: str, radius: float, length: float, pose: ArrayLike = _ORIGIN, *, ignore: Iterable[str] = ()
    ) -> None:
        """Adds a capsule: all points within ``radius`` of a segment of this ``length`` along z, centred at the origin
        of its frame."""
        self._add(name, "capsule", (self._pose(name, pose), float(radius), float(length) / 2), ignore)

    def add_cylinder(
        self, name: str, radius: float, length: float, pose: ArrayLike = _ORIGIN, *, ignore: Iterable[str] = ()
    ) -> None:
        """Adds a cylinder along z, centred at the origin of its frame. It is approximated by a circumscribed prism with
        64 sides, which exceeds the radius by up to 0.13 %."""
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
        """Adds a mesh of ``vertices`` (v, 3) and triangles ``faces`` (f, 3), as in trimesh. It is decomposed into
        convex pieces, as :func:`generate` does for links, at the same cost; :meth:`add_hull` is fast, and fills
        cavities."""
        corners = self._rows(name, vertices, "vertices")
        given: Any = np.asarray(faces)
        if given.ndim != 2 or given.shape[1] != 3 or given.dtype.kind not in "iu":
            raise ObstacleError(
                f"obstacle `{name}`: faces must be whole numbers of shape (f, 3), not {given.dtype} of {given.shape}",
                name,
            )
        if given.size and not (given.min() >= 0 and given.max() < len(corners)):
            raise ObstacleError(f"obstacle `{name}`: a face has a vertex index that is out of range", name)
        triangles = np.ascontiguousarray(given, dtype=np.uint32)
        self._add(name, "mesh", (self._pose(name, pose), corners, triangles), ignore)

    def add_points(
        self,
        name: str,
        points: ArrayLike,
        radius: float = 0.0,
        pose: ArrayLike = _ORIGIN,
        *,
        ignore: Iterable[str] = (),
    ) -> None:
        """Adds a cloud of points (n, 3), such as a depth camera sees: all that is within ``radius`` of one of them. A
        tree finds those near a shape, so that 100,000 points are fine. It is one obstacle of one part."""
        self._add(name, "points", (self._pose(name, pose), self._rows(name, points, "points"), float(radius)), ignore)

    def add_height_field(
        self,
        name: str,
        heights: ArrayLike,
        cell: ArrayLike,
        thickness: float,
        pose: ArrayLike = _ORIGIN,
        *,
        ignore: Iterable[str] = (),
    ) -> None:
        """Adds a field of ``heights`` (rows, columns) over the x-y plane of its frame. Cell (row, column) is a column
        with the sizes ``cell`` (2,) along x and y, its centre at x = column * cell[0], y = row * cell[1]. It reaches
        from its height ``thickness`` down. There are no slopes between cells."""
        try:
            field, sizes = numbers(heights, "heights"), numbers(cell, "a cell")
        except ConfigurationError as error:
            raise ObstacleError(f"obstacle `{name}`: {error}", name) from None
        if field.ndim != 2 or sizes.shape != (2,):
            raise ObstacleError(
                f"obstacle `{name}`: heights must have the shape (rows, columns) and a cell (2,), not {field.shape} "
                f"and {sizes.shape}",
                name,
            )
        arguments = (self._pose(name, pose), field, tuple(sizes.tolist()), float(thickness))
        self._add(name, "height_field", arguments, ignore)

    def move(self, name: str | Sequence[str], pose: ArrayLike) -> None:
        """Moves obstacles: one, to the ``pose`` of its frame, or several by their names, to poses (n, 4, 4) or
        positions (n, 3). The frame of a sphere is at its centre. Nothing is prepared again.

        Raises:
            KeyError: if there is no such obstacle. None has moved then, nor after another error.
            ObstacleError: as the other methods.
        """
        names = [name] if isinstance(name, str) else list(name)
        known = [self._obstacles[one] for one in names]
        placed = self._pose(name, pose)[np.newaxis] if isinstance(name, str) else self._poses(names, pose)
        cores = _urdd.Obstacle.at([one.core for one in known], placed.reshape(-1, 16))
        for one, before, core, at in zip(names, known, cores, placed, strict=True):
            _, *sizes = before.arguments
            place = tuple(at[:3, 3].tolist()) if before.shape == "sphere" else at
            self._obstacles[one] = _Obstacle(core, before.shape, (place, *sizes), before.ignore)

    def remove(self, name: str) -> None:
        """Removes an obstacle.

        Raises:
            KeyError: if there is no such obstacle.
        """
        del self._obstacles[name]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the obstacles, in the order in which they were added."""
        return tuple(self._obstacles)

    def obstacles(self) -> list[tuple[_urdd.Obstacle, list[str]]]:
        """The obstacles, each with the links that it ignores, for the other files of this package."""
        return [(obstacle.core, obstacle.ignore) for obstacle in self._obstacles.values()]

    def num_parts(self, name: str) -> int:
        """Number of convex parts of an obstacle."""
        return self._obstacles[name].core.num_parts

    def __len__(self) -> int:
        return len(self._obstacles)

    def __iter__(self) -> Iterator[str]:
        return iter(self._obstacles)

    def __contains__(self, name: object) -> bool:
        return name in self._obstacles

    def __repr__(self) -> str:
        each = (f"{name} ({obstacle.shape})" for name, obstacle in self._obstacles.items())
        return f"<urdd.World: {', '.join(each) or 'empty'}>"

    def __copy__(self) -> World:
        # Obstacles do not change: both worlds share them.
        found = type(self)()
        found._obstacles = dict(self._obstacles)
        return found

    def __getstate__(self) -> list[tuple[str, str, tuple[Any, ...], list[str]]]:
        return [(name, one.shape, one.arguments, one.ignore) for name, one in self._obstacles.items()]

    def __setstate__(self, state: list[tuple[str, str, tuple[Any, ...], list[str]]]) -> None:
        self._obstacles = {}
        for obstacle in state:
            self._add(*obstacle)

    def _add(self, name: str, shape: str, arguments: tuple[Any, ...], ignore: Iterable[str]) -> None:
        if name in self._obstacles:
            raise ValueError(f"there is an obstacle `{name}` already; remove it first, or choose another name")
        ignored = words(ignore, "ignore")
        core: _urdd.Obstacle = getattr(_urdd.Obstacle, shape)(name, *arguments)
        # The caller may change theirs. Not before the core is made: it refuses what takes too much memory.
        kept = tuple(np.array(one) if isinstance(one, np.ndarray) else one for one in arguments)
        self._obstacles[name] = _Obstacle(core, shape, kept, ignored)

    @staticmethod
    def _three(name: str, values: ArrayLike, what: str) -> tuple[float, float, float]:
        try:
            return three(values, what)
        except ConfigurationError as error:
            raise ObstacleError(f"obstacle `{name}`: {error}", name) from None

    @staticmethod
    def _pose(name: str, pose: ArrayLike) -> Floats:
        try:
            given = poses(pose, "a pose")
        except ConfigurationError as error:
            raise ObstacleError(f"obstacle `{name}`: {error}", name) from None
        if given.shape not in ((4, 4), (3,)):
            raise ObstacleError(
                f"obstacle `{name}`: a pose must have the shape (4, 4) or (3,), not {given.shape}", name
            )
        if given.ndim == 2:
            # A copy: the caller may change theirs.
            return np.array(given)
        found = np.eye(4)
        found[:3, 3] = given
        return found

    @classmethod
    def _poses(cls, names: list[str], given: ArrayLike) -> Floats:
        try:
            found = poses(given, "a pose")
        except ConfigurationError:
            # Says of which.
            found = np.array([cls._pose(name, one) for name, one in zip(names, np.asarray(given), strict=False)])
        if found.shape not in ((len(names), 4, 4), (len(names), 3)):
            raise ConfigurationError(
                f"the poses of {len(names)} obstacles must have the shape ({len(names)}, 4, 4) or ({len(names)}, 3), "
                f"not {found.shape}"
            )
        if found.ndim == 3:
            return np.array(found)
        placed = np.tile(np.eye(4), (len(names), 1, 1))
        placed[:, :3, 3] = found
        return placed

    @staticmethod
    def _rows(name: str, values: ArrayLike, what: str) -> Floats:
        try:
            given = numbers(values, what)
        except ConfigurationError as error:
            raise ObstacleError(f"obstacle `{name}`: {error}", name) from None
        if given.ndim != 2 or given.shape[1] != 3:
            raise ObstacleError(f"obstacle `{name}`: {what} must have the shape (n, 3), not {given.shape}", name)
        return given

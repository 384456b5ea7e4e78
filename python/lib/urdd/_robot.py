"""A robot."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Literal, overload

from numpy.typing import ArrayLike

from ._answers import Box, ConvexMesh, MeshKind, ShapeKind, Skips, Spheres, Visual
from ._arrays import Bools, Floats
from ._collision_model import CollisionModel, missing
from ._motion import Moving
from ._proximity import Proximity
from ._shapes import boxes, convex, skips, spheres, visuals
from ._world import Among, World
from .errors import ModuleMissingError, UrddError

if TYPE_CHECKING:
    # Each takes time to import, and few programs need it.
    from ._answers import PairDistance
    from ._mujoco import MujocoRobot
    from ._pinocchio import PinocchioRobot
    from ._pybullet import PybulletRobot
    from ._show import Frame, Shown, ShownByViser


def load(path: str | os.PathLike[str], *, validate: bool = False) -> Robot:
    """The robot in a folder or a zip archive.

    Nothing of it is read before it is asked for, and no mesh before shapes are. **It is not validated**: a URDD with
    errors is a robot as far as its modules can be read, and gives what they say. With ``validate`` it is checked first,
    as by :func:`urdd.validate`, which takes from some tenths of a second to some seconds.

    Raises:
        OpenError: where there is no URDD.
        ValidationError: with ``validate``, where it does not pass; ``findings`` says what was found.

    >>> import urdd
    >>> robot = urdd.load("welding_arm")
    >>> robot.num_dofs
    6
    """
    robot = Robot(path)
    if validate:
        from ._validate import check

        check(robot.path)
    return robot


class Robot(Moving):
    """A robot to ask about itself: what a URDD holds, with names, units and nothing derived.

    Lengths are metres, angles radians. Poses are matrices (4, 4) in the frame of the root link. A configuration ``q``
    has one value for each DOF, in the order of :attr:`dof_names`; values beyond the bounds are allowed. Where a method
    takes ``q``, it takes one configuration ``(dofs,)`` or any array of them ``(..., dofs)``, and what it gives begins
    with the same axes. Links are in the order of :attr:`link_names`.

    Arrays are copied before the interpreter is let go: threads may ask one robot at the same time, and work in
    parallel. Ctrl-C stops what takes long. Where there is not enough memory for an answer, that is a ``MemoryError``:
    ask for fewer configurations at once. A robot is pickled as its path.
    """

    # Collisions.

    def proximity(self, kind: ShapeKind = "pieces") -> Proximity:
        """The shapes of a kind, prepared for distances. It is prepared once, and then kept."""
        return Proximity(self, kind)

    def in_collision(self, q: ArrayLike, kind: ShapeKind = "pieces") -> Bools:
        """(...): whether the robot collides with itself. As :meth:`Proximity.in_collision`."""
        return self.proximity(kind).in_collision(q)

    def distances(self, q: ArrayLike, kind: ShapeKind = "pieces") -> Floats:
        """(..., pairs): the distance of every pair of shapes that is not skipped, metres, in the order of
        ``proximity(kind).pairs``. As :meth:`Proximity.distances`."""
        return self.proximity(kind).distances(q)

    def self_distance(self, q: ArrayLike, kind: ShapeKind = "pieces") -> Floats:
        """(...): the least distance of all pairs, metres. As :meth:`Proximity.self_distance`."""
        return self.proximity(kind).self_distance(q)

    def nearest(self, q: ArrayLike, k: int = 1, kind: ShapeKind = "pieces") -> list[PairDistance]:
        """The ``k`` nearest pairs in one configuration, nearest first. As :meth:`Proximity.nearest`."""
        return self.proximity(kind).nearest(q, k)

    def collision_model(self) -> CollisionModel:
        """The learned self-collision model, for passing over configurations that are far from any contact before the
        others are checked exactly. An estimate: it guarantees nothing, and says how often it was wrong.

        Raises:
            ModuleMissingError: where the URDD has none, with how to make it.
        """
        try:
            core = self._core.collision_model()
        except ModuleMissingError as error:
            raise missing(error) from None
        return CollisionModel(core, str(self._path.absolute()), self.link_names, self.dof_names)

    def among(self, world: World, kind: ShapeKind = "pieces") -> Among:
        """The robot's shapes of a kind among obstacles, prepared for distances. What is added to the world afterwards
        does not count.

        Raises:
            UnknownNameError: where an obstacle ignores a link that is not there, with the nearest name.
        """
        return Among(self, world, kind)

    # Shapes.

    def shapes(self, kind: ShapeKind = "pieces") -> list[ConvexMesh] | list[Box] | Spheres:
        """The shapes of one kind, by link and piece, in the frames of their links. Meshes are read from their files."""
        if kind in ("hulls", "pieces"):
            return self.hulls() if kind == "hulls" else self.pieces()
        if kind in ("spheres", "piece-spheres"):
            return self.spheres("pieces" if kind == "piece-spheres" else "hulls")
        return self.boxes("pieces" if kind == "piece-boxes" else "hulls")

    def hulls(self) -> list[ConvexMesh]:
        """The convex hull of each link that has geometry."""
        return convex(self, "hulls")

    def pieces(self) -> list[ConvexMesh]:
        """The convex pieces of each link that has geometry."""
        return convex(self, "pieces")

    def boxes(self, about: str = "pieces") -> list[Box]:
        """The box about each of the ``hulls`` or ``pieces``."""
        return boxes(self, about)

    def spheres(self, about: str = "pieces") -> Spheres:
        """The sphere about each of the ``hulls`` or ``pieces``."""
        return spheres(self, about)

    def visuals(self) -> list[Visual]:
        """What links look like: the plain mesh of each link, by colour."""
        return visuals(self)

    def skips(self, kind: ShapeKind = "pieces") -> Skips:
        """Which pairs of shapes of a kind a check for collisions leaves out, and why."""
        return skips(self, kind)

    # Other programs.

    def link_mesh(self, link: str, kind: MeshKind = "plain") -> Any:
        """A link's mesh as ``trimesh.Trimesh``, in the link's frame, metres: as it looks (``plain``, with colours and
        textures), its convex hull (``hulls``), or its convex pieces together (``pieces``).

        Raises:
            MeshError: where the link has no geometry.
        """
        from ._trimesh import link_mesh

        return link_mesh(self, link, kind)

    def to_trimesh(self, q: ArrayLike | None = None, kind: MeshKind = "plain") -> Any:
        """A ``trimesh.Scene`` of the robot in one configuration, :attr:`zero` unless you say otherwise. Each mesh is a
        node ``link/number``."""
        from ._trimesh import to_trimesh

        return to_trimesh(self, q, kind)

    def to_pinocchio(self, shapes: ShapeKind | None = "pieces") -> PinocchioRobot:
        """Pinocchio's model, with shapes of this kind as its collision geometry, and the pairs that are not skipped."""
        from ._pinocchio import to_pinocchio

        return to_pinocchio(self, shapes)

    def to_mujoco(self, shapes: ShapeKind = "pieces", *, visuals: bool = True) -> MujocoRobot:
        """MuJoCo's model, with shapes of this kind as its geoms, and the skips as excluded pairs."""
        from ._mujoco import to_mujoco

        return to_mujoco(self, shapes, visuals=visuals)

    def to_pybullet(
        self, client: int = 0, shapes: ShapeKind = "pieces", *, visuals: bool = False, keep_pairs: bool = False
    ) -> PybulletRobot:
        """Loads the robot into a client of PyBullet, with shapes of this kind, its root fixed.

        PyBullet knows pairs of links, and not of their pieces. Links all of whose pairs of pieces are skipped do not
        collide there. Nor do links of which some pieces are always in contact, in contact in the default configuration,
        or on links that a joint connects, and are skipped for that, while other pieces are checked: with these pieces
        they would touch at all times. What is lost by that is in :attr:`PybulletRobot.notes`. With ``keep_pairs`` such
        links collide, with all of their pieces.

        Raises:
            ExportError: for planar, floating and spherical joints, which PyBullet does not read.
        """
        from ._pybullet import to_pybullet

        return to_pybullet(self, client, shapes, visuals=visuals, keep_pairs=keep_pairs)

    @overload
    def show(
        self,
        q: ArrayLike | None = None,
        *,
        backend: Literal["page"] = "page",
        open_browser: bool = True,
        port: int | None = None,
    ) -> Shown: ...
    @overload
    def show(
        self,
        q: ArrayLike | None = None,
        *,
        backend: Literal["viser"],
        open_browser: bool = True,
        port: int | None = None,
    ) -> ShownByViser: ...
    def show(
        self,
        q: ArrayLike | None = None,
        *,
        backend: Literal["page", "viser"] = "page",
        open_browser: bool = True,
        port: int | None = None,
    ) -> Shown | ShownByViser:
        """Shows the robot in the browser: the page of ``urdd view``, or viser.

        It is served to this machine alone, until what this gives is closed, or Python ends. In a notebook :meth:`frame`
        shows the page in a cell.
        """
        from ._show import show

        return show(self, q, backend=backend, open_browser=open_browser, port=port)

    def frame(self, height: int = 600) -> Frame:
        """The page with this robot, as the output of a notebook's cell; nothing is served."""
        from ._show import frame

        return frame(self, height)

    # Habits of Python.

    def __reduce__(self) -> tuple[type[Robot], tuple[str]]:
        return (type(self), (str(self._path.absolute()),))

    def __repr__(self) -> str:
        try:
            names = self._core.module_names()
            metadata = self.metadata
            profile = "legacy" if metadata is None else f"class {metadata.conformance_class}"
            return (
                f"<urdd.Robot {self.name!r}: {_count(self.num_dofs, 'DOF')}, {_count(self.num_links, 'link')}, "
                f"{_count(len(names), 'module')}, {profile}, at {str(self._path)!r}>"
            )
        except UrddError as error:
            return f"<urdd.Robot at {str(self._path)!r}: {error}>"


def _count(number: int, what: str) -> str:
    return f"{number} {what}" if number == 1 else f"{number} {what}s"

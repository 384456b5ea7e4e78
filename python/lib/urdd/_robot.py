"""A robot."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike

from . import _urdd
from ._answers import Box, ConvexMesh, ExportShapes, MeshKind, ShapeKind, Skips, Spheres, Visual
from ._arrays import Bools, Floats, Indices
from ._collision_model import CollisionModel
from ._kinematics import RobotKinematics
from ._proximity import Proximity
from ._shapes import boxes, convex, shapes, skips, spheres, visuals
from ._sphere_checker import SphereChecker
from ._world import World
from ._world_proximity import WorldProximity
from .errors import UrddError

if TYPE_CHECKING:
    # Slow to import, and rarely needed.
    from ._answers import PairDistance
    from ._chain_arrays import ChainArrays
    from ._export import Actuators
    from ._mujoco import MujocoRobot
    from ._newton import NewtonRobot
    from ._pinocchio import PinocchioRobot
    from ._pybullet import PybulletRobot
    from ._show import Frame, Shown, ShownByViser


def load(path: str | os.PathLike[str], *, validate: bool = False) -> Robot:
    """Opens the robot in a folder or a zip archive.

    Modules and meshes are read on demand, as they were when this was called. **The URDD is not validated**: one with
    errors still works as far as its modules can be read. ``validate=True`` validates it first, as :func:`urdd.validate`
    does, which takes from tenths of a second to seconds.

    Raises:
        OpenError: if there is no URDD.
        ValidationError: with ``validate``, if it does not pass; ``findings`` lists the reasons.

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


class Robot(RobotKinematics):
    """A robot, described by a URDD.

    Lengths are metres, angles radians. Poses are matrices (4, 4) in the frame of the root link. A configuration ``q``
    has one value for each DOF, in the order of :attr:`dof_names`; values beyond the bounds are allowed. A method that
    takes ``q`` accepts one configuration ``(dofs,)`` or any array of them ``(..., dofs)``, and its result begins with
    the same axes. Links are in the order of :attr:`link_names`.

    Threads can share a robot, and work in parallel: arrays are copied before the GIL is released. Ctrl-C stops long
    work. If there is not enough memory for a result, methods raise ``MemoryError``: ask for fewer configurations at
    once. A robot is pickled as its path.

    A robot never changes: it is the one that was there when it was loaded. Each module is read when it is first needed,
    and kept. If the files changed on disk before, methods raise :class:`urdd.ModuleUnusableError`: load it again.
    """

    # Collisions.

    def proximity(self, kind: ShapeKind = "pieces") -> Proximity:
        """The shapes of a kind, prepared for distances on first use."""
        return Proximity(self, kind)

    def skipped_contacts(self, kind: ShapeKind = "pieces") -> list[tuple[str, str]]:
        """The pairs of links that are skipped because they touch in the default configuration, or in the reference
        configuration that ``generate`` was given. Where they touch elsewhere, the robot collides, and
        :meth:`in_collision` calls it free. Pairs that a person decided on are left out."""
        core = self.core.skipped_contacts(kind)
        names = [] if core is None else core.pair_names()
        return list(dict.fromkeys((a, b) for a, b in names))

    def in_collision(self, q: ArrayLike, kind: ShapeKind = "pieces") -> Bools:
        """(...): whether the robot is in self-collision. As :meth:`Proximity.in_collision`. It does not see the pairs
        of :meth:`skipped_contacts`."""
        return self.proximity(kind).in_collision(q)

    def distances(self, q: ArrayLike, kind: ShapeKind = "pieces") -> Floats:
        """(..., pairs): the distance of every pair of shapes that is not skipped, metres, in the order of
        ``proximity(kind).pairs``. As :meth:`Proximity.distances`."""
        return self.proximity(kind).distances(q)

    def self_distance(self, q: ArrayLike, kind: ShapeKind = "pieces") -> Floats:
        """(...): the minimum distance over all pairs, metres. As :meth:`Proximity.self_distance`."""
        return self.proximity(kind).self_distance(q)

    def nearest(self, q: ArrayLike, k: int = 1, kind: ShapeKind = "pieces") -> list[PairDistance]:
        """The ``k`` nearest pairs in one configuration, nearest first. As :meth:`Proximity.nearest`."""
        return self.proximity(kind).nearest(q, k)

    def collision_model(self) -> CollisionModel:
        """The learned self-collision model. It filters out configurations that are far from contact, before an exact
        check of the rest. It is an estimate, not a guarantee, and states its measured error rates.

        Raises:
            ModuleMissingError: if the URDD has none; the message says how to generate it.
        """
        return CollisionModel(self)

    def world_proximity(self, world: World, kind: ShapeKind | Proximity = "pieces") -> WorldProximity:
        """The robot's shapes of a kind, or with what its links carry (:meth:`Proximity.attach`), and a world's
        obstacles, prepared for distances. Later changes of the world have no effect: after
        :meth:`World.move <urdd.World.move>`, call this again, which prepares nothing else.

        Raises:
            UnknownNameError: if an obstacle ignores an unknown link, with the nearest known name.
        """
        return WorldProximity(kind if isinstance(kind, Proximity) else self.proximity(kind), world)

    def sphere_checker(
        self,
        spheres: Mapping[str, ArrayLike] | Sequence[Mapping[str, ArrayLike]] | None = None,
        pairs: Iterable[tuple[str, str]] | None = None,
        *,
        covers: bool = False,
        world: World | None = None,
    ) -> SphereChecker:
        """Spheres in the place of shapes, for yes or no in a fraction of a microsecond.

        ``spheres`` has for each link, by name, its spheres (n, 4): centre in the link's frame and radius, metres. Or it
        is a list of such levels, from coarse to fine, where each is inside the coarser one. ``covers`` says that every
        shape of each link is inside the union of the link's spheres, at each level. ``pairs`` are the pairs of links
        that are checked; by default those of ``proximity("pieces")``. Without ``spheres``, they are those of
        ``link_shapes_spheres_module``: the last level that does not cover the links, or with ``covers`` the finest that
        does, without the pairs that the level ignores.

        >>> import urdd
        >>> robot = urdd.load("welding_arm")
        >>> checker = robot.sphere_checker({"turret": [[0, 0, 0.1, 0.1]], "flange": [[0, 0, 0, 0.08]]})
        >>> checker.in_collision(robot.random(100)).shape
        (100,)

        Raises:
            UnknownNameError: for an unknown link, with the nearest known name.
            ConfigurationError: for a sphere whose centre is not finite, or whose radius is not above 0.
            ModuleMissingError: without ``spheres``, if the URDD has no level of that kind.
        """
        levels: Sequence[Mapping[str, ArrayLike]]
        if spheres is None:
            name = self.link_names
            found, checked = _urdd.sphere_levels(self._core, covers)
            levels = [{name[link]: own for link, own in level} for level in found]
            pairs = [(name[a], name[b]) for a, b in checked] if pairs is None else pairs
        else:
            levels = [spheres] if isinstance(spheres, Mapping) else list(spheres)
        if pairs is None:
            own = self.proximity("pieces").pairs
            pairs = list(dict.fromkeys(pair.links for pair in own))
        return SphereChecker(self, levels, pairs, covers, world)

    def joint_groups(self, file: str | os.PathLike[str] | None = None) -> dict[str, Indices]:
        """Groups of joints that planners move together, by name, as indices of DOFs, ascending.

        Those of an SRDF (its ``<group>``s), or of an ``export.toml`` of ``urdd export init``; by default of
        ``NAME.export.toml`` beside the URDD, or as that command would guess them.

        Raises:
            ExportError: if the file names what the robot does not have, with the place.
        """
        groups = _urdd.joint_groups(self._core, None if file is None else Path(file))
        return {name: np.array(dofs, dtype=np.uintp) for name, dofs in groups}

    # Shapes.

    def shapes(self, kind: ShapeKind = "pieces") -> list[ConvexMesh] | list[Box] | Spheres:
        """The shapes of a kind, by link and piece, in the frames of their links."""
        return shapes(self, kind)

    def hulls(self) -> list[ConvexMesh]:
        """The convex hull of each link that has geometry."""
        return convex(self, "hulls")

    def pieces(self) -> list[ConvexMesh]:
        """The convex pieces of each link that has geometry."""
        return convex(self, "pieces")

    def boxes(self, about: str = "pieces") -> list[Box]:
        """The bounding box of each of the ``hulls`` or ``pieces``."""
        return boxes(self, about)

    def spheres(self, about: str = "pieces") -> Spheres:
        """The bounding sphere of each of the ``hulls`` or ``pieces``."""
        return spheres(self, about)

    def visuals(self) -> list[Visual]:
        """The visual appearance: the plain mesh of each link, by colour."""
        return visuals(self)

    def skips(self, kind: ShapeKind = "pieces") -> Skips:
        """The pairs of shapes of a kind that need no collision check, and the reasons: MoveIt's *allowed collision
        matrix*, for shapes instead of links."""
        return skips(self, kind)

    # Other programs.

    def link_mesh(self, link: str, kind: MeshKind = "plain") -> Any:
        """A link's mesh as ``trimesh.Trimesh``, in the link's frame, metres: its appearance (``plain``, with colours
        and textures), its convex hull (``hulls``), or its convex pieces together (``pieces``).

        Raises:
            MeshError: if the link has no geometry.
        """
        from ._trimesh import link_mesh

        return link_mesh(self, link, kind)

    def chain_arrays(self) -> ChainArrays:
        """The robot's frames as arrays, for programs that compute poses themselves, such as on GPUs: with PyTorch or
        JAX, as ``examples/array_kinematics.py`` does.

        Raises:
            ExportError: for spherical and floating joints, whose rotation is a vector.
        """
        from ._chain_arrays import chain_arrays

        return chain_arrays(self.modules)

    def to_trimesh(self, q: ArrayLike | None = None, kind: MeshKind = "plain") -> Any:
        """A ``trimesh.Scene`` of the robot in one configuration, :attr:`zero` by default. Each mesh is a node
        ``link/number``."""
        from ._trimesh import to_trimesh

        return to_trimesh(self, q, kind)

    def to_pinocchio(self, shapes: ShapeKind | None = "pieces") -> PinocchioRobot:
        """A Pinocchio model, with shapes of this kind as collision geometry, and the pairs that are not skipped."""
        from ._pinocchio import to_pinocchio

        return to_pinocchio(self, shapes)

    def to_mujoco(
        self,
        shapes: ExportShapes = "pieces",
        *,
        visuals: bool | float = True,
        actuators: Actuators | None = None,
        bandwidth: float | None = None,
        floating_base: bool = False,
        start: str | ArrayLike | None = None,
        setup: str | os.PathLike[str] | None = None,
    ) -> MujocoRobot:
        """A MuJoCo model, with shapes of this kind as geoms, and the skips as excluded pairs.

        Args:
            shapes: the kind of shapes, or ``"source"``, as in :func:`urdd.export`.
            visuals: whether the model has visual geometry; or the largest part of its triangles to keep, or the most.
            actuators: what the actuators of joints of one DOF are told; by default there are none. Gains are computed
                from the inertia that each joint moves.
            bandwidth: the frequency below which a joint follows its actuator, Hz, from 0.01 to 1,000; by default that
                of ``setup``, or 10.
            floating_base: the root link moves freely, by a free joint ``floating_base``.
            start: the named configuration, or the configuration (dofs,), of :meth:`MujocoRobot.data`; by default the
                default one. A free base is where ``setup`` has it in the named configuration, or on the floor at z = 0.
            setup: gains, the base and frictions, as ``urdd export init`` writes them; by default ``NAME.export.toml``
                beside the URDD, if it is there.

        Raises:
            UnknownNameError: if there is no named configuration ``start``.
        """
        from ._mujoco import to_mujoco

        options: dict[str, object] = {
            "shapes": shapes,
            "visuals": visuals,
            "actuators": actuators,
            "bandwidth": bandwidth,
            "floating_base": floating_base,
            "setup": setup,
        }
        return to_mujoco(self, options, start)

    def to_newton(
        self,
        shapes: ExportShapes = "pieces",
        *,
        visuals: bool | float = True,
        actuators: Actuators | None = None,
        bandwidth: float | None = None,
        floating_base: bool = False,
        start: str | ArrayLike | None = None,
        setup: str | os.PathLike[str] | None = None,
    ) -> NewtonRobot:
        """A Newton model, with shapes of this kind as convex colliders, and the skips as filtered pairs.

        It goes through our USD. For the arguments, see :meth:`to_mujoco`; what drives joints are drives, and a free
        base is Newton's own free joint. The model is at ``start``, and so are the targets of position drives.
        """
        from ._newton import to_newton

        options: dict[str, object] = {
            "shapes": shapes,
            "visuals": visuals,
            "actuators": actuators,
            "bandwidth": bandwidth,
            "floating_base": floating_base,
            "setup": setup,
        }
        return to_newton(self, options, start)

    def to_pybullet(
        self, client: int = 0, shapes: ShapeKind = "pieces", *, visuals: bool = False, keep_pairs: bool = False
    ) -> PybulletRobot:
        """Loads the robot into a PyBullet client, with shapes of this kind and a fixed root.

        PyBullet disables collisions by pairs of links, not by pairs of pieces. Links do not collide there if all pairs
        of their pieces are skipped. They do not collide either if some pairs are skipped because they are always in
        contact, in contact in the default configuration, or on links that a joint connects: with these pieces they
        would always touch. :attr:`PybulletRobot.notes` states the collisions that are lost. With ``keep_pairs`` such
        links collide, with all of their pieces.

        Raises:
            ExportError: for planar, floating and spherical joints, which PyBullet does not support.
        """
        from ._pybullet import to_pybullet

        return to_pybullet(self, client, shapes, visuals=visuals, keep_pairs=keep_pairs)

    @overload
    def show(
        self,
        q: ArrayLike | None = None,
        *,
        path: ArrayLike | None = None,
        world: World | None = None,
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
        path: ArrayLike | None = None,
        world: World | None = None,
        backend: Literal["page", "viser"] = "page",
        open_browser: bool = True,
        port: int | None = None,
    ) -> Shown | ShownByViser:
        """Shows the robot in the browser: the page of ``urdd view``, or viser.

        ``path`` (n, dofs) is a motion, which the page plays on straight lines, no DOF faster than 1 rad/s or 1 m/s.
        ``world`` is drawn around the robot. Only the page shows both.

        The server accepts connections from this machine only. It ends when the result is closed, or with Python. In a
        notebook, :meth:`frame` shows the page in a cell.
        """
        from ._show import show

        return show(self, q, path=path, world=world, backend=backend, open_browser=open_browser, port=port)

    def frame(
        self,
        q: ArrayLike | None = None,
        path: ArrayLike | None = None,
        world: World | None = None,
        *,
        height: int = 600,
    ) -> Frame:
        """The page with this robot, as the output of a notebook cell, without a server.

        ``q`` is the configuration (dofs,) at the start, ``path`` (n, dofs) a motion that is played, and ``world`` what
        is around the robot, as :meth:`show` takes them.
        """
        from ._show import frame

        # Before 1.4, the height was the first argument. No configuration is a whole number.
        if isinstance(q, int):
            q, height = None, q
        return frame(self, q, path, world, height)

    # Python protocols.

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

"""A robot."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

from numpy.typing import ArrayLike

from . import _urdd
from ._answers import (
    Box,
    ConvexMesh,
    InverseSolution,
    InverseSolutions,
    MeshKind,
    ShapeKind,
    Skips,
    Spheres,
    Visual,
)
from ._arrays import Bools, Floats, configurations, scalar
from ._inverse import as_targets, solve, three
from ._proximity import Proximity
from ._shapes import boxes, convex, skips, spheres, visuals
from .errors import OpenError, UrddError

if TYPE_CHECKING:
    # Each takes time to import, and few programs need it.
    from ._answers import PairDistance
    from ._mujoco import MujocoRobot
    from ._pinocchio import PinocchioRobot
    from ._pybullet import PybulletRobot
    from ._show import Frame, Shown, ShownByViser
    from .modules import Modules, RootMetadata

#: The sequence of configurations repeats itself after so many (SPEC 9.3).
_CONFIGURATIONS = 2**32
#: How far apart the configurations of two seeds begin: by the golden ratio, so that those of many seeds are far apart.
_SEED_STRIDE = 0x9E3779B9


def load(path: str | os.PathLike[str]) -> Robot:
    """The robot in a folder or a zip archive.

    Nothing of it is read before it is asked for, and no mesh before shapes are.

    Raises:
        OpenError: where there is no URDD.

    >>> import urdd
    >>> robot = urdd.load("welding_arm")
    >>> robot.num_dofs
    6
    """
    return Robot(path)


class Robot:
    """A robot to ask about itself: what a URDD holds, with names, units and nothing derived.

    Lengths are metres, angles radians. Poses are matrices (4, 4) in the frame of the root link. A configuration ``q``
    has one value for each DOF, in the order of :attr:`dof_names`; values beyond the bounds are allowed. Where a method
    takes ``q``, it takes one configuration ``(dofs,)`` or any array of them ``(..., dofs)``, and what it gives begins
    with the same axes. Links are in the order of :attr:`link_names`.

    Arrays are copied before the interpreter is let go: threads may ask one robot at the same time, and work in
    parallel. Ctrl-C stops what takes long. A robot is pickled as its path.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = Path(path)
        _check_is_no_urdf(self._path)
        self._core = _urdd.Robot(self._path)

    @property
    def core(self) -> _urdd.Robot:
        """The compiled part, for other files of this package."""
        return self._core

    # What it is.

    @property
    def path(self) -> Path:
        """The folder or archive, as it was given."""
        return self._path

    @cached_property
    def name(self) -> str:
        """The robot's name."""
        metadata = self.metadata
        return metadata.robot_name if metadata is not None else self.modules.urdf.name

    @cached_property
    def metadata(self) -> RootMetadata | None:
        """What ``urdd.json`` says; None in a URDD of before version 1."""
        from .modules import read_root_metadata

        text = self._core.metadata()
        return None if text is None else read_root_metadata(text)

    @cached_property
    def modules(self) -> Modules:
        """The modules, as typed objects: ``robot.modules.dof.dofs[0].name``."""
        from .modules import Modules

        return Modules(self._core)

    @cached_property
    def link_names(self) -> tuple[str, ...]:
        """The name of each link."""
        return tuple(self._core.link_names())

    @cached_property
    def joint_names(self) -> tuple[str, ...]:
        """The name of each joint, fixed ones too."""
        return tuple(self._core.joint_names())

    @cached_property
    def dof_names(self) -> tuple[str, ...]:
        """The name of each DOF: that of its joint, with the coordinate where the joint has several."""
        return tuple(self._core.dof_names())

    @cached_property
    def dof_units(self) -> tuple[str, ...]:
        """The unit of each DOF: ``rad`` or ``m``."""
        return tuple(self._core.dof_units())

    @property
    def num_links(self) -> int:
        """Number of links."""
        return len(self.link_names)

    @property
    def num_dofs(self) -> int:
        """Number of DOFs: the length of a configuration."""
        return len(self.dof_names)

    def link(self, name: str) -> int:
        """The index of a link: ``poses[..., robot.link("tool0"), :, :]``.

        Raises:
            UnknownNameError: where there is no such link, with the nearest name.
        """
        return self._core.link(name)

    def dof(self, name: str) -> int:
        """The index of a DOF.

        Raises:
            UnknownNameError: where there is no such DOF, with the nearest name.
        """
        return self._core.dof(name)

    def index(self, link: str | int) -> int:
        """The index of a link by its name, or by its index, which may count from the end."""
        if isinstance(link, str):
            return self.link(link)
        index = int(link)
        if not -self.num_links <= index < self.num_links:
            raise IndexError(f"there is no link {index}: their number is {self.num_links}")
        return index % self.num_links

    @cached_property
    def folder(self) -> Path | None:
        """The folder on disk; None for an archive."""
        return self._core.folder()

    @cached_property
    def urdf_path(self) -> Path:
        """The URDF that the URDD carries, on disk. Its meshes are the URDD's original meshes, and not beside it.

        Raises:
            OpenError: where none is carried, or in an archive: ``urdf_text`` reads it there.
        """
        source = self._core.source()
        if source is None:
            raise OpenError(f"{self._path}: this URDD carries no URDF")
        if self.folder is None:
            raise OpenError(f"{self._path}: the URDF {source} lies in an archive; `urdf_text` reads it")
        return self.folder / source

    @cached_property
    def urdf_text(self) -> str:
        """The text of the URDF that the URDD carries.

        Raises:
            OpenError: where none is carried.
        """
        source = self._core.source()
        if source is None:
            raise OpenError(f"{self._path}: this URDD carries no URDF")
        return self._core.read_file(source).decode("utf-8", errors="replace")

    def read_file(self, path: str) -> bytes:
        """The bytes of a file of the URDD, such as a mesh that a module names.

        Raises:
            OpenError: where there is none.
        """
        return self._core.read_file(path)

    # Configurations.

    @property
    def bounds(self) -> Floats:
        """(dofs, 2): the lower and the upper bound of each DOF; always finite."""
        return self._core.bounds()

    @property
    def zero(self) -> Floats:
        """(dofs,): every DOF 0, or the bound nearest to 0 where 0 is out of bounds."""
        return self._core.configuration("zero")

    @property
    def middle(self) -> Floats:
        """(dofs,): every DOF half-way between its bounds."""
        return self._core.configuration("middle")

    @property
    def lower(self) -> Floats:
        """(dofs,): every DOF at its lower bound."""
        return self._core.configuration("lower")

    @property
    def upper(self) -> Floats:
        """(dofs,): every DOF at its upper bound."""
        return self._core.configuration("upper")

    def sample(self, n: int | None = None, seed: int = 0) -> Floats:
        """Random configurations, uniform within the bounds: (dofs,), or (n, dofs).

        They are those that the specification defines (SPEC 9.3), the same in every program, on every machine and for
        every ``n``: from number 0 on, and with a seed from ``seed * 0x9E3779B9 % 2**32`` on.
        """
        count, start = 1 if n is None else int(n), int(seed)
        if count < 0:
            raise ValueError(f"the number of configurations must not be negative, and is {count}")
        if not 0 <= start < _CONFIGURATIONS:
            raise ValueError(f"a seed is from 0 to 2**32 - 1, and this is {start}")
        found = self._core.sample(count, start * _SEED_STRIDE % _CONFIGURATIONS)
        return found[0] if n is None else found

    def clamp(self, q: ArrayLike) -> Floats:
        """``q`` with each value moved to the nearest bound where it is out of bounds. Rotation vectors stay."""
        rows, batch = configurations(q, self.dof_names)
        return self._core.clamp(rows).reshape(*batch, self.num_dofs)

    def within_bounds(self, q: ArrayLike) -> Bools:
        """(...): whether each value is within its bounds."""
        rows, batch = configurations(q, self.dof_names)
        return scalar((self._core.clamp(rows) == rows).all(axis=1).reshape(batch))

    # Motion.

    def fk(self, q: ArrayLike, link: str | int | None = None) -> Floats:
        """Forward kinematics: the pose of each link, (..., links, 4, 4); of one link (..., 4, 4).

        Raises:
            ConfigurationError: for another shape, or a value that is not finite.
            UnknownNameError: for a link that is not there.
        """
        rows, batch = configurations(q, self.dof_names)
        if link is None:
            return self._core.poses(rows).reshape(*batch, self.num_links, 4, 4)
        return self._core.poses(rows, self.index(link)).reshape(*batch, 4, 4)

    def link_poses(self, q: ArrayLike) -> dict[str, Floats]:
        """Forward kinematics by name: for each link its pose, (..., 4, 4)."""
        poses = self.fk(q)
        return {name: poses[..., link, :, :] for link, name in enumerate(self.link_names)}

    def jacobian(self, q: ArrayLike, link: str | int, point: ArrayLike | None = None) -> Floats:
        """The geometric Jacobian of a link: (..., 6, dofs).

        Rows 0 to 2 are the velocity of the origin of the link's frame (or of ``point``, (3,), metres in the link's
        frame), rows 3 to 5 its angular velocity, along the axes of the root link's frame. Mimic joints count into the
        column of the DOF that they follow.
        """
        rows, batch = configurations(q, self.dof_names)
        at = None if point is None else three(point, "a point")
        return self._core.jacobians(rows, self.index(link), at).reshape(*batch, 6, self.num_dofs)

    def ik(
        self,
        link: str | int,
        target: ArrayLike,
        start: ArrayLike | None = None,
        *,
        point: ArrayLike = (0.0, 0.0, 0.0),
        position_tolerance: float = 1e-6,
        rotation_tolerance: float = 1e-6,
        iterations: int = 100,
        restarts: int = 100,
        seed: int = 0,
        bounds: ArrayLike | None = None,
    ) -> InverseSolution:
        """Inverse kinematics: a configuration, within bounds, in which a link is where it should be.

        By damped least squares from ``start`` (:attr:`zero` unless you say otherwise), then from random configurations.
        Mimic joints follow. Collisions are not looked at. The same question has the same answer.

        Args:
            link: the link.
            target: a pose (4, 4), or a place (3,) where it does not matter how the link is turned.
            start: a configuration.
            point: the point of the link that should be there, in its frame, metres.
            position_tolerance: metres that the point may be off.
            rotation_tolerance: radians that the link may be turned.
            iterations: steps of each descent, at most.
            restarts: descents from random configurations, at most.
            seed: which random configurations.
            bounds: (dofs, 2), in place of :attr:`bounds`.
        """
        goal = as_targets(target, (3,), (4, 4))
        found = solve(
            self,
            link,
            goal[None],
            start,
            point,
            position_tolerance,
            rotation_tolerance,
            iterations,
            restarts,
            seed,
            bounds,
        )
        return InverseSolution(
            q=found.q[0],
            reached=bool(found.reached[0]),
            position_error=float(found.position_error[0]),
            rotation_error=float(found.rotation_error[0]),
            restarts=int(found.restarts[0]),
            iterations=int(found.iterations[0]),
        )

    def ik_batch(
        self,
        link: str | int,
        targets: ArrayLike,
        start: ArrayLike | None = None,
        *,
        point: ArrayLike = (0.0, 0.0, 0.0),
        position_tolerance: float = 1e-6,
        rotation_tolerance: float = 1e-6,
        iterations: int = 100,
        restarts: int = 100,
        seed: int = 0,
        bounds: ArrayLike | None = None,
    ) -> InverseSolutions:
        """As :meth:`ik`, for many targets, on all threads: poses (n, 4, 4) or places (n, 3). ``start`` is one
        configuration, or one for each target (n, dofs)."""
        goals = as_targets(targets, (None, 3), (None, 4, 4))
        return solve(
            self, link, goals, start, point, position_tolerance, rotation_tolerance, iterations, restarts, seed, bounds
        )

    # Collisions.

    def proximity(self, kind: ShapeKind = "pieces") -> Proximity:
        """The shapes of a kind, prepared for distances. It is prepared once, and then kept."""
        return Proximity(self._core.proximity(kind), self.link_names, self.dof_names)

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
        """MuJoCo's model, with shapes of this kind as its geoms, and the skips as excluded pairs of bodies."""
        from ._mujoco import to_mujoco

        return to_mujoco(self, shapes, visuals=visuals)

    def to_pybullet(self, client: int = 0, shapes: ShapeKind = "pieces", *, visuals: bool = False) -> PybulletRobot:
        """Loads the robot into a client of PyBullet, with shapes of this kind, its root fixed; pairs of links all of
        whose shapes are skipped do not collide there.

        Raises:
            ExportError: for planar, floating and spherical joints, which PyBullet does not read.
        """
        from ._pybullet import to_pybullet

        return to_pybullet(self, client, shapes, visuals=visuals)

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


def _check_is_no_urdf(path: Path) -> None:
    if path.suffix.lower() in (".urdf", ".xacro"):
        folder = path.name.split(".")[0]
        raise OpenError(
            f"{path}: this is a URDF, and no URDD; make one: urdd.generate({str(path)!r}, {folder!r}), or "
            f"`urdd generate {path} -o {folder}`"
        )
    if path.name == "urdd.json":
        raise OpenError(f"{path}: this is a file of a URDD; give the folder that it lies in")

"""A robot's names, numbers and files."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from . import _urdd
from .errors import OpenError

if TYPE_CHECKING:
    # Slow to import, and rarely needed.
    from .modules import Modules, RootMetadata


class RobotDescription:
    """The names, modules and files of a :class:`urdd.Robot`."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = Path(path)
        _check_is_not_a_urdf(self._path)
        self._core = _urdd.Robot(self._path)

    @property
    def core(self) -> _urdd.Robot:
        """The compiled part, for the other files of this package."""
        return self._core

    @property
    def path(self) -> Path:
        """The folder or archive, as it was passed."""
        return self._path

    @cached_property
    def name(self) -> str:
        """The robot's name."""
        metadata = self.metadata
        return metadata.robot_name if metadata is not None else self.modules.urdf.name

    @cached_property
    def metadata(self) -> RootMetadata | None:
        """The content of ``urdd.json``; None for a legacy URDD, from before version 1."""
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
        """The name of each joint, including fixed joints."""
        return tuple(self._core.joint_names())

    @cached_property
    def dof_names(self) -> tuple[str, ...]:
        """The name of each DOF: that of its joint, with the coordinate if the joint has several DOFs."""
        return tuple(self._core.dof_names())

    @cached_property
    def dof_units(self) -> tuple[str, ...]:
        """The unit of each DOF: ``rad`` or ``m``."""
        return tuple(self._core.dof_units())

    @cached_property
    def root_link(self) -> str:
        """The name of the root link. Poses are in its frame."""
        return self.link_names[self.modules.chain.root_idx]

    @property
    def num_links(self) -> int:
        """Number of links."""
        return len(self.link_names)

    @property
    def num_dofs(self) -> int:
        """Number of DOFs: the length of a configuration."""
        return len(self.dof_names)

    def link(self, link: str | int) -> int:
        """The index of a link, from its name or from an index, which may count from the end:
        ``poses[..., robot.link("tool0"), :, :]``.

        Raises:
            UnknownNameError: for an unknown name, with the nearest known one.
            IndexError: for an index that is out of range.
        """
        if isinstance(link, str):
            return self._core.link(link)
        index = int(link)
        if not -self.num_links <= index < self.num_links:
            raise IndexError(f"link index {index} is out of range: the robot has {self.num_links} links")
        return index % self.num_links

    def dof(self, name: str | int) -> int:
        """The index of a DOF, given by name or index; negative indices count from the end.

        Raises:
            UnknownNameError: for an unknown name, with the nearest known one.
            IndexError: for an index that is out of range.
        """
        if isinstance(name, str):
            return self._core.dof(name)
        index = int(name)
        if not -self.num_dofs <= index < self.num_dofs:
            raise IndexError(f"DOF index {index} is out of range: the robot has {self.num_dofs} DOFs")
        return index % self.num_dofs

    @cached_property
    def folder(self) -> Path | None:
        """The folder on disk; None for an archive."""
        return self._core.folder()

    @cached_property
    def urdf_path(self) -> Path:
        """The path of the URDF that the URDD includes. Its meshes are the URDD's original meshes, not files beside it.

        Raises:
            OpenError: if it includes none, or is an archive: ``urdf_text`` reads it there.
        """
        source = self._core.source()
        if source is None:
            raise OpenError(f"{self._path}: this URDD includes no URDF")
        if self.folder is None:
            raise OpenError(f"{self._path}: the URDF {source} is in an archive; `urdf_text` reads it")
        return self.folder / source

    @cached_property
    def urdf_text(self) -> str:
        """The text of the URDF that the URDD includes.

        Raises:
            OpenError: if it includes none.
        """
        source = self._core.source()
        if source is None:
            raise OpenError(f"{self._path}: this URDD includes no URDF")
        return self._core.read_file(source).decode("utf-8", errors="replace")

    def read_file(self, path: str) -> bytes:
        """The bytes of a file of the URDD, such as a mesh that a module references.

        Raises:
            OpenError: if there is no such file.
        """
        return self._core.read_file(path)


def _check_is_not_a_urdf(path: Path) -> None:
    if path.suffix.lower() in (".urdf", ".xacro"):
        folder = path.name.split(".")[0]
        raise OpenError(f"{path}: this is a URDF, not a URDD; generate one: urdd.generate({str(path)!r}, {folder!r})")
    if path.name == "urdd.json":
        raise OpenError(f"{path}: this is a file of a URDD; pass the folder that it is in")

"""What a robot is: its names and numbers, and the files of its URDD."""

from __future__ import annotations

import os
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from . import _urdd
from .errors import OpenError

if TYPE_CHECKING:
    # It takes time to import, and few programs need it.
    from .modules import Modules, RootMetadata


class Described:
    """What a robot is, of :class:`urdd.Robot`."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = Path(path)
        _check_is_no_urdf(self._path)
        self._core = _urdd.Robot(self._path)

    @property
    def core(self) -> _urdd.Robot:
        """The compiled part, for other files of this package."""
        return self._core

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

    @cached_property
    def root_link(self) -> str:
        """The name of the link that all others hang on, in whose frame poses are."""
        return self.link_names[self.modules.chain.root_idx]

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


def _check_is_no_urdf(path: Path) -> None:
    if path.suffix.lower() in (".urdf", ".xacro"):
        folder = path.name.split(".")[0]
        raise OpenError(f"{path}: this is a URDF, and no URDD; make one: urdd.generate({str(path)!r}, {folder!r})")
    if path.name == "urdd.json":
        raise OpenError(f"{path}: this is a file of a URDD; give the folder that it lies in")

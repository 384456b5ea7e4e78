"""Imports of MJCF, SDF and USD."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from . import _urdd
from ._options import source

__all__ = ["Imported", "import_robot"]


@dataclass(frozen=True)
class Imported:
    """An MJCF, SDF or USD as a URDF with its companions, which are written."""

    urdf: Path
    """The URDF."""
    files: list[Path]
    """All files: the URDF, its meshes, ``NAME.srdf``, ``NAME.export.toml``."""
    report: dict[str, Any]
    """What was ``carried``, carried ``otherwise`` and ``lost`` of this robot, each with ``what`` and ``count``, and
    ``notes``."""

    @property
    def lost(self) -> dict[str, int]:
        """What is lost, and how many of it."""
        return {part["what"]: part["count"] for part in self.report["lost"]}

    @property
    def notes(self) -> list[str]:
        """What was assumed or left out, each with its place."""
        return list(self.report["notes"])


def import_robot(
    file: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    body: str | None = None,
    model: str | None = None,
    ball: Literal["spherical", "revolute"] = "spherical",
    massless: Literal["none", "tiny"] = "none",
    packages: Mapping[str, str | os.PathLike[str]] | None = None,
    allowed_folders: Iterable[str | os.PathLike[str]] = (),
    force: bool = False,
) -> Imported:
    """Writes an MJCF, SDF or USD as a URDF with its meshes, an SRDF with named configurations and pairs of links that
    never collide, and an ``export.toml`` with the kind of base and gains. What the file is, its content says.

    Args:
        file: the MJCF, SDF or USD.
        output: the folder to write.
        body: the body of an MJCF or USD that is the root of the robot. By default it is told by the structure.
        model: the model of an SDF file that has several.
        ball: how a ball joint is written: as a spherical joint, which few programs read, or as three revolute joints.
        massless: the mass of links between several joints of one body: none, or 1e-9 kg and 1e-9 kg m², which MuJoCo
            asks of what moves.
        packages: the folders of ROS packages and of models, by name.
        allowed_folders: folders besides that of the file and its project from which files may be read.
        force: overwrites files that exist with other content.

    Raises:
        GenerateError: if the file cannot be imported; ``places`` say where and why.
        FileExistsError: if a file exists with other content, unless ``force``.
    """
    options = source(packages, allowed_folders, body=body, model=model, ball=ball, massless=massless)
    folder = Path(output)
    urdf, files, text, left = _urdd.import_robot(Path(file), folder, options)
    report = json.loads(text)
    report["notes"] += left
    # The URDF, which names the others, is last.
    contents = sorted(files, key=lambda file: file[0] == urdf)
    _urdd.write_files(folder, True, [(Path(name), content) for name, content in contents], force)
    return Imported(urdf=folder / urdf, files=sorted(folder / name for name, _ in files), report=report)

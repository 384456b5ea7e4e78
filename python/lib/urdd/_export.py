"""Exports to the formats of other programs."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from . import _urdd
from ._answers import ShapeKind
from ._description import RobotDescription
from ._options import whole, words

__all__ = ["Export", "Format", "export"]

Format: TypeAlias = Literal["srdf", "urdf", "drake", "mjcf", "curobo", "foam"]
"""A format: SRDF for MoveIt, URDF with our shapes as collision geometry, the same for Drake, MJCF for MuJoCo, spheres
for cuRobo and Foam."""


#: Limits of the arguments of :func:`export`.
MAX_SPHERES = 10_000
MAX_SAMPLES = 1_000_000


@dataclass(frozen=True)
class Export:
    """A robot in another format."""

    text: str
    """The text of the file."""
    files: dict[str, bytes]
    """The mesh files that it references, by path relative to it."""
    notes: list[str]
    """What the format cannot express, or expresses differently."""

    def write(self, file: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes the file, and the mesh files beside it.

        Raises:
            FileExistsError: if a file exists with other content, unless ``force``.
        """
        target = Path(file)
        contents = {target: self.text.encode(), **{target.parent / path: data for path, data in self.files.items()}}
        if not force:
            for path, content in contents.items():
                if path.exists() and path.read_bytes() != content:
                    raise FileExistsError(f"{path} exists with other content: force=True overwrites it")
        for path, content in contents.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        return target


def export(
    robot: RobotDescription | str | os.PathLike[str],
    format: Format,  # noqa: A002
    output: str | os.PathLike[str] | None = None,
    *,
    shapes: ShapeKind = "pieces",
    reasons: Iterable[Literal["same-link", "always", "adjacent", "default", "never"]] | None = None,
    keep_pairs: bool = False,
    spheres: int | None = None,
    total_spheres: int | None = None,
    cover: bool = False,
    samples: int = 10_000,
    visuals: bool = True,
    mesh_folder: str | None = None,
    force: bool = False,
) -> Export:
    """Exports a robot to another format, in memory; with ``output`` to that file too.

    Args:
        robot: the robot, or its path.
        format: the format.
        output: a file to write.
        shapes: the kind of collision shapes. Pairs are disabled by the skips of this kind.
        reasons: the reasons for which pairs of links are disabled; by default those of the URDD. Edits always apply.
        keep_pairs: checks pairs of links of which the URDD skips only some pieces, in formats that disable pairs of
            links only. By default such a pair is disabled, and a note names it.
        spheres: maximum number of spheres for each link. By default 12 on average and at most 150 in all; with
            ``cover``, 8.
        total_spheres: maximum number of spheres for all links together, but at least one for each.
        cover: covers each link with spheres. By default spheres are fitted to collide when the shapes do.
        samples: number of configurations in which the spheres are measured; fewer if that is much work.
        visuals: whether the file has visual geometry.
        mesh_folder: the folder of the mesh files, relative to the file; with ``output``, named after it by default.
        force: overwrites existing files.

    Raises:
        ExportError: if the format cannot hold the robot.
        FileExistsError: if a file exists with other content.
    """
    for name, count in (("spheres", spheres), ("total_spheres", total_spheres)):
        if count is not None:
            whole(count, name, 1, MAX_SPHERES)
    whole(samples, "samples", 100, MAX_SAMPLES)
    if mesh_folder is None:
        mesh_folder = "meshes" if output is None else f"{Path(output).stem}_meshes"
    subject = robot if isinstance(robot, RobotDescription) else RobotDescription(robot)
    text, files, notes = _urdd.export(
        subject.core,
        format,
        shapes,
        None if reasons is None else words(reasons, "reasons"),
        bool(keep_pairs),
        spheres,
        total_spheres,
        bool(cover),
        samples,
        bool(visuals),
        mesh_folder,
    )
    exported = Export(text, dict(files), notes)
    if output is not None:
        exported.write(output, force=force)
    return exported

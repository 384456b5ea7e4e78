"""Exports: what programs read that read no URDD."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from . import _urdd
from ._answers import ShapeKind
from ._options import whole, words
from ._robot import Robot, load

__all__ = ["Export", "Format", "export"]

Format: TypeAlias = Literal["srdf", "urdf", "drake", "mjcf", "curobo", "foam"]
"""A format: SRDF for MoveIt, URDF with our shapes as collision geometry, the same for Drake, MJCF for MuJoCo, spheres
for cuRobo and as Foam writes them."""


#: Spheres that can be asked for, at most: programs take some hundreds.
MAX_SPHERES = 10_000
MAX_SAMPLES = 1_000_000


@dataclass(frozen=True)
class Export:
    """A robot in another format."""

    text: str
    """The text of the file."""
    files: dict[str, bytes]
    """The mesh files that it names, by path relative to it."""
    notes: list[str]
    """What the format could not say, or says in another way."""

    def write(self, file: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes the file, and the mesh files beside it.

        Raises:
            FileExistsError: where a file is there that says something else, unless ``force``.
        """
        target = Path(file)
        contents = {target: self.text.encode(), **{target.parent / path: data for path, data in self.files.items()}}
        if not force:
            for path, content in contents.items():
                if path.exists() and path.read_bytes() != content:
                    raise FileExistsError(
                        f"{path} is there already, and says something else: force=True writes over it"
                    )
        for path, content in contents.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        return target


def export(
    robot: Robot | str | os.PathLike[str],
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
    """A robot in another format, in memory; with ``output`` in that file too.

    Args:
        robot: the robot, or its path.
        format: the format.
        output: a file to write.
        shapes: which shapes stand for the links: as collision geometry, and for which pairs are disabled.
        reasons: for which reasons pairs of links are disabled. Without it, those of the URDD. Edits always hold.
        keep_pairs: a pair of links of which the URDD skips some pieces and checks others is checked, in formats that
            know links only. Without it such a pair is disabled, and a note names it.
        spheres: at most so many spheres for each link. Without it, 12 on average and at most 150 in all; with
            ``cover``, 8.
        total_spheres: at most so many spheres for all links together, but at least one for each.
        cover: spheres hold all of each link. Otherwise they are fitted such that they answer as the shapes do.
        samples: in how many sampled configurations spheres are measured, or fewer where that is much work.
        visuals: whether the file says what links look like.
        mesh_folder: the folder of the mesh files, relative to the file; with ``output`` it is named as that is.
        force: writes over files that are there.

    Raises:
        ExportError: where the format cannot hold the robot.
        FileExistsError: where a file is there that says something else.
    """
    for name, count in (("spheres", spheres), ("total_spheres", total_spheres)):
        if count is not None:
            whole(count, name, 1, MAX_SPHERES)
    whole(samples, "samples", 100, MAX_SAMPLES)
    if mesh_folder is None:
        mesh_folder = "meshes" if output is None else f"{Path(output).stem}_meshes"
    subject = robot if isinstance(robot, Robot) else load(robot)
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
    made = Export(text, dict(files), notes)
    if output is not None:
        made.write(output, force=force)
    return made

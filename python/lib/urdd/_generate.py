"""Generation of URDDs."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from . import _urdd
from ._options import MakingOptions, options_of
from ._robot import Robot, load

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["Generated", "Job", "Note", "find_urdfs", "generate", "generate_text", "generated"]


@dataclass(frozen=True)
class Note:
    """A problem in a source, and the assumption made for it."""

    kind: str
    """The kind of problem, such as ``mesh-not-found``."""
    file: str
    """The file, as it was passed."""
    line: int
    """Line, from 1; 0 if the note is about the file as a whole."""
    column: int
    """Column, from 1; 0 if the note is about the file as a whole."""
    problem: str
    """What is wrong."""
    assumed: str
    """The assumption or action."""

    def __str__(self) -> str:
        place = f":{self.line}:{self.column}" if self.line else ""
        assumed = f": {self.assumed}" if self.assumed else ""
        return f"{self.file}{place}: {self.problem}{assumed}"


@dataclass(frozen=True)
class Generated:
    """A generated URDD."""

    path: Path
    """Its folder."""
    robot_name: str
    """The robot's name."""
    num_links: int
    """Number of links."""
    num_joints: int
    """Number of joints."""
    num_dofs: int
    """Number of DOFs."""
    conformance_class: str
    """The class that it claims: ``Core``, ``Geometry`` or ``Shapes``."""
    modules_made: list[str]
    """The modules that were generated."""
    modules_kept: list[str]
    """The modules that were reused from the previous URDD because their inputs did not change."""
    changed: bool
    """Whether anything differs from the previous URDD; if not, nothing was written."""
    meshes_named: int
    """Number of meshes that the source references."""
    meshes_not_found: int
    """Number of those without a file, or whose file is not a mesh."""
    meshes_not_usable: int
    """Number of those whose file is included but unusable."""
    notes: list[Note]
    """Problems in the source, and the assumptions made for them."""

    def load(self) -> Robot:
        """Opens the robot."""
        return load(self.path)


class Job(NamedTuple):
    """One of many robots to generate."""

    source: Path
    """The URDF or xacro file."""
    name: str
    """A name for its URDD. Names differ in more than case."""


def generate(
    source: str | os.PathLike[str],
    output: str | os.PathLike[str],
    *,
    modules: Iterable[str] | None = None,
    packages: Mapping[str, str | os.PathLike[str]] | None = None,
    allowed_folders: Iterable[str | os.PathLike[str]] = (),
    geometry: Literal["visual", "collision"] = "visual",
    mesh_formats: Iterable[Literal["glb", "stl", "obj"]] = ("glb", "stl", "obj"),
    pieces: int = 7,
    piece_tolerance: float | None = None,
    samples: int = 1000,
    skip: Iterable[Literal["same-link", "always", "adjacent", "default", "never"]] | None = None,
    reference: str | None = None,
    strict: bool = False,
    xacro: bool = False,
    xacro_arguments: Mapping[str, object] | None = None,
    xacro_timeout: float = 60.0,
    body: str | None = None,
    model: str | None = None,
    ball: Literal["spherical", "revolute"] = "spherical",
    massless: Literal["none", "tiny"] = "none",
    drop_edits: bool = False,
    force: bool = False,
    progress: Callable[[str, int, int], object] | None = None,
) -> Generated:
    """Generates a URDD from a URDF, xacro, MJCF, SDF or USD file, in the folder ``output``, which is replaced
    atomically and unchanged on error.

    A second run generates only what changed, and keeps the user's edits of skips.

    Args:
        source: the file.
        output: the folder of the URDD.
        modules: modules or classes to generate besides the core class: ``["geometry"]``. By default all but
            ``self_collision_model``, whose training takes a minute or more: ``["all", "self_collision_model"]``.
        packages: the folders of ROS packages, by name.
        allowed_folders: folders besides those of the robot and its packages from which mesh files may be read.
        geometry: the geometry that shapes are computed from; a link without it uses the other.
        mesh_formats: the file formats of derived meshes. The .glb is always written.
        pieces: maximum number of convex pieces of a link, 1 to 64.
        piece_tolerance: a link gets no more pieces than it needs for this mean distance between their outside and its
            surface, metres. By default it gets as many as reduce the volume enough.
        samples: number of sampled configurations for the distance statistics, at most 100,000.
        skip: the reasons for which pairs of shapes are skipped in collision checks. By default those of the URDD that
            is replaced; for a new URDD all but ``never``.
        reference: the named configuration of the URDD that is replaced, or of the MJCF, in which pairs of links that
            touch are skipped, in place of the default configuration. ``"default"`` is that one again.
        strict: rejects a robot if a mesh is not found, or if an assumption would change the robot.
        xacro: also expands macros in .urdf files.
        xacro_arguments: arguments of the xacro file, by name.
        xacro_timeout: time limit of the program xacro, seconds.
        body: the body of an MJCF or USD that is the root of the robot. By default it is told by the structure.
        model: the model of an SDF file that has several.
        ball: how a ball joint of an MJCF, SDF or USD is written: as a spherical joint, or as three revolute joints.
        massless: the mass of links between several joints of one body: none, or 1e-9 kg and 1e-9 kg m².
        drop_edits: discards the edits of skips and the named configurations in the URDD that is replaced.
        force: writes to a folder that contains something other than a URDD of this program.
        progress: called with the name of each module before it is generated, the number of finished modules, and the
            number of all modules; at the end with all finished. Slow modules also report ``"MODULE: step"``, with the
            number of finished steps and of all steps.

    Raises:
        GenerateError: if the source is not a robot, or the URDD cannot be written.
        KeyboardInterrupt: after Ctrl-C; nothing has changed.
    """
    given: MakingOptions = {
        "modules": modules,
        "packages": packages,
        "allowed_folders": allowed_folders,
        "geometry": geometry,
        "mesh_formats": mesh_formats,
        "pieces": pieces,
        "piece_tolerance": piece_tolerance,
        "samples": samples,
        "skip": skip,
        "reference": reference,
        "strict": strict,
        "xacro": xacro,
        "xacro_timeout": xacro_timeout,
        "body": body,
        "model": model,
        "ball": ball,
        "massless": massless,
        "drop_edits": drop_edits,
        "force": force,
    }
    options = options_of(given, "generate", xacro_arguments)
    target = Path(output)
    return generated(target, _urdd.generate(Path(source), None, target, options, progress))


def generate_text(
    urdf: str | bytes,
    output: str | os.PathLike[str],
    *,
    folder: str | os.PathLike[str] = ".",
    progress: Callable[[str, int, int], object] | None = None,
    **options: Unpack[MakingOptions],
) -> Generated:
    """As :func:`generate`, with the same options, from the text of a URDF. Relative mesh paths are relative to
    ``folder``."""
    text = urdf.encode() if isinstance(urdf, str) else bytes(urdf)
    target = Path(output)
    found = _urdd.generate(Path(folder), text, target, options_of(options, "generate_text"), progress)
    return generated(target, found)


def find_urdfs(*paths: str | os.PathLike[str], shard: tuple[int, int] | None = None) -> list[Job]:
    """Finds the robots below folders: every ``.urdf``, and every ``.urdf.xacro`` without a ``.urdf`` beside it.

    Args:
        paths: files and folders.
        shard: ``(i, n)``: only the i-th of n parts, from 1, as in ``urdd generate --shard i/n``.

    Raises:
        OpenError: if a path does not exist, or a folder has no robots.
    """
    jobs = [Job(source, name) for source, name in _urdd.find_urdfs([Path(path) for path in paths])]
    if shard is None:
        return jobs
    part, of = shard
    if not 1 <= part <= of:
        raise ValueError(f"a shard is (i, n) with i from 1 to n, not {shard}")
    return jobs[part - 1 :: of]


def generated(path: Path, found: dict[str, Any]) -> Generated:
    """The result of the compiled part."""
    notes = [Note(*note) for note in found.pop("notes")]
    return Generated(path=path, notes=notes, **found)

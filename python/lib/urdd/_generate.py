"""Making URDDs."""

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
    """Something odd in a source, and what was made of it."""

    kind: str
    """What kind of oddity it is, such as ``mesh-not-found``."""
    file: str
    """The file, as it was named."""
    line: int
    """Line, from 1; 0 where it is about the file as a whole."""
    column: int
    """Column, from 1; 0 where it is about the file as a whole."""
    problem: str
    """What is wrong."""
    assumed: str
    """What was assumed, or done."""

    def __str__(self) -> str:
        place = f":{self.line}:{self.column}" if self.line else ""
        return f"{self.file}{place}: {self.problem}: {self.assumed}"


@dataclass(frozen=True)
class Generated:
    """A URDD that was made."""

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
    """The modules that were made."""
    modules_kept: list[str]
    """The modules that were taken over from the URDD before, since nothing that they are made of changed."""
    changed: bool
    """Whether anything is different from what was there before; if not, nothing was written."""
    meshes_named: int
    """Names of meshes in the source."""
    meshes_not_found: int
    """Those of which no file was found, or one that is no mesh."""
    meshes_not_usable: int
    """Those whose file is carried and cannot be used."""
    notes: list[Note]
    """What was odd in the source, and what was made of it."""

    def load(self) -> Robot:
        """The robot."""
        return load(self.path)


class Job(NamedTuple):
    """A robot of many."""

    source: Path
    """The URDF or xacro file."""
    name: str
    """A name for its URDD, unlike every other in more than case."""


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
    strict: bool = False,
    xacro: bool = False,
    xacro_arguments: Mapping[str, object] | None = None,
    xacro_timeout: float = 60.0,
    drop_edits: bool = False,
    force: bool = False,
    progress: Callable[[str, int, int], object] | None = None,
) -> Generated:
    """Makes a URDD of a URDF or xacro file, in the folder ``output``. It is there as a whole afterwards, or as it was.

    A second run makes only what changed, and keeps a person's edits of skips.

    Args:
        source: the file.
        output: the folder of the URDD.
        modules: modules to make besides the core class, or classes: ``["geometry"]``. Without it, all but
            ``self_collision_model``, which is trained for a minute or more: ``["all", "self_collision_model"]``.
        packages: where ROS packages are, by name.
        allowed_folders: folders besides those of the robot and its packages from which mesh files may be taken.
        geometry: which geometry links are made from; a link that has none of it gets the other.
        mesh_formats: the files of each derived mesh. The .glb is always made.
        pieces: most convex pieces of a link, 1 to 64.
        piece_tolerance: a link gets no more pieces than are needed for this mean distance from their outside to its
            surface, metres. Without it, as many as save enough.
        samples: sampled configurations of the distance statistics, 100,000 at most.
        skip: for which reasons pairs of shapes are skipped in collision checks. Without it, those of the URDD that is
            replaced; of a new one all but ``never``.
        strict: refuses a robot of which a mesh is not found, or anything has to be assumed that changes it.
        xacro: expands macros in .urdf files too.
        xacro_arguments: arguments of the xacro file, by name.
        xacro_timeout: how long the program xacro may take, seconds.
        drop_edits: drops the edits of skips in the URDD that is replaced.
        force: writes into a folder that holds something else than a URDD of this program.
        progress: is called when a module is begun, with its name, how many modules are done, and how many there are,
            and at last with all done; while a module is made that takes long, also with ``"MODULE: step"``, how many
            steps of it are done, and how many there are.

    Raises:
        GenerateError: where the source is no robot, or the URDD cannot be written.
        KeyboardInterrupt: after Ctrl-C; nothing was changed then.
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
        "strict": strict,
        "xacro": xacro,
        "xacro_timeout": xacro_timeout,
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
    """As :func:`generate`, with the same options, of the text of a URDF. Relative names of meshes begin in
    ``folder``."""
    text = urdf.encode() if isinstance(urdf, str) else bytes(urdf)
    target = Path(output)
    found = _urdd.generate(Path(folder), text, target, options_of(options, "generate_text"), progress)
    return generated(target, found)


def find_urdfs(*paths: str | os.PathLike[str], shard: tuple[int, int] | None = None) -> list[Job]:
    """The robots below folders: every ``.urdf``, and every ``.urdf.xacro`` without one beside it, with a name for each.

    Args:
        paths: files and folders.
        shard: ``(i, n)``: the i-th of n parts alone, from 1; as ``urdd generate --shard i/n`` has them.

    Raises:
        OpenError: where a path is not there, or a folder holds none.
    """
    jobs = [Job(source, name) for source, name in _urdd.find_urdfs([Path(path) for path in paths])]
    if shard is None:
        return jobs
    part, of = shard
    if not 1 <= part <= of:
        raise ValueError(f"a shard is (i, n) with i from 1 to n, and this is {shard}")
    return jobs[part - 1 :: of]


def generated(path: Path, found: dict[str, Any]) -> Generated:
    """What the compiled part says of a URDD that was made."""
    notes = [Note(*note) for note in found.pop("notes")]
    return Generated(path=path, notes=notes, **found)

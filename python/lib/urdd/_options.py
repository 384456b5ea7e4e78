"""Options of the compiled part, with their types checked."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from operator import index
from pathlib import Path
from typing import Literal, SupportsIndex, TypedDict, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _urdd

__all__ = [
    "GenerateOptions",
    "InverseOptions",
    "LintOptions",
    "MakingOptions",
    "Reporting",
    "Source",
    "ValidateOptions",
    "options_of",
    "ranged",
    "source",
    "whole",
    "words",
]


Word = TypeVar("Word", str, str | int)


class MakingOptions(TypedDict, total=False):
    """Keyword arguments of :func:`urdd.generate` that all functions that generate a URDD accept."""

    modules: Iterable[str] | None
    """Modules or classes to generate besides the core class; by default all but ``self_collision_model``."""
    packages: Mapping[str, str | os.PathLike[str]] | None
    """The folders of ROS packages, by name."""
    allowed_folders: Iterable[str | os.PathLike[str]]
    """Folders besides those of the robot and its packages from which mesh files may be read."""
    geometry: Literal["visual", "collision"]
    """The geometry that shapes are computed from."""
    mesh_formats: Iterable[Literal["glb", "stl", "obj"]]
    """The file formats of derived meshes."""
    pieces: int
    """Maximum number of convex pieces of a link, 1 to 64."""
    piece_tolerance: float | None
    """Sufficient mean distance of the pieces from the surface, metres."""
    samples: int
    """Number of sampled configurations for the distance statistics."""
    skip: Iterable[Literal["same-link", "always", "adjacent", "default", "never"]] | None
    """The reasons for which pairs of shapes are skipped."""
    reference: str | None
    """The named configuration in which pairs of links that touch are skipped."""
    strict: bool
    """Rejects assumptions that change the robot."""
    xacro: bool
    """Also expands macros in .urdf files."""
    xacro_timeout: float
    """Time limit of the program xacro, seconds."""
    body: str | None
    """The body of an MJCF or USD that is the root of the robot."""
    model: str | None
    """The model of an SDF file that has several."""
    ball: Literal["spherical", "revolute"]
    """How a ball joint of an MJCF, SDF or USD is written."""
    massless: Literal["none", "tiny"]
    """The mass of links between several joints of one body of an MJCF, SDF or USD."""
    drop_edits: bool
    """Discards the edits of skips in the URDD that is replaced."""
    force: bool
    """Writes to a folder that contains something else."""


@dataclass(frozen=True)
class Source:
    """How descriptions are found and read, for the compiled part."""

    packages: list[tuple[str, Path]]
    allowed_folders: list[Path]
    xacro: bool
    xacro_arguments: list[str]
    xacro_timeout: float
    body: str | None
    model: str | None
    ball: str
    massless: str


@dataclass(frozen=True)
class GenerateOptions:
    """All options of generation, for the compiled part."""

    modules: list[str] | None
    source: Source
    geometry: str
    mesh_formats: list[str]
    pieces: int
    piece_tolerance: float | None
    samples: int
    skip: list[str] | None
    reference: str | None
    strict: bool
    drop_edits: bool
    force: bool


@dataclass(frozen=True)
class InverseOptions:
    """The settings of :meth:`urdd.Robot.inverse_kinematics`, for the compiled part."""

    point: tuple[float, float, float]
    position_tolerance: float
    rotation_tolerance: float
    iterations: int
    restarts: int
    seed: int
    bounds: NDArray[np.float64] | None
    weights: list[float] | None
    locked: list[int]
    posture: list[float] | None
    free_of: list[_urdd.Proximity | _urdd.WorldProximity]
    margin: float
    open_loops: bool


@dataclass(frozen=True)
class Reporting:
    """The options of what is reported, for the compiled part."""

    fail_on: str | None
    config: str | None
    config_folder: Path
    select: list[str]
    ignore: list[str]
    exclude: list[str]


@dataclass(frozen=True)
class ValidateOptions:
    """The options of :func:`urdd.validate`, for the compiled part."""

    conformance_class: str | None
    deep: bool
    reporting: Reporting


@dataclass(frozen=True)
class LintOptions:
    """The options of :func:`urdd.lint`, for the compiled part."""

    for_: list[str] | None
    source: Source
    baseline: Path | None
    reporting: Reporting


def options_of(
    given: MakingOptions, caller: str, xacro_arguments: Mapping[str, object] | None = None
) -> GenerateOptions:
    """All options, with defaults for those that are not given."""
    unknown = given.keys() - MakingOptions.__annotations__.keys()
    if unknown:
        name = min(unknown)
        near = get_close_matches(name, MakingOptions.__annotations__, n=1)
        meant = f". Did you mean {near[0]!r}?" if near else ""
        raise TypeError(f"{caller}() got an unexpected keyword argument {name!r}{meant}")
    modules, skip, tolerance = given.get("modules"), given.get("skip"), given.get("piece_tolerance")
    return GenerateOptions(
        modules=None if modules is None else words(modules, "modules"),
        source=source(
            given.get("packages"),
            given.get("allowed_folders", ()),
            given.get("xacro", False),
            xacro_arguments,
            given.get("xacro_timeout", 60.0),
            body=given.get("body"),
            model=given.get("model"),
            ball=given.get("ball", "spherical"),
            massless=given.get("massless", "none"),
        ),
        geometry=given.get("geometry", "visual"),
        mesh_formats=words(given.get("mesh_formats", ("glb", "stl", "obj")), "mesh_formats"),
        pieces=ranged(given.get("pieces", 7), "generate.pieces"),
        piece_tolerance=None if tolerance is None else float(tolerance),
        samples=ranged(given.get("samples", 1000), "generate.samples"),
        skip=None if skip is None else words(skip, "skip"),
        reference=given.get("reference"),
        strict=bool(given.get("strict", False)),
        drop_edits=bool(given.get("drop_edits", False)),
        force=bool(given.get("force", False)),
    )


def source(
    packages: Mapping[str, str | os.PathLike[str]] | None,
    allowed_folders: Iterable[str | os.PathLike[str]],
    xacro: bool = False,
    xacro_arguments: Mapping[str, object] | None = None,
    xacro_timeout: float = 60.0,
    *,
    body: str | None = None,
    model: str | None = None,
    ball: str = "spherical",
    massless: str = "none",
) -> Source:
    """How descriptions are found and read."""
    return Source(
        packages=[(name, Path(path)) for name, path in (packages or {}).items()],
        allowed_folders=[Path(folder) for folder in allowed_folders],
        xacro=bool(xacro),
        xacro_arguments=[f"{name}:={value}" for name, value in (xacro_arguments or {}).items()],
        xacro_timeout=float(xacro_timeout),
        body=body,
        model=model,
        ball=ball,
        massless=massless,
    )


def whole(given: SupportsIndex, what: str, least: int, most: int) -> int:
    """A whole number from ``least`` to ``most``."""
    number = index(given)
    if not least <= number <= most:
        raise ValueError(f"{what} must be from {least:,} to {most:,}, not {number:,}")
    return number


def ranged(given: SupportsIndex, option: str) -> int:
    """A whole number in the range of an option, such as ``export.samples``."""
    least, most = _urdd.RANGES[option]
    return whole(given, option.rpartition(".")[2], least, most)


def words(given: Iterable[Word], what: str) -> list[Word]:
    """A list of words. Rejects a single text, whose letters would become the words."""
    if isinstance(given, str):
        raise TypeError(f"{what} must be a list of words: [{given!r}]")
    return list(given)

"""How URDDs are made."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from operator import index
from pathlib import Path
from typing import Literal, SupportsIndex, TypedDict

__all__ = ["GenerateOptions", "MakingOptions", "options_of", "whole", "words"]


class MakingOptions(TypedDict, total=False):
    """Keyword arguments of :func:`urdd.generate` that everything takes that makes a URDD; described there."""

    modules: Iterable[str] | None
    """Modules to make besides the core class, or classes. Without it, all but ``self_collision_model``."""
    packages: Mapping[str, str | os.PathLike[str]] | None
    """Where ROS packages are, by name."""
    allowed_folders: Iterable[str | os.PathLike[str]]
    """Folders besides those of the robot and its packages from which mesh files may be taken."""
    geometry: Literal["visual", "collision"]
    """Which geometry links are made from."""
    mesh_formats: Iterable[Literal["glb", "stl", "obj"]]
    """The files of each derived mesh."""
    pieces: int
    """Most convex pieces of a link, 1 to 64."""
    piece_tolerance: float | None
    """The mean distance of pieces to the surface for which no more are needed, metres."""
    samples: int
    """Sampled configurations of the distance statistics."""
    skip: Iterable[Literal["same-link", "always", "adjacent", "default", "never"]] | None
    """For which reasons pairs of shapes are skipped."""
    strict: bool
    """Refuses what changes the robot."""
    xacro: bool
    """Expands macros in .urdf files too."""
    xacro_timeout: float
    """How long the program xacro may take, seconds."""
    drop_edits: bool
    """Drops the edits of skips in the URDD that is replaced."""
    force: bool
    """Writes into a folder that holds something else."""


@dataclass(frozen=True)
class GenerateOptions:
    """The same for the compiled part, every one of them."""

    modules: list[str] | None
    packages: list[tuple[str, Path]]
    allowed_folders: list[Path]
    geometry: str
    mesh_formats: list[str]
    pieces: int
    piece_tolerance: float | None
    samples: int
    skip: list[str] | None
    strict: bool
    xacro: bool
    xacro_arguments: list[str]
    xacro_timeout: float
    drop_edits: bool
    force: bool


def options_of(
    given: MakingOptions, asker: str, xacro_arguments: Mapping[str, object] | None = None
) -> GenerateOptions:
    """All options; what is not given is as usual."""
    unknown = given.keys() - MakingOptions.__annotations__.keys()
    if unknown:
        name = min(unknown)
        near = get_close_matches(name, MakingOptions.__annotations__, n=1)
        meant = f". Did you mean {near[0]!r}?" if near else ""
        raise TypeError(f"{asker}() got an unexpected keyword argument {name!r}{meant}")
    modules, skip, tolerance = given.get("modules"), given.get("skip"), given.get("piece_tolerance")
    return GenerateOptions(
        modules=None if modules is None else words(modules, "modules"),
        packages=[(name, Path(path)) for name, path in (given.get("packages") or {}).items()],
        allowed_folders=[Path(folder) for folder in given.get("allowed_folders", ())],
        geometry=given.get("geometry", "visual"),
        mesh_formats=words(given.get("mesh_formats", ("glb", "stl", "obj")), "mesh_formats"),
        pieces=whole(given.get("pieces", 7), "pieces", 1, 64),
        piece_tolerance=None if tolerance is None else float(tolerance),
        samples=whole(given.get("samples", 1000), "samples", 1, 100_000),
        skip=None if skip is None else words(skip, "skip"),
        strict=bool(given.get("strict", False)),
        xacro=bool(given.get("xacro", False)),
        xacro_arguments=[f"{name}:={value}" for name, value in (xacro_arguments or {}).items()],
        xacro_timeout=float(given.get("xacro_timeout", 60.0)),
        drop_edits=bool(given.get("drop_edits", False)),
        force=bool(given.get("force", False)),
    )


def whole(given: SupportsIndex, what: str, least: int, most: int) -> int:
    """A whole number, which is from ``least`` to ``most``."""
    number = index(given)
    if not least <= number <= most:
        raise ValueError(f"{what} must be from {least:,} to {most:,}, and is {number:,}")
    return number


def words(given: Iterable[str], what: str) -> list[str]:
    """A list of words. A single text is one by mistake: its letters would be the words."""
    if isinstance(given, str):
        raise TypeError(f"{what} must be a list of words: [{given!r}]")
    return list(given)

"""Linting of URDFs."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from . import _urdd
from ._options import LintOptions, source, words
from ._validate import reporting

if TYPE_CHECKING:
    from .report import Report

__all__ = ["lint"]


def lint(
    *paths: str | os.PathLike[str],
    for_: Iterable[str] | None = None,
    packages: Mapping[str, str | os.PathLike[str]] | None = None,
    allowed_folders: Iterable[str | os.PathLike[str]] = (),
    xacro: bool = False,
    xacro_arguments: Mapping[str, object] | None = None,
    xacro_timeout: float = 60.0,
    body: str | None = None,
    model: str | None = None,
    ball: Literal["spherical", "revolute"] = "spherical",
    massless: Literal["none", "tiny"] = "none",
    baseline: str | os.PathLike[str] | None = None,
    fail_on: Literal["error", "warning", "info"] | None = None,
    config: str | os.PathLike[str] | None = None,
    select: Iterable[str] = (),
    ignore: Iterable[str] = (),
    exclude: Iterable[str] = (),
) -> Report:
    """Finds what is wrong with every URDF at or below each of the paths, and what programs do with it.

    >>> import urdd
    >>> (urdf,) = urdd.lint("welding_arm/welding_arm.urdf", for_=["ros", "mujoco"]).urdds
    >>> urdf.verdict
    'pass'
    >>> [program.program for program in urdf.programs if program.is_chosen]
    ['urdfdom6', 'mujoco']

    ``does`` of each of ``programs`` is the worst that the program does: ``refuses``, ``crashes``, ``drops`` or
    ``reads`` (otherwise than the file says), and None where it loads the robot as it is written.

    Args:
        paths: URDFs or xacro files, or folders with URDFs.
        for_: the programs that the URDFs are for: what these refuse is an error, what they read otherwise a warning,
            and what only others do is an information. By default those of ``config``; without any, all count.
        packages: the folders of ROS packages, by name.
        allowed_folders: folders besides those of the robot and its packages from which mesh files may be read.
        xacro: also expands xacro files in folders, macros in .urdf files, and SRDFs of robots that are xacro.
        xacro_arguments: arguments of the xacro files, by name.
        xacro_timeout: time limit of the program xacro, seconds.
        body: the body of an MJCF or USD that is the root of the robot. By default it is told by the structure.
        model: the model of an SDF file that has several.
        ball: how a ball joint of an MJCF, SDF or USD is written: as a spherical joint, or as three revolute joints.
        massless: the mass of links between several joints of one body: none, or 1e-9 kg and 1e-9 kg m².
        baseline: a file of ``urdd lint --write-baseline``, whose findings are left out.
        fail_on: the lowest severity that makes the verdict ``fail``; ``error`` by default.
        config: a settings file such as ``urdd.toml``, also for the robots of xacro files (``[[robot]]``). None is read
            by default.
        select: codes or families of the only rules to report.
        ignore: codes or families of rules not to report.
        exclude: patterns of files and folders to exclude.

    Raises:
        OpenError: if there is nothing to lint at one of the paths.
        ValueError: if there is no program of a name; the message lists all.
    """
    if not paths:
        raise TypeError("lint needs a path: a URDF, or a folder with URDFs")
    options = LintOptions(
        for_=None if for_ is None else words(for_, "for_"),
        source=source(
            packages,
            allowed_folders,
            xacro,
            xacro_arguments,
            xacro_timeout,
            body=body,
            model=model,
            ball=ball,
            massless=massless,
        ),
        baseline=None if baseline is None else Path(baseline),
        reporting=reporting(fail_on, config, select, ignore, exclude),
    )
    from .report import read_report

    return read_report(_urdd.lint([Path(path) for path in paths], options))

"""Comparison of robots."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from . import _urdd
from ._options import source

if TYPE_CHECKING:
    from .report import DiffReport

__all__ = ["diff"]


def diff(
    before: str | os.PathLike[str],
    after: str | os.PathLike[str],
    *,
    findings: bool = True,
    tolerance: float = 0.0,
    packages: Mapping[str, str | os.PathLike[str]] | None = None,
    allowed_folders: Iterable[str | os.PathLike[str]] = (),
    xacro: bool = False,
    xacro_arguments: Mapping[str, object] | None = None,
    xacro_timeout: float = 60.0,
) -> DiffReport:
    """Tells how two robots differ in meaning, as ``urdd diff`` does: formatting, the order of attributes, and the
    format of meshes make no difference.

    >>> import urdd
    >>> report = urdd.diff("welding_arm", "welding_arm")
    >>> report.same
    True

    Args:
        before: a URDF, a xacro file, an MJCF, SDF or USD, or a URDD: a folder or a zip archive.
        after: the other robot.
        findings: also compares what :func:`validate` finds in each, which takes most of the time.
        tolerance: numbers that differ by at most this, in the unit of each value (metres, radians, kilograms, …), are
            equal. Meshes are compared exactly.
        packages: the folders of ROS packages, by name, for meshes of URDFs.
        allowed_folders: folders besides those of the robot and its packages from which mesh files may be read.
        xacro: also expands macros in .urdf files.
        xacro_arguments: arguments of the xacro files, by name, for both robots.
        xacro_timeout: time limit of the program xacro, seconds.

    Raises:
        OpenError: if one of the robots cannot be read.
        ValueError: if the tolerance is negative, or no number.
    """
    from .report import read_diff_report

    text = _urdd.diff(
        Path(before),
        Path(after),
        bool(findings),
        float(tolerance),
        source(packages, allowed_folders, xacro, xacro_arguments, xacro_timeout),
    )
    return read_diff_report(text)

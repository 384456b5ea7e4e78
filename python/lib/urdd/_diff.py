"""Comparison of robots."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from . import _urdd

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
) -> DiffReport:
    """Tells how two robots differ in meaning, as ``urdd diff`` does: formatting, the order of attributes, and the
    format of meshes make no difference.

    >>> import urdd
    >>> report = urdd.diff("welding_arm", "welding_arm")
    >>> report.same
    True

    Args:
        before: a URDF, or a URDD: a folder or a zip archive.
        after: the other robot.
        findings: also compares what :func:`validate` finds in each, which takes most of the time.
        tolerance: numbers that differ by at most this, in the unit of each value (metres, radians, kilograms, …), are
            equal. Meshes are compared exactly.
        packages: the folders of ROS packages, by name, for meshes of URDFs.
        allowed_folders: folders besides those of the robot and its packages from which mesh files may be read.

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
        [(name, Path(path)) for name, path in (packages or {}).items()],
        [Path(folder) for folder in allowed_folders],
    )
    return read_diff_report(text)

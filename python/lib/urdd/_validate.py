"""Validation."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from . import _urdd
from ._options import Reporting, ValidateOptions, words
from .errors import OpenError, ValidationError

if TYPE_CHECKING:
    from .report import Report

__all__ = ["Rule", "check", "explain", "reporting", "validate"]

#: Maximum number of errors in the message of a :class:`ValidationError`.
_SHOWN = 5


@dataclass(frozen=True)
class Rule:
    """A rule of the validator, or of :func:`urdd.lint`."""

    code: str
    """Its code, such as ``DOF003``."""
    name: str
    """A short name of the problem that it finds."""
    severity: str
    """Its severity: ``error``, ``warning`` or ``info``."""
    clause: str
    """The clause of the specification; empty for a rule of :func:`urdd.lint` alone."""
    explanation: str
    """The problem, why it matters, and what to do."""


def validate(
    *paths: str | os.PathLike[str],
    conformance_class: Literal["Core", "Geometry", "Shapes"] | None = None,
    deep: bool = False,
    fail_on: Literal["error", "warning", "info"] | None = None,
    config: str | os.PathLike[str] | None = None,
    select: Iterable[str] = (),
    ignore: Iterable[str] = (),
    exclude: Iterable[str] = (),
) -> Report:
    """Validates every URDD at or below each of the paths against the specification.

    >>> import urdd
    >>> report = urdd.validate("welding_arm")
    >>> report.urdds[0].verdict
    'pass'
    >>> report.urdds[0].findings
    []

    Args:
        paths: URDDs, folders of URDDs, zip archives, or URDFs.
        conformance_class: the class to validate against, instead of the one that each URDD claims.
        deep: recomputes all sampled data, without a time limit.
        fail_on: the lowest severity that makes the verdict ``fail``; ``error`` by default.
        config: a settings file such as ``urdd.toml``. No such file is read by default.
        select: codes or families of the only rules to report.
        ignore: codes or families of rules not to report.
        exclude: patterns of folders to exclude.

    Raises:
        OpenError: if there is nothing to validate at one of the paths.
    """
    if not paths:
        raise TypeError("validate needs a path: a URDD, or a folder with URDDs")
    options = ValidateOptions(
        conformance_class=conformance_class,
        deep=bool(deep),
        reporting=reporting(fail_on, config, select, ignore, exclude),
    )
    from .report import read_report

    return read_report(_urdd.validate([Path(path) for path in paths], options))


def reporting(
    fail_on: str | None,
    config: str | os.PathLike[str] | None,
    select: Iterable[str],
    ignore: Iterable[str],
    exclude: Iterable[str],
) -> Reporting:
    """What is reported, with the text of the settings file."""
    text = None
    if config is not None:
        try:
            text = Path(config).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise OpenError(f"{os.fspath(config)}: the settings cannot be read: {error}") from None
    return Reporting(
        fail_on=fail_on,
        config=text,
        config_folder=Path() if config is None else Path(config).parent,
        select=words(select, "select"),
        ignore=words(ignore, "ignore"),
        exclude=words(exclude, "exclude"),
    )


def check(path: Path) -> None:
    """Validates the URDD at a path.

    Raises:
        ValidationError: if it does not pass, with the findings.
    """
    report = validate(path)
    failed = [urdd for urdd in report.urdds if urdd.verdict != "pass"]
    if not failed:
        return
    found = [finding for urdd in failed for finding in urdd.findings if finding.severity == "error"]
    lines = [f"{path}: does not pass validation ({failed[0].verdict}); `findings` of this error lists all"]
    lines += [urdd.reason for urdd in failed if urdd.reason is not None]
    for finding in found[:_SHOWN]:
        place = "".join(part for part in (finding.file, finding.pointer and f"#{finding.pointer}") if part)
        lines.append(f"{finding.code} {place}: {finding.message}")
    if len(found) > _SHOWN:
        lines.append(f"and {len(found) - _SHOWN} more")
    raise ValidationError("\n".join(lines), report)


def explain(code: str) -> Rule:
    """Explains a rule: what it checks, why, and what to do.

    Raises:
        UnknownNameError: if there is no such rule.
    """
    return Rule(code, *_urdd.explain(code))

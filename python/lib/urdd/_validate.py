"""Validation."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from . import _urdd
from ._options import words
from .errors import OpenError, ValidationError

if TYPE_CHECKING:
    from .report import Report

__all__ = ["Rule", "ValidateOptions", "check", "explain", "validate"]

#: Errors that the message of a :class:`ValidationError` says, at most.
_SHOWN = 5


@dataclass(frozen=True)
class ValidateOptions:
    """How URDDs are validated; each is described at :func:`validate`."""

    conformance_class: str | None
    deep: bool
    fail_on: str | None
    config: str | None
    select: list[str]
    ignore: list[str]
    exclude: list[str]


@dataclass(frozen=True)
class Rule:
    """A rule of the validator."""

    code: str
    """Its code, such as ``DOF003``."""
    name: str
    """What is wrong where it finds something, as a word."""
    severity: str
    """How bad that is: ``error``, ``warning`` or ``info``."""
    clause: str
    """The clause of the specification."""
    explanation: str
    """What is wrong, why it matters, and what to do."""


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
    """Checks every URDD at or below each of the paths against the specification.

    >>> import urdd
    >>> report = urdd.validate("welding_arm")
    >>> report.urdds[0].verdict
    'pass'
    >>> report.urdds[0].findings
    []

    Args:
        paths: URDDs, folders of them, zip archives, or URDFs by themselves.
        conformance_class: the class to hold every URDD to, instead of the one that it claims.
        deep: recomputes sampled data in full, however long it takes.
        fail_on: the severity from which on the verdict is ``fail``; ``error`` without it.
        config: a settings file such as ``urdd.toml``. Without it there are no settings, also where that file is there.
        select: codes or families of rules that alone are reported.
        ignore: codes or families of rules that are not reported.
        exclude: patterns of folders that are left out.

    Raises:
        OpenError: where under one of the paths there is nothing to examine.
    """
    if not paths:
        raise TypeError("validate needs a path: a URDD, or a folder with URDDs")
    text = None
    if config is not None:
        try:
            text = Path(config).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise OpenError(f"{os.fspath(config)}: the settings cannot be read: {error}") from None
    options = ValidateOptions(
        conformance_class=conformance_class,
        deep=bool(deep),
        fail_on=fail_on,
        config=text,
        select=words(select, "select"),
        ignore=words(ignore, "ignore"),
        exclude=words(exclude, "exclude"),
    )
    from .report import read_report

    return read_report(_urdd.validate([Path(path) for path in paths], options))


def check(path: Path) -> None:
    """That the URDD at a path passes.

    Raises:
        ValidationError: with what was found.
    """
    report = validate(path)
    failed = [urdd for urdd in report.urdds if urdd.verdict != "pass"]
    if not failed:
        return
    found = [finding for urdd in failed for finding in urdd.findings if finding.severity == "error"]
    lines = [f"{path}: does not pass validation ({failed[0].verdict}); `findings` of this error says all"]
    lines += [urdd.reason for urdd in failed if urdd.reason is not None]
    for finding in found[:_SHOWN]:
        place = "".join(part for part in (finding.file, finding.pointer and f"#{finding.pointer}") if part)
        lines.append(f"{finding.code} {place}: {finding.message}")
    if len(found) > _SHOWN:
        lines.append(f"and {len(found) - _SHOWN} more")
    raise ValidationError("\n".join(lines), report)


def explain(code: str) -> Rule:
    """What a rule checks, why, and what to do.

    Raises:
        UnknownNameError: where there is no such rule.
    """
    return Rule(code, *_urdd.explain(code))

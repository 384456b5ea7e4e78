"""Errors. Every message says what is wrong, where, and what to do."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    # Slow to import.
    from .report import Finding, Report

__all__ = [
    "CombineError",
    "ConfigurationError",
    "ExportError",
    "GenerateError",
    "MeshError",
    "ModuleMissingError",
    "ModuleUnusableError",
    "ObstacleError",
    "OpenError",
    "Place",
    "UnknownNameError",
    "UrddError",
    "ValidationError",
]


class Place(NamedTuple):
    """A location in a file, and the problem there."""

    file: str
    """The file, as it was passed."""
    line: int
    """Line, from 1; 0 for the file as a whole."""
    column: int
    """Column in the line, in characters, from 1; 0 for the file as a whole."""
    problem: str
    """What is wrong."""


class UrddError(Exception):
    """The base of all errors of this package."""

    @property
    def message(self) -> str:
        """What is wrong, where, and what to do."""
        return str(self.args[0]) if self.args else ""

    def __str__(self) -> str:
        return self.message


class OpenError(UrddError, OSError):
    """A path without a URDD, or one that cannot be read."""


class ModuleMissingError(UrddError, LookupError):
    """A required module is missing."""

    def __init__(self, message: str, module: str = "") -> None:
        super().__init__(message, module)
        self.module: str = module
        """The name of the module, such as ``bounds_module``."""


class ModuleUnusableError(UrddError, ValueError):
    """A required module is unusable. ``urdd.validate`` says more."""

    def __init__(self, message: str, module: str = "") -> None:
        super().__init__(message, module)
        self.module: str = module
        """The name of the module; empty if several modules disagree."""


class UnknownNameError(UrddError, LookupError):
    """An unknown name of a link, DOF, kind of shapes, rule or module."""

    def __init__(self, message: str, what: str = "", name: str = "", nearest: str | None = None) -> None:
        super().__init__(message, what, name, nearest)
        self.what: str = what
        """The kind of name, such as ``link``."""
        self.name: str = name
        """The name."""
        self.nearest: str | None = nearest
        """The most similar known name; None if none is similar."""


class ConfigurationError(UrddError, ValueError):
    """Values that are not configurations of the robot: a wrong shape, or not finite. Or an invalid target of inverse
    kinematics."""


class MeshError(UrddError):
    """An unusable mesh file."""


class ObstacleError(UrddError, ValueError):
    """An invalid obstacle: a negative size, numbers that are not finite, no points."""

    def __init__(self, message: str, name: str = "") -> None:
        super().__init__(message, name)
        self.name: str = name
        """The name of the obstacle."""


class ExportError(UrddError):
    """A format that cannot hold the robot."""


class ValidationError(UrddError, ValueError):
    """A URDD that does not pass validation."""

    def __init__(self, message: str, report: Report) -> None:
        super().__init__(message, report)
        self.report: Report = report
        """The validator's report, as :func:`urdd.validate` returns it."""

    @property
    def findings(self) -> list[Finding]:
        """All findings, of every severity."""
        return [finding for urdd in self.report.urdds for finding in urdd.findings]


class _MakingError(UrddError):
    """An error that leaves the output unchanged."""

    def __init__(
        self, message: str, code: str = "", places: list[tuple[str, int, int, str]] | list[Place] | None = None
    ) -> None:
        found = [Place(*place) for place in places or []]
        super().__init__(message, code, found)
        self.code: str = code
        """The kind of error, such as ``refused``, ``unreadable``, ``outside``, ``strict``."""
        self.places: list[Place] = found
        """The locations of the problems, in the order of the file."""


class GenerateError(_MakingError):
    """A URDD could not be generated. The output is unchanged."""


class CombineError(_MakingError):
    """Robots could not be combined. The output is unchanged. Codes are those of :class:`GenerateError`, ``recipe``,
    ``part`` and ``part-fails``."""

    def __init__(
        self,
        message: str,
        code: str = "",
        places: list[tuple[str, int, int, str]] | list[Place] | None = None,
        part: str | None = None,
    ) -> None:
        super().__init__(message, code, places)
        self.part: str | None = part
        """The id of the part with the problem; None if it is in the recipe, or in the combination."""

    def __reduce__(self) -> tuple[type[CombineError], tuple[object, ...]]:
        return type(self), (*self.args, self.part)

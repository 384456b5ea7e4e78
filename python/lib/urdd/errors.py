"""What can go wrong. Every message says what is wrong, where, and what to do."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    # It takes time to import.
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
    """A place in a file, and what is wrong there."""

    file: str
    """The file, as it was named."""
    line: int
    """Line, from 1; 0 where it is about the file as a whole."""
    column: int
    """Column in the line, in characters, from 1; 0 where it is about the file as a whole."""
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
    """There is no URDD at a path, or it cannot be read."""


class ModuleMissingError(UrddError, LookupError):
    """A module that is needed is not there."""

    def __init__(self, message: str, module: str = "") -> None:
        super().__init__(message, module)
        self.module: str = module
        """The name of the module, such as ``bounds_module``."""


class ModuleUnusableError(UrddError, ValueError):
    """A module that is needed is there, and of no use. ``urdd.validate`` says more."""

    def __init__(self, message: str, module: str = "") -> None:
        super().__init__(message, module)
        self.module: str = module
        """The name of the module; empty where several disagree."""


class UnknownNameError(UrddError, LookupError):
    """There is no link, DOF, kind of shapes, rule or module of this name."""

    def __init__(self, message: str, what: str = "", name: str = "", nearest: str | None = None) -> None:
        super().__init__(message, what, name, nearest)
        self.what: str = what
        """What it should be the name of."""
        self.name: str = name
        """The name."""
        self.nearest: str | None = nearest
        """The name that is nearest to it; None where none is near."""


class ConfigurationError(UrddError, ValueError):
    """Values that are no configurations of the robot: another shape, or not finite. Or no target of inverse
    kinematics."""


class MeshError(UrddError):
    """A mesh file that cannot be used."""


class ObstacleError(UrddError, ValueError):
    """An obstacle that is none: a size below 0, numbers that are not finite, no points."""

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
        """What the validator found: as :func:`urdd.validate` returns it."""

    @property
    def findings(self) -> list[Finding]:
        """What was found, of every severity."""
        return [finding for urdd in self.report.urdds for finding in urdd.findings]


class _MakingError(UrddError):
    """Nothing was written, and what was there before still is."""

    def __init__(
        self, message: str, code: str = "", places: list[tuple[str, int, int, str]] | list[Place] | None = None
    ) -> None:
        found = [Place(*place) for place in places or []]
        super().__init__(message, code, found)
        self.code: str = code
        """What kind of error it is, such as ``refused``, ``unreadable``, ``outside``, ``strict``."""
        self.places: list[Place] = found
        """The places that are at fault, in the order of the file."""


class GenerateError(_MakingError):
    """A URDD could not be made. Nothing was written, and what was there before still is."""


class CombineError(_MakingError):
    """Robots could not be put together. Nothing was written, and what was there before still is. Codes are those of
    :class:`GenerateError`, ``recipe``, ``part`` and ``part-fails``."""

    def __init__(
        self,
        message: str,
        code: str = "",
        places: list[tuple[str, int, int, str]] | list[Place] | None = None,
        part: str | None = None,
    ) -> None:
        super().__init__(message, code, places)
        self.part: str | None = part
        """The id of the part that is at fault; None where it is the recipe, or all together."""

    def __reduce__(self) -> tuple[type[CombineError], tuple[object, ...]]:
        return type(self), (*self.args, self.part)

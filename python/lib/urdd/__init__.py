"""Universal Robot Description Directories (URDDs): a robot to ask about itself.

>>> import urdd
>>> robot = urdd.load("welding_arm")
>>> q = robot.sample(100)
>>> robot.fk(q).shape
(100, 9, 4, 4)
>>> robot.in_collision(q).shape
(100,)

Lengths are metres, angles radians, poses matrices (4, 4) in the frame of the root link. :class:`Robot` says the rest.
:func:`generate` makes a URDD of a URDF, :func:`combine` one of several robots, :func:`validate` checks one,
:func:`export` hands it on. :class:`World` holds obstacles.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from . import errors
from ._answers import (
    SKIP_REASONS,
    Box,
    ConvexMesh,
    InverseSolution,
    InverseSolutions,
    LearnedPair,
    MeshKind,
    ObstacleDistance,
    ObstaclePair,
    Pair,
    PairDistance,
    Rate,
    ShapeKind,
    SkipReason,
    Skips,
    Spheres,
    Visual,
)
from ._collision_model import CollisionModel
from ._combine import Combined, CombineNote, combine
from ._export import Export, export
from ._generate import Generated, Job, Note, find_urdfs, generate, generate_text
from ._proximity import Proximity
from ._robot import Robot, load
from ._urdd import __version__, num_threads, set_num_threads
from ._validate import Rule, explain, validate
from ._world import Among, World
from .errors import (
    CombineError,
    ConfigurationError,
    ExportError,
    GenerateError,
    MeshError,
    ModuleMissingError,
    ModuleUnusableError,
    ObstacleError,
    OpenError,
    UnknownNameError,
    UrddError,
    ValidationError,
)

if TYPE_CHECKING:
    from . import modules, report
    from ._mujoco import MujocoRobot
    from ._pinocchio import PinocchioRobot
    from ._pybullet import PybulletRobot
    from ._show import Frame, Shown, ShownByViser

__all__ = [
    "SKIP_REASONS",
    "Among",
    "Box",
    "CollisionModel",
    "CombineError",
    "CombineNote",
    "Combined",
    "ConfigurationError",
    "ConvexMesh",
    "Export",
    "ExportError",
    "Frame",
    "GenerateError",
    "Generated",
    "InverseSolution",
    "InverseSolutions",
    "Job",
    "LearnedPair",
    "MeshError",
    "MeshKind",
    "ModuleMissingError",
    "ModuleUnusableError",
    "MujocoRobot",
    "Note",
    "ObstacleDistance",
    "ObstacleError",
    "ObstaclePair",
    "OpenError",
    "Pair",
    "PairDistance",
    "PinocchioRobot",
    "Proximity",
    "PybulletRobot",
    "Rate",
    "Robot",
    "Rule",
    "ShapeKind",
    "Shown",
    "ShownByViser",
    "SkipReason",
    "Skips",
    "Spheres",
    "UnknownNameError",
    "UrddError",
    "ValidationError",
    "Visual",
    "World",
    "__version__",
    "combine",
    "errors",
    "explain",
    "export",
    "find_urdfs",
    "generate",
    "generate_text",
    "load",
    "modules",
    "num_threads",
    "report",
    "set_num_threads",
    "validate",
]


#: What is imported when it is first asked for: together that takes as long as numpy.
_LATER = {
    "Frame": "_show",
    "MujocoRobot": "_mujoco",
    "PinocchioRobot": "_pinocchio",
    "PybulletRobot": "_pybullet",
    "Shown": "_show",
    "ShownByViser": "_show",
    "modules": "modules",
    "report": "report",
}


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}", name=name, obj=sys.modules[__name__])
    from importlib import import_module

    module = import_module(f".{_LATER[name]}", __name__)
    return module if _LATER[name] == name else getattr(module, name)

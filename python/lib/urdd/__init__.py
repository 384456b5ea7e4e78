"""Universal Robot Description Directories (URDDs): queries on robots.

>>> import urdd
>>> robot = urdd.load("welding_arm")
>>> q = robot.random(100)
>>> robot.link_poses(q).shape
(100, 9, 4, 4)
>>> robot.in_collision(q).shape
(100,)

Lengths are metres, angles radians, poses matrices (4, 4) in the frame of the root link: see :class:`Robot`.
:func:`generate` generates a URDD from a URDF, MJCF, SDF or USD, :func:`combine` one from several robots,
:func:`validate` validates one, :func:`export` writes it in the formats of other programs, :func:`import_robot` makes a
URDF of MJCF, SDF and USD, :func:`diff` compares two. :func:`lint` finds what is wrong with a URDF, and what programs do
with it.
:class:`World` holds obstacles.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from . import errors
from ._answers import (
    SKIP_REASONS,
    Box,
    Closed,
    ConvexMesh,
    FreeDofs,
    InverseSolution,
    LearnedPair,
    LoopErrors,
    MeshKind,
    ObstacleDistance,
    ObstacleGradient,
    ObstacleOverlap,
    ObstaclePair,
    Pair,
    PairDistance,
    PairGradient,
    PairOverlap,
    Rate,
    ShapeKind,
    SkipReason,
    Skips,
    Spheres,
    Visual,
)
from ._collision_model import CollisionModel
from ._combine import Combined, CombineNote, combine
from ._diff import diff
from ._export import Export, export
from ._generate import Generated, Job, Note, find_urdfs, generate, generate_text
from ._import import Imported, import_robot
from ._lint import lint
from ._proximity import Proximity
from ._robot import Robot, load
from ._sphere_checker import SphereChecker
from ._urdd import __version__, num_threads, set_num_threads
from ._validate import Rule, explain, validate
from ._world import World
from ._world_proximity import WorldProximity
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
    from ._newton import NewtonRobot
    from ._pinocchio import PinocchioRobot
    from ._pybullet import PybulletRobot
    from ._show import Frame, Shown, ShownByViser

__all__ = [
    "SKIP_REASONS",
    "Box",
    "Closed",
    "CollisionModel",
    "CombineError",
    "CombineNote",
    "Combined",
    "ConfigurationError",
    "ConvexMesh",
    "Export",
    "ExportError",
    "Frame",
    "FreeDofs",
    "GenerateError",
    "Generated",
    "Imported",
    "InverseSolution",
    "Job",
    "LearnedPair",
    "LoopErrors",
    "MeshError",
    "MeshKind",
    "ModuleMissingError",
    "ModuleUnusableError",
    "MujocoRobot",
    "NewtonRobot",
    "Note",
    "ObstacleDistance",
    "ObstacleError",
    "ObstacleGradient",
    "ObstacleOverlap",
    "ObstaclePair",
    "OpenError",
    "Pair",
    "PairDistance",
    "PairGradient",
    "PairOverlap",
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
    "SphereChecker",
    "Spheres",
    "UnknownNameError",
    "UrddError",
    "ValidationError",
    "Visual",
    "World",
    "WorldProximity",
    "__version__",
    "combine",
    "diff",
    "errors",
    "explain",
    "export",
    "find_urdfs",
    "generate",
    "generate_text",
    "import_robot",
    "lint",
    "load",
    "modules",
    "num_threads",
    "report",
    "set_num_threads",
    "validate",
]


#: Imported on first use: together they take as long to import as numpy.
_LATER = {
    "Frame": "_show",
    "MujocoRobot": "_mujoco",
    "NewtonRobot": "_newton",
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

"""Universal Robot Description Directories (URDDs): a robot to ask about itself.

>>> import urdd
>>> robot = urdd.load("welding_arm")
>>> q = robot.sample(100)
>>> robot.fk(q).shape
(100, 9, 4, 4)
>>> robot.in_collision(q).shape
(100,)

Lengths are metres, angles radians, poses matrices (4, 4) in the frame of the root link. :class:`Robot` says the rest.
:func:`generate` makes a URDD of a URDF, :func:`validate` checks one, :func:`export` hands it on.
"""

from __future__ import annotations

from . import errors, modules, report
from ._answers import (
    SKIP_REASONS,
    Box,
    ConvexMesh,
    InverseSolution,
    InverseSolutions,
    Pair,
    PairDistance,
    ShapeKind,
    SkipReason,
    Skips,
    Spheres,
    Visual,
)
from ._export import Export, export
from ._generate import Generated, Job, Note, find_urdfs, generate, generate_text
from ._mujoco import MujocoRobot
from ._pinocchio import PinocchioRobot
from ._proximity import Proximity
from ._pybullet import PybulletRobot
from ._robot import Robot, load
from ._show import Frame, Shown, ShownByViser
from ._trimesh import MeshKind
from ._urdd import __version__, num_threads, set_num_threads
from ._validate import Rule, explain, validate
from .errors import (
    ConfigurationError,
    ExportError,
    GenerateError,
    MeshError,
    ModuleMissingError,
    ModuleUnusableError,
    OpenError,
    UnknownNameError,
    UrddError,
)

__all__ = [
    "SKIP_REASONS",
    "Box",
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
    "MeshError",
    "MeshKind",
    "ModuleMissingError",
    "ModuleUnusableError",
    "MujocoRobot",
    "Note",
    "OpenError",
    "Pair",
    "PairDistance",
    "PinocchioRobot",
    "Proximity",
    "PybulletRobot",
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
    "Visual",
    "__version__",
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

"""The robots of the repository as URDDs, generated once."""

from __future__ import annotations

import json
import signal
from pathlib import Path
from typing import Any

import pytest

import urdd

REPOSITORY = Path(__file__).resolve().parents[2]
ROBOTS = REPOSITORY / "conformance" / "robots"
NAMES = [
    "gripper",
    "hand",
    "planar_base_arm",
    "quadruped",
    "single_link",
    "six_axis_arm",
    "toy_all_joints",
    "welding_arm",
]


# A shell that runs this in the background has Ctrl-C ignored, also by what is started here, and tests press it.
signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def urdds(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a URDD of each of our robots, by name."""
    folder = tmp_path_factory.mktemp("urdds")
    for name in NAMES:
        urdd.generate(ROBOTS / f"{name}.urdf", folder / name, samples=100)
    return folder


@pytest.fixture(scope="session")
def arm(urdds: Path) -> urdd.Robot:
    """A robot with meshes, with one DOF per joint."""
    return urdd.load(urdds / "welding_arm")


@pytest.fixture(scope="session")
def toy(urdds: Path) -> urdd.Robot:
    """A robot with every type of joint, and mimics of mimics."""
    return urdd.load(urdds / "toy_all_joints")


@pytest.fixture(scope="session")
def training(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[tuple[str, int, int]]]:
    """A URDD with a learned self-collision model, and the progress reported while it was generated."""
    told: list[tuple[str, int, int]] = []
    path = tmp_path_factory.mktemp("learned") / "welding_arm_with_a_model"
    made = urdd.generate(
        ROBOTS / "welding_arm.urdf",
        path,
        modules=["all", "self_collision_model"],
        samples=100,
        progress=lambda what, done, total: told.append((what, done, total)),
    )
    assert "self_collision_model_module" in made.modules_made, made.notes
    return path, told


@pytest.fixture(scope="session")
def learned(training: tuple[Path, list[tuple[str, int, int]]]) -> urdd.Robot:
    """A robot with a learned self-collision model."""
    return urdd.load(training[0])


@pytest.fixture(scope="session")
def figures() -> Any:
    """Poses of our robots by closed forms, Pinocchio, MuJoCo and yourdfpy."""
    return json.loads((REPOSITORY / "conformance" / "vectors" / "forward_kinematics.json").read_text(encoding="utf-8"))

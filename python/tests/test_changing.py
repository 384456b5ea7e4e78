"""An open robot is one robot: each answer is that of the files that were there when it was opened, or an error."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import urdd

Q = np.linspace(-0.4, 0.5, 6)
QUESTIONS: dict[str, Callable[[urdd.Robot], Any]] = {
    "name": lambda robot: robot.name,
    "links": lambda robot: robot.link_names,
    "joints": lambda robot: robot.joint_names,
    "dofs": lambda robot: (robot.dof_names, robot.dof_units),
    "root": lambda robot: robot.root_link,
    "bounds": lambda robot: robot.bounds,
    "random": lambda robot: robot.random(3),
    "poses": lambda robot: robot.link_poses(Q),
    "jacobian": lambda robot: robot.jacobian(Q, "elbow"),
    "limits": lambda robot: (robot.velocity_limits, robot.effort_limits),
    "masses": lambda robot: robot.link_masses,
    "centre_of_mass": lambda robot: robot.centre_of_mass(Q),
    "gravity_torques": lambda robot: robot.gravity_torques(Q),
    "metadata": lambda robot: robot.metadata,
    "urdf_text": lambda robot: robot.urdf_text,
    "urdf": lambda robot: robot.modules.urdf,
    "versions": lambda robot: [robot.modules.version(name) for name in robot.modules.names()],
    "documents": lambda robot: [robot.modules.json(name) for name in robot.modules.names()],
    "visuals": lambda robot: robot.visuals(),
    "mjcf": lambda robot: urdd.export(robot, "mjcf").text,
    "drake": lambda robot: urdd.export(robot, "drake").text,
    "frame": lambda robot: robot.frame().text,
}


def ask_of(kind: Any) -> None:
    QUESTIONS[f"shapes {kind}"] = lambda robot: robot.shapes(kind)
    QUESTIONS[f"skips {kind}"] = lambda robot: robot.skips(kind)
    QUESTIONS[f"distances {kind}"] = lambda robot: robot.distances(Q, kind)


for one in ("hulls", "pieces", "boxes", "spheres", "piece-boxes", "piece-spheres"):
    ask_of(one)


def edit(path: Path) -> None:
    for file in path.rglob("*"):
        if file.is_file():
            file.write_bytes(file.read_bytes().replace(b"1", b"3"))


def answer(robot: urdd.Robot, question: str) -> str:
    with np.printoptions(threshold=10**9):
        return repr(QUESTIONS[question](robot))


# Asked of one robot after the change.
SLOW = {"frame", "mjcf", "drake"}
CHANGED = "it changed on disk since it was opened: open it again"


def answered(robot: urdd.Robot, question: str) -> str:
    try:
        return answer(robot, question)
    except urdd.UrddError as error:
        return CHANGED if CHANGED in str(error) else str(error)


@pytest.mark.parametrize("how", ["edit", "replace", "remove"])
def test_an_open_robot_is_the_one_that_was_there(urdds: Path, tmp_path: Path, how: str) -> None:
    path, other = tmp_path / "robot", tmp_path / "other"
    shutil.copytree(urdds / "six_axis_arm", path)
    shutil.copytree(path, other)
    edit(other)
    time.sleep(0.05)
    first: dict[str, str] = {}
    for question in QUESTIONS:
        first[question] = answer(urdd.load(path), question)
    robots = {}
    for before in QUESTIONS:
        robots[before] = urdd.load(path)
        answer(robots[before], before)
    if how == "edit":
        edit(path)
    else:
        shutil.rmtree(path)
    if how == "replace":
        other.rename(path)
    refused = 0
    for before, robot in robots.items():
        for question in QUESTIONS.keys() - SLOW | {before}:
            found = answered(robot, question)
            refused += found == CHANGED
            assert found in (CHANGED, first[question]), (before, question)
    assert refused > len(QUESTIONS)

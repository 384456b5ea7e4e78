"""Counts the lines of a Python library that run before a robot's first pose. Started by `lines.py`, once a library.

    python benches/evaluation/lines_python.py NAME URDF URDD

Prints JSON: for each stage the distinct lines, by package; and how far the last link's pose is from the one that the
URDD states. A line counts where `sys.settrace` reports it in a file of the library. Importing comes before counting.
"""

from __future__ import annotations

import importlib
import json
import sys
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

Lines = set[tuple[str, int]]

#: What is counted of each library: packages, and files below one.
PACKAGES = {
    "a program by json and numpy": ["forward_kinematics"],
    "urdd in Python": ["urdd"],
    "yourdfpy": ["yourdfpy", "trimesh/scene"],
    "roboticstoolbox": ["roboticstoolbox", "spatialmath", "spatialgeometry"],
}


def folder_of(package: str) -> str:
    """Where a package's files are, or the one file of a module."""
    name, _, below = package.partition("/")
    path = Path(str(importlib.import_module(name).__file__))
    return str(path.parent / below) if path.name == "__init__.py" else str(path)


def traced(work: Callable[[], Any], folders: dict[str, str]) -> tuple[Any, dict[str, Lines]]:
    """What work gives, and the lines of each package that it ran."""
    lines: dict[str, Lines] = {package: set() for package in folders}

    def local(frame: FrameType, event: str, _: Any, package: str) -> Any:
        if event == "line":
            lines[package].add((frame.f_code.co_filename, frame.f_lineno))
        return lambda frame, event, argument: local(frame, event, argument, package)

    def begin(frame: FrameType, event: str, argument: Any) -> Any:
        for package, folder in folders.items():
            if frame.f_code.co_filename.startswith(folder) and frame.f_code.co_name != "<module>":
                return lambda frame, event, argument: local(frame, event, argument, package)
        return None

    sys.settrace(begin)
    try:
        found = work()
    finally:
        sys.settrace(None)
    return found, lines


def stages(name: str, urdf: str, urdd: str) -> tuple[Callable[[], Any], Callable[[Any, dict[str, float], str], Any]]:
    """Loading a robot, and the pose of a link in a configuration by names of joints."""
    if name == "a program by json and numpy":
        own: Any = importlib.import_module("forward_kinematics")

        def load() -> Any:
            return own.read(urdd, "chain_module"), own.read(urdd, "dof_module")

        def pose(robot: Any, q: dict[str, float], link: str) -> Any:
            chain, dof = robot
            names = [one["name"] for one in chain["links_in_chain"]]
            return own.link_poses(chain, dof, list(q.values()))[names.index(link)]

    elif name == "urdd in Python":
        ours: Any = importlib.import_module("urdd")

        def load() -> Any:
            return ours.load(urdd)

        def pose(robot: Any, q: dict[str, float], link: str) -> Any:
            return robot.link_pose(np.array(list(q.values())), link)

    elif name == "yourdfpy":
        yourdfpy: Any = importlib.import_module("yourdfpy")
        importlib.import_module("trimesh.scene")

        def load() -> Any:
            return yourdfpy.URDF.load(urdf, load_meshes=False)

        def pose(robot: Any, q: dict[str, float], link: str) -> Any:
            robot.update_cfg(q)
            return robot.get_transform(link)

    else:
        toolbox: Any = importlib.import_module("roboticstoolbox")

        def load() -> Any:
            return toolbox.ERobot.URDF(urdf)

        def pose(robot: Any, q: dict[str, float], link: str) -> Any:
            joints = [one._joint_name for one in robot.links if one.isjoint]
            return robot.fkine([q[joint] for joint in joints], end=link).A

    return load, pose


def main() -> None:
    name, urdf, urdd = sys.argv[1:]
    root = Path(__file__).resolve().parents[2]
    sys.path.insert(0, str(root / "examples"))
    import forward_kinematics as own

    chain, dof = own.read(urdd, "chain_module"), own.read(urdd, "dof_module")
    sample = own.read(urdd, "kinematics_samples_module")["samples"][-1]
    q = {one["joint_name"]: value for one, value in zip(dof["dofs"], sample["configuration"], strict=True)}
    link, stated = chain["links_in_chain"][-1]["name"], sample["link_poses"][-1]
    right = own.transform(own.quaternion(stated["quaternion_wxyz"]), stated["position"])

    folders = {package: folder_of(package) for package in PACKAGES[name]}
    load, pose = stages(name, urdf, urdd)
    robot, loading = traced(load, folders)
    found, moving = traced(lambda: pose(robot, q, link), folders)
    counted = {
        "load": {package: len(lines) for package, lines in loading.items()},
        "pose": {package: len(lines - loading[package]) for package, lines in moving.items()},
        "off": float(np.abs(np.asarray(found) - right).max()),
    }
    print(json.dumps(counted))


if __name__ == "__main__":
    main()

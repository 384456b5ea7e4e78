"""Exports to the formats of other programs."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from . import _urdd
from ._answers import ExportShapes
from ._description import RobotDescription

__all__ = ["Actuators", "Export", "Format", "Ros", "export", "exported_with"]

Format: TypeAlias = Literal[
    "srdf",
    "urdf",
    "drake",
    "mjcf",
    "curobo",
    "foam",
    "spherized",
    "moveit",
    "sdf",
    "usd",
    "urdf-plus",
    "extended-urdf",
]
"""A format: SRDF for MoveIt, URDF with our shapes as collision geometry, the same for Drake, MJCF for MuJoCo, spheres
for cuRobo and Foam, URDF with these spheres, a package for MoveIt 2, SDF for Gazebo, USD for Isaac, Newton
and Omniverse, and URDF with what closes its loops, as URDF+ and Extended URDF have it."""

Actuators: TypeAlias = Literal["position", "velocity", "motor"]
"""What actuators are told: positions (rad or m), velocities (rad/s or m/s), or torques and forces (N m or N)."""

Ros: TypeAlias = Literal["humble", "jazzy"]
"""A distribution of ROS 2."""


@dataclass(frozen=True)
class Export:
    """A robot in another format."""

    text: str
    """The text of the file."""
    files: dict[str, bytes]
    """The files that it references, by path relative to it; for ``moveit``, the other files of the package."""
    notes: list[str]
    """What the format cannot express, or expresses differently."""
    report: dict[str, object]
    """What was ``carried``, carried ``otherwise`` and ``lost`` of this robot, each with ``what`` and ``count``."""
    path: str | None = None
    """The path of the text in the folder of a package; ``None`` for other formats."""

    def write(self, file: str | os.PathLike[str], *, force: bool = False) -> Path:
        """Writes the file, and the mesh files beside it; for ``moveit``, the folder of the package.

        Raises:
            FileExistsError: if a file exists with other content, unless ``force``.
        """
        target = Path(file)
        # The file that references the others is last.
        files = [(Path(path), data) for path, data in self.files.items()]
        own = (Path(target.name if self.path is None else self.path), self.text.encode())
        _urdd.write_files(target, self.path is not None, [*files, own], force)
        return target


def export(
    robot: RobotDescription | str | os.PathLike[str],
    format: Format,  # noqa: A002
    output: str | os.PathLike[str] | None = None,
    *,
    setup: str | os.PathLike[str] | None = None,
    # The options of crates/urdd-export/src/choices.rs: `cargo xtask update` writes them, and what they do below.
    shapes: ExportShapes = "pieces",
    reasons: Iterable[Literal["same-link", "always", "adjacent", "default", "never"]] | None = None,
    keep_pairs: bool = False,
    spheres: int | None = None,
    total_spheres: int | None = None,
    cover: bool = False,
    samples: int = 10_000,
    visuals: bool | float = True,
    mesh_folder: str | None = None,
    floating_base: bool = False,
    fit: tuple[float, float] | None = None,
    merge_fixed: bool = False,
    root: str | None = None,
    actuators: Actuators | None = None,
    bandwidth: float | None = None,
    sensors: bool = False,
    scene: bool = False,
    robot_file: str | None = None,
    package: str | None = None,
    ros: Ros | None = None,
    # End of the options.
    force: bool = False,
) -> Export:
    """Exports a robot to another format, in memory; with ``output`` to that file too.

    Args:
        robot: the robot, or its path.
        format: the format.
        output: a file to write.
        shapes: shapes that represent the links, in the collision geometry and in the disabled pairs. ``pieces``: the
            convex pieces of links; ``hulls``: the convex hulls of links; ``boxes``: the bounding boxes of hulls;
            ``spheres``: the bounding spheres of hulls; ``piece-boxes``: the bounding boxes of pieces;
            ``piece-spheres``: the bounding spheres of pieces; ``source``: the collision elements of the source: boxes,
            cylinders, capsules, spheres and meshes as it has them, and pieces for links that have none. Visual
            primitives stay primitives too.
        reasons: reasons for which pairs of links are disabled. Default: those of the URDD. A person's edits apply in
            either case.
        keep_pairs: checks a pair of links if the URDD skips some pairs of their pieces and checks others. By default,
            such a pair is disabled. Applies to formats that list pairs of links; MJCF always follows the URDD for each
            piece, and USD then does.
        spheres: maximum number of spheres per link. Default: 12 on average and at most 150 in total; with ``cover``, 8.
            It is a whole number from 1 to 10,000.
        total_spheres: maximum number of spheres for all links together; each link has at least one. It is a whole
            number from 1 to 65,535.
        cover: makes the spheres enclose each link completely. No collision is missed then, but often every
            configuration is in contact; the file states how often. By default, spheres are fitted to give the same
            answers as the shapes.
        samples: number of sampled configurations in which spheres are measured; fewer where that would take long. It is
            a whole number from 100 to 1,000,000.
        visuals: visual geometry with fewer triangles: at most a part of them (``0.1``), or at most as many in total
            (``20000``). ``False`` leaves it out.
        mesh_folder: the folder of the mesh files, relative to the file. Default: the name of the file without its
            extension, followed by ``_meshes``.
        floating_base: MJCF, SDF and USD: the root link moves freely. Otherwise it is fixed to the world.
        fit: puts a box, cylinder, capsule or sphere around each convex mesh in its place, the tightest that has at most
            VOLUME times the volume of the mesh and is at most STANDOFF metres off it. Pairs are judged by these shapes.
            Not for formats of spheres.
        merge_fixed: makes one body of links that are fixed to each other, with their masses, shapes and pairs. Each
            keeps its frame: a site, a frame, an empty ``Xform``, or in URDF an empty link. Not for formats of spheres.
        root: makes another link the root: joints between it and the old root are turned round. Values, limits and names
            of joints stay. Not for formats of spheres.
        actuators: MJCF and USD: adds an actuator, or a drive, to each joint of one DOF. Gains are computed from
            inertias, for ``bandwidth``. ``position``: they are told positions, rad or m; ``velocity``: they are told
            velocities, rad/s or m/s; ``motor``: they are told torques or forces, N m or N.
        bandwidth: MJCF and USD: the frequency below which a joint follows its actuator, Hz. Default: that of
            ``NAME.export.toml``, or 10. It is from 0.01 to 1,000 Hz.
        sensors: MJCF: a gyroscope and an accelerometer at each IMU frame of ``NAME.export.toml``.
        scene: MJCF: writes a scene with floor and light beside the file: ``NAME_scene.xml``.
        robot_file: cuRobo: writes the whole robot file, for the URDF of this path.
        package: MoveIt: the name of the package. Default: the name of the folder. Drake: writes ``package.xml`` and a
            model directive beside the file.
        ros: MoveIt: the distribution of ROS 2 whose MoveIt and ros2_control read the package. Default: jazzy, whose
            files Kilted reads too. ``humble``: MoveIt 2.5, ros2_control 2; ``jazzy``: MoveIt 2.12, ros2_control 4;
            Kilted reads the same files.
        setup: what the URDD does not say, as ``urdd export init`` writes it; by default ``NAME.export.toml`` beside the
            URDD ``NAME``, if it is there.
        force: overwrites existing files.

    Raises:
        ValueError: for an option of another format, or a scene without ``output``.
        ExportError: if the format cannot hold the robot, or ``setup`` is wrong.
        FileExistsError: if a file exists with other content.
    """
    # Every argument, by its name.
    options = dict(locals())
    for other in ("robot", "format", "force"):
        del options[other]
    if scene and output is None:
        raise ValueError("a scene includes the file that is written: give output")
    subject = robot if isinstance(robot, RobotDescription) else RobotDescription(robot)
    exported = exported_with(subject, format, options)
    if output is not None:
        exported.write(output, force=force)
    return exported


def exported_with(robot: RobotDescription, format: Format, options: dict[str, object]) -> Export:  # noqa: A002
    """As :func:`export`, in memory."""
    text, path, files, notes, report = _urdd.export(robot.core, format, options)
    return Export(text, dict(files), notes, json.loads(report), path)

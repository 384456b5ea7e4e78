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
from ._options import ExportOptions, ranged, words

__all__ = ["Actuators", "Export", "Format", "Ros", "export", "export_options", "exported_with"]

Format: TypeAlias = Literal["srdf", "urdf", "drake", "mjcf", "curobo", "foam", "spherized", "moveit", "sdf", "usd"]
"""A format: SRDF for MoveIt, URDF with our shapes as collision geometry, the same for Drake, MJCF for MuJoCo, spheres
for cuRobo and Foam, URDF with these spheres, a package for MoveIt 2, SDF for Gazebo, USD for Isaac, Newton
and Omniverse."""

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
    shapes: ExportShapes = "pieces",
    reasons: Iterable[Literal["same-link", "always", "adjacent", "default", "never"]] | None = None,
    keep_pairs: bool = False,
    spheres: int | None = None,
    total_spheres: int | None = None,
    cover: bool = False,
    samples: int = 10_000,
    visuals: bool | float = True,
    mesh_folder: str | None = None,
    actuators: Actuators | None = None,
    bandwidth: float | None = None,
    floating_base: bool = False,
    merge_fixed: bool = False,
    root: str | None = None,
    fit: tuple[float, float] | None = None,
    sensors: bool = False,
    scene: bool = False,
    setup: str | os.PathLike[str] | None = None,
    package: str | None = None,
    ros: Ros | None = None,
    robot_file: str | None = None,
    force: bool = False,
) -> Export:
    """Exports a robot to another format, in memory; with ``output`` to that file too.

    Args:
        robot: the robot, or its path.
        format: the format.
        output: a file to write.
        shapes: the kind of collision shapes, or ``"source"``: boxes, cylinders, capsules, spheres and meshes as the
            collision elements of the source have them, and pieces for links without any; visual primitives stay
            primitives too. Pairs are disabled by the skips of this kind, or judged by the shapes of the source.
        reasons: the reasons for which pairs of links are disabled; by default those of the URDD. Edits always apply.
        keep_pairs: checks pairs of links of which the URDD skips only some pieces, in formats that disable pairs of
            links only, and in USD, piece by piece. By default such a pair is disabled, and a note names it.
        spheres: maximum number of spheres for each link. By default 12 on average and at most 150 in all; with
            ``cover``, 8.
        total_spheres: maximum number of spheres for all links together, but at least one for each.
        cover: covers each link with spheres. By default spheres are fitted to collide when the shapes do.
        samples: number of configurations in which the spheres are measured; fewer if that is much work.
        visuals: whether the file has visual geometry; or the largest part of its triangles to keep, such as 0.1, or
            the most to keep in all.
        mesh_folder: the folder of the mesh files, relative to the file; with ``output``, named after it by default.
        actuators: MJCF and USD: what the actuators of joints of one DOF are told; by default there are none. Gains are
            computed from the inertia that each joint moves.
        bandwidth: MJCF and USD: the frequency below which a joint follows its actuator, Hz, from 0.01 to 1,000. By
            default that of ``setup``, or 10.
        floating_base: MJCF, SDF and USD: the root link moves freely, in MJCF by a free joint ``floating_base``.
        merge_fixed: makes one body of links that are fixed to each other, with their masses, shapes and pairs. Each
            keeps its frame: a site, a frame, an empty ``Xform``, or in URDF an empty link. Not for formats of spheres.
        root: the link that becomes the root: joints between it and the old root are turned round. Values, limits and
            names of joints stay. Not for formats of spheres.
        fit: puts a box, cylinder, capsule or sphere around each convex mesh in its place: the tightest that has at most
            so many times the volume of the mesh and is at most so many metres off it, such as ``(1.2, 0.005)``. Pairs
            are judged by these shapes. Not for formats of spheres.
        sensors: MJCF: a gyroscope and an accelerometer at each IMU frame of ``setup``.
        scene: MJCF: with ``output``, writes a scene with floor and light beside it: ``NAME_scene.xml``.
        setup: what the URDD does not say, as ``urdd export init`` writes it; by default ``NAME.export.toml`` beside the
            URDD ``NAME``, if it is there.
        package: MoveIt: the name of the package, by default ``output``'s. Drake: writes ``package.xml`` and a model
            directive too.
        ros: MoveIt: the distribution of ROS 2 whose MoveIt and ros2_control read the package, by default ``"jazzy"``,
            whose files Kilted reads too.
        robot_file: cuRobo: the path of the URDF; the text is then the whole robot file.
        force: overwrites existing files.

    Raises:
        ValueError: for an option of another format, or a scene without ``output``.
        ExportError: if the format cannot hold the robot, or ``setup`` is wrong.
        FileExistsError: if a file exists with other content.
    """
    if scene and output is None:
        raise ValueError("a scene includes the file that is written: give output")
    options = export_options(
        shapes=shapes,
        reasons=reasons,
        keep_pairs=keep_pairs,
        spheres=spheres,
        total_spheres=total_spheres,
        cover=cover,
        samples=samples,
        visuals=visuals,
        mesh_folder=mesh_folder,
        actuators=actuators,
        bandwidth=bandwidth,
        floating_base=floating_base,
        merge_fixed=merge_fixed,
        root=root,
        fit=fit,
        sensors=sensors,
        scene=scene,
        output=output,
        setup=setup,
        package=package,
        ros=ros,
        robot_file=robot_file,
    )
    subject = robot if isinstance(robot, RobotDescription) else RobotDescription(robot)
    exported = exported_with(subject, format, options)
    if output is not None:
        exported.write(output, force=force)
    return exported


def exported_with(robot: RobotDescription, format: Format, options: ExportOptions) -> Export:  # noqa: A002
    """As :func:`export`, in memory."""
    text, path, files, notes, report = _urdd.export(robot.core, format, options)
    return Export(text, dict(files), notes, json.loads(report), path)


def export_options(
    *,
    shapes: ExportShapes = "pieces",
    reasons: Iterable[str] | None = None,
    keep_pairs: bool = False,
    spheres: int | None = None,
    total_spheres: int | None = None,
    cover: bool = False,
    samples: int = 10_000,
    visuals: bool | float = True,
    mesh_folder: str | None = None,
    actuators: Actuators | None = None,
    bandwidth: float | None = None,
    floating_base: bool = False,
    merge_fixed: bool = False,
    root: str | None = None,
    fit: tuple[float, float] | None = None,
    sensors: bool = False,
    scene: bool = False,
    output: str | os.PathLike[str] | None = None,
    setup: str | os.PathLike[str] | None = None,
    package: str | None = None,
    ros: Ros | None = None,
    robot_file: str | None = None,
) -> ExportOptions:
    """The options of :func:`export`, with their types checked."""
    for name, count in (("spheres", spheres), ("total_spheres", total_spheres)):
        if count is not None:
            ranged(count, f"export.{name}")
    return ExportOptions(
        shapes=shapes,
        reasons=None if reasons is None else words(reasons, "reasons"),
        keep_pairs=bool(keep_pairs),
        spheres=spheres,
        total_spheres=total_spheres,
        cover=bool(cover),
        samples=ranged(samples, "export.samples"),
        visuals=bool(visuals),
        detail=None if isinstance(visuals, bool) else float(visuals),
        mesh_folder=mesh_folder,
        actuators=actuators,
        bandwidth=None if bandwidth is None else float(bandwidth),
        floating_base=bool(floating_base),
        merge_fixed=bool(merge_fixed),
        root=root,
        fit=None if fit is None else (float(fit[0]), float(fit[1])),
        sensors=bool(sensors),
        scene=bool(scene),
        output=None if output is None else Path(output),
        setup=None if setup is None else Path(setup),
        package=package,
        ros=ros,
        robot_file=robot_file,
    )

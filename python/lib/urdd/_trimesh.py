"""Meshes and scenes of trimesh."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._answers import MeshKind
from ._arrays import one_configuration
from ._kinematics import RobotKinematics
from ._need import need
from .errors import MeshError


def link_mesh(robot: RobotKinematics, link: str, kind: MeshKind = "plain") -> Any:
    """As :meth:`urdd.Robot.link_mesh`."""
    trimesh = need("trimesh", "trimesh", "link_mesh")
    meshes = _meshes(robot, trimesh, robot.link_names[robot.link(link)], kind)
    if not meshes:
        raise MeshError(f"link `{link}` has no geometry; `robot.hulls()` lists the links that have some")
    return meshes[0] if len(meshes) == 1 else trimesh.util.concatenate(meshes)


def to_trimesh(robot: RobotKinematics, q: ArrayLike | None = None, kind: MeshKind = "plain") -> Any:
    """As :meth:`urdd.Robot.to_trimesh`."""
    trimesh = need("trimesh", "trimesh", "to_trimesh")
    row = one_configuration(robot.zero if q is None else q, robot.dof_names)[0]
    scene = trimesh.Scene(base_frame=robot.root_link)
    for link, pose in zip(robot.link_names, robot.link_poses(row), strict=True):
        for piece, mesh in enumerate(_meshes(robot, trimesh, link, kind)):
            scene.add_geometry(mesh, node_name=f"{link}/{piece}", geom_name=f"{link}/{piece}", transform=pose)
    return scene


def _meshes(robot: RobotKinematics, trimesh: Any, link: str, kind: MeshKind) -> list[Any]:
    """The meshes of a link, in its frame, with the colours and textures of its .glb."""
    modules, index = robot.modules, robot.link(link)
    if kind == "plain":
        plain = modules.plain_meshes.link_meshes[index]
        paths = [] if plain is None else [plain.files.glb]
    elif kind == "hulls":
        hull = modules.convex_hull_meshes.link_hulls[index]
        paths = [] if hull is None else [hull.glb]
    elif kind == "pieces":
        paths = [piece.glb for piece in modules.convex_decomposition_meshes.link_pieces[index]]
    else:
        raise ValueError(f"unknown kind of meshes {kind!r}; expected one of plain, hulls, pieces")
    found: list[Any] = []
    for path in paths:
        scene = trimesh.load_scene(io.BytesIO(robot.read_file(path)), file_type="glb")
        parts = scene.dump()
        found += [part for part in (parts if isinstance(parts, (list, np.ndarray)) else [parts]) if len(part.faces)]
    return found

"""Shapes, and the pairs of them that are skipped."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._answers import SKIP_REASONS, Box, ConvexMesh, ShapeKind, Skips, Spheres, Visual
from ._arrays import Indices
from ._description import RobotDescription


def shapes(robot: RobotDescription, kind: ShapeKind) -> list[ConvexMesh] | list[Box] | Spheres:
    """The shapes of a kind."""
    if kind in ("hulls", "pieces"):
        return convex(robot, kind)
    about = "pieces" if kind.startswith("piece-") else "hulls"
    return spheres(robot, about) if kind.endswith("spheres") else boxes(robot, about)


def convex(robot: RobotDescription, kind: ShapeKind) -> list[ConvexMesh]:
    """The hulls or pieces."""
    found: list[Any] = robot.core.shapes(kind)
    return [
        ConvexMesh(robot.link_names[one["link"]], one["piece"], one["vertices"], _faces(one["faces"])) for one in found
    ]


def boxes(robot: RobotDescription, about: str) -> list[Box]:
    """The bounding box of each of the hulls or pieces."""
    found: list[Any] = robot.core.shapes(_about(about, "boxes", "piece-boxes"))
    return [Box(robot.link_names[one["link"]], one["piece"], one["pose"], one["half_extents"]) for one in found]


def spheres(robot: RobotDescription, about: str) -> Spheres:
    """The bounding sphere of each of the hulls or pieces."""
    found: list[Any] = robot.core.shapes(_about(about, "spheres", "piece-spheres"))
    return Spheres(
        [robot.link_names[one["link"]] for one in found],
        np.array([one["piece"] for one in found], dtype=np.uintp),
        np.array([one["centre"] for one in found], dtype=np.float64).reshape(len(found), 3),
        np.array([one["radius"] for one in found], dtype=np.float64),
    )


def visuals(robot: RobotDescription) -> list[Visual]:
    """The plain mesh of each link, by colour."""
    found: list[Any] = robot.core.visuals()
    return [
        Visual(
            robot.link_names[one["link"]],
            None if one["color"] is None else tuple(one["color"]),
            one["vertices"],
            one["faces"],
        )
        for one in found
    ]


def skips(robot: RobotDescription, kind: ShapeKind) -> Skips:
    """The skipped pairs, and the reasons."""
    places, skipped, reasons = robot.core.skips(kind)
    words = None if reasons is None else [[SKIP_REASONS[number] for number in row] for row in reasons.tolist()]
    links = tuple(robot.link_names[link] for link in places[:, 0].tolist())
    return Skips(kind, links, places[:, 1], skipped, words)


def _faces(faces: Any) -> Indices:
    return np.asarray(faces, dtype=np.uintp)


def _about(about: str, hulls: ShapeKind, pieces: ShapeKind) -> ShapeKind:
    if about not in ("hulls", "pieces"):
        raise ValueError(f"about must be 'hulls' or 'pieces', not {about!r}")
    return hulls if about == "hulls" else pieces

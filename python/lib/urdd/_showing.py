"""What is shown beside a robot, in the form that the page reads (`page/src/showing.ts`)."""

from __future__ import annotations

import json
from base64 import b64encode
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import Floats, configurations, one_configuration
from ._world import World
from .errors import ConfigurationError

#: The shortest time between two configurations of a path, s.
_SHORTEST = 1e-3


def showing(
    dof_names: tuple[str, ...],
    q: ArrayLike | None = None,
    path: ArrayLike | None = None,
    world: World | None = None,
) -> str | None:
    """JSON, or ``None`` if there is nothing beside the robot."""
    shown: dict[str, Any] = {}
    if q is not None:
        shown["q"] = one_configuration(q, dof_names)[0].tolist()
    if path is not None:
        shown["path"] = _path(path, dof_names)
    if world is not None:
        shown["world"] = [
            {"name": name, "pose": _pose(shape, place).ravel().tolist(), "shape": _shape(shape, sizes)}
            for name, shape, (place, *sizes), _ in world.__getstate__()
        ]
    return json.dumps(shown) if shown else None


def _path(path: ArrayLike, dof_names: tuple[str, ...]) -> dict[str, Any]:
    """No DOF is faster than 1 rad/s or 1 m/s."""
    rows, shape = configurations(path, dof_names)
    if len(shape) != 1 or shape[0] == 0:
        raise ConfigurationError(f"a path must have the shape (n, {len(dof_names)}), with n of at least 1")
    steps = np.abs(np.diff(rows, axis=0)).max(axis=1, initial=_SHORTEST)
    return {"times": [0.0, *np.cumsum(steps).tolist()], "rows": rows.tolist()}


def _pose(shape: str, place: Any) -> Floats:
    if shape != "sphere":
        return np.asarray(place, dtype=float)
    pose = np.eye(4)
    pose[:3, 3] = place
    return pose


def _shape(shape: str, sizes: list[Any]) -> dict[str, Any]:
    if shape == "cuboid":
        return {"kind": shape, "half_extents": list(sizes[0])}
    if shape == "sphere":
        return {"kind": shape, "radius": sizes[0]}
    if shape in ("capsule", "cylinder"):
        return {"kind": shape, "radius": sizes[0], "half_length": sizes[1]}
    if shape == "hull":
        return {"kind": shape, "points": _packed(sizes[0])}
    if shape == "mesh":
        faces = b64encode(np.ascontiguousarray(sizes[1], dtype="<u4").tobytes()).decode()
        return {"kind": shape, "vertices": _packed(sizes[0]), "faces": faces}
    if shape == "points":
        return {"kind": shape, "points": _packed(sizes[0]), "radius": sizes[1]}
    heights, cell, thickness = sizes
    columns = int(heights.shape[1])
    field = {"heights": _packed(heights), "columns": columns, "cell": list(cell), "thickness": thickness}
    return {"kind": shape, **field}


def _packed(values: Floats) -> str:
    """Bytes in base64: 32 bits a number."""
    return b64encode(np.ascontiguousarray(values, dtype="<f4").tobytes()).decode()

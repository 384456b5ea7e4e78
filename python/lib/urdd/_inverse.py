"""Inverse kinematics: what is asked, and the answer as arrays."""

from __future__ import annotations

from sys import maxsize
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ._answers import InverseSolutions
from ._arrays import Floats, configurations, numbers, points
from ._options import whole
from .errors import ConfigurationError

if TYPE_CHECKING:
    from ._motion import Moving


def solve(
    robot: Moving,
    link: str | int,
    goals: Floats,
    start: ArrayLike | None,
    point: ArrayLike,
    position_tolerance: float,
    rotation_tolerance: float,
    iterations: int,
    restarts: int,
    seed: int,
    bounds: ArrayLike | None,
) -> InverseSolutions:
    """A configuration for each of some places (n, 3) or poses (n, 4, 4)."""
    count = len(goals)
    starts, batch = configurations(robot.zero if start is None else start, robot.dof_names)
    if batch not in ((), (1,), (count,)):
        raise ConfigurationError(
            f"start must be one configuration, or one for each of the {count} targets: its shape is "
            f"{(*batch, robot.num_dofs)}"
        )
    limits = None
    if bounds is not None:
        limits = numbers(bounds, "bounds")
        if limits.shape != (robot.num_dofs, 2):
            raise ConfigurationError(f"bounds must have the shape ({robot.num_dofs}, 2), and have {limits.shape}")
    if not (position_tolerance >= 0 and rotation_tolerance >= 0):
        raise ConfigurationError("tolerances must be numbers, and not negative")
    found = robot.core.inverse(
        robot.index(link),
        goals if goals.ndim == 3 else goals[:, None, :],
        starts,
        three(point, "a point"),
        (float(position_tolerance), float(rotation_tolerance)),
        whole(iterations, "iterations", 0, maxsize),
        whole(restarts, "restarts", 0, maxsize),
        whole(seed, "a seed", 0, 2**64 - 1),
        limits,
    )
    told = found[:, robot.num_dofs :].T
    return InverseSolutions(
        q=np.ascontiguousarray(found[:, : robot.num_dofs]),
        reached=told[0] > 0,
        position_error=np.ascontiguousarray(told[1]),
        rotation_error=np.ascontiguousarray(told[2]),
        restarts=told[3].astype(np.uintp),
        iterations=told[4].astype(np.uintp),
    )


def three(point: ArrayLike, what: str) -> tuple[float, float, float]:
    """Three finite numbers."""
    x, y, z = points(point, what, 3).tolist()
    return (x, y, z)


def as_targets(
    target: ArrayLike, place: tuple[int | None, ...], pose: tuple[int | None, ...], what: str = "a target"
) -> Floats:
    """Places or poses, which are rotations and translations."""
    given = numbers(target, what)

    def fits(shape: tuple[int | None, ...]) -> bool:
        pairs = zip(given.shape, shape, strict=False)
        return given.ndim == len(shape) and all(want is None or have == want for have, want in pairs)

    if not fits(place) and not fits(pose):
        words = [str(shape).replace("None", "n") for shape in (pose, place)]
        raise ConfigurationError(f"{what} is of shape {words[0]} or {words[1]}, and this of {given.shape}")
    if not np.isfinite(given).all():
        raise ConfigurationError(f"{what} is not finite")
    if fits(pose):
        rotation = given[..., :3, :3]
        unit = np.abs(rotation @ np.swapaxes(rotation, -1, -2) - np.eye(3)).max(initial=0.0) < 1e-6
        last = np.abs(given[..., 3, :] - np.array([0.0, 0.0, 0.0, 1.0])).max(initial=0.0) < 1e-9
        if not (unit and last and bool((np.linalg.det(rotation) > 0).all())):
            raise ConfigurationError(f"{what} is no pose: a rotation, a translation, and the last row 0, 0, 0, 1")
    return given

"""Inverse kinematics: what is asked, and the answer as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ._answers import InverseSolutions
from ._arrays import Floats, configurations, numbers, points
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
    q, reached, errors, effort = robot.core.inverse(
        robot.index(link),
        goals if goals.ndim == 3 else goals[:, None, :],
        starts,
        three(point, "a point"),
        (float(position_tolerance), float(rotation_tolerance)),
        int(iterations),
        int(restarts),
        int(seed),
        limits,
    )
    both = np.array(errors, dtype=np.float64).reshape(count, 2)
    counts = np.array(effort, dtype=np.uintp).reshape(count, 2)
    return InverseSolutions(
        q=q,
        reached=np.array(reached, dtype=np.bool_),
        position_error=both[:, 0],
        rotation_error=both[:, 1],
        restarts=counts[:, 0],
        iterations=counts[:, 1],
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

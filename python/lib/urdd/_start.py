"""The start of a robot in another program: a configuration, and where its base is."""

from __future__ import annotations

from difflib import get_close_matches

from numpy.typing import ArrayLike

from . import _urdd
from ._arrays import Floats, one_configuration
from ._export import Format
from ._kinematics import RobotKinematics
from .errors import UnknownNameError


def start_of(
    robot: RobotKinematics,
    format: Format,  # noqa: A002
    options: dict[str, object],
    start: str | ArrayLike | None,
) -> tuple[Floats, list[float] | None]:
    """(dofs,) and, of a free base, x, y, z and the quaternion w, x, y, z."""
    name = start if isinstance(start, str) else None
    if start is None:
        q = robot.zero
    elif isinstance(start, str):
        named = robot.named_configurations
        if start not in named:
            near = next(iter(get_close_matches(start, named, n=1)), None)
            known = ", ".join(named) or "none: `urdd configurations` adds one"
            raise UnknownNameError(
                f"there is no named configuration `{start}`; there are: {known}", "named configuration", start, near
            )
        q = named[start]
    else:
        q = one_configuration(start, robot.dof_names)[0]
    return q, _urdd.base_pose(robot.core, format, options, name, q.tolist())


def brief(robot: object, **rows: object) -> str:
    """A robot of another program in a few lines, for people."""
    lines = [f"<urdd.{type(robot).__name__}"]
    for name, row in rows.items():
        shown = ", ".join(row) if isinstance(row, tuple) else str(row)
        lines.append(f"  {name}: {shown or 'none'}")
    return "\n".join(lines) + ">"

"""The spheres of a URDD, as a checker takes them."""

from __future__ import annotations

import numpy as np

from ._arrays import Floats
from ._description import RobotDescription
from .errors import ConfigurationError

Level = dict[str, Floats]


def levels_of(robot: RobotDescription, covers: bool) -> tuple[list[Level], set[tuple[str, str]]]:
    """The last level that covers the links, or that does not, after those that it is inside of; and the pairs that it
    ignores."""
    levels = robot.modules.link_shapes_spheres.levels
    found = [number for number, level in enumerate(levels) if level.covers == covers]
    if not found:
        kind = "covers" if covers else "does not cover"
        raise ConfigurationError(f"link_shapes_spheres_module has no level that {kind} the links")
    names = robot.link_names
    at: int | None = found[-1]
    ignored = {(names[pair.link_a_idx], names[pair.link_b_idx]) for pair in levels[found[-1]].ignored_pairs}
    chain: list[Level] = []
    while at is not None:
        level = levels[at]
        chain.append(
            {
                name: np.array([[*sphere.offset_xyz, sphere.radius] for sphere in own])
                for name, own in zip(names, level.spheres, strict=True)
                if own
            }
        )
        outer = level.outer_level_idx
        # A level that is no earlier one is a fault that a validator names.
        at = outer if outer is not None and outer < at else None
    return chain[::-1], ignored

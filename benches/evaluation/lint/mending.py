"""Inertias that a link's shapes give, in place of flagged ones."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import trimesh
from lxml import etree
from model import Link, Robot
from shapes import body_shapes, link_shapes

#: What of an inertial a rule is about.
PART = dict.fromkeys(["LNT001", "LNT004", "LNT005", "SRC004", "SRC005"], "tensor") | {"LNT002": "center"}
PART |= dict.fromkeys(["LNT003", "LNT006", "LNT008", "SRC003"], "all")
CONTROLS = {"control: tensor": "tensor", "control: centre": "center"}
WATER = 1000.0  # kg/m3


class Inertial(NamedTuple):
    mass: float
    center: Any
    tensor: Any

    def xml(self) -> str:
        t, c = self.tensor, self.center
        names = {"ixx": t[0, 0], "ixy": t[0, 1], "ixz": t[0, 2], "iyy": t[1, 1], "iyz": t[1, 2], "izz": t[2, 2]}
        said = " ".join(f'{name}="{float(value)!r}"' for name, value in names.items())
        xyz = " ".join(repr(float(x)) for x in c)
        return f'<inertial><origin xyz="{xyz}"/><mass value="{float(self.mass)!r}"/><inertia {said}/></inertial>'


def part_of(rule: str) -> str:
    return CONTROLS.get(rule) or PART.get(rule, "all")


def hull_of(robot: Robot, name: str, fall_back: bool) -> Any:
    """The hull of a link's shapes in its frame; with `fall_back`, of its body's if it has none. None without volume."""
    own = [points for _, points in link_shapes(robot)[name]]
    if not own and fall_back:
        top = robot.body_of()[name]
        pose = np.linalg.inv(dict(robot.bodies()[top])[name])
        own = [p @ pose[:3, :3].T + pose[:3, 3] for _, p in body_shapes(robot)[top][0]]
    if not own or any(points is None for points in own):
        return None
    try:
        hull = trimesh.convex.convex_hull(np.concatenate(own))
    except Exception:  # flat
        return None
    return hull if hull.volume > 1e-12 else None


def even(hull: Any, mass: float) -> Inertial:
    """A hull evenly filled; without a hull, a ball of water."""
    if hull is None:
        radius = (mass / WATER * 0.75 / np.pi) ** (1 / 3)
        return Inertial(mass, np.zeros(3), np.eye(3) * 0.4 * mass * radius**2)
    hull.density = mass / hull.volume
    return Inertial(mass, hull.center_mass, hull.moment_inertia)


def mended(robot: Robot, name: str, rules: set[str], light: set[str]) -> tuple[Inertial | None, bool]:
    """The inertial that a flagged link gets, and whether the link's geometry gave it. `light`: links without mass."""
    link, parts = robot.links[name], {PART.get(rule) or CONTROLS[rule] for rule in rules}
    mass = link.mass if link.mass and link.mass > 0 else None
    body = [n for n, _ in robot.bodies()[robot.body_of()[name]]]
    hull = hull_of(robot, name, fall_back="all" not in parts)
    if "LNT003" in rules and mass and link.tensor is not None:
        points = np.concatenate([p for _, p in body_shapes(robot)[body[0]][0]])
        factor = WATER * trimesh.convex.convex_hull(points).volume / sum(robot.links[n].mass or 0 for n in body)
        filled = even(hull_of(robot, name, True), mass * factor)
        tensor = filled.tensor if "tensor" in parts else link.tensor * factor
        return Inertial(mass * factor, filled.center if "center" in parts else link.centre, tensor), True
    if "all" in parts:
        if mass is None and (set(body) - light or (hull is None and name != body[0])):
            return None, True
        return even(hull, mass or (WATER * hull.volume if hull else 0.1)), hull is not None
    filled = even(hull, mass or 0.1)
    tensor = filled.tensor if "tensor" in parts or link.tensor is None else link.tensor
    return Inertial(filled.mass, filled.center if "center" in parts else link.centre, tensor), hull is not None


def written(link: Link) -> str:
    return "" if link.inertial is None else etree.tostring(link.inertial, with_tail=False, encoding="unicode")

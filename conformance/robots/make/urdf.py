"""Pieces of URDF text."""

from math import pi

Size = tuple[float, float, float]


def number(value: float) -> str:
    return f"{round(value, 9) + 0.0:.10g}"


def vector(values) -> str:
    return " ".join(number(v) for v in values)


def origin(xyz=(0, 0, 0), rpy=(0, 0, 0)) -> str:
    return f'<origin xyz="{vector(xyz)}" rpy="{vector(rpy)}"/>'


def inertial(mass: float, size: Size, at=(0, 0, 0)) -> str:
    """A solid box of this mass and size."""
    x, y, z = (a * a for a in size)
    ixx, iyy, izz = (mass / 12 * s for s in (y + z, x + z, x + y))
    return (
        f"    <inertial>\n      {origin(at)}\n      <mass value=\"{number(mass)}\"/>\n"
        f'      <inertia ixx="{number(ixx)}" ixy="0" ixz="0" iyy="{number(iyy)}" iyz="0" izz="{number(izz)}"/>\n    </inertial>\n'
    )


def mesh(filename: str, scale=None) -> str:
    scale = f' scale="{vector(scale)}"' if scale else ""
    return f'<mesh filename="{filename}"{scale}/>'


def element(kind: str, geometry: str, xyz=(0, 0, 0), rpy=(0, 0, 0), material: str | None = None) -> str:
    material = f'      <material name="{material}"/>\n' if material else ""
    return f"    <{kind}>\n      {origin(xyz, rpy)}\n      <geometry>{geometry}</geometry>\n{material}    </{kind}>\n"


def visual(geometry: str, xyz=(0, 0, 0), rpy=(0, 0, 0), material: str | None = None) -> str:
    return element("visual", geometry, xyz, rpy, material)


def collision(geometry: str, xyz=(0, 0, 0), rpy=(0, 0, 0)) -> str:
    return element("collision", geometry, xyz, rpy)


def link(name: str, *parts: str) -> str:
    return f'  <link name="{name}">\n{"".join(parts)}  </link>\n' if parts else f'  <link name="{name}"/>\n'


def joint(name: str, kind: str, parent: str, child: str, xyz=(0, 0, 0), rpy=(0, 0, 0), axis=None, limit=None, mimic=None) -> str:
    """`limit` is lower, upper, effort, velocity, each a number or None; `mimic` is the joint, multiplier, offset."""
    lines = [f'    <parent link="{parent}"/>', f'    <child link="{child}"/>', f"    {origin(xyz, rpy)}"]
    if axis:
        lines.append(f'    <axis xyz="{vector(axis)}"/>')
    if limit:
        names = ("lower", "upper", "effort", "velocity")
        given = [f'{name}="{number(value)}"' for name, value in zip(names, limit) if value is not None]
        lines.append(f"    <limit {' '.join(given)}/>")
    if mimic:
        lines.append(f'    <mimic joint="{mimic[0]}" multiplier="{number(mimic[1])}" offset="{number(mimic[2])}"/>')
    return f'  <joint name="{name}" type="{kind}">\n' + "\n".join(lines) + "\n  </joint>\n"


def robot(name: str, says: str, *parts: str) -> str:
    return f'<?xml version="1.0"?>\n<!-- {says} Written by make/make_robots.py. -->\n<robot name="{name}">\n{"".join(parts)}</robot>\n'


def material(name: str, rgba) -> str:
    return f'  <material name="{name}">\n    <color rgba="{vector(rgba)}"/>\n  </material>\n'


__all__ = ["pi", "origin", "inertial", "mesh", "visual", "collision", "link", "joint", "robot", "material"]

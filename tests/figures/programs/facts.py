"""What a URDF says, in the facts that drivers report: for a file that is well-formed and means what it says."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence

Vector = Sequence[float]
Matrix = list[list[float]]


def number(value: float) -> str:
    text = f"{value:.7g}"
    return "0" if text == "-0" else text


def numbers(values: Vector) -> str:
    return " ".join(number(value) for value in values)


def vector(text: str | None, default: str) -> list[float]:
    return [float(value) for value in (default if text is None else text).split()]


def of_rpy(roll: float, pitch: float, yaw: float) -> list[float]:
    """A quaternion wxyz."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(angle / 2), math.sin(angle / 2)) for angle in (roll, pitch, yaw))
    return [
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    ]


def rotation(quaternion: Vector) -> Matrix:
    w, x, y, z = quaternion
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def product(a: Matrix, b: Matrix) -> Matrix:
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def in_link_axes(inertia: Vector, quaternion: Vector) -> list[float]:
    """ixx ixy ixz iyy iyz izz, turned by the inertial frame's rotation."""
    xx, xy, xz, yy, yz, zz = inertia
    r = rotation(quaternion)
    transposed = [list(column) for column in zip(*r, strict=True)]
    turned = product(product(r, [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]), transposed)
    return [turned[0][0], turned[0][1], turned[0][2], turned[1][1], turned[1][2], turned[2][2]]


def pose(element: ET.Element | None, version: str) -> tuple[list[float], list[float]]:
    """Position and quaternion wxyz, w >= 0."""
    if element is None:
        return [0, 0, 0], [1, 0, 0, 0]
    quaternion = element.get("quat_xyzw")
    if quaternion is None or version == "1.0":
        turned = of_rpy(*vector(element.get("rpy"), "0 0 0"))
    else:
        x, y, z, w = vector(quaternion, "")
        norm = math.sqrt(x * x + y * y + z * z + w * w) or 1
        turned = [w / norm, x / norm, y / norm, z / norm]
    if turned[0] < 0:
        turned = [-value for value in turned]
    return vector(element.get("xyz"), "0 0 0"), turned


def shape(element: ET.Element, version: str) -> str | None:
    """The geometry as text, or nothing if it lacks what it needs."""
    try:
        if element.tag == "box":
            return "box " + numbers(vector(element.attrib["size"], ""))
        if element.tag == "sphere":
            return "sphere " + number(float(element.attrib["radius"]))
        if element.tag == "cylinder" or (element.tag == "capsule" and version != "1.0"):
            return f"{element.tag} " + numbers([float(element.attrib["radius"]), float(element.attrib["length"])])
        if element.tag == "mesh":
            return f"mesh {element.attrib['filename']} " + numbers(vector(element.get("scale"), "1 1 1"))
    except KeyError:
        pass
    return None


class Meant:
    """The facts of one document."""

    def __init__(self, root: ET.Element) -> None:
        self.root = root
        self.version = root.get("version", "1.0")
        self.facts: dict[str, str] = {}
        self.materials: dict[str, tuple[str | None, str | None]] = {}
        if (name := root.get("name")) is not None:
            self.facts["robot"] = name
        for material in root.findall("material"):
            self.material(material)
        for link in root.findall("link"):
            for visual in link.findall("visual"):
                if (material := visual.find("material")) is not None:
                    self.material(material)
        for name, (color, texture) in self.materials.items():
            self.facts[f"material/{name}"] = color or texture or ""
        for link in root.findall("link"):
            self.link(link)
        for joint in root.findall("joint"):
            self.joint(joint)
        for transmission in root.findall("transmission"):
            joint_name = transmission.find("joint")
            if (name := transmission.get("name")) is not None and joint_name is not None:
                self.facts[f"transmission/{name}"] = joint_name.get("name", "")

    def material(self, element: ET.Element) -> None:
        if (look := self.look(element)) is not None:
            self.materials.setdefault(element.get("name", ""), look)

    def look(self, element: ET.Element) -> tuple[str | None, str | None] | None:
        """The colour and the texture that a material has itself."""
        color, texture = element.find("color"), element.find("texture")
        if color is None and texture is None:
            return None
        rgba = numbers(vector(color.get("rgba"), "0 0 0 1")) if color is not None else None
        return rgba, texture.get("filename") if texture is not None else None

    def link(self, link: ET.Element) -> None:
        key = f"link/{link.get('name', '')}"
        self.facts[key] = "1"
        if (inertial := link.find("inertial")) is not None:
            self.inertial(key, inertial)
        for kind in ("visual", "collision"):
            parts = [part for part in link.findall(kind) if self.geometry(part) is not None]
            if parts:
                self.facts[f"{key}/{kind}"] = str(len(parts))
            for i, part in enumerate(parts):
                self.part(f"{key}/{kind}/{i}", part)

    def inertial(self, key: str, inertial: ET.Element) -> None:
        self.facts[f"{key}/inertial"] = "1"
        position, turned = pose(inertial.find("origin"), self.version)
        mass, inertia = inertial.find("mass"), inertial.find("inertia")
        if mass is not None and mass.get("value") is not None:
            self.facts[f"{key}/inertial/mass"] = number(float(mass.attrib["value"]))
        self.facts[f"{key}/inertial/com"] = numbers(position)
        if inertia is not None:
            values = [float(inertia.get(name, "0")) for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")]
            self.facts[f"{key}/inertial/inertia"] = numbers(in_link_axes(values, turned))

    def geometry(self, part: ET.Element) -> str | None:
        geometry = part.find("geometry")
        shapes = [shape(child, self.version) for child in geometry] if geometry is not None else []
        return next((found for found in shapes if found), None)

    def part(self, key: str, part: ET.Element) -> None:
        position, turned = pose(part.find("origin"), self.version)
        self.facts[f"{key}/geometry"] = self.geometry(part) or ""
        self.facts[f"{key}/origin"] = numbers([*position, *turned])
        if (name := part.get("name")) is not None:
            self.facts[f"{key}/name"] = name
        if (material := part.find("material")) is not None:
            # Its own, whatever others of the name have.
            color, texture = self.look(material) or self.materials.get(material.get("name", ""), (None, None))
            if color:
                self.facts[f"{key}/color"] = color
            if texture:
                self.facts[f"{key}/texture"] = texture

    def joint(self, joint: ET.Element) -> None:
        key = f"joint/{joint.get('name', '')}"
        kind = joint.get("type", "")
        self.facts[key] = kind
        for name in ("parent", "child"):
            if (found := joint.find(name)) is not None and found.get("link") is not None:
                self.facts[f"{key}/{name}"] = found.attrib["link"]
        position, turned = pose(joint.find("origin"), self.version)
        self.facts[f"{key}/origin"] = numbers([*position, *turned])
        if kind not in ("fixed", "floating"):
            axis = joint.find("axis")
            self.facts[f"{key}/axis"] = numbers(vector(axis.get("xyz") if axis is not None else None, "1 0 0"))
        if kind != "fixed":
            self.limits(joint, kind)
        if (mimic := joint.find("mimic")) is not None and mimic.get("joint") is not None:
            values = [float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))]
            self.facts[f"{key}/mimic"] = f"{mimic.attrib['joint']} {numbers(values)}"
        if (safety := joint.find("safety_controller")) is not None:
            names = ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")
            self.facts[f"{key}/safety"] = numbers([float(safety.get(name, "0")) for name in names])
        if (calibration := joint.find("calibration")) is not None:
            edges = [calibration.get(name) for name in ("rising", "falling")]
            self.facts[f"{key}/calibration"] = " ".join("-" if edge is None else number(float(edge)) for edge in edges)

    def limits(self, joint: ET.Element, kind: str) -> None:
        self.named(joint, "limit", ("velocity", "effort"))
        if kind != "continuous":
            self.named(joint, "limit", ("lower", "upper"), "0")
        if self.version == "1.2":
            self.named(joint, "limit", ("acceleration", "deceleration", "jerk"))
        self.named(joint, "dynamics", ("damping", "friction"), "0")

    def named(self, joint: ET.Element, tag: str, names: tuple[str, ...], default: str | None = None) -> None:
        if (element := joint.find(tag)) is None:
            return
        for name in names:
            text = element.get(name, default)
            if text is not None:
                self.facts[f"joint/{joint.get('name', '')}/{name}"] = number(float(text))


def otherwise(before: dict[str, str], after: dict[str, str]) -> dict[str, str | None]:
    """Facts that are otherwise, None for one that is gone."""
    gone: dict[str, str | None] = {key: None for key in before if key not in after}
    return gone | {key: value for key, value in after.items() if before.get(key) != value}


def meant(data: bytes) -> dict[str, str]:
    return Meant(ET.fromstring(data)).facts

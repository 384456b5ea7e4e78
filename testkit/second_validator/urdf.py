"""Reading a URDF (6.1.8, 6.1.9), into the form that `urdf_module` has."""

from __future__ import annotations

import functools
import math
import re
from typing import Any

from .numeric import number
from .xmltree import Element, NotXml, read_xml

TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar", "spherical")
SPACE = " \t\n\r"
VERSION = re.compile(r"[ \t\n\r]*([0-9]+)\.([0-9]+)[ \t\n\r]*")
IN_ROBOT = ("link", "joint", "material")
IN_LINK = ("inertial", "visual", "collision")
IN_JOINT = ("origin", "parent", "child", "axis", "limit", "dynamics", "mimic", "safety_controller")
IN_JOINT += ("calibration",)
SHAPES = ("mesh", "box", "cylinder", "capsule", "sphere")


def text(element: Element, name: str) -> str:
    """An attribute that has to be there."""
    if name not in element.attributes:
        raise NotXml
    return element.attributes[name]


def numbers(element: Element, name: str, count: int, needed: bool = False) -> Any:
    """An attribute of numbers: None where it is absent, or one of them is not finite."""
    if name not in element.attributes:
        if needed:
            raise NotXml
        return None
    words = [word for word in re.split(f"[{SPACE}]", element.attributes[name]) if word]
    values = [number(word) for word in words]
    if len(values) != count or None in values:
        raise NotXml
    if not all(math.isfinite(value) for value in values):
        if needed:
            raise NotXml
        return None
    return values[0] if count == 1 else values


def single(element: Element | None, *names: str) -> Any:
    """An object of numbers that may be absent, each alone."""
    return element and {name: numbers(element, name, 1) for name in names}


class UrdfReader:
    """Reads the elements that count."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.states_quaternions = False

    def unknown(self, element: Element, known: tuple[str, ...]) -> list[str]:
        """6.1.1: the text of the elements that URDF does not define."""
        return [
            self.data[child.start : child.end].decode()
            for child in element.children
            if child.name not in known
        ]

    def robot(self) -> dict[str, Any]:
        root = read_xml(self.data)
        if root.name != "robot":
            raise NotXml
        name = text(root, "name")
        version = VERSION.fullmatch(root.attributes.get("version", ""))
        if version:
            self.states_quaternions = (int(version[1]), int(version[2])) >= (1, 1)
        return {
            "name": name,
            "version": root.attributes.get("version"),
            "links": [self.link(child) for child in root.all("link")],
            "joints": [self.joint(child) for child in root.all("joint")],
            "materials": [self.material(child) for child in root.all("material")],
            "unknown_elements": self.unknown(root, IN_ROBOT),
        }

    def link(self, element: Element) -> dict[str, Any]:
        inertial = element.first("inertial")
        return {
            "name": text(element, "name"),
            "inertial": inertial and self.inertial(inertial),
            "visual": [self.shown(child, True) for child in element.all("visual")],
            "collision": [self.shown(child, False) for child in element.all("collision")],
            "unknown_elements": self.unknown(element, IN_LINK),
        }

    def origin(self, element: Element) -> Any:
        """6.1.9."""
        found = element.first("origin")
        if not found:
            return None
        if self.states_quaternions and {"rpy", "quat_xyzw"} <= found.attributes.keys():
            raise NotXml
        return {
            "xyz": numbers(found, "xyz", 3),
            "rpy": numbers(found, "rpy", 3),
            "quat_xyzw": numbers(found, "quat_xyzw", 4),
        }

    def inertial(self, element: Element) -> dict[str, Any]:
        mass = element.first("mass")
        value = mass and numbers(mass, "value", 1)
        moments = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        return {
            "origin": self.origin(element),
            "mass": None if value is None else {"value": value},
            "inertia": single(element.first("inertia"), *moments),
        }

    def shown(self, element: Element, visual: bool) -> dict[str, Any]:
        """A visual or collision element."""
        geometry = element.first("geometry")
        shape = geometry.first(*SHAPES) if geometry else None
        found = {
            "name": element.attributes.get("name"),
            "origin": self.origin(element),
            "geometry": shape and self.shape(shape),
        }
        if visual:
            material = element.first("material")
            found["material"] = material and self.material(material)
        return found

    def shape(self, element: Element) -> dict[str, Any]:
        if element.name == "mesh":
            inside: dict[str, Any] = {"filename": text(element, "filename")}
            inside["scale"] = numbers(element, "scale", 3)
        elif element.name == "box":
            inside = {"size": numbers(element, "size", 3, True)}
        else:
            inside = {"radius": numbers(element, "radius", 1, True)}
            if element.name != "sphere":
                inside["length"] = numbers(element, "length", 1, True)
        return {element.name.capitalize(): inside}

    def material(self, element: Element) -> dict[str, Any]:
        color, texture = element.first("color"), element.first("texture")
        rgba = color and numbers(color, "rgba", 4)
        filename = texture and texture.attributes.get("filename")
        return {
            "name": element.attributes.get("name"),
            "color": rgba and {"rgba": rgba},
            "texture": None if filename is None else {"filename": filename},
        }

    def joint(self, element: Element) -> dict[str, Any]:
        parent, child = element.first("parent"), element.first("child")
        if text(element, "type") not in TYPES or not parent or not child:
            raise NotXml
        axis, mimic = element.first("axis"), element.first("mimic")
        limits = ("lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk")
        soft = ("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity")
        return {
            "name": text(element, "name"),
            "joint_type": text(element, "type").capitalize(),
            "origin": self.origin(element),
            "parent": {"link": text(parent, "link")},
            "child": {"link": text(child, "link")},
            "axis": axis and {"xyz": numbers(axis, "xyz", 3)},
            "limit": single(element.first("limit"), *limits),
            "dynamics": single(element.first("dynamics"), "damping", "friction"),
            "mimic": mimic
            and {"joint": text(mimic, "joint")} | single(mimic, "multiplier", "offset"),
            "safety_controller": single(element.first("safety_controller"), *soft),
            "calibration": single(element.first("calibration"), "rising", "falling"),
            "unknown_elements": self.unknown(element, IN_JOINT),
        }


@functools.lru_cache(maxsize=1024)
def read_urdf(data: bytes) -> dict[str, Any]:
    """What a URDF says. Raises NotXml where it is not readable (6.1.8)."""
    return UrdfReader(data).robot()

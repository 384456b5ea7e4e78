"""A URDF as the rules see it, and the list of the rules."""
import json, math, os, re, sys
from pathlib import Path
from urllib.parse import unquote

import numpy as np
from lxml import etree
from scipy.spatial import ConvexHull, QhullError

from meshes import summary

MOVING = {"revolute", "continuous", "prismatic", "planar", "floating", "spherical"}
WITH_AXIS = {"revolute", "continuous", "prismatic", "planar"}
ONE_DOF = {"revolute", "continuous", "prismatic"}
NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\Z")

RULES = {}


def rule(code, name):
    """Registers a rule: a function of a Robot that yields (element, message, data)."""
    def register(function):
        RULES[code] = (name, function)
        return function
    return register


def numbers(text, n):
    """The n finite numbers in `text`, or None."""
    if text is None:
        return None
    parts = text.split()
    if len(parts) != n or not all(NUMBER.match(p) for p in parts):
        return None
    values = [float(p) for p in parts]
    return values if all(map(math.isfinite, values)) else None


def number(text):
    values = numbers(text, 1)
    return values[0] if values else None


def tag(element):
    """The name as it is written, prefix included; '' for comments."""
    if not isinstance(element.tag, str):
        return ""
    name = element.tag.rpartition("}")[2]                    # a prefix that is not declared stays in the name
    return f"{element.prefix}:{name}" if element.prefix else name


def children(element, *names):
    return [] if element is None else [c for c in element if tag(c) in names]


def child(element, name):
    found = children(element, name)
    return found[0] if found else None


def get(element, name):
    return None if element is None else element.get(name)


def rotation(rpy):
    r, p, y = rpy
    cr, sr, cp, sp, cy, sy = math.cos(r), math.sin(r), math.cos(p), math.sin(p), math.cos(y), math.sin(y)
    return np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                     [-sp, cp * sr, cp * cr]])


def pose(element):
    """4x4 of the element's `origin`."""
    origin = child(element, "origin")
    t = np.eye(4)
    t[:3, 3] = numbers(get(origin, "xyz"), 3) or [0, 0, 0]
    t[:3, :3] = rotation(numbers(get(origin, "rpy"), 3) or [0, 0, 0])
    return t


class Link:
    def __init__(self, element):
        self.element = element
        self.name = element.get("name", "")
        self.visuals = children(element, "visual")
        self.collisions = children(element, "collision")
        self.inertial = child(element, "inertial")
        self.mass = number(get(child(self.inertial, "mass"), "value")) if self.inertial is not None else None
        self.tensor = None                                   # about the centre of mass, in the link's frame
        self.centre = np.zeros(3)
        if self.inertial is not None:
            frame = pose(self.inertial)
            self.centre = frame[:3, 3]
            inertia = child(self.inertial, "inertia")
            if inertia is not None:
                xx, xy, xz, yy, yz, zz = (number(inertia.get(k)) or 0.0 for k in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
                self.raw = (xx, xy, xz, yy, yz, zz)
                r = frame[:3, :3]
                self.tensor = r @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ r.T


class Joint:
    def __init__(self, element):
        self.element = element
        self.name = element.get("name", "")
        self.type = element.get("type", "")
        self.parent = get(child(element, "parent"), "link")
        self.child = get(child(element, "child"), "link")
        self.origin = pose(element)
        self.limit = child(element, "limit")
        self.mimic = child(element, "mimic")
        self.axis_element = child(element, "axis")
        self.axis = numbers(get(self.axis_element, "xyz"), 3)

    def bound(self, name):
        """A number of `limit`, or None."""
        return number(get(self.limit, name))


class Robot:
    def __init__(self, path, root=None):
        self.path = Path(path).resolve()
        self.root = Path(root).resolve() if root else None
        self.text = self.path.read_bytes().lstrip(b"\xef\xbb\xbf \t\r\n").rstrip(b"\0")
        self.text = re.sub(rb"^(<\?xml[^>]*version\s*=\s*)([\"'])0\.0[\"']", rb"\1\g<2>1.0\2", self.text)   # SPEC 6.1.8, repairs
        if b"<?xml" in self.text[5:2000] and re.match(rb"\s*<!--", self.text):
            self.text = self.text[self.text.index(b"<?xml"):]                                           # a comment before the declaration
        parser = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=True)
        try:
            self.xml = etree.fromstring(self.text, parser)
        except etree.XMLSyntaxError as error:
            if "prefix" not in str(error).lower() or "not defined" not in str(error):
                raise
            parser = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=True, recover=True)
            self.xml = etree.fromstring(self.text, parser)
        if tag(self.xml) != "robot":
            raise ValueError(f"the root element is <{tag(self.xml)}>, not <robot>")
        self.name = self.xml.get("name", "")
        self.links, self.joints = {}, {}
        for element in children(self.xml, "link"):
            self.links.setdefault(element.get("name", ""), Link(element))
        for element in children(self.xml, "joint"):
            self.joints.setdefault(element.get("name", ""), Joint(element))
        self.above = {j.child: j for j in self.joints.values() if j.parent in self.links and j.child in self.links}
        moved = {j.child for j in self.joints.values()}
        self.roots = [n for n in self.links if n not in moved]
        self.xacro = any(isinstance(e.tag, str) and (tag(e).startswith("xacro:") or any("${" in v or "$(" in v for v in e.attrib.values()))
                         for e in self.xml.iter())
        self._files = {}

    # ---- bodies
    def body_of(self):
        """Link name -> name of the topmost link that fixed joints connect it with."""
        top = {}
        for name in self.links:
            trail, at = [], name
            while at not in top:
                trail.append(at)
                joint = self.above.get(at)
                if joint is None or joint.type != "fixed" or joint.parent in trail:
                    top[at] = at
                    break
                at = joint.parent
            for n in trail:
                top[n] = top[at]
        return top

    def bodies(self):
        """Topmost link -> list of (link name, 4x4 of the link in the topmost link's frame)."""
        top, result = self.body_of(), {}
        for name in self.links:
            t, at = np.eye(4), name
            while at != top[name]:
                t = self.above[at].origin @ t
                at = self.above[at].parent
            result.setdefault(top[name], []).append((name, t))
        return result

    def zero_poses(self):
        """Link name -> 4x4 in its root's frame, every joint at zero."""
        poses = {}

        def of(name, seen=()):
            if name not in poses:
                joint = self.above.get(name)
                if joint is None or name in seen:
                    poses[name] = np.eye(4)
                else:
                    poses[name] = of(joint.parent, seen + (name,)) @ joint.origin
            return poses[name]
        for name in self.links:
            of(name)
        return poses

    # ---- files
    def find(self, filename):
        """(path or None, why): the file that `filename` names, as ROS and Pinocchio find it."""
        if filename not in self._files:
            self._files[filename] = self._find(filename)
        return self._files[filename]

    def _find(self, filename):
        scheme = re.match(r"(package|model)://([^/]*)/?(.*)\Z", filename)
        if scheme:
            package, rest = scheme.group(2), scheme.group(3)
            seen = False
            for folder in self.path.parents:
                for base in ([folder] if folder.name == package else []) + [folder / package]:
                    if base.is_dir():
                        seen = True
                        if (base / rest).is_file():
                            return base / rest, "found"
                if self.root and folder == self.root:
                    break
            return None, "file-not-found" if seen else "package-not-found"
        name = filename
        if name.startswith("file://"):
            name = unquote(name[7:])
        path = Path(name) if name.startswith("/") else self.path.parent / name
        return (path, "found") if path.is_file() else (None, "file-not-found")

    def geometries(self, *kinds):
        """(link, 'visual'|'collision', index, element, shape element) of every shape."""
        for link in self.links.values():
            for kind, elements in (("visual", link.visuals), ("collision", link.collisions)):
                if kinds and kind not in kinds:
                    continue
                for index, element in enumerate(elements):
                    geometry = child(element, "geometry")
                    shapes = children(geometry, "mesh", "box", "cylinder", "sphere", "capsule")
                    if shapes:
                        yield link, kind, index, element, shapes[0]

    def meshes(self, *kinds):
        for link, kind, index, element, shape in self.geometries(*kinds):
            if tag(shape) == "mesh" and shape.get("filename"):
                yield link, kind, index, element, shape


def where(kind, name):
    return f"{kind} {name}"

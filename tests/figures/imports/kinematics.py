"""A URDF as numbers: poses of its links by NumPy alone, and what its links and joints say."""

import xml.etree.ElementTree as ET

import numpy as np


def floats(text, count):
    values = np.array([float(word) for word in (text or "").split()])
    return values if len(values) == count else np.zeros(count)


def rpy(angles):
    (cr, cp, cy), (sr, sp, sy) = np.cos(angles), np.sin(angles)
    return np.array([
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ])


def pose(rotation, position):
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation, position
    return matrix


def origin(element):
    of = element.find("origin") if element is not None else None
    if of is None:
        return np.eye(4)
    return pose(rpy(floats(of.get("rpy"), 3)), floats(of.get("xyz"), 3))


def turn(axis, angles):
    """Rotations about an axis, one an angle."""
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    sines, cosines = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    return np.eye(3) + sines * cross + (1 - cosines) * (cross @ cross)


def along(joint):
    axis = joint.find("axis")
    xyz = floats(axis.get("xyz"), 3) if axis is not None else np.array([1.0, 0, 0])
    return xyz / max(np.linalg.norm(xyz), 1e-300)


def plane(normal):
    """SPEC's two axes of a plane: x and y, turned on the shortest way that takes z to the normal."""
    x, y, z = normal / np.linalg.norm(normal)
    if np.hypot(x, y) < 1e-12:
        return np.array([[1, 0, 0], [0, np.sign(z), 0]])
    around = np.array([-y, x, 0])
    return (turn(around, np.arctan2([np.hypot(x, y)], [z]))[0] @ np.eye(3)[:, :2]).T


def of_quaternion(q):
    w, x, y, z = np.moveaxis(np.asarray(q, float), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, -1) for row in rows], -2)


class Urdf:
    def __init__(self, path):
        self.path = path
        self.root_element = ET.parse(path).getroot()
        self.links = {link.get("name"): link for link in self.root_element.findall("link")}
        self.joints = self.root_element.findall("joint")
        self.into = {joint.find("child").get("link"): joint for joint in self.joints}
        self.root = next(name for name in self.links if name not in self.into)
        self.moving = [joint for joint in self.joints if joint.get("type") != "fixed"]

    def bodies(self):
        """The links, in order, without those between two joints of a body."""
        def between(name):
            joint = self.into.get(name)
            return joint is not None and name.endswith("/" + joint.get("name"))
        return [name for name in self.links if not between(name)]

    def poses(self, values, count):
        """The pose of each link in the root, `count` of each. Values by joint: numbers, or of a sphere rotations."""
        found = {self.root: np.broadcast_to(np.eye(4), (count, 4, 4))}

        def value(joint):
            mimic = joint.find("mimic")
            if mimic is None:
                return values[joint.get("name")]
            leader = next(of for of in self.joints if of.get("name") == mimic.get("joint"))
            return float(mimic.get("multiplier", 1)) * value(leader) + float(mimic.get("offset", 0))

        def of(link):
            chain = []
            while link not in found:
                chain.append(link)
                link = self.into[link].find("parent").get("link")
            for link in reversed(chain):
                joint = self.into[link]
                moved = np.broadcast_to(np.eye(4), (count, 4, 4)).copy()
                kind = joint.get("type")
                if kind in ("revolute", "continuous"):
                    moved[:, :3, :3] = turn(along(joint), value(joint))
                elif kind == "prismatic":
                    moved[:, :3, 3] = value(joint)[:, None] * along(joint)
                elif kind == "spherical":
                    moved[:, :3, :3] = value(joint)
                elif kind == "planar":
                    # SPEC 5.8: along two axes of the plane, then about its normal.
                    normal, places = along(joint), value(joint)
                    moved[:, :3, :3] = turn(normal, places[:, 2])
                    moved[:, :3, 3] = places[:, :2] @ plane(normal)
                elif kind == "floating":
                    moved[:] = value(joint)
                elif kind != "fixed":
                    raise ValueError(f"a joint of type {kind}")
                parent = found[joint.find("parent").get("link")]
                found[link] = parent @ origin(joint) @ moved

        for link in self.links:
            of(link)
        return found

    def inertial(self, link):
        """Mass, centre, and the inertia along the axes of the link."""
        element = self.links[link].find("inertial")
        if element is None:
            return 0.0, np.zeros(3), np.zeros((3, 3))
        of = {key: float(value) for key, value in element.find("inertia").attrib.items()}
        inertia = np.array([
            [of["ixx"], of["ixy"], of["ixz"]],
            [of["ixy"], of["iyy"], of["iyz"]],
            [of["ixz"], of["iyz"], of["izz"]],
        ])
        at = origin(element)
        turned = at[:3, :3] @ inertia @ at[:3, :3].T
        return float(element.find("mass").get("value")), at[:3, 3], turned

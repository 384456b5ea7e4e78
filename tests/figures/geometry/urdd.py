"""Reads the parts of a URDD directory that the scripts beside this file compare: documents, STL files, the carried URDF.

Nothing here knows how the generator works: binary STL and URDF are read in a few lines, so that a mistake of the
generator's own readers cannot hide.
"""

import json
import pathlib
import xml.etree.ElementTree as ET

import numpy as np


class Urdd:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.metadata = json.loads((self.root / "urdd.json").read_text())
        self.urdf_path = self.root / self.metadata["source"]["Urdf"]["path"]
        self.paths = {module["name"]: module["path"] for module in self.metadata["modules"]}

    def document(self, module):
        """The document of a module, by the module's name."""
        return json.loads((self.root / self.paths[module] / "module.json").read_text())

    def urdf(self):
        """The root element of the carried URDF."""
        return ET.parse(self.urdf_path).getroot()

    def triangles(self, path):
        """The corners of a binary STL file: (n, 3, 3), metres, link frame."""
        data = (self.root / path).read_bytes()
        count = int.from_bytes(data[80:84], "little")
        assert len(data) == 84 + 50 * count, f"{path} is no binary STL"
        record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        return np.frombuffer(data, record, count, 84)["corners"].astype(float)


def indexed(triangles):
    """Corners (n, 3, 3) as vertices, each position once, and faces."""
    vertices, faces = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    return vertices, faces.reshape(-1, 3)


def numbers(text, default):
    return np.array([float(x) for x in text.split()] if text else default)


def rotation(rpy):
    """Rz(yaw) Ry(pitch) Rx(roll), SPEC 5.4."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array([
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ])


def planes(triangles):
    """Outward unit normals and offsets of a convex body's faces: inside is normals @ p <= offsets. Slivers are left out."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normals = np.cross(b - a, c - a)
    length = np.linalg.norm(normals, axis=1)
    keep = length > 1e-16
    normals, a = normals[keep] / length[keep, None], a[keep]
    centre = triangles.reshape(-1, 3).mean(0)
    normals[np.einsum("ij,ij->i", normals, centre - a) > 0] *= -1
    return normals, np.einsum("ij,ij->i", normals, a)

"""Whether the files of derived meshes are sound, and hold the same triangles (7.6)."""

from __future__ import annotations

import functools
import math
import re
import struct
from typing import Any

from .faces import UNPLACED, Face, NotMesh, triangles_of
from .geometry import (
    RESOLUTION,
    Triangle,
    largest_coordinate,
    least_height,
    normal,
    resolution,
    same_triangles,
)
from .gltf import (
    FAN,
    JSON_CHUNK,
    STRIP,
    TRIANGLES,
    GltfReader,
    chunks_of,
    local,
    split_glb,
)
from .mesh import HEADER, RECORD, read_obj
from .numeric import distance, norm

NORMAL_TOLERANCE = 1e-3  # 7.6
EXTENSIONS = re.compile(r"[A-Za-z0-9]+_(?:texture|lights|materials)_")
INSTANCES = "EXT_mesh_gpu_instancing"


class Unsound(Exception):
    """A derived file that breaks 7.6 (MSH013)."""


def require(holds: bool) -> None:
    if not holds:
        raise Unsound


def is_binary_gltf(data: bytes) -> bool:
    """7.6: the header and the list of chunks of a GLB (MSH010)."""
    if len(data) < 20 or data[:4] != b"glTF":
        return False
    version, length = struct.unpack_from("<II", data, 4)
    try:
        chunks = chunks_of(data)
    except NotMesh:
        return False
    total = 12 + sum(8 + len(chunk) for _, chunk in chunks)
    aligned = all(len(chunk) % 4 == 0 for _, chunk in chunks)
    first = chunks[0][0] if chunks else None
    return version == 2 and length == len(data) == total and aligned and first == JSON_CHUNK


def check_finite(triangles: list[Triangle]) -> None:
    require(len(triangles) > 0)
    numbers = [part for triangle in triangles for corner in triangle for part in corner]
    require(all(math.isfinite(part) for part in numbers))


def sound_stl(data: bytes) -> list[Triangle]:
    """7.6: binary STL."""
    require(len(data) >= HEADER)
    count = int.from_bytes(data[80:84], "little")
    require(len(data) == HEADER + RECORD * count)
    triangles = []
    normals = []
    for n in range(count):
        numbers = struct.unpack_from("<12f", data, HEADER + RECORD * n)
        triangles.append((numbers[3:6], numbers[6:9], numbers[9:12]))
        normals.append(numbers[0:3])
        require(data[HEADER + RECORD * n + 48 : HEADER + RECORD * n + 50] == b"\0\0")
    check_finite(triangles)
    for stated, triangle in zip(normals, triangles):
        thin = RESOLUTION / NORMAL_TOLERANCE * largest_coordinate([triangle])
        if any(stated) and least_height(triangle) > thin:
            require(distance(stated, normal(triangle)) <= NORMAL_TOLERANCE)
    return triangles


def is_face(line: list[str]) -> bool:
    """7.5: a face of fewer than three corners is nothing."""
    return line[0] in ("f", "fo") and len(line) > 3


def sound_obj(data: bytes) -> list[Face]:
    """7.6: OBJ."""
    words = [line.split() for line in data.decode("latin-1").replace("\\\n", " ").splitlines()]
    lines = [line for line in words if line]
    require(all(line[0] != "mtllib" for line in lines))
    faces = read_obj(data)
    require(len(faces) == len([line for line in lines if is_face(line)]))
    used: set[int] = set()
    count = 0
    for line in lines:
        if line[0] == "v":
            count += 1
        if is_face(line):
            places = [int(word.split("/")[0]) for word in line[1:]]
            used |= {place - 1 if place > 0 else count + place for place in places}
    require(used == set(range(count)))
    check_finite([(c, c, c) for face in faces for c in face.corners])  # type: ignore[misc]
    return faces


def check_document(document: Any) -> None:
    """7.6: what a GLB may not have anywhere."""
    require(not document.get("animations"))
    for entry in [*document.get("images", []), *document.get("buffers", [])]:
        require(entry.get("uri", "data:").startswith("data:"))
    for name in document.get("extensionsRequired", []):
        require(name == "KHR_mesh_quantization" or EXTENSIONS.match(name))


def check_node(reader: GltfReader, place: Any) -> list[Any]:
    """7.6: a node that the scene reaches; gives the primitives of it and of those below."""
    node = reader.item("nodes", place)
    require(local(node) == UNPLACED)
    require("skin" not in node and INSTANCES not in node.get("extensions", {}))
    mesh = reader.item("meshes", node["mesh"]) if "mesh" in node else {"primitives": []}
    require("weights" not in mesh or not mesh["weights"])
    found = list(mesh["primitives"])
    for child in node.get("children", []):
        found += check_node(reader, child)
    return found


def check_primitive(reader: GltfReader, primitive: Any) -> None:
    """7.6: a primitive shows triangles, and says the truth of its positions."""
    require(primitive.get("mode", TRIANGLES) in (TRIANGLES, STRIP, FAN))
    require(not primitive.get("targets"))
    accessor = reader.item("accessors", primitive["attributes"]["POSITION"])
    positions = reader.positions(primitive["attributes"]["POSITION"])
    if "indices" in primitive:
        indices = reader.indices(primitive["indices"])
    else:
        indices = list(range(len(positions)))
    require(set(indices) == set(range(len(positions))))
    require(primitive.get("mode", TRIANGLES) != TRIANGLES or len(indices) % 3 == 0)
    stored = reader.rows(accessor, 3)
    for key, extreme in (("min", min), ("max", max)):
        if key in accessor:
            right = [extreme(row[axis] for row in stored) for axis in range(3)]
            stated = [struct.unpack("<f", struct.pack("<f", value))[0] for value in accessor[key]]
            require(stated == right)
    if "NORMAL" in primitive["attributes"]:
        normals = reader.positions(primitive["attributes"]["NORMAL"])
        require(len(normals) == len(positions))
        require(all(abs(norm(one) - 1) <= NORMAL_TOLERANCE for one in normals))


def sound_glb(data: bytes) -> list[Triangle]:
    """7.6: binary glTF, as it stands."""
    document, binary = split_glb(data)
    check_document(document)
    reader = GltfReader(document, binary, lambda _: None)
    faces = reader.show()
    for root in reader.roots():
        for primitive in check_node(reader, root):
            check_primitive(reader, primitive)
    triangles = [tuple(face.corners) for face in faces]
    check_finite(triangles)  # type: ignore[arg-type]
    return triangles  # type: ignore[return-value]


@functools.lru_cache(maxsize=2048)
def sound(data: bytes, kind: str) -> list[Triangle] | None:
    """The triangles of a derived file, or None where it is not sound."""
    try:
        if kind == "stl":
            return sound_stl(data)
        if kind == "glb":
            return sound_glb(data)
        return [tuple(t) for face in sound_obj(data) for t in triangles_of(face)]  # type: ignore[misc]
    except (Unsound, NotMesh, KeyError, TypeError, AttributeError, IndexError, ValueError):
        return None


@functools.lru_cache(maxsize=2048)
def files_agree(glb: bytes, other: bytes, kind: str) -> bool:
    """7.6: whether two files of one mesh hold the same triangles (MSH014)."""
    one, two = sound(glb, "glb") or [], sound(other, kind) or []
    return same_triangles(one, two, max(resolution(one), resolution(two)))

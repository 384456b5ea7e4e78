"""What a glTF or GLB file shows (7.5)."""

from __future__ import annotations

import base64
import binascii
import struct
from collections.abc import Callable
from typing import Any
from urllib.parse import unquote_to_bytes

from .faces import (
    MAX_NODES_INSIDE,
    MAX_TRIANGLES,
    MAX_VISITS,
    UNPLACED,
    Affine,
    Face,
    NotMesh,
    then,
)
from .jsontext import TextFault, read_json
from .numeric import from_quaternion

Fetch = Callable[[str], bytes | None]
JSON_CHUNK, BIN_CHUNK = 0x4E4F534A, 0x004E4942
COMPRESSED = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression")
COMPONENTS = {5120: ("b", 127), 5121: ("B", 255), 5122: ("h", 32767), 5123: ("H", 65535)}
COMPONENTS |= {5125: ("I", 4294967295), 5126: ("f", 1)}
INDEX_COMPONENTS = (5121, 5123, 5125)
TRIANGLES, STRIP, FAN = 4, 5, 6


class GltfReader:
    """Follows a document from its scene. What is missing or misshapen raises NotMesh."""

    def __init__(self, document: Any, binary: bytes | None, fetch: Fetch) -> None:
        self.document = document
        self.binary = binary
        self.fetch = fetch
        self.visits = 0
        self.triangles = 0
        self.buffers: dict[int, bytes] = {}
        self.faces: list[Face] = []
        self.primitives: dict[tuple[int, int], list[Face]] = {}

    def item(self, kind: str, place: Any) -> Any:
        """What a place in a list of the document names."""
        items = self.document.get(kind, [])
        if isinstance(place, bool) or not isinstance(place, int) or not 0 <= place < len(items):
            raise NotMesh
        return items[place]

    def show(self) -> list[Face]:
        asset = self.document.get("asset")
        version = asset.get("version") if isinstance(asset, dict) else None
        if not isinstance(version, str) or not version.startswith("2."):
            raise NotMesh
        if any(name in COMPRESSED for name in self.document.get("extensionsRequired", [])):
            raise NotMesh
        for node in self.roots():
            self.node(node, UNPLACED, ())
        return self.faces

    def roots(self) -> list[Any]:
        if "scene" in self.document or self.document.get("scenes"):
            return self.item("scenes", self.document.get("scene", 0)).get("nodes", [])
        nodes = self.document.get("nodes", [])
        children = {child for node in nodes for child in node.get("children", [])}
        return [place for place in range(len(nodes)) if place not in children]

    def node(self, place: Any, above: Affine, inside: tuple[int, ...]) -> None:
        node = self.item("nodes", place)
        self.visits += 1
        if place in inside or self.visits > MAX_VISITS or len(inside) >= MAX_NODES_INSIDE:
            raise NotMesh
        here = then(above, local(node))
        if "mesh" in node:
            mesh = self.item("meshes", node["mesh"])
            for number, primitive in enumerate(mesh["primitives"]):
                self.primitive(node["mesh"], number, primitive, here)
        for child in node.get("children", []):
            self.node(child, here, (*inside, place))

    def primitive(self, mesh: int, number: int, primitive: Any, place: Affine) -> None:
        if COMPRESSED[0] in primitive.get("extensions", {}):
            raise NotMesh
        if primitive.get("mode", TRIANGLES) not in (TRIANGLES, STRIP, FAN):
            return
        if "POSITION" not in primitive["attributes"]:
            return
        if (mesh, number) not in self.primitives:
            self.primitives[mesh, number] = self.read_primitive(primitive)
        found = self.primitives[mesh, number]
        self.triangles += len(found)
        if self.triangles > MAX_TRIANGLES:
            raise NotMesh
        self.faces += [Face(face.corners, place) for face in found]

    def read_primitive(self, primitive: Any) -> list[Face]:
        positions = self.positions(primitive["attributes"]["POSITION"])
        mode = primitive.get("mode", TRIANGLES)
        if "indices" in primitive:
            indices = self.indices(primitive["indices"])
        else:
            indices = list(range(len(positions)))
        faces = []
        for triangle in triangles(mode, indices):
            if all(index < len(positions) for index in triangle):
                faces.append(Face([positions[index] for index in triangle]))
        return faces

    def indices(self, place: Any) -> list[int]:
        accessor = self.item("accessors", place)
        if accessor["type"] != "SCALAR" or accessor["componentType"] not in INDEX_COMPONENTS:
            raise NotMesh
        if "sparse" in accessor:
            raise NotMesh
        return [int(row[0]) for row in self.rows(accessor, 1)]

    def positions(self, place: Any) -> list[tuple[float, float, float]]:
        accessor = self.item("accessors", place)
        if accessor["type"] != "VEC3":
            raise NotMesh
        rows = self.rows(accessor, 3)
        if "sparse" in accessor:
            sparse = accessor["sparse"]
            count = sparse["count"]
            where = self.view_rows(sparse["indices"], count, 1)
            values = self.view_rows(
                {
                    **accessor,
                    **sparse["values"],
                    "byteOffset": sparse["values"].get("byteOffset", 0),
                },
                count,
                3,
            )
            for (index,), value in zip(where, values):
                rows[int(index)] = value
        if accessor.get("normalized"):
            largest = COMPONENTS[accessor["componentType"]][1]
            rows = [tuple(max(part / largest, -1.0) for part in row) for row in rows]
        return rows

    def rows(self, accessor: Any, width: int) -> list[Any]:
        if "bufferView" not in accessor:
            return [(0.0,) * width] * accessor["count"]
        return self.view_rows(accessor, accessor["count"], width)

    def view_rows(self, accessor: Any, count: int, width: int) -> list[Any]:
        """So many rows of numbers in a view."""
        view = self.item("bufferViews", accessor["bufferView"])
        data = self.buffer(view["buffer"])
        start = view.get("byteOffset", 0)
        end = start + view["byteLength"]
        code = COMPONENTS[accessor["componentType"]][0]
        form = struct.Struct(f"<{width}{code}")
        step = view.get("byteStride", form.size)
        first = start + accessor.get("byteOffset", 0)
        if end > len(data) or (count and first + step * (count - 1) + form.size > end):
            raise NotMesh
        return [form.unpack_from(data, first + step * n) for n in range(count)]

    def buffer(self, place: Any) -> bytes:
        entry = self.item("buffers", place)
        if place not in self.buffers:
            data = data_of(entry["uri"], self.fetch) if "uri" in entry else self.binary
            if data is None or ("uri" not in entry and place != 0):
                raise NotMesh
            if len(data) < entry["byteLength"]:
                raise NotMesh
            self.buffers[place] = data
        return self.buffers[place]


def data_of(uri: str, fetch: Fetch) -> bytes | None:
    """The bytes that a URI stands for."""
    if not uri.startswith("data:"):
        return fetch(uri)
    head, _, body = uri.partition(",")
    if not head.endswith(";base64"):
        return unquote_to_bytes(body)
    return base64.b64decode(unquote_to_bytes(body))


def triangles(mode: int, indices: list[int]) -> list[tuple[int, ...]]:
    """The triangles of a list, strip or fan."""
    count = len(indices)
    if mode == TRIANGLES:
        return [tuple(indices[n : n + 3]) for n in range(0, count - 2, 3)]
    if mode == FAN:
        return [(indices[0], indices[n], indices[n + 1]) for n in range(1, count - 1)]
    return strip(indices)


def strip(indices: list[int]) -> list[tuple[int, ...]]:
    """7.8: every second triangle of a strip is turned round."""
    found = []
    for n in range(len(indices) - 2):
        a, b, c = indices[n : n + 3]
        found.append((b, a, c) if n % 2 else (a, b, c))
    return found


def local(node: Any) -> Affine:
    """The transform of a node."""
    if "matrix" in node:
        m = node["matrix"]
        return tuple((m[r], m[4 + r], m[8 + r], m[12 + r]) for r in range(3))
    t = node.get("translation", (0.0, 0.0, 0.0))
    x, y, z, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
    s = node.get("scale", (1.0, 1.0, 1.0))
    rotation = from_quaternion((w, x, y, z))
    return tuple(
        (row[0] * s[0], row[1] * s[1], row[2] * s[2], shift) for row, shift in zip(rotation, t)
    )


def show(document: Any, binary: bytes | None, fetch: Fetch) -> list[Face]:
    try:
        return GltfReader(document, binary, fetch).show()
    except (KeyError, TypeError, AttributeError, IndexError, ValueError, binascii.Error) as fault:
        raise NotMesh from fault


def document_of(data: bytes) -> Any:
    try:
        return read_json(data, True)
    except TextFault as fault:
        raise NotMesh from fault


def read_gltf(data: bytes, fetch: Fetch) -> list[Face]:
    return show(document_of(data.removeprefix(b"\xef\xbb\xbf")), None, fetch)


def chunks_of(data: bytes) -> list[tuple[int, bytes]]:
    """The chunks of a GLB that are whole (7.6)."""
    found = []
    at = 12
    while at + 8 <= len(data):
        length, kind = struct.unpack_from("<II", data, at)
        if at + 8 + length > len(data):
            raise NotMesh
        found.append((kind, data[at + 8 : at + 8 + length]))
        at += 8 + length
    return found


def split_glb(data: bytes) -> tuple[Any, bytes | None]:
    """The document and the binary chunk of a GLB."""
    chunks = chunks_of(data)
    if not chunks or chunks[0][0] != JSON_CHUNK:
        raise NotMesh
    binary = chunks[1][1] if len(chunks) > 1 and chunks[1][0] == BIN_CHUNK else None
    return document_of(chunks[0][1]), binary


def read_glb(data: bytes, fetch: Fetch) -> list[Face]:
    document, binary = split_glb(data)
    return show(document, binary, fetch)

"""Which format a mesh file has, and what it shows (7.5)."""

from __future__ import annotations

import functools
import re
import struct
from collections.abc import Callable

from .collada import read_collada
from .faces import MAX_TRIANGLES, Face, NotMesh, Vertex, count_triangles, triangles_of
from .gltf import read_glb, read_gltf
from .numeric import cross, norm, number, sub

FIRST = 64 * 1024
BYTE_ORDER_MARK = b"\xef\xbb\xbf"
NOT_TEXT = re.compile(rb"[\x00-\x08\x0e-\x19\x1b-\x1f]")
NOT_MESHES = re.compile(
    rb"PK\x03\x04|(?:ply|OFF)[\n\r]|Kaydara FBX|BLENDER|\x1f\x8b|version https://git-lfs"
)
OBJ_WORDS = (b"v", b"vt", b"vn", b"vp", b"f", b"o", b"g", b"s", b"mtllib", b"usemtl")
STL_NAMES = (".stl", ".stla", ".stlb")
HEADER = 84
RECORD = 50
SPACE = b" \t\n\r\v\f"
STL_WORD = re.compile(rb"[^\x00-\x20]+")
INDEX = re.compile(r"[+-]?[0-9]+")


def is_text(data: bytes) -> bool:
    return NOT_TEXT.search(data[:FIRST]) is None


def starts_as_obj(data: bytes) -> bool:
    """Whether the first line that says something begins with a word of OBJ."""
    for line in re.split(rb"[\n\r]", data):
        words = line.split()
        if words and not words[0].startswith(b"#"):
            return words[0] in OBJ_WORDS
    return False


def format_of(data: bytes, name: str) -> str:
    """The first row of the table of 7.5 that fits, or nothing."""
    named = name.lower()
    if data.startswith(b"glTF"):
        return "glb"
    if len(data) >= HEADER and len(data) == HEADER + RECORD * int.from_bytes(data[80:84], "little"):
        return "stl"
    if not data or NOT_MESHES.match(data):
        return ""
    start = data.removeprefix(BYTE_ORDER_MARK).lstrip(SPACE)
    first = data[:FIRST].lower()
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        if data[:FIRST].decode("utf-16", "replace").lstrip().startswith("<"):
            return "dae"
    text = is_text(data)
    if text and start.startswith(b"<"):
        return "dae" if b"collada" in first else ""
    if text and start.startswith(b"{"):
        return "gltf"
    if start[:5].lower() == b"solid" and (b"facet" in first or b"endsolid" in first):
        if text or not named.endswith(STL_NAMES):
            return "stl text"
    if text and starts_as_obj(start):
        return "obj"
    if named.endswith(STL_NAMES) and len(data) >= HEADER:
        return "stl"
    return "obj" if named.endswith(".obj") and text else ""


def read_stl(data: bytes) -> list[Face]:
    """Binary STL."""
    stated = int.from_bytes(data[80:84], "little")
    whole = (len(data) - HEADER) // RECORD
    count = min(stated, whole) if stated else whole
    if stated and not whole:
        raise NotMesh
    faces = []
    for n in range(count):
        numbers = struct.unpack_from("<12f", data, HEADER + RECORD * n)[3:]
        faces.append(Face([numbers[0:3], numbers[3:6], numbers[6:9]]))
    return faces


def vertex(words: list[str]) -> Vertex:
    """Three numbers, or a corner that is no number."""
    values = [number(word) for word in words]
    return None if len(values) < 3 or None in values else tuple(values)  # type: ignore[return-value]


def read_stl_text(data: bytes) -> list[Face]:
    """STL as text."""
    faces = []
    corners: list[Vertex] = []
    at = 0
    while True:
        match = STL_WORD.search(data, at)
        if not match:
            return faces
        at = match.end()
        word = match[0].lower()
        if word in (b"solid", b"endsolid"):
            line = re.compile(rb"[^\n\r]*").match(data, at)
            at = line.end() if line else at
        elif word == b"vertex":
            words = []
            for _ in range(3):
                match = STL_WORD.search(data, at)
                if match:
                    words.append(match[0].decode("latin-1"))
                    at = match.end()
            corners.append(vertex(words))
        elif word in (b"endloop", b"endfacet"):
            if len(corners) >= 3:
                faces.append(Face(corners))
            corners = []


def read_obj(data: bytes) -> list[Face]:
    """OBJ: a face with a wrong index is left out whole."""
    text = data.decode("latin-1").replace("\r\n", "\n").replace("\r", "\n").replace("\\\n", " ")
    vertices: list[Vertex] = []
    faces: list[list[int | None]] = []
    for line in text.split("\n"):
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append(vertex(words[1:4]))
        elif words[0] in ("f", "fo"):
            faces.append(obj_face(line.split("#")[0].split()[1:], len(vertices)))
    return [
        Face([vertices[place] for place in face])  # type: ignore[index]
        for face in faces
        if len(face) >= 3 and all(p is not None and 0 <= p < len(vertices) for p in face)
    ]


def obj_face(words: list[str], so_far: int) -> list[int | None]:
    """The places of a face's vertices, and None for what is not an index."""
    places: list[int | None] = []
    for word in words:
        index = word.split("/")[0]
        value = int(index) if INDEX.fullmatch(index) else 0
        places.append(value - 1 if value > 0 else so_far + value if value < 0 else None)
    return places


def read_mesh(data: bytes, name: str, fetch: Callable[[str], bytes | None]) -> list[Face]:
    """What a mesh file shows; `fetch` gives files that it names. Raises NotMesh."""
    kind = format_of(data, name)
    if kind == "stl":
        faces = read_stl(data)
    elif kind == "stl text":
        faces = read_stl_text(data)
    elif kind == "obj":
        faces = read_obj(data)
    elif kind == "dae":
        faces = read_collada(data)
    elif kind == "gltf":
        faces = read_gltf(data, fetch)
    elif kind == "glb":
        faces = read_glb(data, fetch)
    else:
        raise NotMesh
    if count_triangles(faces) > MAX_TRIANGLES:
        raise NotMesh
    return faces


def has_area(triangle: list[tuple[float, float, float]]) -> bool:
    """7.5: whether the cross product of two edges has a length above 0."""
    a, b, c = triangle
    return norm(cross(sub(b, a), sub(c, a))) > 0


def is_usable(faces: list[Face]) -> bool:
    """7.5: whether a triangle with an area is left."""
    return any(has_area(triangle) for face in faces for triangle in triangles_of(face))


@functools.lru_cache(maxsize=512)
def read_alone(data: bytes, name: str) -> list[Face]:
    """A mesh file that names no others, such as a derived one."""
    return read_mesh(data, name, lambda _: None)

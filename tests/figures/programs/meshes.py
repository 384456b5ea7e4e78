#!/usr/bin/env python3
"""Writes the meshes beside the base files: a box in several formats, and files that are wrong in one way each."""

from __future__ import annotations

import json
import re
import struct
import zlib
from pathlib import Path

BASE = Path(__file__).resolve().parent / "base"
CORNERS = [(x, y, z) for x in (-0.05, 0.05) for y in (-0.06, 0.06) for z in (-0.07, 0.07)]
FACES = [
    (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
    (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
]  # fmt: skip


def binary_stl(faces: list[tuple[int, int, int]], header: bytes = b"box") -> bytes:
    body = b"".join(
        struct.pack("<12fH", 0, 0, 0, *(value for corner in face for value in CORNERS[corner]), 0) for face in faces
    )
    return header.ljust(80, b" ") + struct.pack("<I", len(faces)) + body


def ascii_stl() -> bytes:
    lines = ["solid box"]
    for face in FACES:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex {} {} {}".format(*CORNERS[corner]) for corner in face]
        lines += ["endloop", "endfacet"]
    return ("\n".join([*lines, "endsolid box"]) + "\n").encode()


def obj(material: str | None, faces: list[tuple[int, int, int]]) -> bytes:
    lines = [f"mtllib {material}"] if material else []
    lines += ["v {} {} {}".format(*corner) for corner in CORNERS]
    if material:
        lines += ["vt 0 0", "vt 1 0", "vt 1 1", "usemtl red"]
    for face in faces:
        lines.append(
            "f " + " ".join(f"{corner + 1}/{i + 1}" if material else str(corner + 1) for i, corner in enumerate(face))
        )
    return ("\n".join(lines) + "\n").encode()


def dae(unit: float, up: str) -> bytes:
    positions = " ".join(str(value) for corner in CORNERS for value in corner)
    indices = " ".join(str(corner) for face in FACES for corner in face)
    return f"""<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2026-01-01T00:00:00</created><modified>2026-01-01T00:00:00</modified>
<unit name="unit" meter="{unit}"/><up_axis>{up}</up_axis></asset>
<library_geometries><geometry id="box" name="box"><mesh>
<source id="positions"><float_array id="values" count="24">{positions}</float_array>
<technique_common><accessor source="#values" count="8" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="vertices"><input semantic="POSITION" source="#positions"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#vertices" offset="0"/><p>{indices}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene">
<node id="node"><instance_geometry url="#box"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
""".encode()


def gltf() -> tuple[dict[str, object], bytes]:
    positions = b"".join(struct.pack("<3f", *corner) for corner in CORNERS)
    indices = b"".join(struct.pack("<3H", *face) for face in FACES)
    low, high = ([pick(corner[i] for corner in CORNERS) for i in range(3)] for pick in (min, max))
    document: dict[str, object] = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": low, "max": high},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(positions)},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)},
        ],
        "buffers": [{"byteLength": len(positions) + len(indices)}],
    }
    return document, positions + indices


def glb() -> bytes:
    document, body = gltf()
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    body += b"\0" * (-len(body) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(body), b"BIN\0") + body
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def png() -> bytes:
    def chunk(kind: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    rows = b"".join(b"\0" + bytes([200, 120, 40]) * 2 for _ in range(2))
    header = struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def ply() -> bytes:
    lines = ["ply", "format ascii 1.0", "element vertex 8", "property float x", "property float y", "property float z"]
    lines += ["element face 12", "property list uchar int vertex_indices", "end_header"]
    lines += ["{} {} {}".format(*corner) for corner in CORNERS]
    lines += ["3 {} {} {}".format(*face) for face in FACES]
    return ("\n".join(lines) + "\n").encode()


PACKAGE = b"""<?xml version="1.0"?>
<package format="2"><name>part_description</name><version>1.0.0</version><description>A part.</description>
<maintainer email="nobody@example.com">nobody</maintainer><license>MIT</license></package>
"""


def files() -> dict[str, bytes]:
    part = binary_stl(FACES)
    document, body = gltf()
    document["buffers"] = [{"byteLength": len(body), "uri": "part.bin"}]
    return {
        "part.stl": part,
        "ascii.stl": ascii_stl(),
        "solid.stl": binary_stl(FACES, b"solid box"),
        "upper.STL": part,
        "part.obj": obj("part.mtl", FACES),
        "plain.obj": obj(None, FACES),
        "part.mtl": b"newmtl red\nKd 0.8 0.1 0.1\nmap_Kd part.png\n",
        "part.png": png(),
        "part.dae": dae(1, "Z_UP"),
        "part_cm_y.dae": dae(0.01, "Y_UP"),
        "part.glb": glb(),
        "part.gltf": json.dumps(document).encode(),
        "part.bin": body,
        "part.ply": ply(),
        "part": part,
        "part.xyz": part,
        "with space.stl": part,
        "größe.stl": part,
        "folder/inside.stl": part,
        "folder/part.stl": part,
        "empty.stl": b"",
        "empty.obj": b"",
        "odd.stl": b"This is text, and not a mesh.\n",
        "odd.obj": b"This is text, and not a mesh.\n",
        "odd.dae": b"This is text, and not a mesh.\n",
        "no_scene.dae": re.sub(rb"<scene>.*</scene>", b"", dae(1, "Z_UP")),
        "no_asset.dae": re.sub(rb"<asset>.*</asset>", b"", dae(1, "Z_UP")),
        "no_place.dae": re.sub(rb"<instance_geometry [^/]*/>", b"", dae(1, "Z_UP")),
        "short.stl": part[:200],
        "long.stl": part + b"\0" * 7,
        "no_faces.stl": binary_stl([]),
        "no_faces.obj": obj(None, []),
        "no_faces_ascii.stl": b"solid box\nendsolid box\n",
        "flat.stl": binary_stl(FACES[:2]),
        "open.stl": binary_stl(FACES[:8]),
        "one.stl": binary_stl(FACES[:1]),
        "no_material.obj": obj("missing.mtl", FACES),
        "really_obj.stl": obj(None, FACES),
        "really_stl.obj": part,
        "packages/part_description/package.xml": PACKAGE,
        "packages/part_description/meshes/part.stl": part,
    }


def main() -> None:
    for name, content in files().items():
        path = BASE / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


if __name__ == "__main__":
    main()

"""Mesh files of a body, in each format that URDFs name."""

import json
import struct

from solids import Triangle, indexed, scaled


def normal(triangle: Triangle) -> tuple[float, ...]:
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = triangle
    u, v = (bx - ax, by - ay, bz - az), (cx - ax, cy - ay, cz - az)
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = sum(a * a for a in n) ** 0.5
    return tuple(a / length for a in n)


def binary_stl(body: list[Triangle]) -> bytes:
    data = [b"binary STL of a body of conformance/robots".ljust(80), struct.pack("<I", len(body))]
    for triangle in body:
        numbers = [*normal(triangle), *(a for p in triangle for a in p)]
        data.append(struct.pack("<12fH", *numbers, 0))
    return b"".join(data)


def ascii_stl(body: list[Triangle]) -> bytes:
    lines = ["solid body"]
    for triangle in body:
        lines += ["facet normal " + " ".join(f"{a:.6g}" for a in normal(triangle)), " outer loop"]
        lines += ["  vertex " + " ".join(f"{a:.6g}" for a in p) for p in triangle]
        lines += [" endloop", "endfacet"]
    return "\n".join([*lines, "endsolid body", ""]).encode()


def obj(body: list[Triangle], library: str, material: str) -> bytes:
    points, triangles = indexed(body)
    lines = [f"mtllib {library}", "o body"]
    lines += ["v " + " ".join(f"{a:.6g}" for a in p) for p in points]
    lines += [f"usemtl {material}"]
    lines += ["f " + " ".join(str(i + 1) for i in t) for t in triangles]
    return "\n".join([*lines, ""]).encode()


def mtl(material: str, rgb: tuple[float, float, float]) -> bytes:
    return f"newmtl {material}\nKd {rgb[0]} {rgb[1]} {rgb[2]}\n".encode()


def collada(bodies: list[tuple[list[Triangle], tuple[float, float, float]]], rgb, up: str = "Z_UP", unit: float = 1.0) -> bytes:
    """A COLLADA file: each body a geometry of its own, written about its own origin and put in its
    place by its node; lengths in `unit` metres. `up` is written and nothing is turned by it: that is how
    URDF tools read it (RViz, Pinocchio, trimesh), and how half of the exporters write it."""
    geometries, nodes = [], []
    for n, (body, at) in enumerate(bodies):
        local = scaled([tuple(tuple(a - b for a, b in zip(p, at)) for p in t) for t in body], 1 / unit)
        place = [a / unit for a in at]
        points, triangles = indexed(local)
        numbers = " ".join(f"{a + 0.0:.6g}" for p in points for a in p)
        corners = " ".join(str(i) for t in triangles for i in t)
        geometries.append(
            f'<geometry id="g{n}"><mesh><source id="g{n}p"><float_array id="g{n}a" count="{3 * len(points)}">{numbers}</float_array>'
            f'<technique_common><accessor source="#g{n}a" count="{len(points)}" stride="3"><param name="X" type="float"/>'
            f'<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>'
            f'<vertices id="g{n}v"><input semantic="POSITION" source="#g{n}p"/></vertices>'
            f'<triangles count="{len(triangles)}" material="paint"><input semantic="VERTEX" source="#g{n}v" offset="0"/>'
            f"<p>{corners}</p></triangles></mesh></geometry>\n"
        )
        nodes.append(
            f'<node id="n{n}"><translate>{" ".join(f"{a + 0.0:.6g}" for a in place)}</translate><instance_geometry url="#g{n}">'
            f'<bind_material><technique_common><instance_material symbol="paint" target="#paint"/></technique_common></bind_material>'
            f"</instance_geometry></node>\n"
        )
    red, green, blue = rgb
    return (
        '<?xml version="1.0" encoding="utf-8"?>\n<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">\n'
        f'<asset><created>2026-01-01T00:00:00</created><modified>2026-01-01T00:00:00</modified><unit name="unit" meter="{unit}"/><up_axis>{up}</up_axis></asset>\n'
        '<library_effects><effect id="e"><profile_COMMON><technique sid="common"><lambert><diffuse>'
        f"<color>{red} {green} {blue} 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>\n"
        '<library_materials><material id="paint"><instance_effect url="#e"/></material></library_materials>\n'
        f'<library_geometries>\n{"".join(geometries)}</library_geometries>\n'
        f'<library_visual_scenes><visual_scene id="s">\n{"".join(nodes)}</visual_scene></library_visual_scenes>\n'
        '<scene><instance_visual_scene url="#s"/></scene>\n</COLLADA>\n'
    ).encode()


def glb(body: list[Triangle], rgb: tuple[float, float, float]) -> bytes:
    points, triangles = indexed(body)
    positions = b"".join(struct.pack("<3f", *p) for p in points)
    indices = b"".join(struct.pack("<3I", *t) for t in triangles)
    # The extremes as binary32 has them, as the format asks.
    rounded = [struct.unpack("<3f", struct.pack("<3f", *p)) for p in points]
    document = {
        "asset": {"version": "2.0", "generator": "conformance/robots/make"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [*rgb, 1.0]}}],
        "buffers": [{"byteLength": len(positions) + len(indices)}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(positions), "target": 34962},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices), "target": 34963},
        ],
        "accessors": [
            {
                "bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3",
                "min": [min(p[i] for p in rounded) for i in range(3)],
                "max": [max(p[i] for p in rounded) for i in range(3)],
            },
            {"bufferView": 1, "componentType": 5125, "count": 3 * len(triangles), "type": "SCALAR"},
        ],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data = positions + indices
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

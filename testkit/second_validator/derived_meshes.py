"""The rules about what derived meshes hold (7.6, 7.8 to 7.10)."""

from __future__ import annotations

import functools
from typing import Any

from .derived_rules import robot_of
from .documents import derived_files
from .faces import NotMesh
from .geometry import (
    Point,
    Triangle,
    diagonal,
    is_closed,
    outside,
    planes_of,
    resolution,
)
from .mesh import format_of
from .mesh_rules import LISTS, Elements
from .modules import Urdd, file_of
from .numeric import add, distance, dot, scaled
from .original_rules import read_original
from .plain import MeshElement, PlainCheck
from .shapes_of_urdf import Shape
from .sound import files_agree, is_binary_gltf, sound

MAX_OUT = 0.02  # 7.10
MAX_UNCOVERED = 0.05  # 7.10


def check_files(urdd: Urdd, name: str) -> None:
    """7.6: each file is sound, and the files of a mesh hold the same triangles."""
    error = urdd.report.error
    for files, pointer in derived_files(urdd.documents[name]):
        # A file's name is in one of these; other keys are the producer's own (3.1.2).
        named = {kind: files[kind] for kind in ("stl", "obj", "glb") if files[kind]}
        data = {kind: urdd.tree.read(path) for kind, path in named.items()}
        glb = data["glb"]
        if glb is not None and not is_binary_gltf(glb):
            error("MSH010", files["glb"])
            continue
        unsound = [kind for kind in data if data[kind] is not None and not sound(data[kind], kind)]
        for kind in unsound:
            error("MSH013", files[kind])
        if unsound or glb is None:
            continue
        for kind in ("stl", "obj"):
            other = data.get(kind)
            if other is not None and not files_agree(glb, other, kind):
                error("MSH014", file_of(name), f"{pointer}/{kind}")


def triangles(urdd: Urdd, files: Any) -> list[Triangle]:
    """The triangles of a derived mesh, of its `.glb`."""
    return sound(urdd.tree.read(files["glb"]) or b"", "glb") or []


def corners(mesh: list[Triangle]) -> list[Point]:
    """Only the corners of triangles count as vertices (7.6)."""
    return sorted({corner for triangle in mesh for corner in triangle})


@functools.lru_cache(maxsize=2048)
def is_convex_body(data: bytes) -> bool:
    """7.9: the closed surface of a convex body, facing outward."""
    mesh = sound(data, "glb") or []
    least = resolution(mesh)
    points = corners(mesh)
    size = diagonal(points)
    planes = planes_of(mesh, least)
    return is_closed(mesh) and all(
        dot(n, point) - level <= least * (1 + size / height)
        for n, level, height in planes
        for point in points
    )


def check_plain(urdd: Urdd, elements: Elements) -> None:
    """7.8."""
    version = robot_of(urdd.documents["urdf_module"]).version
    for link, mesh in enumerate(urdd.documents["plain_meshes_module"]["link_meshes"]):
        if not mesh:
            continue
        meshes, shapes = [], []
        for element, path in elements.used(link, mesh["geometry"]):
            if path is None:
                shapes.append(Shape(element, version))
                continue
            try:
                faces = read_original(urdd, path)
            except NotMesh:
                return  # 7.5 judges that
            kind = format_of(urdd.tree.read(path) or b"", path)
            meshes.append(MeshElement(faces, element, version, kind in ("gltf", "glb")))
        if not PlainCheck(triangles(urdd, mesh["files"]), meshes, shapes).holds():
            urdd.report.error("MSH015", file_of("plain_meshes_module"), f"/link_meshes/{link}")


@functools.lru_cache(maxsize=1024)
def hull_holds(hull: bytes, plain: bytes) -> bool:
    """7.9: a hull holds every vertex of the plain mesh (MSH018)."""
    mesh = sound(hull, "glb") or []
    least = resolution(mesh)
    size = diagonal(corners(mesh))
    planes = planes_of(mesh, least)
    points = corners(sound(plain, "glb") or [])
    return all(
        dot(n, point) - level <= least * (1 + size / height)
        for n, level, height in planes
        for point in points
    )


@functools.lru_cache(maxsize=1024)
def hull_vertices_are(hull: bytes, plain: bytes) -> bool:
    """7.9: each vertex of a hull is one of the plain mesh (MSH019)."""
    mesh = sound(plain, "glb") or []
    points = corners(mesh)
    known = set(points)
    least = resolution(mesh)
    return all(
        vertex in known or any(distance(vertex, point) <= least for point in points)
        for vertex in corners(sound(hull, "glb") or [])
    )


def check_hulls(urdd: Urdd) -> None:
    """7.9."""
    name = "convex_hull_meshes_module"
    plain = urdd.documents["plain_meshes_module"]["link_meshes"]
    for link, hull in enumerate(urdd.documents[name][LISTS[name]]):
        if not hull or not plain[link]:
            continue
        data = urdd.tree.read(hull["glb"]) or b""
        of_plain = urdd.tree.read(plain[link]["files"]["glb"]) or b""
        pointer = f"/link_hulls/{link}"
        if not is_convex_body(data):
            urdd.report.error("MSH017", file_of(name), pointer)
            continue
        if not hull_holds(data, of_plain):
            urdd.report.error("MSH018", file_of(name), pointer)
        if not hull_vertices_are(data, of_plain):
            urdd.report.error("MSH019", file_of(name), pointer)


def check_pieces(urdd: Urdd) -> None:
    """7.10."""
    name = "convex_decomposition_meshes_module"
    document = urdd.documents[name]
    plain = urdd.documents["plain_meshes_module"]["link_meshes"]
    hulls = urdd.documents["convex_hull_meshes_module"]["link_hulls"]
    for link, pieces in enumerate(document["link_pieces"]):
        if not plain[link] or not hulls[link]:
            continue
        hull = triangles(urdd, hulls[link])
        hull_planes = planes_of(hull, resolution(hull))
        allowed = max(MAX_OUT * diagonal(corners(hull)), resolution(hull))
        solid = []
        for place, piece in enumerate(pieces):
            pointer = f"/link_pieces/{link}/{place}"
            mesh = triangles(urdd, piece)
            if not is_convex_body(urdd.tree.read(piece["glb"]) or b""):
                urdd.report.error("MSH020", file_of(name), pointer)
                continue
            if any(outside(hull_planes, point) > allowed for point in corners(mesh)):
                urdd.report.error("MSH021", file_of(name), pointer)
            solid.append(planes_of(mesh, resolution(mesh)))
        mesh = triangles(urdd, plain[link]["files"])
        tolerance = document["method"]["surface_tolerance"]
        if not covered(mesh, solid, tolerance):
            urdd.report.error("MSH022", file_of(name), f"/link_pieces/{link}")


def covered(mesh: list[Triangle], solid: list[Any], tolerance: float | None) -> bool:
    """7.10: whether the pieces hold the surface, to the tolerance that the method promises."""
    points = corners(mesh)
    points += [scaled(add(add(a, b), c), 1 / 3) for a, b, c in mesh]
    most = MAX_UNCOVERED * diagonal(corners(mesh))
    t = most if tolerance is None else min(max(tolerance, 0.0), most)
    allowed = t + resolution(mesh)
    return all(any(outside(planes, point) <= allowed for planes in solid) for point in points)


def check_derived_meshes(urdd: Urdd, elements: Elements) -> None:
    """7.6, 7.8 to 7.10."""
    for name in LISTS:
        if urdd.have(name):
            check_files(urdd, name)
    if not urdd.report.clean("MSH", "DIR01", "DIR023"):
        return
    check_plain(urdd, elements)
    if urdd.have("convex_hull_meshes_module"):
        check_hulls(urdd)
        if urdd.have("convex_decomposition_meshes_module"):
            check_pieces(urdd)

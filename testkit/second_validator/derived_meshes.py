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
SPLINTER = 8  # 7.10
MAX_UNCOVERED = 0.05  # 7.10


def check_files(urdd: Urdd, name: str) -> None:
    """7.6: each file is sound, and the files of a mesh hold the same triangles."""
    error = urdd.report.error
    for files, pointer in derived_files(urdd.documents[name]):
        # A file's name is in one of these; other keys are the producer's own (3.1.2).
        data = {kind: urdd.tree.read(files[kind]) for kind in ("stl", "obj", "glb") if files[kind]}
        if None in data.values():
            continue  # 2.7 judges that
        if not is_binary_gltf(data["glb"]):
            error("MSH010", files["glb"])
            continue
        unsound = [kind for kind in data if not sound(data[kind], kind)]
        for kind in unsound:
            error("MSH013", files[kind])
        for kind in ("stl", "obj"):
            if kind in data and not unsound and not files_agree(data["glb"], data[kind], kind):
                error("MSH014", file_of(name), f"{pointer}/{kind}")


def shown(data: bytes) -> list[Triangle]:
    """The triangles of a derived mesh, of its `.glb`."""
    return sound(data, "glb") or []


def triangles(urdd: Urdd, files: Any) -> list[Triangle]:
    return shown(urdd.tree.data(files["glb"]))


def corners(mesh: list[Triangle]) -> list[Point]:
    """Only the corners of triangles count as vertices (7.6)."""
    return sorted({corner for triangle in mesh for corner in triangle})


@functools.lru_cache(maxsize=2048)
def is_convex_body(data: bytes) -> bool:
    """7.9: the closed surface of a convex body, facing outward."""
    mesh = shown(data)
    least = resolution(mesh)
    points = corners(mesh)
    size = diagonal(points)
    planes = planes_of(mesh, least)
    return is_closed(mesh) and all(
        dot(n, point) - level <= least * (1 + size / height)
        for n, level, height in planes
        for point in points
    )


def plain_holds(plain: list[Triangle], version: tuple[int, int], *elements: Any) -> bool:
    """7.8: of each element itself, its faces or None, and whether they have y up."""
    meshes, shapes = [], []
    for element, faces, y_up in zip(elements[::3], elements[1::3], elements[2::3]):
        if faces is None:
            shapes.append(Shape(element, version))
        else:
            meshes.append(MeshElement(faces, element, version, y_up))
    return PlainCheck(plain, meshes, shapes).holds()


def check_plain(urdd: Urdd, elements: Elements) -> None:
    """7.8."""
    version = robot_of(urdd.documents["urdf_module"]).version
    for link, mesh in enumerate(urdd.documents["plain_meshes_module"]["link_meshes"]):
        if not mesh:
            continue
        used: list[Any] = []
        for element, path in elements.used(link, mesh["geometry"]):
            used.append(element)
            if path is None:
                used += [None, False]
                continue
            try:
                used.append(read_original(urdd, path))
            except NotMesh:
                return  # 7.5 judges that
            used.append(format_of(urdd.tree.data(path), path) in ("gltf", "glb"))
        if not plain_holds(triangles(urdd, mesh["files"]), version, *used):
            urdd.report.error("MSH015", file_of("plain_meshes_module"), f"/link_meshes/{link}")


@functools.lru_cache(maxsize=1024)
def hull_holds(hull: bytes, plain: bytes) -> bool:
    """7.9: a hull holds every vertex of the plain mesh (MSH018)."""
    mesh = shown(hull)
    least = resolution(mesh)
    size = diagonal(corners(mesh))
    planes = planes_of(mesh, least)
    points = corners(shown(plain))
    return all(
        dot(n, point) - level <= least * (1 + size / height)
        for n, level, height in planes
        for point in points
    )


@functools.lru_cache(maxsize=1024)
def hull_vertices_are(hull: bytes, plain: bytes) -> bool:
    """7.9: each vertex of a hull is one of the plain mesh (MSH019)."""
    mesh = shown(plain)
    points = corners(mesh)
    known = set(points)
    least = resolution(mesh)
    return all(
        vertex in known or any(distance(vertex, point) <= least for point in points)
        for vertex in corners(shown(hull))
    )


def check_hulls(urdd: Urdd) -> None:
    """7.9."""
    name = "convex_hull_meshes_module"
    plain = urdd.documents["plain_meshes_module"]["link_meshes"]
    for link, hull in enumerate(urdd.documents[name][LISTS[name]]):
        if not hull:
            continue
        data = urdd.tree.data(hull["glb"])
        of_plain = urdd.tree.data(plain[link]["files"]["glb"])
        pointer = f"/link_hulls/{link}"
        if not is_convex_body(data):
            urdd.report.error("MSH017", file_of(name), pointer)
            continue
        if not hull_holds(data, of_plain):
            urdd.report.error("MSH018", file_of(name), pointer)
        if not hull_vertices_are(data, of_plain):
            urdd.report.error("MSH019", file_of(name), pointer)


@functools.lru_cache(maxsize=1024)
def piece_is_near(piece: bytes, hull: bytes) -> bool:
    """7.10: a piece is not far outside of the hull (MSH021)."""
    mesh = shown(hull)
    least = resolution(mesh)
    planes = planes_of(mesh, least)
    allowed = max(MAX_OUT * diagonal(corners(mesh)), SPLINTER * least)
    points = corners(shown(piece))
    return all(outside(planes, point) <= allowed for point in points)


@functools.lru_cache(maxsize=1024)
def covered(plain: bytes, pieces: tuple[bytes, ...], tolerance: float | None) -> bool:
    """7.10: whether the pieces hold the surface, to the tolerance that the method promises."""
    mesh = shown(plain)
    solid = [planes_of(one, resolution(one)) for one in map(shown, pieces)]
    points = corners(mesh)
    most = MAX_UNCOVERED * diagonal(points)
    points += [scaled(add(add(a, b), c), 1 / 3) for a, b, c in mesh]
    t = most if tolerance is None else min(max(tolerance, 0.0), most)
    allowed = t + resolution(mesh)
    return all(any(outside(planes, point) <= allowed for planes in solid) for point in points)


def check_pieces(urdd: Urdd) -> None:
    """7.10."""
    name = "convex_decomposition_meshes_module"
    document = urdd.documents[name]
    plain = urdd.documents["plain_meshes_module"]["link_meshes"]
    hulls = urdd.documents["convex_hull_meshes_module"]["link_hulls"]
    for link, pieces in enumerate(document["link_pieces"]):
        if not pieces:
            continue
        hull = urdd.tree.data(hulls[link]["glb"])
        convex = []
        for place, piece in enumerate(pieces):
            pointer = f"/link_pieces/{link}/{place}"
            data = urdd.tree.data(piece["glb"])
            if not is_convex_body(data):
                urdd.report.error("MSH020", file_of(name), pointer)
                continue
            if not piece_is_near(data, hull):
                urdd.report.error("MSH021", file_of(name), pointer)
            convex.append(data)
        of_plain = urdd.tree.data(plain[link]["files"]["glb"])
        tolerance = document["method"]["surface_tolerance"]
        if not covered(of_plain, tuple(convex), tolerance):
            urdd.report.error("MSH022", file_of(name), f"/link_pieces/{link}")


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

"""The rules of `original_meshes_module` (7.5)."""

from __future__ import annotations

from typing import Any
from urllib.parse import unquote

from .faces import Face, NotMesh, Shown
from .mesh import format_of, is_usable, read_alone, read_mesh
from .modules import Urdd, file_of
from .sidefiles import normal, side_files

FILE = file_of("original_meshes_module")
FOLDER = "mesh_modules/original_meshes_module/meshes/"


def read_original(urdd: Urdd, path: str) -> list[Face]:
    """What a carried mesh shows. Raises NotMesh."""
    data = urdd.tree.data(path)
    if format_of(data, path) not in ("gltf", "glb"):
        return read_alone(data, path)
    folder = path.rpartition("/")[0]

    def fetch(name: str) -> bytes | None:
        return urdd.tree.read(normal(folder, unquote(name)))

    return read_mesh(data, path, fetch)


def expected_references(robot: Any) -> list[tuple[int, str, int, str]]:
    """7.5: every mesh of the URDF, in order."""
    found = []
    for link, entry in enumerate(robot["links"]):
        for kind in ("Visual", "Collision"):
            for place, element in enumerate(entry[kind.lower()]):
                if element["geometry"] and "Mesh" in element["geometry"]:
                    found.append((link, kind, place, element["geometry"]["Mesh"]["filename"]))
    return found


def check_lists(urdd: Urdd, document: Any) -> None:
    """7.5: `files` and `path`."""
    error = urdd.report.error
    paths = [file["path"] for file in document["files"]]
    named = {one["path"] for one in document["references"] if one["path"] is not None}
    if paths != sorted(set(paths), key=str.encode) or set(paths) != named:
        error("MSH012", FILE, "/files")
    path_of: dict[str, Any] = {}
    for place, one in enumerate(document["references"]):
        if path_of.setdefault(one["filename"], one["path"]) != one["path"]:
            error("MSH012", FILE, f"/references/{place}/path")
    known = set(paths)
    for place, file in enumerate(document["files"]):
        sides = file["side_files"]
        if sides != sorted(set(sides), key=str.encode):
            error("MSH012", FILE, f"/files/{place}/side_files")
        known |= set(sides)
    for entry in urdd.entries():
        if entry["name"] == "original_meshes_module":
            for listed in entry["files"]:
                if listed["path"].startswith(FOLDER) and listed["path"] not in known:
                    error("MSH012", "urdd.json", "/modules")


def check_file(urdd: Urdd, place: int, file: Any) -> None:
    """7.5: `usable` and `side_files`."""
    pointer = f"/files/{place}"
    try:
        faces: list[Face] | None = read_original(urdd, file["path"])
    except NotMesh:
        faces = None
    if isinstance(faces, Shown) and faces.may_be_refused and not file["usable"]:
        return
    if file["usable"] != (faces is not None and is_usable(faces)):
        urdd.report.error("MSH016", FILE, pointer + "/usable")
    if faces is not None and file["side_files"] != side_files(urdd.tree, file["path"]):
        urdd.report.error("MSH016", FILE, pointer + "/side_files")


def check_originals(urdd: Urdd) -> None:
    """7.5."""
    if not urdd.have("urdf_module", "original_meshes_module") or not urdd.report.clean("URD"):
        return
    document = urdd.documents["original_meshes_module"]
    stated = [
        (one["link_idx"], one["geometry"], one["element_idx"], one["filename"])
        for one in document["references"]
    ]
    if stated != expected_references(urdd.documents["urdf_module"]):
        urdd.report.error("MSH009", FILE, "/references")
    check_lists(urdd, document)
    if urdd.report.clean("MSH012"):
        for place, file in enumerate(document["files"]):
            check_file(urdd, place, file)

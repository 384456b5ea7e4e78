"""The rules about lists, names and presence of derived meshes (7.1 to 7.4, 7.7)."""

from __future__ import annotations

import re
from typing import Any

from .documents import derived_files
from .modules import TABLE, Urdd, file_of

KINDS = ("stl", "obj", "glb")
MAX_SLUG = 64  # 7.3
LISTS = {
    "plain_meshes_module": "link_meshes",
    "convex_hull_meshes_module": "link_hulls",
    "convex_decomposition_meshes_module": "link_pieces",
}
OVER_PIECES = {
    "link_shapes_approximations_module": (
        "decomposition_obbs",
        "decomposition_bounding_spheres",
    ),
    "link_shapes_max_distance_from_origin_module": (
        "decomposition_convex_hulls_maximum_distances",
        "decomposition_obbs_maximum_distances",
        "decomposition_bounding_spheres_maximum_distances",
    ),
}


def slug(name: str) -> str:
    """7.3."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", name)[:MAX_SLUG] or "link"


def check_formats(urdd: Urdd, name: str) -> None:
    """7.1, 7.3: formats and names of the files of one module."""
    document = urdd.documents[name]
    links = urdd.documents["urdf_module"]["links"]
    file = file_of(name)
    entries = derived_files(document)
    for kind in ("stl", "obj"):
        if len({files[kind] is None for files, _ in entries}) > 1:
            urdd.report.error("MSH003", file, "/" + LISTS[name])  # 7.1
    passed: set[str] = set()
    for files, pointer in entries:
        parts = pointer.split("/")
        link = int(parts[2])
        stem = f"{link}_{slug(links[link]['name'])}"
        if parts[1] == "link_pieces":
            stem += "/" + parts[3]
        for kind in KINDS:
            path = files[kind]
            if path is None:
                continue
            if not path.lower().endswith("." + kind):
                urdd.report.error("MSH003", file, f"{pointer}/{kind}")  # 7.1
            if path in passed:
                urdd.report.error("MSH005", file, f"{pointer}/{kind}")  # 7.3
            passed.add(path)
            if path != f"{TABLE[name][0]}/meshes/{kind}/{stem}.{kind}":
                urdd.report.error("MSH006", file, f"{pointer}/{kind}")  # 7.3


def shape_is_usable(kind: str, shape: Any) -> bool:
    """7.2: boxes, cylinders, capsules and spheres."""
    if kind == "Box":
        sides = shape["size"]
        return min(sides) >= 0 and len([side for side in sides if side > 0]) >= 2
    return shape["radius"] > 0 and shape.get("length", 0) >= 0


class Elements:
    """7.2, 7.5: which elements of links are usable, and where their meshes are."""

    def __init__(self, urdd: Urdd) -> None:
        originals = urdd.documents["original_meshes_module"]
        usable = {file["path"]: file["usable"] for file in originals["files"]}
        self.links = urdd.documents["urdf_module"]["links"]
        self.paths = {
            (one["link_idx"], one["geometry"], one["element_idx"]): one["path"]
            for one in originals["references"]
        }
        self.usable_paths = {path for path, is_usable in usable.items() if is_usable}

    def used(self, link: int, kind: str) -> list[tuple[Any, str | None]]:
        """The usable elements of a link, each with the path of its mesh."""
        found = []
        for place, element in enumerate(self.links[link][kind.lower()]):
            for shape, inside in (element["geometry"] or {}).items():
                path = self.paths.get((link, kind, place))
                if shape == "Mesh":
                    is_thin = (inside["scale"] or []).count(0) > 1
                    if path in self.usable_paths and not is_thin:
                        found.append((element, path))
                elif not shape.startswith("x_") and shape_is_usable(shape, inside):
                    found.append((element, None))
        return found


def check_presence(urdd: Urdd, elements: Elements) -> None:
    """7.2, 7.4: which links have meshes, hulls and pieces."""
    error = urdd.report.error
    plain = urdd.documents["plain_meshes_module"]
    preferred = plain["preferred_geometry"]
    other = "Collision" if preferred == "Visual" else "Visual"
    for link, mesh in enumerate(plain["link_meshes"]):
        kind = preferred if elements.used(link, preferred) else other
        has = bool(elements.used(link, kind))
        if has != (mesh is not None):
            error("MSH011", file_of("plain_meshes_module"), f"/link_meshes/{link}")
        elif mesh and mesh["geometry"] != kind:
            error("MSH008", file_of("plain_meshes_module"), f"/link_meshes/{link}/geometry")
        for name in ("convex_hull_meshes_module", "convex_decomposition_meshes_module"):
            if urdd.have(name):
                entry = urdd.documents[name][LISTS[name]][link]
                if bool(entry) != (mesh is not None):
                    error("MSH007", file_of(name), f"/{LISTS[name]}/{link}")


def check_pieces(urdd: Urdd) -> None:
    """7.7, 8.2."""
    if not urdd.have("convex_decomposition_meshes_module"):
        return
    pieces = [
        len(of_link)
        for of_link in urdd.documents["convex_decomposition_meshes_module"]["link_pieces"]
    ]
    for name, keys in OVER_PIECES.items():
        for key in keys if urdd.have(name) else ():
            stated = urdd.documents[name][key]
            for link, (one, count) in enumerate(zip(stated, pieces)):
                if len(one) != count:
                    urdd.report.error("MSH004", file_of(name), f"/{key}/{link}")


def check_mesh_lists(urdd: Urdd) -> Elements | None:
    """7.1 to 7.4, 7.7; gives the elements where meshes can be judged."""
    if not urdd.have("urdf_module") or not urdd.report.clean("URD"):
        return None
    count = len(urdd.documents["urdf_module"]["links"])
    for name, key in LISTS.items():
        if urdd.have(name) and len(urdd.documents[name][key]) != count:
            urdd.report.error("MSH001", file_of(name), "/" + key)
    if not urdd.report.clean("MSH001"):
        return None
    for name in LISTS:
        if urdd.have(name):
            check_formats(urdd, name)
    check_pieces(urdd)
    if not urdd.have("original_meshes_module", "plain_meshes_module"):
        return None
    elements = Elements(urdd)
    if urdd.report.clean("MSH009", "MSH012"):
        check_presence(urdd, elements)
    return elements

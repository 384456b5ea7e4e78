"""Reading the documents of modules: their text (3), their schema (3.1.2), versions and drafts."""

from __future__ import annotations

import functools
from typing import Any

from .directory import check_path
from .jsontext import TextFault, read_json
from .modules import EXTENSION, MESH, TABLE, Urdd, file_of, version_of
from .schema import file_fits, fits
from .yamltext import read_yaml, same

KNOWN_VERSION = (1, 0, 0)  # 4.2: of all modules
SIMPLE_SKIPS_OF_DRAFT = ["chain_module", "link_shapes_distance_statistics_module"]  # 4.4


@functools.lru_cache(maxsize=4096)
def mirrors(yaml: bytes, json: bytes) -> bool:
    """3.2.1: whether a `module.yaml` says what the `module.json` says."""
    return same(read_yaml(yaml), read_json(json))


def read_mirror(urdd: Urdd, folder: str) -> None:
    """3.2: `module.yaml` is well-formed, and says the same."""
    path = folder + "/module.yaml"
    data = urdd.tree.read(path)
    if data is None:
        return
    try:
        if not mirrors(data, urdd.tree.data(folder + "/module.json")):
            urdd.report.error("YML007", path)
    except TextFault as fault:
        urdd.report.error(str(fault), path)


def read_document(urdd: Urdd, folder: str) -> tuple[bool, Any]:
    """The document of a module's folder, and whether there is one."""
    path = folder + "/module.json"
    data = urdd.tree.read(path)
    if data is None:
        return False, None
    try:
        document = read_json(data)
    except TextFault as fault:
        urdd.report.error(str(fault), path)
        return False, None
    read_mirror(urdd, folder)
    return True, document


def follows_draft(name: str, document: Any, depends_on: list[str]) -> bool:
    """4.4: whether a document has the form of a draft."""
    if name == "link_shapes_simple_skips_module" and depends_on == SIMPLE_SKIPS_OF_DRAFT:
        return True
    if not isinstance(document, dict):
        return False
    if name == "link_shapes_skips_module" and "skipped_reasons" not in document:
        return fits(name, {**document, "skipped_reasons": []})
    if "held_out" in document:
        known = {key: value for key, value in document.items() if key != "held_out"}
        counts = ("num_colliding", "num_missed", "num_near_contact", "num_near_contact_missed")
        evaluation = dict.fromkeys((*counts, "num_free", "num_cleared"), 0)
        return "evaluation" not in document and fits(name, {**known, "evaluation": evaluation})
    return False


def read_known(urdd: Urdd, name: str, entry: dict[str, Any]) -> None:
    """4.2, 3.1.2: the document of a module of the table."""
    version = version_of(entry["version"])
    if version[0] != KNOWN_VERSION[0]:
        urdd.report.error("DIR008", entry["path"] + "/VERSION")
        return
    there, document = read_document(urdd, entry["path"])
    if not there:
        return
    if follows_draft(name, document, entry["depends_on"]):
        urdd.report.error("DIR030", file_of(name))
        return
    data = urdd.tree.data(file_of(name))
    if not file_fits(name, data, version > KNOWN_VERSION):
        urdd.report.error("SCH001", file_of(name))
        return
    urdd.documents[name] = document


def named_files(name: str, document: Any) -> list[tuple[str, str]]:
    """The files that a document names, with the place that names each."""
    found = []
    if name == "original_meshes_module":
        for place, file in enumerate(document["files"]):
            found.append((file["path"], f"/files/{place}/path"))
            for number, path in enumerate(file["side_files"]):
                found.append((path, f"/files/{place}/side_files/{number}"))
        return found
    for files, pointer in derived_files(document):
        for kind in ("stl", "obj", "glb"):
            if files[kind] is not None:
                found.append((files[kind], f"{pointer}/{kind}"))
    return found


def derived_files(document: Any) -> list[tuple[dict[str, Any], str]]:
    """The entries with files of a document of derived meshes, with their places."""
    found = []
    for place, mesh in enumerate(document.get("link_meshes", [])):
        if mesh:
            found.append((mesh["files"], f"/link_meshes/{place}/files"))
    for place, hull in enumerate(document.get("link_hulls", [])):
        if hull:
            found.append((hull, f"/link_hulls/{place}"))
    for place, pieces in enumerate(document.get("link_pieces", [])):
        for number, piece in enumerate(pieces):
            found.append((piece, f"/link_pieces/{place}/{number}"))
    return found


def check_named(urdd: Urdd, entry: dict[str, Any]) -> None:
    """2.7, 2.8, 7.1: files that a document names."""
    name = entry["name"]
    if name not in urdd.documents or not entry["path"].startswith(MESH):
        return
    listed = {file["path"] for file in entry["files"]}
    for path, pointer in named_files(name, urdd.documents[name]):
        check_path(urdd, path, file_of(name), pointer)
        kind = urdd.tree.kind(path)
        if kind == "missing" and path not in listed:
            urdd.report.error("MSH002", file_of(name), pointer)
        if kind == "folder":
            urdd.report.error("DIR023", path)
        if kind == "file" and path.startswith(entry["path"] + "/") and path not in listed:
            urdd.report.error("DIR012", "urdd.json")


def read_documents(urdd: Urdd) -> None:
    """Reads all documents that can be judged."""
    for entry in urdd.entries():
        name = entry["name"]
        if name in TABLE and entry["path"] == TABLE[name][0]:
            read_known(urdd, name, entry)
            check_named(urdd, entry)
        elif EXTENSION.fullmatch(entry["path"]):
            urdd.extensions.append((name, entry["path"]))
    meta_name = urdd.meta["robot_name"]
    if urdd.have("urdf_module") and urdd.documents["urdf_module"]["name"] != meta_name:
        urdd.report.error("DIR020", "urdd.json", "/robot_name")  # 2.11
    for name in list(TABLE):
        if not all(above in urdd.documents for above in TABLE[name][2] if listed(urdd, above)):
            urdd.documents.pop(name, None)  # 4.2, 4.4: what depends on it is not judged


def listed(urdd: Urdd, name: str) -> bool:
    return any(entry["name"] == name for entry in urdd.entries())

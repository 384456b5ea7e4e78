"""The rules of section 2: which files and folders there are, and what `urdd.json` says."""

from __future__ import annotations

import hashlib
import re
from typing import Any

from .jsontext import TextFault, read_json
from .modules import CLASSES, EXTENSION, ORDER, TABLE, VERSION, Urdd, version_of
from .report import Unreadable
from .schema import fits

META = "urdd.json"
BAD_PART = re.compile(r"[\\:\x00-\x1f\x7f-\x9f]")
KNOWN_MAJOR = 1
KNOWN_VERSION = (1, 1, 0)  # of this specification
DOCUMENTS = ("VERSION", "module.json")
PARENTS = ("mesh_modules", "link_shapes_modules")


def well_formed(path: str) -> bool:
    """2.8: one or more parts joined by `/`."""
    return all(
        part not in ("", ".", "..") and not BAD_PART.search(part) for part in path.split("/")
    )


def check_path(urdd: Urdd, path: str, file: str, pointer: str) -> bool:
    """2.8: the form of a path, and that it does not leave the root."""
    if not well_formed(path):
        urdd.report.error("DIR015", file, pointer)
        return False
    if urdd.tree.kind(path) == "outside":
        urdd.report.error("DIR016", file, pointer)
        return False
    return True


def open_metadata(urdd: Urdd) -> bool:
    """2.2, 4.1: reads `urdd.json`; says whether the rest can be judged."""
    kind = urdd.tree.kind(META)
    if kind == "missing":
        folders = [TABLE[name][0] for name in TABLE if TABLE[name][0] in urdd.tree.folders]
        versions = [urdd.tree.data(folder + "/VERSION").strip() for folder in folders]
        legacy = any(version.startswith(b"0.") for version in versions)
        if not folders or (legacy and not any(version.startswith(b"1.") for version in versions)):
            raise Unreadable("no urdd.json, and no module, or one of a legacy URDD (2.2, 10.2)")
        urdd.report.error("DIR001")
        return False
    if kind != "file" and not any(folder in urdd.tree.folders for folder, *_ in TABLE.values()):
        raise Unreadable("urdd.json is no file, and no module is there (2.2)")
    if kind in ("folder", "special"):
        urdd.report.error("DIR023", META)
        return False
    if kind == "outside":
        urdd.report.error("DIR016", META)
        return False
    try:
        meta = read_json(urdd.tree.data(META))
    except TextFault as fault:
        urdd.report.error(str(fault), META)
        return False
    version = meta.get("urdd_version") if isinstance(meta, dict) else None
    known = VERSION.fullmatch(version) if isinstance(version, str) else None
    if known and version_of(str(version))[0] != KNOWN_MAJOR:
        urdd.report.error("DIR025", META, "/urdd_version")  # 4.1
        return False
    newer = bool(known) and version_of(str(version)) > KNOWN_VERSION
    if not fits("root_metadata", meta, newer):
        urdd.report.error("SCH001", META)
        return False
    urdd.meta = meta
    return True


def check_listed_file(urdd: Urdd, entry: dict[str, Any], pointer: str, needed: bool) -> None:
    """2.7, 2.8, 2.9: a listed file, or the source, is there as it is described."""
    path = entry["path"]
    if not check_path(urdd, path, META, pointer + "/path"):
        return
    kind = urdd.tree.kind(path)
    if kind == "missing":
        if not needed:
            urdd.report.error("DIR011", META, pointer + "/path")
        return
    if kind != "file":
        urdd.report.error("DIR023", path)
        return
    data = urdd.tree.data(path)
    if len(data) != entry["size"] or hashlib.sha256(data).hexdigest() != entry["sha256"]:
        urdd.report.error("DIR014", path)


def check_source(urdd: Urdd) -> None:
    """2.12."""
    if urdd.meta["source"] is None:
        return
    entry = urdd.meta["source"]["Urdf"]
    check_listed_file(urdd, entry, "/source/Urdf", False)
    if "/" in entry["path"]:
        urdd.report.error("DIR028", META, "/source/Urdf/path")


def check_entries(urdd: Urdd) -> None:
    """2.6: names, folders and order of the entries."""
    names = [entry["name"] for entry in urdd.entries()]
    for place, entry in enumerate(urdd.entries()):
        pointer = f"/modules/{place}"
        name, path = entry["name"], entry["path"]
        if not check_path(urdd, path, META, pointer + "/path"):
            continue
        if path.split("/")[-1] != name or (name in TABLE and path != TABLE[name][0]):
            urdd.report.error("DIR021", META, pointer + "/path")
        if name in names[:place]:
            urdd.report.error("DIR021", META, pointer + "/name")
        paths = [file["path"].encode() for file in entry["files"]]
        if paths != sorted(set(paths)):
            urdd.report.error("DIR026", META, pointer + "/files")
    keys = [
        (ORDER.index(name), b"") if name in ORDER else (len(ORDER), name.encode()) for name in names
    ]
    if keys != sorted(keys):
        urdd.report.error("DIR026", META, "/modules")


def linked(urdd: Urdd, path: str) -> bool:
    """Whether a folder, or one on the way to it, is a symbolic link (2.3)."""
    parts = path.split("/")
    return any("/".join(parts[:n]) in urdd.tree.links for n in range(1, len(parts) + 1))


def check_folders(urdd: Urdd) -> None:
    """2.3: listed modules are there, and modules that are there are listed."""
    listed = {entry["path"] for entry in urdd.entries()}
    for place, entry in enumerate(urdd.entries()):
        path = entry["path"]
        kind = urdd.tree.kind(path)
        if well_formed(path) and kind != "outside" and (kind != "folder" or linked(urdd, path)):
            urdd.report.error("DIR002", META, f"/modules/{place}")
    folders = [folder for folder, _, _ in TABLE.values()]
    folders += [path for path in urdd.tree.folders if EXTENSION.fullmatch(path)]
    for folder in folders:
        if folder in urdd.tree.folders and folder not in listed:
            urdd.report.error("DIR003", folder)


def check_version_file(urdd: Urdd, entry: dict[str, Any]) -> None:
    """2.4, 2.5."""
    path = entry["path"] + "/VERSION"
    kind = urdd.tree.kind(path)
    judged = entry["name"] in TABLE or EXTENSION.fullmatch(entry["path"])
    if kind == "missing" and judged:
        urdd.report.error("DIR005", path)
    if kind != "file":
        return
    text = urdd.tree.data(path).decode("utf-8", "replace")
    if not VERSION.fullmatch(text.removesuffix("\n")):
        urdd.report.error("DIR006", path)
    elif text.removesuffix("\n") != entry["version"]:
        urdd.report.error("DIR007", path)


def check_module_files(urdd: Urdd, place: int, entry: dict[str, Any]) -> None:
    """2.4, 2.7 to 2.9: what a module's folder has, and what is listed of it."""
    folder = entry["path"]
    extension = EXTENSION.fullmatch(folder)
    known = entry["name"] in TABLE
    document = folder + "/module.json"
    if urdd.tree.kind(document) == "missing" and (known or extension):
        urdd.report.error("DIR004", document)
    names = ("VERSION", "module.json", "module.yaml", *(["schema.json"] if extension else []))
    paths = [file["path"] for file in entry["files"]]
    for path in [f"{folder}/{name}" for name in names]:
        if urdd.tree.kind(path) == "file" and path not in paths:
            urdd.report.error("DIR012", META, f"/modules/{place}/files")
    for number, file in enumerate(entry["files"]):
        pointer = f"/modules/{place}/files/{number}"
        needed = (known or extension) and file["path"] in (document, folder + "/VERSION")
        check_listed_file(urdd, file, pointer, bool(needed))
        if not file["path"].startswith(folder + "/"):
            urdd.report.error("DIR012", META, pointer)


def carried(urdd: Urdd, name: str) -> bool:
    """2.10, 11.2: whether a module is listed, or its folder is there."""
    if any(entry["name"] == name for entry in urdd.entries()):
        return True
    if name in TABLE:
        return TABLE[name][0] in urdd.tree.folders
    named = [at for at in urdd.tree.folders if at.rpartition("/")[2] == name]
    outside = [at for at in named if not re.search(r"_module/", at) and name.endswith("_module")]
    return any(at + "/" + file in urdd.tree.files for at in outside for file in DOCUMENTS)


def check_dependencies(urdd: Urdd, place: int, entry: dict[str, Any]) -> None:
    """2.10."""
    pointer = f"/modules/{place}/depends_on"
    named = entry["depends_on"]
    rows = TABLE[entry["name"]][2] if entry["name"] in TABLE else None
    if len(set(named)) != len(named):
        urdd.report.error("DIR018", META, pointer)
        return
    if rows is not None and set(named) != set(rows):
        urdd.report.error("DIR018", META, pointer)
        return
    for name in named:
        if not carried(urdd, name):
            urdd.report.error("DIR017", META, pointer)


def in_class(urdd: Urdd, name: str) -> bool:
    """Whether the class that is claimed asks for a module (12.1)."""
    claimed = CLASSES.index(urdd.meta["conformance_class"])
    return name in TABLE and TABLE[name][1] in CLASSES[: claimed + 1]


def check_class(urdd: Urdd) -> None:
    """12.1."""
    for name in TABLE:
        if in_class(urdd, name) and not carried(urdd, name):
            urdd.report.error("DIR019", META, "/conformance_class")


def check_names(urdd: Urdd) -> None:
    """2.9: names in UTF-8, and none that differ by case alone."""
    modules = {entry["path"] for entry in urdd.entries() if entry["path"] in urdd.tree.folders}
    special = {META, *PARENTS, *modules}
    if urdd.meta["source"]:
        special.add(urdd.meta["source"]["Urdf"]["path"])
    inside = {path for module in modules for path in urdd.tree.below(module)}
    for path in inside:
        if any("\udc80" <= sign <= "\udcff" for sign in path):
            urdd.report.error("DIR024", path)
    matters = special | inside
    by_lower: dict[str, list[str]] = {}
    every = {*urdd.tree.files, *urdd.tree.folders, *urdd.tree.links, *urdd.tree.special}
    for path in sorted(every):
        folder, _, name = path.rpartition("/")
        by_lower.setdefault(f"{folder}/{name.lower()}", []).append(path)
    for paths in by_lower.values():
        if len(paths) > 1 and any(path in matters for path in paths):
            urdd.report.error("DIR027", paths[1])


def check_directory(urdd: Urdd) -> bool:
    """Section 2; says whether documents can be judged."""
    if not open_metadata(urdd):
        return False
    check_source(urdd)
    check_entries(urdd)
    check_folders(urdd)
    check_names(urdd)
    check_class(urdd)
    for place, entry in enumerate(urdd.entries()):
        check_dependencies(urdd, place, entry)
        check_version_file(urdd, entry)
        check_module_files(urdd, place, entry)
    return True

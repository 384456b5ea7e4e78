"""The files that a mesh file names (7.5)."""

from __future__ import annotations

import re
from typing import Any
from urllib.parse import unquote

from .collada import parse_collada
from .gltf import document_of, split_glb
from .mesh import format_of
from .tree import Tree

CONTROL = re.compile(r"[:\x00-\x1f\x7f-\x9f]")
MTL_WORDS = ("bump", "disp", "decal", "norm", "refl")


def normal(folder: str, name: str) -> str:
    """The path that a name leads to from a folder; that of the root where it leads out of it."""
    parts = folder.split("/")
    for part in CONTROL.sub("_", name.replace("\\", "/")).split("/"):
        if part == "..":
            if not parts:
                return ""
            parts.pop()
        elif part not in ("", "."):
            parts.append(part)
    return "/".join(parts)


def lines_of(data: bytes) -> list[str]:
    text = data.decode("utf-8", "replace").replace("\r\n", "\n").replace("\r", "\n")
    return text.replace("\\\n", " ").split("\n")


def rest_of(line: str) -> str:
    """What follows the first word of a line."""
    parts = line.strip().split(None, 1)
    return parts[1].strip() if len(parts) > 1 else ""


def libraries_of(tree: Tree, folder: str, data: bytes) -> list[str]:
    """The paths that `mtllib` names in an OBJ."""
    found = []
    for line in lines_of(data):
        if line.split()[:1] != ["mtllib"] or not rest_of(line):
            continue
        rest = rest_of(line)
        names = rest.split()
        there = tree.kind(normal(folder, rest)) == "file"
        if there or not all(name.lower().endswith(".mtl") for name in names):
            names = [rest]
        found += [normal(folder, name) for name in names]
    return found


def maps_of(tree: Tree, mesh_folder: str, library: str) -> list[str]:
    """The paths of the textures that an MTL names."""
    data = tree.data(library)
    folder = library.rpartition("/")[0]
    found = []
    in_material = False
    for line in lines_of(data):
        word = (line.split() or [""])[0].lower()
        in_material = in_material or word == "newmtl"
        rest = rest_of(line)
        if not in_material or not (word in MTL_WORDS or word.startswith("map_")):
            continue
        name = rest.split()[-1] if rest.startswith("-") else rest
        found.append(normal(mesh_folder if name.startswith("/") else folder, name))
    return found


def images_of(data: bytes) -> list[str]:
    """The names of images in a COLLADA file."""
    found = []
    for library in parse_collada(data).all("library_images"):
        for image in library.all("image"):
            for init in image.all("init_from"):
                refs = init.all("ref")
                found += [one.text.strip() for one in (refs or [init])]
    return found


def uris_of(document: Any) -> list[str]:
    """The URIs of images and buffers in glTF that are not `data:`."""
    entries = [*document.get("images", []), *document.get("buffers", [])]
    uris = [entry["uri"] for entry in entries if "uri" in entry]
    return [uri for uri in uris if not uri.startswith("data:")]


def side_files(tree: Tree, path: str) -> list[str]:
    """7.5: the files that a mesh names and that are there, the mesh left out."""
    data = tree.data(path)
    folder = path.rpartition("/")[0]
    kind = format_of(data, path)
    names: list[str] = []
    found: list[str] = []
    if kind == "obj":
        libraries = libraries_of(tree, folder, data)
        found += libraries
        for library in libraries:
            found += maps_of(tree, folder, library)
    elif kind == "dae":
        names = images_of(data)
    elif kind in ("gltf", "glb"):
        document = document_of(data) if kind == "gltf" else split_glb(data)[0]
        names = uris_of(document)
    found += [normal(folder, unquote(name)) for name in names]
    there = {one for one in found if tree.kind(one) == "file" and one != path}
    return sorted(there, key=str.encode)

"""The files of a URDD, read into memory from a folder or a zip archive (2.3, 2.14, 13.1)."""

from __future__ import annotations

import io
import os
import stat
import zipfile

MAX_LINKS = 40


class Tree:
    """Files, folders and symbolic links by their path from the root, with `/` between parts."""

    def __init__(self, place: str = "") -> None:
        self.place = place
        self.files: dict[str, bytes] = {}
        self.folders: set[str] = {""}
        self.links: dict[str, str] = {}
        self.special: set[str] = set()

    def top(self) -> list[str]:
        """The folders directly in the root."""
        return sorted(path for path in self.folders if path and "/" not in path)

    def below(self, folder: str) -> list[str]:
        """The paths of all that lies in a folder, at any depth; links are not followed."""
        found = [*self.files, *self.folders, *self.links, *self.special]
        return sorted(path for path in found if path.startswith(folder + "/"))

    def resolve(self, path: str) -> tuple[str, str]:
        """Follows links (2.3, 2.8).

        Gives the kind (`file`, `folder`, `special`, `missing`, `outside`) and the real path.
        """
        parts = path.split("/")
        real: list[str] = []
        followed = 0
        while parts:
            part = parts.pop(0)
            if part in ("", "."):
                continue
            if part == "..":
                if not real:
                    return "outside", ""
                real.pop()
                continue
            here = "/".join([*real, part])
            if here not in self.links:
                real.append(part)
                continue
            followed += 1
            if followed > MAX_LINKS:
                return "missing", ""
            target = self.links[here]
            if target.startswith("/"):
                if not (target + "/").startswith(self.place + "/"):
                    return "outside", ""
                target = target[len(self.place) :]
                real = []
            parts = target.split("/") + parts
        found = "/".join(real)
        if found in self.files:
            return "file", found
        if found in self.folders:
            return "folder", found
        if found in self.special:
            return "special", found
        return "missing", found

    def kind(self, path: str) -> str:
        """What a path leads to."""
        return self.resolve(path)[0]

    def read(self, path: str) -> bytes | None:
        """The bytes of a file, or None where the path does not lead to one."""
        kind, real = self.resolve(path)
        return self.files[real] if kind == "file" else None

    def data(self, path: str) -> bytes:
        """The bytes of a file that is known to be there."""
        return self.read(path) or b""


def read_folder(folder: str) -> Tree:
    """Reads all of a folder, without following links."""
    tree = Tree(os.path.realpath(folder))
    waiting = [""]
    while waiting:
        at = waiting.pop()
        with os.scandir(os.path.join(folder, at)) as entries:
            for entry in entries:
                path = f"{at}/{entry.name}" if at else entry.name
                mode = entry.stat(follow_symlinks=False).st_mode
                if stat.S_ISLNK(mode):
                    tree.links[path] = os.readlink(entry.path)
                elif stat.S_ISDIR(mode):
                    tree.folders.add(path)
                    waiting.append(path)
                elif stat.S_ISREG(mode) and os.access(entry.path, os.R_OK):
                    with open(entry.path, "rb") as file:
                        tree.files[path] = file.read()
                else:
                    tree.special.add(path)
    return tree


def read_archive(data: bytes) -> Tree:
    """Reads a packed URDD (2.14). Raises what `zipfile` raises where it is not an archive."""
    tree = Tree("/")
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        for entry in archive.infolist():
            path = entry.filename.rstrip("/")
            above = path.split("/")[:-1]
            tree.folders.update("/".join(above[:n]) for n in range(1, len(above) + 1))
            if entry.is_dir():
                tree.folders.add(path)
            elif stat.S_ISLNK(entry.external_attr >> 16):
                tree.links[path] = archive.read(entry).decode()
            else:
                tree.files[path] = archive.read(entry)
    return tree


def subtree(tree: Tree, folder: str) -> Tree:
    """The part of a tree in one folder, as a tree of its own."""
    cut = len(folder) + 1
    part = Tree(f"{tree.place.rstrip('/')}/{folder}")
    inside = set(tree.below(folder))
    part.files = {path[cut:]: data for path, data in tree.files.items() if path in inside}
    part.folders |= {path[cut:] for path in tree.folders if path in inside}
    part.links = {path[cut:]: to for path, to in tree.links.items() if path in inside}
    return part

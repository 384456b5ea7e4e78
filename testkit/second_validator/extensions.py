"""The rules of extensions (11.1, 11.5)."""

from __future__ import annotations

from typing import Any

from .documents import read_document
from .extension_schema import Unusable, check_schema, check_work
from .jsontext import TextFault, read_json
from .modules import Urdd
from .schema import Interpreter, is_integer

MAX_SCHEMA_BYTES = 1024 * 1024
NUM_SAMPLES = 2**32


class Counts:
    """11.4: how many of each thing there are; any number where the URDD does not say."""

    def __init__(self, urdd: Urdd) -> None:
        self.numbers: dict[str, int] = {"sample": NUM_SAMPLES}
        self.pieces: list[int] | None = None
        robot = urdd.document("urdf_module")
        if robot:
            self.numbers["link"] = len(robot["links"])
            self.numbers["joint"] = len(robot["joints"])
            for kind in ("visual", "collision"):
                self.numbers[kind] = max([len(link[kind]) for link in robot["links"]], default=0)
        if urdd.have("dof_module"):
            self.numbers["dof"] = urdd.documents["dof_module"]["num_dofs"]
        if urdd.have("convex_hull_meshes_module"):
            hulls = urdd.documents["convex_hull_meshes_module"]["link_hulls"]
            self.numbers["full_shape"] = len([hull for hull in hulls if hull])
        if urdd.have("convex_decomposition_meshes_module"):
            pieces = urdd.documents["convex_decomposition_meshes_module"]["link_pieces"]
            self.pieces = [len(of_link) for of_link in pieces]
            self.numbers["decomposition_shape"] = sum(self.pieces)
            self.numbers["piece"] = max(self.pieces, default=0)
        if urdd.have("composition_module"):
            self.numbers["part"] = len(urdd.documents["composition_module"]["parts"])
        if urdd.have("self_collision_model_module"):
            self.numbers["pair"] = len(urdd.documents["self_collision_model_module"]["pairs"])

    def index_fits(self, word: str, value: float) -> bool:
        return is_integer(value) and 0 <= value < self.numbers.get(word, float("inf"))

    def length_fits(self, word: str, length: int, link: int | None) -> bool:
        if word == "pieces":
            if self.pieces is None:
                return True
            if link is not None and link < len(self.pieces):
                return length == self.pieces[link]
            return length in self.pieces
        return self.numbers.get(word[:-1], length) == length


def read_schema(urdd: Urdd, folder: str) -> Any:
    """11.1: the schema of an extension; raises Unusable."""
    data = urdd.tree.read(folder + "/schema.json")
    if data is None or len(data) > MAX_SCHEMA_BYTES:
        raise Unusable
    try:
        schema = read_json(data, True)
    except TextFault as fault:
        raise Unusable from fault
    check_schema(schema)
    return schema


def check_extension(urdd: Urdd, folder: str, counts: Counts) -> None:
    """11.1, 11.5."""
    there, document = read_document(urdd, folder)
    try:
        schema = read_schema(urdd, folder)
        if there:
            check_work(schema, document)
    except Unusable:
        urdd.report.error("EXT001", folder + "/schema.json")
        return
    if not there:
        return
    file = folder + "/module.json"
    interpreter = Interpreter(schema)
    if not interpreter.valid(document):
        urdd.report.error("EXT002", file)
        return
    interpreter.counts = counts
    for keyword, code in (("x-index", "EXT003"), ("x-length", "EXT004")):
        interpreter.keyword = keyword
        if not interpreter.valid(document):
            urdd.report.error(code, file)


def check_extensions(urdd: Urdd) -> None:
    """11."""
    counts = Counts(urdd)
    for _, folder in urdd.extensions:
        check_extension(urdd, folder, counts)

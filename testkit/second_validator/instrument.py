"""Loads the second validator so that it notes which blocks it executes, and remembers results."""

from __future__ import annotations

import ast
import functools
import os
import re
import sys
import types
from collections.abc import Callable
from typing import Any

HERE = os.path.dirname(os.path.abspath(__file__))
PACKAGE = "second_validator"
NOT_MUTATED = ("mutants", "mutation", "instrument", "schema_mutants", "__main__", "__init__")
SHAPE_MODULES = (
    "link_shapes_approximations_module",
    "link_shapes_distance_statistics_module",
    "link_shapes_simple_skips_module",
    "link_shapes_skips_module",
    "link_shapes_max_distance_from_origin_module",
    "self_collision_model_module",
)
CORE_MODULES = (
    "dof_module",
    "chain_module",
    "connections_module",
    "bounds_module",
    "kinematics_samples_module",
    "named_configurations_module",
)
MESH_MODULES = (
    "original_meshes_module",
    "plain_meshes_module",
    "convex_hull_meshes_module",
    "convex_decomposition_meshes_module",
)
# Functions on a whole URDD that are remembered: the documents that each reads, and whether meshes.
STAGES = {
    "check_core": (CORE_MODULES, False),
    "check_loops": ((*CORE_MODULES, "loops_module"), False),
    "check_derived_meshes": (MESH_MODULES, True),
    "check_originals": (MESH_MODULES, True),
    "check_shapes": ((*MESH_MODULES, *SHAPE_MODULES), True),
    "check_all_matrices": ((*MESH_MODULES, *SHAPE_MODULES), True),
}


class Hits:
    """The blocks that were executed since the last start."""

    def __init__(self) -> None:
        self.blocks: set[int] = set()


HITS = Hits()
CHANGED: set[int] = set()
FRESH: dict[Any, Any] = {}


def remember(memory: dict[Any, Any], key: Any, compute: Callable[[], Any]) -> Any:
    """A result, or what was raised, with the blocks that were executed for it."""
    entry = memory.get(key)
    if entry is not None and CHANGED and not CHANGED.isdisjoint(entry[1]):
        entry = FRESH.get((id(memory), key))
    if entry is None:
        outer, HITS.blocks = HITS.blocks, set()
        try:
            result: tuple[bool, Any] = (True, compute())
        except Exception as fault:
            result = (False, fault)
        entry = (result, frozenset(HITS.blocks))
        HITS.blocks = outer
        if CHANGED:
            FRESH[id(memory), key] = entry
        else:
            memory[key] = entry
    HITS.blocks |= entry[1]
    if not entry[0][0]:
        raise entry[0][1]
    return entry[0][1]


def recording_cache(maxsize: int = 0) -> Callable[[Any], Any]:
    """In place of `functools.lru_cache`."""

    def wrap(function: Any) -> Any:
        memory: dict[Any, Any] = {}

        def cached(*arguments: Any) -> Any:
            return remember(memory, arguments, lambda: function(*arguments))

        cached.function = function  # type: ignore[attr-defined]
        return cached

    return wrap


def staged(function: Any, names: tuple[str, ...], with_meshes: bool) -> Any:
    """A function on a URDD, remembered by the documents and meshes that it reads."""
    memory: dict[Any, Any] = {}
    kept: list[Any] = []

    def stage(urdd: Any, *arguments: Any) -> Any:
        documents = [urdd.documents.get(name) for name in ("urdf_module", *names)]
        kept.append(documents)
        key: list[Any] = [id(document) for document in documents]
        key.append(frozenset(urdd.report.codes()))
        key.append(tuple(entry["name"] for entry in urdd.meta["modules"]))
        if with_meshes:
            paths = sorted(path for path in urdd.tree.files if path.startswith("mesh_modules/"))
            key += [(path, id(urdd.tree.files[path])) for path in paths]
            key += sorted(urdd.tree.links.items())
            key += [tuple(file["path"] for file in e["files"]) for e in urdd.meta["modules"]]
        if "self_collision_model_module" in names or not with_meshes:
            key += [
                id(data) for path, data in sorted(urdd.tree.files.items()) if "module.j" in path
            ]

        def compute() -> Any:
            before = len(urdd.report.errors)
            result = function(urdd, *arguments)
            return result, urdd.report.errors[before:]

        result, errors = remember(memory, tuple(key), compute)
        for error in errors:
            urdd.report.error(*error)
        return result

    stage.function = function  # type: ignore[attr-defined]
    return stage


class Instrument(ast.NodeTransformer):
    """Puts a mark at the beginning of each block, and notes the block of each node."""

    def __init__(self, first: int) -> None:
        self.next = first
        self.block_of: dict[int, int] = {}

    def mark(self, body: list[ast.stmt]) -> list[ast.stmt]:
        block = self.next
        self.next += 1
        start = 0
        text = isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant)
        start = 1 if text and len(body) > 1 else 0
        call = ast.parse(f"_hits.blocks.add({block})").body[0]
        for node in body:
            for inner in ast.walk(node):
                self.block_of[id(inner)] = block
        marked = [*body[:start], ast.copy_location(call, body[0]), *body[start:]]
        return [self.visit(statement) for statement in marked]

    def visit_block(self, node: Any) -> Any:
        for name in ("body", "orelse", "finalbody"):
            if getattr(node, name, None):
                setattr(node, name, self.mark(getattr(node, name)))
        for handler in getattr(node, "handlers", []):
            handler.body = self.mark(handler.body)
        return node

    visit_FunctionDef = visit_If = visit_For = visit_While = visit_Try = visit_With = visit_block


class Loaded:
    """A module of the package, instrumented."""

    def __init__(self, name: str, first: int) -> None:
        self.name = name
        self.path = os.path.join(HERE, name + ".py")
        with open(self.path, encoding="utf-8") as file:
            self.source = file.read()
        self.tree = ast.parse(self.source)
        instrument = Instrument(first)
        self.tree = ast.fix_missing_locations(instrument.visit(self.tree))
        self.block_of = instrument.block_of
        self.next = instrument.next
        self.module = types.ModuleType(f"{PACKAGE}.{name}")
        self.module.__file__ = self.path
        self.module.__package__ = PACKAGE

        self.constants = [
            target.id
            for statement in self.tree.body
            if isinstance(statement, (ast.Assign, ast.AnnAssign, ast.AugAssign))
            for target in getattr(statement, "targets", [getattr(statement, "target", None)])
            if isinstance(target, ast.Name)
        ]
        self.blocks_of_name: dict[str, set[int]] = {}
        for node in ast.walk(self.tree):
            if isinstance(node, ast.Name) and id(node) in self.block_of:
                self.blocks_of_name.setdefault(node.id, set()).add(self.block_of[id(node)])

    def codes_near(self, line: int) -> dict[str, int]:
        """The codes of rules in this module: 0 for those in the function of a line, else 1."""
        near = dict.fromkeys(re.findall(r"\b[A-Z]{3}[0-9]{3}\b", self.source), 1)
        lines = self.source.split("\n")
        for node in ast.walk(self.tree):
            if isinstance(node, ast.FunctionDef) and node.lineno <= line <= (node.end_lineno or 0):
                inside = "\n".join(lines[node.lineno - 1 : node.end_lineno])
                near |= dict.fromkeys(re.findall(r"\b[A-Z]{3}[0-9]{3}\b", inside), 0)
        return near

    def code(self) -> types.CodeType:
        return compile(self.tree, self.path, "exec")


def load_package() -> dict[str, Loaded]:
    """Loads all modules, each once, with `lru_cache` that remembers blocks."""
    functools.lru_cache = recording_cache  # type: ignore[assignment]
    package = types.ModuleType(PACKAGE)
    package.__path__ = []  # type: ignore[attr-defined]
    sys.modules[PACKAGE] = package
    names = sorted(f[:-3] for f in os.listdir(HERE) if f.endswith(".py"))
    loaded: dict[str, Loaded] = {}
    first = 1
    for name in names:
        if name not in NOT_MUTATED:
            loaded[name] = Loaded(name, first)
            first = loaded[name].next

    def need(name: str) -> None:
        qualified = f"{PACKAGE}.{name}"
        if qualified in sys.modules:
            return
        for match in re.finditer(r"^from \.(\w+) import", loaded[name].source, re.MULTILINE):
            need(match[1])
        module = loaded[name].module
        module.__dict__["_hits"] = HITS
        sys.modules[qualified] = module
        exec(loaded[name].code(), module.__dict__)

    for name in loaded:
        need(name)
    validator = sys.modules[f"{PACKAGE}.validator"]
    for name, (documents, with_meshes) in STAGES.items():
        setattr(validator, name, staged(getattr(validator, name), documents, with_meshes))
    return loaded

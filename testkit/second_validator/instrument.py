"""Loads the second validator so that it notes which blocks it executes, and remembers results."""

from __future__ import annotations

import ast
import functools
import marshal
import os
import pickle
import re
import sys
import time
import types
from collections.abc import Callable, Iterable
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
    "check_mesh_lists": ((*MESH_MODULES, *SHAPE_MODULES), False),
    "check_derived_meshes": (MESH_MODULES, True),
    "check_originals": (MESH_MODULES, True),
    "check_shapes": ((*MESH_MODULES, *SHAPE_MODULES), True),
    "check_all_matrices": ((*MESH_MODULES, *SHAPE_MODULES), True),
}

# Pure functions that are remembered by the identity of what they are given.
PURE = {
    "extension_schema": ("check_schema", "check_work"),
    "kinematics": ("sampled", "named"),
    "derived_rules": ("robot_of",),
    "derived_meshes": ("plain_holds",),
    "mesh": ("is_usable",),
}
PLAIN = (".json", ".yaml", "VERSION")


class Hits:
    """What runs now: the blocks that it executed itself, and what it asked that is remembered."""

    def __init__(self) -> None:
        self.start()

    def start(self) -> None:
        self.blocks: set[int] = set()
        self.asked: dict[int, Entry] = {}

    def mask(self) -> int:
        return mask_of(self.blocks)


class Entry:
    """A result that is remembered, with what it depends on."""

    __slots__ = ("again", "all", "asked", "fresh", "own", "result", "same", "seconds", "tried")

    def __init__(self, again: Callable[[], Any] | None) -> None:
        self.again = again
        self.own = self.all = self.tried = 0
        self.asked: tuple[Entry, ...] = ()
        self.result: Any = None
        self.fresh: Any = None
        self.seconds = 0.0
        self.same = True

    def still_holds(self) -> bool:
        """Whether the mutant leaves the result as it is; what is pure is computed again for that.

        Where the mutant changes something inside, and what is inside gives the same, nothing
        around it needs to run.
        """
        if not self.all & CHANGED.mask:
            return True
        if self.tried != CHANGED.number:
            self.tried, self.fresh = CHANGED.number, None
            self.same = not self.own & CHANGED.mask and all(e.still_holds() for e in self.asked)
            if not self.same and self.again:
                self.fresh = outcome(self.again)
                self.same = alike(self.result, self.fresh)
        return self.same


class Changed:
    """The blocks that the mutant changes, as bits, and the mutant's number."""

    def __init__(self) -> None:
        self.mask = 0
        self.number = 0
        self.fresh: dict[Any, Any] = {}
        self.kept: list[Any] = []

    def begin(self, blocks: set[int]) -> None:
        self.number += 1
        self.mask = mask_of(blocks)

    def end(self) -> None:
        self.mask = 0
        self.fresh.clear()
        self.kept.clear()


def mask_of(blocks: Iterable[int]) -> int:
    mask = 0
    for block in blocks:
        mask |= 1 << block
    return mask


HITS = Hits()
CHANGED = Changed()


def outcome(compute: Callable[[], Any]) -> tuple[bool, Any]:
    """A result, or what was raised."""
    try:
        return True, compute()
    except Exception as fault:
        return False, fault


def frozen(value: Any) -> bytes:
    try:
        return marshal.dumps(value, 0)
    except ValueError:
        return pickle.dumps(value)


def alike(a: tuple[bool, Any], b: tuple[bool, Any]) -> bool:
    """Whether two outcomes are the same; where that is not known, they are not."""
    if a[0] != b[0]:
        return False
    if not a[0]:
        return type(a[1]) is type(b[1]) and str(a[1]) == str(b[1])
    try:
        return a[1] is b[1] or frozen(a[1]) == frozen(b[1])
    except Exception:
        return False


def remember(
    memory: dict[Any, Entry], key: Any, compute: Callable[[], Any], pure: bool, kept: Any = None
) -> Any:
    """A result, or what was raised, as it was when it was computed first, or as a mutant has it."""
    entry = memory.get(key)
    if CHANGED.mask:
        result = entry.result if entry and entry.still_holds() else None
        if result is None and entry and entry.fresh:
            result = entry.fresh
        if result is None:
            result = CHANGED.fresh.get((id(memory), key))
        if result is None:
            CHANGED.kept.append(kept)
            result = outcome(compute)
            if entry and alike(entry.result, result):
                result = entry.result
            CHANGED.fresh[id(memory), key] = result
    else:
        if entry is None:
            entry = memory[key] = record(compute, pure, kept)
        HITS.asked[id(entry)] = entry
        result = entry.result
    if not result[0]:
        raise result[1]
    return result[1]


def record(compute: Callable[[], Any], pure: bool, kept: Any) -> Entry:
    """Runs what was not run yet, and notes what it depends on."""
    entry = Entry(compute if pure else None)
    KEPT.append(kept)
    outer = HITS.blocks, HITS.asked
    HITS.start()
    start = time.process_time()
    entry.result = outcome(compute)
    entry.seconds = time.process_time() - start
    entry.asked = tuple(HITS.asked.values())
    entry.own = HITS.mask()
    entry.all = entry.own
    for inner in entry.asked:
        entry.all |= inner.all
    HITS.blocks, HITS.asked = outer
    return entry


KEPT: list[Any] = []


def recording_cache(maxsize: int = 0) -> Callable[[Any], Any]:
    """In place of `functools.lru_cache`."""

    def wrap(function: Any) -> Any:
        memory: dict[Any, Entry] = {}

        def cached(*arguments: Any) -> Any:
            return remember(memory, arguments, lambda: function(*arguments), True)

        cached.function = function  # type: ignore[attr-defined]
        return cached

    return wrap


def by_identity(function: Any) -> Any:
    """A pure function of documents that are remembered, and of what is made of them."""
    memory: dict[Any, Entry] = {}

    def cached(*arguments: Any) -> Any:
        key = tuple(a if isinstance(a, (int, str)) else (id(a),) for a in arguments)
        return remember(memory, key, lambda: function(*arguments), True, arguments)

    cached.function = function  # type: ignore[attr-defined]
    return cached


def key_of_meshes(urdd: Any) -> tuple[Any, ...]:
    """The files of a URDD that rules of meshes may read."""
    tree = urdd.tree
    if not hasattr(tree, "key"):
        paths = [p for p in sorted(tree.files) if p.startswith("mesh_") or not p.endswith(PLAIN)]
        tree.key = (
            tuple((path, id(tree.files[path])) for path in paths),
            tuple(sorted(tree.links.items())),
            tuple(sorted(path for path in tree.folders if path.startswith("mesh_"))),
            tuple(sorted(tree.special)),
        )
    return tree.key


DOCUMENTS: dict[int, Any] = {}


def known(value: Any) -> int:
    """An object that is kept, by its number."""
    DOCUMENTS[id(value)] = value
    return id(value)


def state_of(urdd: Any) -> tuple[Any, ...]:
    """What stages change of a URDD but its report."""
    documents = tuple((name, known(one)) for name, one in urdd.documents.items())
    return known(urdd.meta), documents, tuple(urdd.extensions)


def put_state(urdd: Any, state: tuple[Any, ...]) -> None:
    urdd.meta = DOCUMENTS[state[0]]
    urdd.documents = {name: DOCUMENTS[number] for name, number in state[1]}
    urdd.extensions = list(state[2])


def staged(function: Any) -> Any:
    """A function on a URDD, remembered by the documents and files that it reads."""
    memory: dict[Any, Entry] = {}
    name = function.__name__

    def key_of(urdd: Any, arguments: tuple[Any, ...]) -> tuple[Any, ...]:
        codes = frozenset(urdd.report.codes())
        if name not in STAGES:
            state = state_of(urdd) if urdd.meta else ()
            return (known(urdd.tree), codes, state, *map(id, arguments))
        names, with_meshes = STAGES[name]
        key: list[Any] = [codes, *(id(urdd.documents.get(one)) for one in ("urdf_module", *names))]
        key += [id(one) for one in arguments]
        key.append(tuple(entry["name"] for entry in urdd.meta["modules"]))
        if with_meshes:
            key.append(key_of_meshes(urdd))
            key += [tuple(file["path"] for file in e["files"]) for e in urdd.meta["modules"]]
        return tuple(key)

    def stage(urdd: Any, *arguments: Any) -> Any:
        tree, state, errors = urdd.tree, state_of(urdd), list(urdd.report.errors)

        def compute() -> Any:
            fresh = type(urdd)(tree, type(urdd.report)())
            put_state(fresh, state)
            fresh.report.errors = list(errors)
            result = function(fresh, *arguments)
            return result, fresh.report.errors[len(errors) :], state_of(fresh)

        key = key_of(urdd, arguments)
        result, new, after = remember(memory, key, compute, True, (arguments, state))
        urdd.report.errors += new
        if name in ("check_directory", "read_documents"):
            put_state(urdd, after)
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
            for whole in getattr(statement, "targets", [getattr(statement, "target", None)])
            for target in getattr(whole, "elts", [whole])
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

    def blocks_of_function(self, name: str) -> set[int]:
        """The blocks with which functions of a name begin."""
        return {
            self.block_of[id(node.body[-1])]
            for node in ast.walk(self.tree)
            if isinstance(node, ast.FunctionDef) and node.name == name.rpartition(".")[2]
        }

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
        for function in PURE.get(name, ()):
            module.__dict__[function] = by_identity(module.__dict__[function])

    for name in loaded:
        need(name)
    validator = sys.modules[f"{PACKAGE}.validator"]
    for name, function in list(vars(validator).items()):
        if name.startswith("check_") or name == "read_documents":
            setattr(validator, name, staged(function))
    return loaded

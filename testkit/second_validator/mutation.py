"""The changes that `mutants.py` makes to a program, by its syntax tree."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from second_validator.instrument import Loaded

SWAPS: dict[type, list[type]] = {
    ast.Lt: [ast.LtE, ast.GtE], ast.LtE: [ast.Lt, ast.Gt], ast.Gt: [ast.GtE, ast.LtE],
    ast.GtE: [ast.Gt, ast.Lt], ast.Eq: [ast.NotEq], ast.NotEq: [ast.Eq], ast.In: [ast.NotIn],
    ast.NotIn: [ast.In], ast.Is: [ast.IsNot], ast.IsNot: [ast.Is], ast.Add: [ast.Sub],
    ast.Sub: [ast.Add], ast.Mult: [ast.Div], ast.Div: [ast.Mult], ast.And: [ast.Or],
    ast.Or: [ast.And],
}  # fmt: skip
# No number is exactly at a tolerance, so whether the tolerance itself passes is not asked.
TOLERANCES = re.compile(
    r"RELATIVE|ABSOLUTE|[Tt]olerance|TOLERANCE|FIT|allowed|NEARLY|slack|thin|least|LEAST_AREA|SAG"
)
CALLS = {"min": "max", "max": "min", "all": "any", "any": "all"}
Change = Callable[[], Callable[[], None]]


def set_field(node: Any, name: str, value: Any) -> Change:
    def change() -> Callable[[], None]:
        before = getattr(node, name)
        setattr(node, name, value)
        return lambda: setattr(node, name, before)

    return change


def set_item(items: list[Any], place: int, value: Any) -> Change:
    def change() -> Callable[[], None]:
        before = items[place]
        items[place] = ast.copy_location(value, before)
        return lambda: items.__setitem__(place, before)

    return change


def constants(value: Any) -> list[Any]:
    """What a constant of a program becomes."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1] if value < 2 else [value + 1, value - 1]
    return [value * 10, value / 10] if isinstance(value, float) and value else []


def changes_of(node: ast.AST) -> Iterator[tuple[str, Change]]:
    """The mutations of one node."""
    if isinstance(node, ast.Compare):
        tolerant = TOLERANCES.search(ast.unparse(node)) is not None
        for place, op in enumerate(node.ops):
            others = SWAPS.get(type(op), [])
            for other in others[-1:] if tolerant else others:
                yield f"{type(op).__name__} to {other.__name__}", set_item(node.ops, place, other())
    elif isinstance(node, ast.BinOp) and type(node.op) in SWAPS:
        text = isinstance(node.left, (ast.Constant, ast.JoinedStr)) and isinstance(
            getattr(node.left, "value", ""), str
        )
        if not text:
            for other in SWAPS[type(node.op)]:
                name = f"{type(node.op).__name__} to {other.__name__}"
                yield name, set_field(node, "op", other())
    elif isinstance(node, ast.BoolOp):
        yield "and/or", set_field(node, "op", SWAPS[type(node.op)][0]())
        for place in range(len(node.values)):
            rest = node.values[:place] + node.values[place + 1 :]
            rest = rest if len(rest) > 1 else rest * 2  # one operand alone is not a BoolOp
            yield f"operand {place + 1} left out", set_field(node, "values", rest)
    elif isinstance(node, (ast.If, ast.IfExp)):
        for value in (True, False):
            test = ast.copy_location(ast.Constant(value), node.test)
            yield f"condition {value}", set_field(node, "test", test)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        twice = ast.copy_location(ast.UnaryOp(ast.Not(), node.operand), node)
        yield "not left out", set_field(node, "operand", twice)
    elif isinstance(node, ast.Constant):
        for value in constants(node.value):
            yield f"{node.value} to {value}", set_field(node, "value", value)
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in CALLS:
        yield (
            f"{node.func.id} to {CALLS[node.func.id]}",
            set_field(node.func, "id", CALLS[node.func.id]),
        )


class Mutant:
    """One change of one module."""

    def __init__(self, module: str, block: int, line: int, kind: str, change: Change) -> None:
        self.module, self.line = module, line
        self.blocks = {block} if block else set()
        self.kind, self.change = kind, change


def statement_changes(loaded: Loaded) -> Iterator[tuple[ast.stmt, str, Change]]:
    """Reports and raises that are left out."""
    for node in ast.walk(loaded.tree):
        for name in ("body", "orelse"):
            body = getattr(node, name, None)
            for place, statement in enumerate(body if isinstance(body, list) else []):
                call = statement.value if isinstance(statement, ast.Expr) else None
                calls_error = isinstance(call, ast.Call) and "error" in ast.dump(call.func)
                if calls_error or isinstance(statement, ast.Raise):
                    yield statement, "left out", set_item(body, place, ast.Pass())


def mutants_of(loaded: Loaded) -> list[Mutant]:
    """All mutants of a module, in the order of its lines."""
    found = []
    skipped: set[int] = set()
    for node in ast.walk(loaded.tree):
        for part in ("returns", "annotation"):
            if getattr(node, part, None) is not None:
                skipped |= {id(inner) for inner in ast.walk(getattr(node, part))}
        for decorator in getattr(node, "decorator_list", []):
            skipped |= {id(inner) for inner in ast.walk(decorator)}
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            skipped |= {id(inner) for inner in ast.walk(node)}
        if isinstance(node, ast.Call) and "_hits" in ast.dump(node.func):
            skipped |= {id(inner) for inner in ast.walk(node)}
        if isinstance(node, ast.keyword) and node.arg == "maxsize":
            skipped |= {id(inner) for inner in ast.walk(node)}
    for node in ast.walk(loaded.tree):
        if id(node) not in skipped:
            for kind, change in changes_of(node):
                block = loaded.block_of.get(id(node), 0)
                found.append(Mutant(loaded.name, block, node.lineno, kind, change))
    for statement, kind, change in statement_changes(loaded):
        block = loaded.block_of.get(id(statement), 0)
        found.append(Mutant(loaded.name, block, statement.lineno, kind, change))
    return sorted(found, key=lambda mutant: (mutant.line, mutant.kind))

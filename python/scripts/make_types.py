"""Writes the typed modules: `lib/urdd/modules.py` and `lib/urdd/report.py`, from the schemas in `schema/`.

python python/scripts/make_types.py            writes them
python python/scripts/make_types.py --check    exits with 1 where they are not what it would write
"""

from __future__ import annotations

import json
import keyword
import sys
import textwrap
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
SCHEMAS = HERE.parent.parent / "schema"
PACKAGE = HERE.parent / "lib" / "urdd"
VERSION = "1.0.0"
WIDTH = 116

#: In the order of the specification's table of modules; others follow.
MODULES = [
    "urdf_module",
    "dof_module",
    "chain_module",
    "connections_module",
    "bounds_module",
    "kinematics_samples_module",
    "composition_module",
    "named_configurations_module",
    "original_meshes_module",
    "plain_meshes_module",
    "convex_hull_meshes_module",
    "convex_decomposition_meshes_module",
    "link_shapes_approximations_module",
    "link_shapes_max_distance_from_origin_module",
    "link_shapes_distance_statistics_module",
    "link_shapes_simple_skips_module",
    "link_shapes_skips_module",
    "self_collision_model_module",
]
NOT_MODULES = {"root_metadata", "report", "diff_report", "producer_result", "validator_result"}

HEAD = '''"""{title}

Written by `python/scripts/make_types.py` from `schema/`. Do not edit.
"""

from __future__ import annotations

{imports}

__all__ = [
{names}
]
'''

READER = '''
class Modules(Reading):
    """The modules of a URDD, as typed objects. Each is read when it is first asked for, and then kept.

    Each property raises `ModuleMissingError` where the module is not there, and `ModuleUnusableError` where it is of no
    use, or of before version 1: `json` reads those too.
    """
{properties}

def read_root_metadata(text: str) -> RootMetadata:
    """`urdd.json`."""
    return {root}(json.loads(text))
'''

REPORT_READER = '''

def read_{schema}(text: str) -> {type}:
    """A report as `urdd {command} --format json` writes it."""
    return {root}(json.loads(text))
'''


class Types:
    """The types that several schemas define, and their readers."""

    def __init__(self) -> None:
        self.known: dict[str, dict[str, Any]] = {}
        #: Lists, and what may be null, that a minor version added to a type: reports of earlier versions lack them.
        self.later: set[tuple[str, str]] = set()
        self.order: list[str] = []

    def add(self, schema: dict[str, Any]) -> str:
        for name, definition in schema.get("$defs", {}).items():
            self._put(name, definition)
        self._put(schema["title"], {key: value for key, value in schema.items() if key != "$defs"})
        return str(schema["title"])

    def _put(self, name: str, definition: dict[str, Any]) -> None:
        if self.known.setdefault(name, definition) != definition:
            raise SystemExit(f"{name} is defined in two ways")
        if name not in self.order:
            self.order.append(name)

    def target(self, reference: str) -> str:
        return reference.removeprefix("#/$defs/")

    def is_tag(self, name: str) -> bool:
        """Whether it is an object with one key, which determines the type of its value."""
        reference = {"$ref": f"#/$defs/{name}"}
        return any(reference in other.get("oneOf", []) for other in self.known.values())

    def tagged(self, name: str) -> tuple[str, dict[str, Any]]:
        ((key, value),) = self.known[name]["properties"].items()
        return key, value

    def annotation(self, schema: dict[str, Any]) -> str:
        """The type of a value, in Python."""
        if "$ref" in schema:
            return self.target(schema["$ref"])
        if "allOf" in schema:
            (only,) = schema["allOf"]
            return self.annotation(only)
        if "anyOf" in schema or "oneOf" in schema:
            parts = schema.get("anyOf") or schema["oneOf"]
            return " | ".join(self.annotation(part) for part in parts)
        kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
        words = {"string": "str", "number": "float", "integer": "int", "boolean": "bool", "null": "None"}
        found = [f"list[{self.annotation(schema['items'])}]" if kind == "array" else words[kind] for kind in kinds]
        return " | ".join(found)

    def expression(self, schema: dict[str, Any], value: str, depth: int = 0) -> str:
        """The reader of a value."""
        if "$ref" in schema:
            name = self.target(schema["$ref"])
            is_read = self.known[name].get("type") == "object" or "oneOf" in self.known[name]
            return f"_{snake(name)}({value})" if is_read else value
        if "allOf" in schema:
            return self.expression(schema["allOf"][0], value, depth)
        if "anyOf" in schema:
            some, null = schema["anyOf"]
            assert null == {"type": "null"}, schema
            return nullable(value, self.expression(some, value, depth))
        kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
        read = value
        if "integer" in kinds:
            read = f"int({value})"
        if "array" in kinds:
            item = "xyzuvw"[depth]
            inner = self.expression(schema["items"], item, depth + 1)
            if inner != item:
                read = f"[{inner} for {item} in {value}]"
        return nullable(value, read) if "null" in kinds else read


def nullable(value: str, read: str) -> str:
    return value if read == value else f"None if {value} is None else {read}"


def snake(name: str) -> str:
    return "".join("_" + letter.lower() if letter.isupper() else letter for letter in name).lstrip("_")


def attribute(key: str) -> str:
    return key + "_" if keyword.iskeyword(key) else key


def docstring(text: str, indent: str) -> str:
    """A description as a docstring. Its lines are kept, and wrapped."""
    text = text.replace("\\", "\\\\")
    lines: list[str] = []
    for line in text.split("\n"):
        hang = "  " if line.startswith("- ") else ""
        lines += textwrap.wrap(line, WIDTH - len(indent) - 3, subsequent_indent=hang, break_on_hyphens=False) or [""]
    if "\n" in text:
        lines.append("")
    first, *rest = lines
    rest = [f"{indent}{line}".rstrip() for line in rest]
    if rest and rest[-1] == "":
        rest[-1] = indent
        return f'{indent}"""' + "\n".join([first, *rest]) + '"""\n'
    return f'{indent}"""' + "\n".join([first, *rest]) + '"""\n'


def sentence(schema: dict[str, Any]) -> str:
    """What the annotations of a property say (SPEC 11.3), in a line."""
    lengths: list[str] = []
    inner = schema
    while True:
        if "x-length" in inner:
            lengths.append(inner["x-length"])
        if "items" not in inner:
            break
        inner = inner["items"]
    words = {"Unit": "x-unit", "Frame": "x-frame", "Index of": "x-index"}
    said = {word: schema.get(key, inner.get(key)) for word, key in words.items()}
    said["Length"] = "`, each `".join(lengths)
    return " ".join(f"{word}: `{value}`." for word, value in said.items() if value)


def described(schema: dict[str, Any]) -> str:
    """The description of a property, and its annotations as a paragraph of their own."""
    return "\n\n".join(text for text in [schema["description"], sentence(schema)] if text)


def fields(definition: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in definition["properties"].items() if key != "$schema"}


def declaration(types: Types, name: str) -> str:
    definition = types.known[name]
    text = definition["description"]
    if "enum" in definition:
        words = ", ".join(f'"{word}"' for word in definition["enum"])
        line = f"{name}: TypeAlias = Literal[{words}]\n"
        if len(line) > 121:
            words = "".join(f'    "{word}",\n' for word in definition["enum"])
            line = f"{name}: TypeAlias = Literal[\n{words}]\n"
        return line + docstring(text, "")
    if "oneOf" in definition:
        tags = [types.tagged(types.target(part["$ref"])) for part in definition["oneOf"]]
        values = [types.annotation(part) for _, part in tags]
        union, here = " | ".join(values), "that key's value"
        if is_ambiguous(types, definition):
            words = ", ".join(f'"{key}"' for key, _ in tags)
            union, here = f"tuple[Literal[{words}], {values[0]}]", "that key and its value"
        text = text.split(":")[0].removesuffix(".") + f": in JSON an object of one key, here {here}."
        return f"{name}: TypeAlias = {union}\n" + docstring(text, "")
    lines = [f"@dataclass(frozen=True)\nclass {name}:\n", docstring(text, "    ")]
    for key, schema in fields(definition).items():
        lines.append(f"\n    {attribute(key)}: {types.annotation(schema)}\n")
        lines.append(docstring(described(schema), "    "))
    return "".join(lines)


def is_ambiguous(types: Types, definition: dict[str, Any]) -> bool:
    """Whether the value alone does not determine the alternative."""
    values = [types.annotation(types.tagged(types.target(part["$ref"]))[1]) for part in definition["oneOf"]]
    return len(set(values)) < len(values)


def reader(types: Types, name: str) -> str:
    definition = types.known[name]
    head = f"def _{snake(name)}(v: Any) -> {name}:\n"
    if "oneOf" in definition:
        lines = ["    ((kind, value),) = v.items()\n"]
        tags = [types.tagged(types.target(part["$ref"])) for part in definition["oneOf"]]
        if is_ambiguous(types, definition):
            return head + lines[0] + f"    return kind, {types.expression(tags[0][1], 'value')}\n"
        for key, schema in tags[:-1]:
            lines.append(f'    if kind == "{key}":\n        return {types.expression(schema, "value")}\n')
        lines.append(f"    return {types.expression(tags[-1][1], 'value')}\n")
        if len(tags) == 1:
            lines[0] = "    (value,) = v.values()\n"
        return head + "".join(lines)
    lines = [f"    return {name}(\n"]
    for key, schema in fields(definition).items():
        value = f'v["{key}"]'
        if (name, key) in types.later:
            value = f'v.get("{key}", [])' if schema.get("type") == "array" else f'v.get("{key}")'
        line = f"        {attribute(key)}={types.expression(schema, value)},\n"
        if len(line) > 121:
            # As the formatter wraps it.
            line = line.replace("=None if ", "=None\n        if ", 1).replace(" else ", "\n        else ", 1)
        lines.append(line)
    return head + "".join([*lines, "    )\n"])


def body(types: Types) -> str:
    order = [name for name in types.order if not types.is_tag(name)]
    words = [name for name in order if "enum" in types.known[name]]
    unions = [name for name in order if "oneOf" in types.known[name]]
    classes = [name for name in order if name not in words + unions]
    read = [name for name in order if name not in words]
    parts = ["\n" + declaration(types, name) for name in words]
    parts += ["\n\n" + declaration(types, name) for name in classes]
    # The types that they refer to must be defined earlier; annotations of fields are not evaluated.
    parts += [("\n\n" if k == 0 else "\n") + declaration(types, name) for k, name in enumerate(unions)]
    parts += ["\n\n" + reader(types, name) for name in read]
    return "".join(parts)


def names_of(types: Types, more: list[str]) -> str:
    names = [name for name in types.order if not types.is_tag(name)] + more
    return "\n".join(f'    "{name}",' for name in sorted(names))


def newest(name: str) -> str:
    """The newest version of a schema."""
    versions = [path.stem for path in (SCHEMAS / name).glob("*.json")]
    return max(versions, key=lambda version: [int(part) for part in version.split(".")])


def read_schema(name: str, version: str = VERSION) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((SCHEMAS / name / f"{version}.json").read_text(encoding="utf-8"))
    return found


def modules_file() -> str:
    there = {path.parent.name for path in SCHEMAS.glob(f"*/{VERSION}.json")} - NOT_MODULES
    missing = set(MODULES) - there
    if missing:
        raise SystemExit(f"there is no schema of {', '.join(sorted(missing))}")
    types = Types()
    root = types.add(read_schema("root_metadata"))
    properties: list[str] = []
    for module in [*MODULES, *sorted(there - set(MODULES))]:
        schema = read_schema(module)
        name = types.add(schema)
        short = module.removesuffix("_module")
        properties.append(
            f"\n    @property\n    def {short}(self) -> {name}:\n{docstring(schema['description'], '        ')}"
            f'        return self._read("{module}", _{snake(name)})\n'
        )
    imports = "\n".join(
        [
            "import json",
            "from dataclasses import dataclass",
            "from typing import Any, Literal, TypeAlias",
            "",
            "from ._reading import Reading",
        ]
    )
    head = HEAD.format(
        title="The modules of version 1, as dataclasses: every field with its meaning, shape, unit and frame.",
        imports=imports,
        names=names_of(types, ["Modules", "read_root_metadata"]),
    )
    end = READER.format(properties="".join(properties), root=f"_{snake(root)}")
    return head + body(types) + "\n" + end


def report_file() -> str:
    types = Types()
    readers = ""
    names = []
    for schema, command in [("report", "validate"), ("diff_report", "diff")]:
        root = types.add(read_schema(schema, newest(schema)))
        readers += REPORT_READER.format(schema=schema, type=root, command=command, root=f"_{snake(root)}")
        names.append(f"read_{schema}")
    types.later = {(kind, "programs") for kind in ("Urdd", "Finding", "Place")}
    types.later |= {("WrittenAt", "used_at"), ("WrittenAt", "calls"), ("Urdd", "not_examined")}
    types.later |= {("Does", "is_supposed"), ("ProgramEffect", "is_supposed")}
    types.later |= {("Totals", key) for key in ("passed", "failed", "not_examined")}
    imports = "import json\nfrom dataclasses import dataclass\nfrom typing import Any, Literal, TypeAlias"
    head = HEAD.format(
        title="The reports of a validation and of a comparison, as dataclasses.",
        imports=imports,
        names=names_of(types, names),
    )
    return head + body(types) + readers


def main() -> int:
    is_check = "--check" in sys.argv[1:]
    stale = 0
    for name, text in {"modules.py": modules_file(), "report.py": report_file()}.items():
        path = PACKAGE / name
        if path.exists() and path.read_text(encoding="utf-8") == text:
            continue
        stale = 1
        if is_check:
            print(f"{path} is not what the schemas make: run python/scripts/make_types.py", file=sys.stderr)
        else:
            path.write_text(text, encoding="utf-8")
            print(f"wrote {path}", file=sys.stderr)
    return stale if is_check else 0


if __name__ == "__main__":
    sys.exit(main())

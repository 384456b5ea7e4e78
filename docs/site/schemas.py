"""One page a module with the fields of every version, from schema/*/*.json; and the list of all."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from text import code, table

Schema = dict[str, Any]
# Annotations that carry meaning, and what their column says.
MEANINGS = {"x-unit": "unit", "x-frame": "frame", "x-index": "index of", "x-length": "length"}


def pages(folder: Path) -> dict[str, str]:
    """All pages by name."""
    made, rows = {}, []
    for module in sorted(path for path in folder.iterdir() if path.is_dir()):
        versions = sorted(module.glob("*.json"), key=lambda path: number(path.stem), reverse=True)
        schemas = [(path.stem, json.loads(path.read_text(encoding="utf-8"))) for path in versions]
        made[f"schema/{module.name}/README.md"] = page(module.name, schemas)
        links = ", ".join(f"[{version}]({module.name}/README.md#{anchor(version)})" for version, _ in schemas)
        rows.append((module.name, [f"[`{module.name}`]({module.name}/README.md)", links, first(schemas[0][1])]))
    made["schema/README.md"] = index(rows)
    return made


def number(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.split(".")) if version[0].isdigit() else (-1,)


def anchor(version: str) -> str:
    return version.replace(".", "")


def first(schema: Schema) -> str:
    """The first sentence of a schema."""
    text: str = schema.get("description", "").split(". ")[0]
    return text.rstrip(".") + "."


def index(rows: list[tuple[str, list[str]]]) -> str:
    modules = [row for name, row in rows if name.endswith("_module") or name == "root_metadata"]
    others = [row for name, row in rows if not name.endswith("_module") and name != "root_metadata"]
    head = ["schema", "versions", "what"]
    return (
        "# Schemas\n\nA JSON Schema (draft 2020-12) for every module and version. Version 1.0.0 is that of the "
        "[specification](../SPEC.md); versions 0.0.x are legacy. `urdd schema export DIR` writes the same files.\n\n"
        + table(head, modules)
        + "\n## Reports and results\n\n"
        + table(head, others)
    )


def page(name: str, schemas: list[tuple[str, Schema]]) -> str:
    parts = [f"# {name}\n"]
    for version, schema in schemas:
        parts.append(
            f"\n## {version} {{ #{anchor(version)} }}\n\nThe schema: [`{name}/{version}.json`]({version}.json)\n\n"
        )
        parts.append(fields(schema))
        for title, part in schema.get("$defs", {}).items():
            parts.append(f"\n### {title} {{ #{anchor(version)}-{title} }}\n\n{fields(part, version)}")
    return "".join(parts)


def fields(schema: Schema, version: str = "") -> str:
    """What a schema of an object says, or of anything else."""
    version = version or schema.get("$id", "").rsplit(":", 1)[-1]
    text: str = schema.get("description", "") + "\n\n"
    properties = {key: part for key, part in schema.get("properties", {}).items() if key != "$schema"}
    if not properties:
        kind = kinds(schema, version)
        return text + (f"Type: {kind}\n" if kind != "object" else "")
    required = schema.get("required", [])
    carries = any(meaning(part) for part in properties.values())
    head = ["key", "type", *(["carries"] if carries else []), "meaning"]
    rows = []
    for key, part in properties.items():
        kind = kinds(part, version) + ("" if key in required else " (may be absent)")
        rows.append([f"`{key}`", kind, *([meaning(part)] if carries else []), part.get("description", "")])
    return text + table(head, rows)


def kinds(schema: Schema, version: str) -> str:
    """The type in words."""
    if "$ref" in schema:
        title = schema["$ref"].rsplit("/", 1)[-1]
        return f"[{title}](#{anchor(version)}-{title})"
    for key in ("anyOf", "oneOf", "allOf"):
        if key in schema:
            return " or ".join(dict.fromkeys(kinds(part, version) for part in schema[key]))
    if "const" in schema:
        return code(json.dumps(schema["const"]))
    if "enum" in schema:
        return ", ".join(code(json.dumps(value)) for value in schema["enum"])
    kind = schema.get("type", "anything")
    if isinstance(kind, list):
        return " or ".join(kinds({**schema, "type": one}, version) for one in kind)
    if kind == "array" and "prefixItems" in schema:
        return "list of " + ", ".join(kinds(part, version) for part in schema["prefixItems"])
    if kind == "array":
        of = kinds(schema.get("items", {}), version)
        least, most = schema.get("minItems"), schema.get("maxItems")
        return f"{least} of {of}" if least is not None and least == most else f"list of ({of})"
    if kind == "object" and "properties" in schema:
        keys = ", ".join(f"`{key}`: {kinds(part, version)}" for key, part in schema["properties"].items())
        return f"{{{keys}}}"
    return str(kind)


def meaning(schema: Schema) -> str:
    """Unit, frame, index and length of a field, also of its items: annotations that begin with `x-`."""
    own = [f"{MEANINGS.get(key, key[2:])} {words(value)}" for key, value in schema.items() if key.startswith("x-")]
    inner = meaning(schema["items"]) if isinstance(schema.get("items"), dict) else ""
    return "; ".join([*own, *([inner] if inner else [])])


def words(value: Any) -> str:
    return ", ".join(map(str, value)) if isinstance(value, list) else str(value)

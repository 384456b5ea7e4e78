"""An interpreter of JSON Schema, draft 2020-12 (3.1.2, 11.1), with the annotations of 11.5."""

from __future__ import annotations

import functools
import json
import os
from fractions import Fraction
from typing import Any

from .jsontext import read_json
from .pattern import compiled

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "schema")
TYPES: dict[str, tuple[type, ...]] = {
    "object": (dict,),
    "array": (list,),
    "string": (str,),
    "boolean": (bool,),
    "null": (type(None),),
}


def is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_integer(value: Any) -> bool:
    """3.1.3: a number with a whole value, however it is written."""
    return is_number(value) and float(value).is_integer()


def has_type(value: Any, name: str) -> bool:
    if name == "number":
        return is_number(value)
    if name == "integer":
        return is_integer(value)
    return isinstance(value, TYPES[name])


def frozen(value: Any) -> Any:
    """A form in which equal JSON values are equal, and no others."""
    if isinstance(value, dict):
        return ("object", frozenset((key, frozen(inner)) for key, inner in value.items()))
    if isinstance(value, list):
        return ("list", tuple(frozen(inner) for inner in value))
    if is_number(value):
        value = float(value)  # 11.1: as binary64
    return (isinstance(value, bool), isinstance(value, str), value)


class Seen:
    """Which members and elements of a value a schema has evaluated."""

    def __init__(self) -> None:
        self.keys: set[str] = set()
        self.places: set[int] = set()

    def add(self, other: Seen) -> None:
        self.keys |= other.keys
        self.places |= other.places


class Interpreter:
    """Judges values. `counts` turns on the annotations of 11.5 that it has words for."""

    def __init__(self, root: Any, lenient: bool = False) -> None:
        self.root = root
        self.lenient = lenient
        self.tracks = "unevaluated" in json.dumps(root)
        self.active: set[tuple[int, int]] = set()
        self.counts: Any = None
        self.keyword: Any = None  # of 11.5, where `counts` is there

    def valid(self, value: Any) -> bool:
        return self.judge(self.root, value, None, Seen())

    def judge(self, schema: Any, value: Any, link: int | None, seen: Seen) -> bool:
        """Whether a value is valid. `link` is the link of a list over links that it is of."""
        if isinstance(schema, bool):
            return schema
        key = (id(schema), id(value))
        if key in self.active:
            return True  # 11.1: a reference that leads back to itself says nothing
        self.active.add(key)
        mine = Seen()
        valid = (
            self.plain(schema, value)
            and self.annotated(schema, value, link)
            and self.combined(schema, value, link, mine)
            and self.inside(schema, value, mine)
            and (not self.tracks or self.left_over(schema, value, mine))
        )
        self.active.discard(key)
        if valid:
            seen.add(mine)
        return valid

    def plain(self, schema: dict[str, Any], value: Any) -> bool:
        """Keywords that look at the value alone."""
        if "type" in schema:
            names = schema["type"]
            if not any(has_type(value, n) for n in ([names] if isinstance(names, str) else names)):
                return False
        if "enum" in schema and frozen(value) not in [frozen(one) for one in schema["enum"]]:
            return False
        if "const" in schema and frozen(value) != frozen(schema["const"]):
            return False
        if is_number(value):
            return number_fits(schema, value)
        if isinstance(value, str):
            return text_fits(schema, value)
        if isinstance(value, list):
            return list_fits(schema, value)
        return not isinstance(value, dict) or object_fits(schema, value)

    def annotated(self, schema: dict[str, Any], value: Any, link: int | None) -> bool:
        """11.5: `x-index` and `x-length`."""
        if self.keyword not in schema:
            return True
        words = schema[self.keyword].split(" or ")
        if self.keyword == "x-index":
            fits = self.counts.index_fits
            return not is_number(value) or any(fits(word, value) for word in words)
        length_fits = self.counts.length_fits
        return not isinstance(value, list) or any(
            length_fits(word, len(value), link) for word in words
        )

    def combined(self, schema: dict[str, Any], value: Any, link: int | None, seen: Seen) -> bool:
        """Keywords that apply schemas to the same value."""
        for name in ("$ref", "$dynamicRef"):
            if name in schema:
                if not self.judge(find(self.root, schema[name]), value, None, seen):
                    return False
        for one in schema.get("allOf", []):
            if not self.judge(one, value, link, seen):
                return False
        if "anyOf" in schema:
            if not any([self.judge(one, value, link, seen) for one in schema["anyOf"]]):
                return False
        if "oneOf" in schema:
            if sum(self.judge(one, value, link, seen) for one in schema["oneOf"]) != 1:
                return False
        if "not" in schema and self.judge(schema["not"], value, link, Seen()):
            return False
        if "if" in schema:
            branch = "then" if self.judge(schema["if"], value, link, seen) else "else"
            if branch in schema and not self.judge(schema[branch], value, link, seen):
                return False
        if isinstance(value, dict):
            for key, one in schema.get("dependentSchemas", {}).items():
                if key in value and not self.judge(one, value, None, seen):
                    return False
        return True

    def inside(self, schema: dict[str, Any], value: Any, seen: Seen) -> bool:
        """Keywords about members and elements."""
        if isinstance(value, dict):
            return self.members(schema, value, seen)
        if isinstance(value, list):
            return self.elements(schema, value, seen)
        return True

    def members(self, schema: dict[str, Any], value: dict[str, Any], seen: Seen) -> bool:
        properties = schema.get("properties", {})
        patterns = schema.get("patternProperties", {})
        others = schema.get("additionalProperties", True)
        for key, inner in value.items():
            schemas = [properties[key]] if key in properties else []
            schemas += [one for text, one in patterns.items() if compiled(text).search(key)]
            known = bool(schemas)
            if not known and not (self.lenient and others is False):
                schemas = [others]
            known = known or "additionalProperties" in schema
            if not all(self.judge(one, inner, None, Seen()) for one in schemas):
                return False
            if "propertyNames" in schema:
                if not self.judge(schema["propertyNames"], key, None, Seen()):
                    return False
            if known:
                seen.keys.add(key)
        return True

    def elements(self, schema: dict[str, Any], value: list[Any], seen: Seen) -> bool:
        first = schema.get("prefixItems", [])
        rest = schema.get("items", True)
        over_links = schema.get("x-length") == "links"
        for place, inner in enumerate(value):
            one = first[place] if place < len(first) else rest
            link = place if over_links and place >= len(first) else None
            if not self.judge(one, inner, link, Seen()):
                return False
        seen.places |= set(range(len(value) if "items" in schema else len(first)))
        if "contains" in schema:
            contained = schema["contains"]
            found = [
                place
                for place, inner in enumerate(value)
                if self.judge(contained, inner, None, Seen())
            ]
            seen.places |= set(found)
            least = schema.get("minContains", 1)
            if not least <= len(found) <= schema.get("maxContains", len(value)):
                return False
        return True

    def left_over(self, schema: dict[str, Any], value: Any, seen: Seen) -> bool:
        """`unevaluatedProperties` and `unevaluatedItems`."""
        if isinstance(value, dict) and "unevaluatedProperties" in schema:
            for key in value.keys() - seen.keys:
                if not self.judge(schema["unevaluatedProperties"], value[key], None, Seen()):
                    return False
            seen.keys |= value.keys()
        if isinstance(value, list) and "unevaluatedItems" in schema:
            for place in set(range(len(value))) - seen.places:
                if not self.judge(schema["unevaluatedItems"], value[place], None, Seen()):
                    return False
            seen.places |= set(range(len(value)))
        return True


def number_fits(schema: dict[str, Any], value: float) -> bool:
    if "minimum" in schema and value < schema["minimum"]:
        return False
    if "maximum" in schema and value > schema["maximum"]:
        return False
    if "exclusiveMinimum" in schema and value <= schema["exclusiveMinimum"]:
        return False
    if "exclusiveMaximum" in schema and value >= schema["exclusiveMaximum"]:
        return False
    return "multipleOf" not in schema or is_multiple(value, schema["multipleOf"])


def is_multiple(value: float, unit: float) -> bool:
    """`multipleOf`, on the decimals that are written."""
    return Fraction(repr(value)) % Fraction(repr(unit)) == 0


def text_fits(schema: dict[str, Any], value: str) -> bool:
    if len(value) < schema.get("minLength", 0) or len(value) > schema.get("maxLength", len(value)):
        return False
    return "pattern" not in schema or compiled(schema["pattern"]).search(value) is not None


def list_fits(schema: dict[str, Any], value: list[Any]) -> bool:
    if len(value) < schema.get("minItems", 0) or len(value) > schema.get("maxItems", len(value)):
        return False
    return not schema.get("uniqueItems") or len({frozen(one) for one in value}) == len(value)


def object_fits(schema: dict[str, Any], value: dict[str, Any]) -> bool:
    size = len(value)
    if size < schema.get("minProperties", 0) or size > schema.get("maxProperties", size):
        return False
    if not all(key in value for key in schema.get("required", [])):
        return False
    dependent = schema.get("dependentRequired", {})
    return all(key not in value or all(k in value for k in dependent[key]) for key in dependent)


def find(root: Any, reference: str) -> Any:
    """The schema that a reference leads to; raises LookupError where there is none."""
    from urllib.parse import unquote

    name = unquote(reference[1:])
    if not name.startswith("/"):
        return root if not name else anchored(root, name)
    at = root
    for part in name[1:].split("/"):
        part = part.replace("~1", "/").replace("~0", "~")
        at = at[int(part)] if isinstance(at, list) else at[part]
    return at


def anchored(schema: Any, name: str) -> Any:
    """The schema with an anchor of this name."""
    waiting = [schema]
    while waiting:
        at = waiting.pop()
        if isinstance(at, dict):
            if name in (at.get("$anchor"), at.get("$dynamicAnchor")):
                return at
            waiting += at.values()
        elif isinstance(at, list):
            waiting += at
    raise LookupError(name)


@functools.lru_cache(maxsize=64)
def published(name: str, version: str) -> Any:
    """The published schema of a module, or of `root_metadata`."""
    with open(os.path.join(FOLDER, name, version + ".json"), "rb") as file:
        return read_json(file.read())


def fits(name: str, document: Any, lenient: bool = False) -> bool:
    """Whether a document is valid under the newest published schema (3.1.2, 4.2)."""
    return Interpreter(published(name, "1.0.0"), lenient).valid(document)


@functools.lru_cache(maxsize=4096)
def file_fits(name: str, data: bytes, lenient: bool) -> bool:
    """The same of the document in a file."""
    return fits(name, read_json(data), lenient)

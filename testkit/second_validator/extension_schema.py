"""Whether the `schema.json` of an extension can be used by any validator (11.1, 11.3, 11.4)."""

from __future__ import annotations

import re
import sys
from typing import Any

from .pattern import BadPattern, compiled
from .schema import TYPES, find, is_integer, is_number

ONE = ("items", "contains", "additionalProperties", "propertyNames", "unevaluatedItems")
ONE += ("unevaluatedProperties", "not", "if", "then", "else", "contentSchema")
MANY = ("allOf", "anyOf", "oneOf", "prefixItems")
NAMED = ("properties", "patternProperties", "$defs", "dependentSchemas", "definitions")
COUNTS = ("maxLength", "minLength", "maxItems", "minItems", "maxContains", "minContains")
COUNTS += ("maxProperties", "minProperties")
NUMBERS = ("maximum", "exclusiveMaximum", "minimum", "exclusiveMinimum", "multipleOf")
FLAGS = ("uniqueItems", "deprecated", "readOnly", "writeOnly")
STRINGS = ("$schema", "$id", "$ref", "$dynamicRef", "$anchor", "$dynamicAnchor", "$comment")
STRINGS += ("title", "description", "format", "pattern", "contentEncoding", "contentMediaType")
SAME_VALUE = ("not", "if", "then", "else")
FORBIDDEN = re.compile(r"(?:^|[^\\])(?:\\\\)*(?:\(\?<?[=!]|\\[1-9]|\\k<)")
SYMBOL = r"(?:m|kg|s|A|K|mol|cd|rad|sr|Hz|N|Pa|J|W|C|V|F|ohm|S|Wb|T|H|lm|lx|bit|byte)(?:\^[2-9])?"
UNIT = re.compile(rf"1|(?:1(?=/)|{SYMBOL}(?:\*{SYMBOL})*)(?:/{SYMBOL}(?:\*{SYMBOL})*)?")
FRAME = re.compile(r"world|root|link|parent_link|joint|inertial|shape")
INDEX = re.compile(
    r"link|joint|dof|visual|collision|piece|full_shape|decomposition_shape|part|pair|sample|other"
)
LENGTH = re.compile(r"links|joints|dofs|pieces|full_shapes|decomposition_shapes|parts|pairs")
ANNOTATIONS = {"x-unit": UNIT, "x-frame": FRAME, "x-index": INDEX, "x-length": LENGTH}
MAX_COMPARISONS = 1_000_000
COMPARISONS_A_VALUE = 20
MAX_NESTED = 5000
sys.setrecursionlimit(8 * MAX_NESTED)


class Unusable(Exception):
    """A schema that breaks 11.1."""


def require(holds: bool) -> None:
    if not holds:
        raise Unusable


def unique_strings(value: Any) -> bool:
    strings = isinstance(value, list) and all(isinstance(one, str) for one in value)
    return strings and len(set(value)) == len(value)


def check_pattern(text: str) -> None:
    """11.1: patterns of JavaScript, without lookaround and references to groups."""
    require(not FORBIDDEN.search(text))
    try:
        compiled(text)
    except BadPattern as fault:
        raise Unusable from fault


def check_words(schema: dict[str, Any]) -> None:
    """11.1, 11.4: the annotations."""
    for keyword, words in ANNOTATIONS.items():
        if keyword in schema:
            value = schema[keyword]
            require(isinstance(value, str))
            require(all(words.fullmatch(word) for word in value.split(" or ")))
    types = schema.get("type")
    names = [types] if isinstance(types, str) else types
    if names is not None:
        require("x-index" not in schema or "integer" in names or "number" in names)
        require("x-length" not in schema or "array" in names)


def check_keywords(schema: dict[str, Any], is_root: bool) -> None:
    """What the dialect says of the values of keywords."""
    require(is_root or "$id" not in schema)
    require("#" not in str(schema.get("$id", ""))[:-1])
    if "type" in schema:
        names = schema["type"]
        require(isinstance(names, str) or (unique_strings(names) and len(names) > 0))
        known = (*TYPES, "number", "integer")
        require(all(one in known for one in ([names] if isinstance(names, str) else names)))
    for key in COUNTS:
        require(key not in schema or (is_integer(schema[key]) and schema[key] >= 0))
    for key in NUMBERS:
        require(key not in schema or is_number(schema[key]))
    require(schema.get("multipleOf", 1) > 0)
    for key in FLAGS:
        require(isinstance(schema.get(key, False), bool))
    for key in STRINGS:
        require(isinstance(schema.get(key, ""), str))
    require(isinstance(schema.get("enum", []), list))
    require(unique_strings(schema.get("required", [])))
    dependent = schema.get("dependentRequired", {})
    require(isinstance(dependent, dict) and all(unique_strings(one) for one in dependent.values()))
    for key in NAMED:
        require(isinstance(schema.get(key, {}), dict))
    for key in MANY:
        require(key not in schema or (isinstance(schema[key], list) and len(schema[key]) > 0))
    for text in [schema.get("pattern", ""), *schema.get("patternProperties", {})]:
        check_pattern(text)


def inner_schemas(schema: dict[str, Any]) -> list[Any]:
    """The schemas directly inside a schema."""
    found = [schema[key] for key in ONE if key in schema]
    for key in MANY:
        found += schema.get(key, [])
    for key in NAMED:
        found += schema.get(key, {}).values()
    return found


def check_schema(root: Any) -> None:
    """11.1: raises Unusable."""
    waiting, all_schemas = [root], []
    while waiting:
        schema = waiting.pop()
        require(isinstance(schema, (bool, dict)))
        all_schemas.append(schema)
        if isinstance(schema, dict):
            check_keywords(schema, schema is root)
            check_words(schema)
            waiting += inner_schemas(schema)
    places = {id(schema) for schema in all_schemas}
    anchors = [
        name
        for schema in all_schemas
        if isinstance(schema, dict)
        for name in {schema.get("$anchor"), schema.get("$dynamicAnchor")}
    ]
    for schema in all_schemas:
        for key in ("$ref", "$dynamicRef"):
            if isinstance(schema, dict) and key in schema:
                require(schema[key].startswith("#"))
                require(anchors.count(schema[key][1:]) < 2)
                try:
                    require(id(find(root, schema[key])) in places)
                except (LookupError, ValueError, TypeError) as fault:
                    raise Unusable from fault


def size_of(value: Any) -> int:
    """11.1: the values in a value are itself and all that is inside it."""
    inside = value.values() if isinstance(value, dict) else value
    return 1 + sum(map(size_of, inside)) if isinstance(value, (dict, list)) else 1


def pattern_work(pattern: str, text: str) -> int:
    slow = 16 if "{" in pattern or "\\" in pattern else 1
    return 5 + len(text.encode()) * (slow + len(pattern.encode()) // 32)


def longest_key(value: Any) -> str:
    """The longest key of a document."""
    if isinstance(value, dict):
        keys = [*value, *(longest_key(one) for one in value.values())]
    else:
        keys = [longest_key(one) for one in value] if isinstance(value, list) else []
    return max(keys, key=lambda key: len(key.encode()), default="")


class Work:
    """Counts comparisons by the table of 11.1."""

    def __init__(self, root: Any, document: Any) -> None:
        self.root = root
        self.longest = longest_key(document)
        self.allowed = max(MAX_COMPARISONS, COMPARISONS_A_VALUE * size_of(document))
        self.met = 0
        self.active: set[tuple[int, int]] = set()
        self.known: dict[tuple[int, int], int] = {}

    def of(self, schema: Any, value: Any) -> int:
        self.met += 1
        require(self.met <= self.allowed and len(self.active) + 1 < MAX_NESTED)
        key = (id(schema), id(value))
        if isinstance(schema, bool) or key in self.active:
            return 1
        if key in self.known:
            return self.known[key]
        self.active.add(key)
        work = len(schema) + self.alone(schema, value)
        for name in ("$ref", "$dynamicRef"):
            if name in schema:
                work += self.of(find(self.root, schema[name]), value)
        for name in SAME_VALUE:
            if name in schema:
                work += self.of(schema[name], value)
        same = [one for name in ("allOf", "anyOf", "oneOf") for one in schema.get(name, [])]
        for one in [*same, *schema.get("dependentSchemas", {}).values()]:
            work += self.of(one, value)
        work += self.inside(schema, value)
        self.active.discard(key)
        self.known[key] = work
        return work

    def alone(self, schema: dict[str, Any], value: Any) -> int:
        work = 0
        if "pattern" in schema and isinstance(value, str):
            work += pattern_work(schema["pattern"], value)
        if isinstance(value, dict):
            for pattern in schema.get("patternProperties", {}):
                work += sum(2 * pattern_work(pattern, key) for key in value)
        if "enum" in schema:
            size = size_of(value)
            work += sum(min(size_of(one), size) for one in schema["enum"])
        if "const" in schema or "uniqueItems" in schema:
            work += size_of(value)
        return work

    def inside(self, schema: dict[str, Any], value: Any) -> int:
        work = 0
        if isinstance(value, dict):
            for key, one in schema.get("properties", {}).items():
                if key in value:
                    work += self.of(one, value[key])
            if "propertyNames" in schema:
                work += len(value) * self.of(schema["propertyNames"], self.longest)
            names = ("additionalProperties", "unevaluatedProperties")
            many = list(schema.get("patternProperties", {}).values())
            elements = list(value.values())
        elif isinstance(value, list):
            names = ("items", "contains", "unevaluatedItems")  # type: ignore[assignment]
            many = list(schema.get("prefixItems", []))
            elements = value
        else:
            return 0
        many += [schema[name] for name in names if name in schema]
        return work + sum(self.of(one, element) for one in many for element in elements)


def check_work(root: Any, document: Any) -> None:
    """11.1: raises Unusable where evaluating takes too many comparisons."""
    work = Work(root, document)
    require(work.of(root, document) <= work.allowed)

"""Switches off each keyword of the schemas of version 1 in turn, as `mutants.py` does with code.

python3 testkit/second_validator/schema_mutants.py SUITE [--out FILE]

A mutant that allows more runs on the cases whose document was not valid and is, one that allows
less on those whose document was: on any other it says what it said.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
from collections.abc import Callable, Iterator
from typing import Any

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from instrument import CHANGED, HITS, load_package  # noqa: E402
from mutants import Case, load_cases, remember_trees, run_baseline, says_of  # noqa: E402

REMOVED = ("type", "enum", "const", "pattern", "minimum", "maximum", "minItems", "maxItems")
REMOVED += ("additionalProperties", "patternProperties", "$ref", "anyOf", "oneOf", "allOf")
OFF_BY_ONE = {"minimum": -1, "maximum": 1, "minItems": -1, "maxItems": 1}
SECONDS = 60.0
ALLOWS_LESS = re.compile(r"/(enum|anyOf|oneOf)/\d+$|/patternProperties$")


def mutations(schema: Any, place: str) -> Iterator[tuple[str, str, Callable[[], None], Any]]:
    """Place, kind, the change and what undoes it, for each keyword in a schema."""
    if isinstance(schema, list):
        for number, inner in enumerate(schema):
            yield from mutations(inner, f"{place}/{number}")
        return
    if not isinstance(schema, dict):
        return
    for key in REMOVED:
        if key in schema:
            value = schema[key]
            restore = _setter(schema, key, value)
            yield f"{place}/{key}", "left out", _remover(schema, key), restore
            if key in OFF_BY_ONE:
                change = _setter(schema, key, value + OFF_BY_ONE[key])
                yield f"{place}/{key}", "off by one", change, restore
    for key in ("required", "enum", "anyOf", "oneOf"):
        for number in range(len(schema.get(key, []))):
            whole = schema[key]
            rest = whole[:number] + whole[number + 1 :]
            name = whole[number] if key == "required" else number
            change = _setter(schema, key, rest)
            yield f"{place}/{key}/{name}", "left out", change, _setter(schema, key, whole)
    for key in ("properties", "$defs"):
        for name, inner in schema.get(key, {}).items():
            yield from mutations(inner, f"{place}/{key}/{name}")
    for key in ("items", "anyOf", "oneOf", "allOf"):
        if key in schema:
            yield from mutations(schema[key], f"{place}/{key}")


def _setter(schema: dict[str, Any], key: str, value: Any) -> Callable[[], None]:
    return lambda: schema.__setitem__(key, value)


def _remover(schema: dict[str, Any], key: str) -> Callable[[], None]:
    return lambda: schema.pop(key, None)


class Document:
    """A document of some cases, and whether it is valid."""

    def __init__(self, value: Any) -> None:
        self.value = value
        self.cases: list[Case] = []
        self.valid = True


def documents_of(name: str, cases: list[Case], loaded: Any) -> list[Document]:
    """The documents of a module in all cases that can be read, each once."""
    modules, text = loaded["modules"].module, loaded["jsontext"].module
    path = "urdd.json" if name == "root_metadata" else modules.file_of(name)
    found: dict[bytes, Document] = {}
    for case in cases:
        try:
            data = loaded["validator"].module.open_tree(case.place).files.get(path)
        except loaded["report"].module.Unreadable:
            continue
        if data is None:
            continue
        if data not in found:
            try:
                found[data] = Document(text.read_json(data))
            except text.TextFault:
                continue
        found[data].cases.append(case)
    return sorted(found.values(), key=lambda document: len(json.dumps(document.value)))


def killer_of(
    documents: list[Document], name: str, place: str, fits: Any, loaded: Any
) -> Case | None:
    """The case that kills a mutant."""
    allows_less = ALLOWS_LESS.search(place) is not None
    for document in documents:
        if document.valid != allows_less or fits(name, document.value) == document.valid:
            continue
        for case in sorted(document.cases, key=lambda case: case.seconds):
            if says_of(case, loaded, SECONDS) != case.says:
                return case
    return None


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("suite")
    parser.add_argument("--cases", default="", help="cases whose names begin so, by commas")
    parser.add_argument("--every", type=int, default=1, help="each n-th mutant of a module alone")
    parser.add_argument("--out", default="schema_mutants.jsonl")
    arguments = parser.parse_args()
    loaded = load_package()
    schemas = loaded["schema"].module
    published = schemas.published

    names = ["root_metadata", *loaded["modules"].module.TABLE]
    first = max(one.next for one in loaded.values())
    block_of = {name: first + place for place, name in enumerate(names)}

    def noted(name: str, version: str) -> Any:
        HITS.blocks.add(block_of[name])
        return published(name, version)

    schemas.published = noted
    remember_trees(loaded)
    cases = load_cases(arguments.suite, tuple(arguments.cases.split(",")))
    run_baseline(cases, loaded)
    fits = schemas.fits
    rows = []
    for name in names:
        documents = documents_of(name, cases, loaded)
        for document in documents:
            document.valid = fits(name, document.value)
        every = list(mutations(published(name, "1.0.0"), ""))
        for place, kind, change, restore in every[:: arguments.every]:
            change()
            CHANGED.begin({block_of[name]})
            killer = killer_of(documents, name, place, fits, loaded)
            restore()
            CHANGED.end()
            rows.append([name, place, kind, killer.name if killer else "survived"])
            with open(arguments.out, "a", encoding="utf-8") as file:
                file.write(json.dumps(rows[-1]) + "\n")
    survivors = [row for row in rows if row[3] == "survived"]
    for row in survivors:
        print(*row)
    print(f"{len(rows)} mutants, {len(rows) - len(survivors)} killed, {len(survivors)} survived")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Changes of one attribute: its value, its name, its place."""

from __future__ import annotations

from collections.abc import Iterator

import values
from change import Change, Edit
from document import Attribute, Element

# What most readers treat differently: taken for every attribute that is the first of its kind.
CORE = {
    "empty", "spaces", "trailing_space", "text", "nan", "inf", "negative", "zero", "comma", "unit",
    "hexadecimal", "too_few", "too_many", "commas", "double_spaces", "tabs", "newlines", "zeros", "negatives",
    "first_nan", "last_text", "last_trailing_space", "upper", "other", "dropped", "repeated", "attribute_upper",
    "exponent_huge", "two_values",
}  # fmt: skip


def label(variant: str) -> str:
    return f"value_{variant}"


def changes(base: str, root: Element) -> Iterator[tuple[Change, Attribute, Element]]:
    """Every change of every attribute."""
    for element in root.all():
        for change, attribute in of_element(base, element):
            yield change, attribute, element


def of_element(base: str, element: Element) -> Iterator[tuple[Change, Attribute]]:
    for attribute in element.attributes:
        if not attribute.name.startswith("xmlns"):
            for change in [*of_value(base, element, attribute), *of_place(base, element, attribute)]:
                yield change, attribute


def of_value(base: str, element: Element, attribute: Attribute) -> Iterator[Change]:
    kind = values.kind(element.name, attribute.name)
    if not attribute.value.strip():
        return
    for variant, text, meaning in values.KINDS[kind](attribute.value):
        if text == attribute.value:
            continue
        edits = (Edit(attribute.value_start, attribute.value_end, text.encode()),)
        meant = () if meaning is None else (Edit(attribute.value_start, attribute.value_end, meaning.encode()),)
        yield change(base, element, attribute, label(variant), edits, meant)


def of_place(base: str, element: Element, attribute: Attribute) -> Iterator[Change]:
    name, value = attribute.name, attribute.value
    quoted = f'{name}="{value}"'.encode()

    def one(variant: str, edits: tuple[Edit, ...], meant: tuple[Edit, ...] = ()) -> Change:
        return change(base, element, attribute, variant, edits, meant)

    def whole(text: str) -> tuple[Edit, ...]:
        return (Edit(attribute.start, attribute.end, text.encode()),)

    drop = Edit(attribute.start, attribute.end, b"")
    yield one("dropped", (drop,), (drop,))
    yield one("repeated", (Edit(attribute.end, attribute.end, b" " + quoted),))
    yield one("repeated_other", (Edit(attribute.end, attribute.end, f' {name}="7"'.encode()),))
    name_end = attribute.name_start + len(name)
    for variant, text in (
        ("attribute_upper", name.upper()),
        ("attribute_capitalised", name.capitalize()),
        ("attribute_misspelt", name[:-2] + name[-1] + name[-2] if len(name) > 2 else name + "x"),
        ("attribute_prefixed", f"x:{name}"),
        ("attribute_plural", f"{name}s"),
    ):
        yield one(variant, (Edit(attribute.name_start, name_end, text.encode()),))
    yield one("single_quotes", whole(f" {name}='{value}'"), whole(f" {name}='{value}'"))
    yield one("spaces_around", whole(f' {name} = "{value}"'))
    yield one("newline_before", whole(f'\n{name}="{value}"'))
    yield one("unquoted", whole(f" {name}={value}"))
    yield one("unclosed", whole(f' {name}="{value}'))
    yield one("no_value", whole(f" {name}"))
    yield one("no_space_before", whole(f'{name}="{value}"'))
    yield one("comma_after", (Edit(attribute.end, attribute.end, b","),))
    yield one("less_in_value", (Edit(attribute.value_end, attribute.value_end, b"<"),))
    yield one("ampersand_in_value", (Edit(attribute.value_end, attribute.value_end, b"&"),))
    yield one("entity_in_value", (Edit(attribute.value_end, attribute.value_end, b"&unknown;"),))
    if element.alone:
        slash = element.end - 2
        if slash >= attribute.end:
            yield one("as_text", (drop, Edit(slash, element.end, f">{value}</{element.name}>".encode())))
            inner = f"><{name}>{value}</{name}></{element.name}>".encode()
            yield one("as_child", (drop, Edit(slash, element.end, inner)))


def change(
    base: str, element: Element, attribute: Attribute, variant: str, edits: tuple[Edit, ...], meant: tuple[Edit, ...]
) -> Change:
    stem = base.removesuffix(".urdf")
    return Change(f"{stem}/{element.path()}@{attribute.name}:{variant}", base, f"attribute {variant}", edits, meant)


def of_text(base: str, root: Element, data: bytes) -> Iterator[Change]:
    """Values that are an element's text: what is in a transmission."""
    stem = base.removesuffix(".urdf")
    for element in root.all():
        if element.name not in {"type", "hardwareInterface", "mechanicalReduction"} or element.children:
            continue
        value = data[element.inside : element.inside_end].decode()
        kind = values.number if element.name == "mechanicalReduction" else values.text
        for variant, text, meaning in kind(value):
            edits = (Edit(element.inside, element.inside_end, text.encode()),)
            meant = edits if meaning is not None else ()
            yield Change(f"{stem}/{element.path()}#text:{variant}", base, f"text {variant}", edits, meant)

"""A URDF's elements and attributes with the bytes that each takes, for files that are well-formed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

TOKEN = re.compile(
    rb"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<!DOCTYPE[^>\[]*(?:\[.*?\]\s*)?>|<\?.*?\?>"
    rb"|</(?P<close>[^\s>]+)\s*>"
    rb"|<(?P<open>[^\s/>!?]+)(?P<attributes>(?:[^>\"']|\"[^\"]*\"|'[^']*')*?)(?P<alone>/?)>",
    re.DOTALL,
)
ATTRIBUTE = re.compile(rb"\s+([^\s=]+)\s*=\s*(?:\"([^\"]*)\"|'([^']*)')")


@dataclass(frozen=True)
class Attribute:
    """`start` is where the white space before the attribute begins; `value` is without quotes."""

    name: str
    value: str
    start: int
    name_start: int
    value_start: int
    value_end: int
    end: int


@dataclass(eq=False)
class Element:
    """`inside` and `inside_end` delimit the content; they are equal for `<a/>`."""

    name: str
    parent: Element | None
    start: int
    name_end: int
    inside: int = 0
    inside_end: int = 0
    end: int = 0
    alone: bool = False
    attributes: list[Attribute] = field(default_factory=list)
    children: list[Element] = field(default_factory=list)

    def attribute(self, name: str) -> Attribute | None:
        return next((attribute for attribute in self.attributes if attribute.name == name), None)

    def get(self, name: str, default: str = "") -> str:
        attribute = self.attribute(name)
        return attribute.value if attribute else default

    def child(self, name: str) -> Element | None:
        return next((child for child in self.children if child.name == name), None)

    def all(self) -> Iterator[Element]:
        yield self
        for child in self.children:
            yield from child.all()

    def tags(self) -> tuple[str, ...]:
        """Names from below the root down to this element."""
        return (*self.parent.tags(), self.name) if self.parent else ()

    def path(self) -> str:
        """A short name that is unique in its file: `arm.inertial.mass`, `arm.visual2.geometry`."""
        if self.parent is None:
            return "robot"
        if self.parent.parent is None:
            return self.get("name") or self.name
        twins = [child for child in self.parent.children if child.name == self.name]
        number = str(twins.index(self) + 1) if len(twins) > 1 else ""
        return f"{self.parent.path()}.{self.name}{number}"


def parse(data: bytes) -> Element:
    """The root element."""
    root: Element | None = None
    current: Element | None = None
    for token in TOKEN.finditer(data):
        if token["open"]:
            element = Element(token["open"].decode(), current, token.start(), token.end("open"))
            element.attributes = attributes(token["attributes"], token.start("attributes"))
            element.inside = token.end()
            if current:
                current.children.append(element)
            root = root or element
            if token["alone"]:
                element.alone = True
                element.inside_end = element.end = token.end()
            else:
                current = element
        elif token["close"]:
            if current is None or current.name != token["close"].decode():
                raise ValueError(f"byte {token.start()}: {token[0].decode()} closes nothing")
            current.inside_end, current.end = token.start(), token.end()
            current = current.parent
    if root is None or current is not None:
        raise ValueError("an element is not closed")
    return root


def attributes(data: bytes, offset: int) -> list[Attribute]:
    found = []
    for match in ATTRIBUTE.finditer(data):
        group = 2 if match[2] is not None else 3
        places = (match.start(), match.start(1), match.start(group), match.end(group), match.end())
        found.append(Attribute(match[1].decode(), match[group].decode(), *(offset + place for place in places)))
    return found

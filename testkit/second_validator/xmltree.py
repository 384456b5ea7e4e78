"""Reading XML with places in the file: well-formed, with namespaces, without entities (6.1.8)."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from xml.parsers import expat

MAX_BYTES = 64 * 1024 * 1024
MAX_DEPTH = 256
MAX_ELEMENTS = 500_000
MAX_ATTRIBUTES = 256
MAX_PREFIXES = 64
BYTE_ORDER_MARK = b"\xef\xbb\xbf"
DECLARATION = re.compile(rb"<\?xml(?=[ \t\r\n])([^?>]*)\?>")
VERSION = re.compile(rb"""[ \t\r\n]version[ \t\r\n]*=[ \t\r\n]*["']1\.[0-9]+["']""")
SPACE = rb"[ \t\r\n]"
QUOTED = rb"""(?:"[^"]*"|'[^']*')"""
EQUALS = SPACE + b"*=" + SPACE + b"*"
WHOLE = re.compile(
    rb"<\?xml" + SPACE + b"+version" + EQUALS + QUOTED
    + b"(?:" + SPACE + b"+encoding" + EQUALS + QUOTED + b")?"
    + b"(?:" + SPACE + b"+standalone" + EQUALS + rb"""(?:"(?:yes|no)"|'(?:yes|no)'))?"""
    + SPACE + rb"*\?>"
)  # fmt: skip
ENCODING = re.compile(rb"""[ \t\r\n]encoding[ \t\r\n]*=[ \t\r\n]*["']([^"']*)["']""")
LITERAL = re.compile(rb"<!--.*?-->|<\?.*?\?>|\"[^\"]*\"|'[^']*'", re.DOTALL)
PARAMETER = re.compile(rb"%[^ \t\r\n;%&\"']+;")
START_TAG = re.compile(rb"""<(?:[^"'>]|"[^"]*"|'[^']*')*>""")
NO_BEGIN = "[-.0-9\u00b7\u0300-\u036f\u203f\u2040]|$"
XML_NAMESPACE = "http://www.w3.org/XML/1998/namespace"
XMLNS_NAMESPACE = "http://www.w3.org/2000/xmlns/"


class NotXml(Exception):
    """A text that is not XML, or that 6.1.8 does not allow."""


@dataclass
class Element:
    """An element with its place in the file, in bytes."""

    name: str
    attributes: dict[str, str]
    start: int
    end: int
    children: list[Element] = field(default_factory=list)
    text: str = ""

    def all(self, *names: str) -> list[Element]:
        return [child for child in self.children if child.name in names]

    def first(self, *names: str) -> Element | None:
        """The one that counts (6.1.8)."""
        found = self.all(*names)
        return found[0] if found else None


def check_name(name: str) -> None:
    """Namespaces in XML: at most one colon, with a name on both sides."""
    if name.count(":") > 1 or any(re.match(NO_BEGIN, part) for part in name.split(":")):
        raise NotXml


def check_plain(name: str, *_: object) -> None:
    """Namespaces in XML: no colon."""
    if ":" in name:
        raise NotXml


class Builder:
    """Handlers of expat that build the tree."""

    def __init__(self, data: bytes, most_elements: int) -> None:
        self.data = data
        self.most_elements = most_elements
        self.stack: list[Element] = []
        self.scopes: list[dict[str, str]] = [{"xml": XML_NAMESPACE}]
        self.prefixes: set[str] = set()
        self.count = 0
        self.root: Element | None = None
        self.parser = expat.ParserCreate()
        self.parser.buffer_text = True
        self.parser.StartElementHandler = self.start
        self.parser.EndElementHandler = self.finish
        self.parser.CharacterDataHandler = self.characters
        self.parser.ProcessingInstructionHandler = check_plain

    def declare(self, attributes: dict[str, str]) -> dict[str, str]:
        """The prefixes that hold inside an element."""
        scope = dict(self.scopes[-1])
        for key, value in attributes.items():
            if key == "xmlns" and value in (XML_NAMESPACE, XMLNS_NAMESPACE):
                raise NotXml
            if not key.startswith("xmlns:"):
                continue
            prefix = key[len("xmlns:") :]
            self.prefixes.add(prefix)
            if not value or prefix == "xmlns" or value == XMLNS_NAMESPACE:
                raise NotXml
            if (prefix == "xml") != (value == XML_NAMESPACE):
                raise NotXml
            scope[prefix] = value
        return scope

    def start(self, name: str, attributes: dict[str, str]) -> None:
        self.count += 1
        scope = self.declare(attributes)
        too_many = self.count > self.most_elements or len(self.prefixes) > MAX_PREFIXES
        too_large = len(attributes) > MAX_ATTRIBUTES
        if too_many or too_large or len(self.stack) >= MAX_DEPTH:
            raise NotXml
        expanded = set()
        for key in [name, *attributes]:
            check_name(key)
            prefix, _, local = key.rpartition(":")
            if prefix == "xmlns" and key != name:
                continue
            if prefix and prefix not in scope:
                raise NotXml
            if prefix and key != name:
                if (scope[prefix], local) in expanded:
                    raise NotXml
                expanded.add((scope[prefix], local))
        self.scopes.append(scope)
        element = Element(name, attributes, *[self.parser.CurrentByteIndex] * 2)
        if self.stack:
            self.stack[-1].children.append(element)
        else:
            self.root = element
        self.stack.append(element)

    def finish(self, _: str) -> None:
        element = self.stack.pop()
        self.scopes.pop()
        tag = START_TAG.match(self.data, element.start)
        if tag and tag[0].endswith(b"/>"):
            element.end = tag.end()
        else:
            element.end = self.data.index(b">", self.parser.CurrentByteIndex) + 1

    def characters(self, text: str) -> None:
        self.stack[-1].text += text


def blank_doctype(data: bytes) -> bytes:
    """The text with spaces in place of a DOCTYPE, which has no effect (6.1.8)."""
    places: list[int] = []
    parser = expat.ParserCreate()

    def begin(name: str, *_: object) -> None:
        places.append(parser.CurrentByteIndex)
        check_name(name)

    def attribute(element: str, name: str, *_: object) -> None:
        check_name(element)
        check_name(name)

    parser.StartDoctypeDeclHandler = begin
    parser.ElementDeclHandler = lambda name, _: check_name(name)
    parser.AttlistDeclHandler = attribute
    parser.NotationDeclHandler = check_plain
    parser.ProcessingInstructionHandler = check_plain
    parser.EndDoctypeDeclHandler = lambda: places.append(parser.CurrentByteIndex)
    parser.Parse(data, True)
    if not places:
        return data
    start = data.index(b"<!DOCTYPE")
    end = places[-1] + 1
    inside = data[start:end]
    bracket = LITERAL.sub(b"", inside)
    if b"<!ENTITY" in bracket or PARAMETER.search(bracket):
        raise NotXml
    for literal in LITERAL.findall(inside.partition(b"[")[2]):
        if literal[:1] in b"\"'" and b">" in literal:
            raise NotXml
    return data[:start] + b" " * len(inside) + data[end:]


def parse(data: bytes) -> Element:
    """The root of the tree. Raises NotXml, or what expat raises."""
    builder = Builder(data, MAX_ELEMENTS)
    builder.parser.Parse(data, True)
    assert builder.root is not None
    return builder.root


def read_xml(data: bytes) -> Element:
    """The tree of a URDF's text (6.1.8). Raises NotXml."""
    if len(data) > MAX_BYTES:
        raise NotXml
    start = len(BYTE_ORDER_MARK) if data.startswith(BYTE_ORDER_MARK) else 0
    declaration = DECLARATION.match(data, start)
    if declaration:
        encoding = ENCODING.search(declaration[1])
        if not VERSION.match(declaration[1]) or not WHOLE.fullmatch(declaration[0]):
            raise NotXml
        if encoding and not re.fullmatch(rb"utf-?8", encoding[1], re.IGNORECASE):
            raise NotXml
        unnamed = ENCODING.sub(lambda match: b" " * len(match[0]), declaration[0])
        data = data[:start] + unnamed + data[declaration.end() :]
    try:
        return parse(blank_doctype(data))
    except expat.ExpatError as fault:
        raise NotXml from fault

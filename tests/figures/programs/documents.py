"""Changes of a file as a document: its encoding, declaration, what is around the root, and what is no XML."""

from __future__ import annotations

from collections.abc import Iterator

from change import Change, Edit
from document import Element

DECLARATION = b'<?xml version="1.0" encoding="UTF-8"?>'


def changes(base: str, root: Element, data: bytes) -> Iterator[Change]:
    stem = base.removesuffix(".urdf")
    for variant, edits, meant in [*encodings(data), *declarations(), *around(root, data), *broken(root), *roots(root)]:
        yield Change(f"{stem}/document:{variant}", base, "document", edits, meant)


Found = tuple[str, tuple[Edit, ...], tuple[Edit, ...]]


def encodings(data: bytes) -> Iterator[Found]:
    text = data.decode()

    def whole(variant: str, content: bytes) -> Found:
        return variant, (Edit(0, len(data), content),), ()

    yield "bom", (Edit(0, 0, b"\xef\xbb\xbf"),), ()
    yield whole("utf16_le_bom", b"\xff\xfe" + text.replace("UTF-8", "UTF-16").encode("utf-16-le"))
    yield whole("utf16_be_bom", b"\xfe\xff" + text.replace("UTF-8", "UTF-16").encode("utf-16-be"))
    yield whole("utf16_le", text.replace("UTF-8", "UTF-16").encode("utf-16-le"))
    yield "bom_twice", (Edit(0, 0, b"\xef\xbb\xbf\xef\xbb\xbf"),), ()
    at = data.index(b"<link")
    comment = "<!-- größe -->"
    yield "latin1_comment", (Edit(at, at, comment.encode("latin-1")),), ()
    yield "utf8_comment", (Edit(at, at, comment.encode()),), ()
    encoding = data.index(b"UTF-8")
    for name in ("ISO-8859-1", "latin1", "windows-1252", "US-ASCII", "UTF-16", "utf8", "UTF8", "unknown", "", "cp1252"):
        declared = Edit(encoding, encoding + 5, name.encode())
        yield f"declares_{name or 'nothing'}", (declared,), ()
        yield f"declares_{name or 'nothing'}_with_bytes", (declared, Edit(at, at, comment.encode("latin-1"))), ()
        yield f"declares_{name or 'nothing'}_with_utf8", (declared, Edit(at, at, comment.encode())), ()
    robot = data.index(b'"small"') + 6
    yield "latin1_name", (Edit(robot, robot, "ö".encode("latin-1")),), ()
    mass = data.index(b'mass value="') + 12
    yield "latin1_in_number", (Edit(mass, mass, b"\xa0"),), ()
    link = data.index(b'link name="two"') + 14
    yield "latin1_link", (Edit(link, link, b"\xf6"),), ()
    for variant, byte in (
        ("nul", b"\0"),
        ("bell", b"\x07"),
        ("escape", b"\x1b"),
        ("delete", b"\x7f"),
        ("bad_utf8", b"\xff"),
    ):
        yield f"{variant}_in_content", (Edit(at, at, byte),), ()
        yield f"{variant}_in_comment", (Edit(at, at, b"<!-- " + byte + b" -->"),), ()
        yield f"{variant}_in_name", (Edit(robot, robot, byte),), ()
        yield f"{variant}_at_end", (Edit(len(data), len(data), byte),), ()
    yield "nul_reference", (Edit(robot, robot, b"&#0;"),), ()
    yield "control_reference", (Edit(robot, robot, b"&#1;"),), ()
    yield "surrogate_reference", (Edit(robot, robot, b"&#xD800;"),), ()
    yield "huge_reference", (Edit(robot, robot, b"&#x110000;"),), ()
    yield whole("returns", data.replace(b"\n", b"\r\n"))
    yield whole("old_mac", data.replace(b"\n", b"\r"))
    yield whole("one_line", data.replace(b"\n", b""))
    yield whole("nothing", b"")
    yield whole("one_newline", b"\n")
    yield whole("declaration_alone", DECLARATION + b"\n")
    yield whole("comment_alone", b"<!-- nothing -->")
    yield whole("text_alone", b"robot\n")
    yield whole("half", data[: len(data) // 2])
    yield whole("without_last", data.rstrip()[:-1])


def declarations() -> Iterator[Found]:
    end = len(DECLARATION)
    for variant, text in (
        ("no_declaration", b""),
        ("xml_1_1", b'<?xml version="1.1" encoding="UTF-8"?>'),
        ("xml_2_0", b'<?xml version="2.0"?>'),
        ("no_version", b'<?xml encoding="UTF-8"?>'),
        ("single_quotes", b"<?xml version='1.0' encoding='UTF-8'?>"),
        ("standalone", b'<?xml version="1.0" encoding="UTF-8" standalone="no"?>'),
        ("standalone_odd", b'<?xml version="1.0" encoding="UTF-8" standalone="maybe"?>'),
        ("unclosed_declaration", b'<?xml version="1.0" encoding="UTF-8">'),
        ("upper_declaration", b'<?XML version="1.0"?>'),
        ("declaration_twice", DECLARATION + b"\n" + DECLARATION),
        ("empty_declaration", b"<?xml?>"),
        ("space_in_declaration", b'< ?xml version="1.0"?>'),
        ("doctype", DECLARATION + b"<!DOCTYPE robot>"),
        ("doctype_system", DECLARATION + b'<!DOCTYPE robot SYSTEM "robot.dtd">'),
        ("doctype_entity", DECLARATION + b'<!DOCTYPE robot [<!ENTITY width "1">]>'),
        ("doctype_element", DECLARATION + b"<!DOCTYPE robot [<!ELEMENT robot ANY>]>"),
        ("doctype_other", DECLARATION + b"<!DOCTYPE html>"),
        ("instruction", DECLARATION + b'<?xml-stylesheet href="x"?>'),
        ("instruction_other", DECLARATION + b"<?x y?>"),
    ):
        edits = (Edit(0, end, text),)
        yield variant, edits, ()
    for variant, text in (
        ("space", b" "),
        ("newline", b"\n"),
        ("newlines", b"\n\n  "),
        ("comment", b"<!-- x -->"),
        ("text", b"x"),
    ):
        yield f"{variant}_before_declaration", (Edit(0, 0, text),), ()


def around(root: Element, data: bytes) -> Iterator[Found]:
    start, end = root.start, root.end
    for variant, text in (
        ("text", b"text"),
        ("element", b"<x/>"),
        ("comment", b"<!-- x -->"),
        ("newlines", b"\n\n\n"),
        ("robot", b'<robot name="other"><link name="only"/></robot>'),
        ("instruction", b"<?x y?>"),
        ("closing", b"</robot>"),
        ("entity", b"&amp;"),
        ("less", b"<"),
    ):
        yield f"{variant}_after_root", (Edit(end, end, text),), ()
        yield f"{variant}_before_root", (Edit(start, start, text),), ()
    wrapped = (Edit(start, start, b"<robots>"), Edit(end, end, b"</robots>"))
    yield "root_wrapped", wrapped, ()
    yield "cdata_around_link", (Edit(root.children[0].start, root.children[0].start, b"<![CDATA[x]]>"),), ()
    yield "default_namespace", (Edit(root.name_end, root.name_end, b' xmlns="http://www.ros.org"'),), ()
    yield "xacro_namespace", (Edit(root.name_end, root.name_end, b' xmlns:xacro="http://www.ros.org/wiki/xacro"'),), ()
    yield "prefix_declared_twice", (Edit(root.name_end, root.name_end, b' xmlns:x="a" xmlns:x="a"'),), ()
    yield "prefix_undeclared", (Edit(root.inside, root.inside, b'<x:y z="1"/>'),), ()
    yield "xacro_left", (Edit(root.inside, root.inside, b'<xacro:property name="x" value="1"/>'),), ()
    yield (
        "xacro_macro_left",
        (Edit(root.inside, root.inside, b'<xacro:arm name="x"><link name="inner"/></xacro:arm>'),),
        (),
    )
    mass = data.index(b'mass value="2"') + 12
    width = b'<!DOCTYPE robot [<!ENTITY width "2">]>'
    yield "entity_used", (Edit(start, start, width), Edit(mass, mass + 1, b"&width;")), ()
    yield "entity_undefined", (Edit(mass, mass + 1, b"&width;"),), ()
    for entity in ("amp", "lt", "gt", "quot", "apos", "nbsp", "AMP"):
        yield f"entity_{entity}_in_content", (Edit(root.inside, root.inside, f"&{entity};".encode()),), ()
    yield "bare_ampersand", (Edit(root.inside, root.inside, b" a & b "),), ()
    yield "bare_greater", (Edit(root.inside, root.inside, b" a > b "),), ()
    yield "cdata_end_in_text", (Edit(root.inside, root.inside, b" a ]]> b "),), ()
    deep = 600
    yield "deep", (Edit(root.inside, root.inside, b"<x>" * deep + b"</x>" * deep),), ()
    yield "deep_100", (Edit(root.inside, root.inside, b"<x>" * 100 + b"</x>" * 100),), ()


def broken(root: Element) -> Iterator[Found]:
    at = root.children[0].start
    for variant, text in (
        ("comment_with_dashes", b"<!-- a -- b -->"),
        ("comment_end_dash", b"<!-- a --->"),
        ("comment_unclosed", b"<!-- a"),
        ("comment_empty", b"<!---->"),
        ("comment_nested", b"<!-- a <!-- b --> c -->"),
        ("comment_with_element", b"<!-- <link name='x'/> -->"),
        ("comment_short", b"<!-->"),
        ("comment_odd", b"<!- a -->"),
        ("cdata_unclosed", b"<![CDATA[ a"),
        ("cdata_odd", b"<![cdata[ a ]]>"),
        ("less", b" < "),
        ("less_more", b"<>"),
        ("closing_alone", b"</link>"),
        ("digit_element", b"<1a/>"),
        ("hyphen_element", b"<-a/>"),
        ("dot_element", b"<a.b-c_d/>"),
        ("unicode_element", "<größe/>".encode()),
        ("doctype_inside", b"<!DOCTYPE x>"),
        ("declaration_inside", b'<?xml version="1.0"?>'),
        ("instruction_unclosed", b"<?x y"),
        ("instruction_empty", b"<??>"),
        ("slash_space", b"<x / >"),
        ("two_slashes", b"<x//>"),
        ("attribute_alone", b"<x y/>"),
        ("attributes_touch", b'<x y="1"z="2"/>'),
        ("attribute_twice", b'<x y="1" y="1"/>'),
        ("attribute_prefixes_twice", b'<x xmlns:a="u" xmlns:b="u" a:y="1" b:y="2"/>'),
        ("attribute_less", b'<x y="<"/>'),
        ("attribute_greater", b'<x y=">"/>'),
        ("attribute_ampersand", b'<x y="&"/>'),
        ("attribute_unquoted", b"<x y=1/>"),
        ("attribute_digit", b'<x 1y="1"/>'),
        ("attribute_colon", b'<x :y="1"/>'),
        ("attribute_xmlns_empty", b'<x xmlns:a=""/>'),
        ("unclosed_element", b"<x>"),
        ("wrongly_nested", b"<x><y></x></y>"),
        ("closing_upper", b"<x></X>"),
        ("closing_attribute", b'<x></x y="1">'),
        ("closing_slash", b"<x></x/>"),
    ):
        yield variant, (Edit(at, at, text),), ()


def roots(root: Element) -> Iterator[Found]:
    for name in ("Robot", "ROBOT", "robots", "model", "x:robot", "sdf", "mujoco"):
        opening = Edit(root.start + 1, root.name_end, name.encode())
        yield f"root_{name}", (opening, Edit(root.inside_end, root.end, f"</{name}>".encode())), ()
    yield "root_unclosed", (Edit(root.inside_end, root.end, b""),), ()
    yield "root_closed_twice", (Edit(root.end, root.end, b"</robot>"),), ()
    whole = (Edit(root.inside, root.inside_end, b""),)
    yield "root_empty", whole, whole
    yield "root_alone", (Edit(root.inside - 1, root.end, b"/>"),), ()

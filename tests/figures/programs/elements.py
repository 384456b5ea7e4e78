"""Changes of one element: gone, repeated, empty, misspelt, in another place."""

from __future__ import annotations

from collections.abc import Iterator

from change import Change, Edit
from document import Element

# What may stand where an element stands, and reads its attributes or children otherwise.
KIN = {
    "box": ('<sphere radius="0.3"/>', '<cylinder radius="0.3" length="0.2"/>', '<mesh filename="part.obj"/>'),
    "sphere": (
        '<box size="0.3 0.3 0.3"/>',
        '<cylinder radius="0.3" length="0.2"/>',
        '<capsule radius="0.3" length="0.2"/>',
    ),
    "cylinder": ('<box size="0.3 0.3 0.3"/>', '<sphere radius="0.3"/>', '<capsule radius="0.3" length="0.2"/>'),
    "capsule": ('<box size="0.3 0.3 0.3"/>', '<cylinder radius="0.3" length="0.2"/>'),
    "mesh": ('<box size="0.3 0.3 0.3"/>', '<sphere radius="0.3"/>'),
    "color": ('<texture filename="part.png"/>',),
    "texture": ('<color rgba="0.1 0.2 0.3 1"/>', '<texture filename="missing.png"/>'),
}
RENAMED = {
    "visual": "collision", "collision": "visual", "box": "cone", "sphere": "ellipsoid", "cylinder": "cone",
    "origin": "pose", "mass": "weight", "inertial": "inertia", "limit": "limits", "axis": "axes", "parent":
    "parent_link", "child": "children", "link": "body", "mesh": "model", "geometry": "shape", "dynamics":
    "friction", "mimic": "follow",
}  # fmt: skip
ONCE = {
    "dropped", "repeated", "emptied", "misspelt", "upper", "wrapped", "prefixed", "attributes_gone",
    "repeated_empty_first", "repeated_other_first", "text_inside", "unknown_attribute", "unknown_child",
    "to_parent", "to_root",
}  # fmt: skip


def changes(base: str, root: Element, data: bytes) -> Iterator[tuple[Change, Element]]:
    for element in root.all():
        if element is not root:
            for change in of_element(base, element, data):
                yield change, element


def of_element(base: str, element: Element, data: bytes) -> Iterator[Change]:
    stem, path = base.removesuffix(".urdf"), element.path()
    of = [
        *of_itself(element, data),
        *of_name(element),
        *of_content(element),
        *of_place(element, data),
        *of_kin(element),
    ]
    for variant, edits, meant in of:
        yield Change(f"{stem}/{path}:{variant}", base, f"element {variant}", edits, meant)


Found = tuple[str, tuple[Edit, ...], tuple[Edit, ...]]


def of_itself(element: Element, data: bytes) -> Iterator[Found]:
    copy = data[element.start : element.end]
    drop = (Edit(element.start, element.end, b""),)
    several = element.name in {"visual", "collision"}
    yield "dropped", drop, drop
    again = (Edit(element.end, element.end, copy),)
    yield "repeated", again, again if several else ()
    empty = f"<{element.name}/>".encode()
    yield "repeated_empty", (Edit(element.end, element.end, empty),), ()
    yield "repeated_empty_first", (Edit(element.start, element.start, empty),), ()
    if other := with_other_number(element, copy):
        after = (Edit(element.end, element.end, other),)
        yield "repeated_other", after, after if several else ()
        before = (Edit(element.start, element.start, other),)
        yield "repeated_other_first", before, before if several else ()
    yield "in_comment", (Edit(element.start, element.end, b"<!--" + copy + b"-->"),), drop


def with_other_number(element: Element, copy: bytes) -> bytes | None:
    """A copy in which the first number is another one."""
    for inner in element.all():
        for attribute in inner.attributes:
            first = attribute.value.split(" ")[0]
            try:
                number = float(first)
            except ValueError:
                continue
            at = attribute.value_start - element.start
            return copy[:at] + f"{number + 0.125:.6g}".encode() + copy[at + len(first) :]
    return None


def of_name(element: Element) -> Iterator[Found]:
    name = element.name
    names = [
        ("misspelt", name[:-2] + name[-1] + name[-2] if len(name) > 2 else name + "x"),
        ("upper", name.upper()),
        ("capitalised", name.capitalize()),
        ("prefixed", f"x:{name}"),
        ("underscored", f"_{name}"),
    ]
    if name in RENAMED:
        names.append(("renamed", RENAMED[name]))
    for variant, text in names:
        edits = renamed(element, text)
        yield variant, edits, edits if variant == "renamed" and name in {"visual", "collision"} else ()


def renamed(element: Element, name: str) -> tuple[Edit, ...]:
    opening = Edit(element.start + 1, element.name_end, name.encode())
    if element.alone:
        return (opening,)
    return opening, Edit(element.inside_end, element.end, f"</{name}>".encode())


def of_content(element: Element) -> Iterator[Found]:
    name = element.name
    if element.attributes:
        first, last = element.attributes[0], element.attributes[-1]
        gone = (Edit(first.start, last.end, b""),)
        if len(element.attributes) > 1:
            yield "attributes_gone", gone, gone
        yield "emptied_wholly", (Edit(element.start, element.end, f"<{name}/>".encode()),), ()
    if element.children:
        inside = (Edit(element.inside, element.inside_end, b""),)
        yield "emptied", inside, inside
    if element.alone:
        open_end = Edit(element.end - 2, element.end, f"></{name}>".encode())
        yield "closed_apart", (open_end,), (open_end,)
        yield "text_inside", (Edit(element.end - 2, element.end, f">text</{name}>".encode()),), ()
        yield "child_inside", (Edit(element.end - 2, element.end, f"><x/></{name}>".encode()),), ()
        yield "space_before_slash", (Edit(element.end - 2, element.end - 2, b" "),), ()
        yield "never_closed", (Edit(element.end - 2, element.end, b">"),), ()
    else:
        yield "text_inside", (Edit(element.inside, element.inside, b"text"),), ()
        yield "text_at_end", (Edit(element.inside_end, element.inside_end, b"text"),), ()
        yield "unknown_child", (Edit(element.inside, element.inside, b'<unknown value="1"/>'),), ()
        yield "comment_inside", (Edit(element.inside, element.inside, b"<!-- x -->"),), ()
        yield "cdata_inside", (Edit(element.inside, element.inside, b"<![CDATA[<x>]]>"),), ()
        yield "instruction_inside", (Edit(element.inside, element.inside, b"<?x y?>"),), ()
        yield "never_closed", (Edit(element.inside_end, element.end, b""),), ()
        yield "closed_by_another", (Edit(element.inside_end, element.end, b"</another>"),), ()
        yield "space_in_closing", (Edit(element.end - 1, element.end - 1, b" "),), ()
    yield "unknown_attribute", (Edit(element.name_end, element.name_end, b' unknown="1"'),), ()
    yield "space_before_name", (Edit(element.start + 1, element.start + 1, b" "),), ()


def of_place(element: Element, data: bytes) -> Iterator[Found]:
    parent = element.parent
    assert parent
    copy = data[element.start : element.end]
    drop = Edit(element.start, element.end, b"")
    around = (Edit(element.start, element.start, b"<group>"), Edit(element.end, element.end, b"</group>"))
    yield "wrapped", around, ()
    twice = (
        Edit(element.start, element.start, f"<{element.name}>".encode()),
        Edit(element.end, element.end, f"</{element.name}>".encode()),
    )
    yield "wrapped_in_its_own", twice, ()
    siblings = parent.children
    at = siblings.index(element)
    if at + 1 < len(siblings):
        after = siblings[at + 1]
        swapped = (drop, Edit(after.end, after.end, copy))
        yield "swapped", swapped, swapped
        if not after.alone:
            yield "into_next", (drop, Edit(after.inside, after.inside, copy)), ()
    if at > 1:
        first = (Edit(siblings[0].start, siblings[0].start, copy), drop)
        yield "to_first", first, first
    if at + 2 < len(siblings):
        last = (drop, Edit(siblings[-1].end, siblings[-1].end, copy))
        yield "to_last", last, last
    if parent.parent:
        yield "to_parent", (drop, Edit(parent.end, parent.end, copy)), ()
        if parent.parent.parent:
            root = parent
            while root.parent and root.parent.parent:
                root = root.parent
            yield "to_root", (drop, Edit(root.end, root.end, copy)), ()


def of_kin(element: Element) -> Iterator[Found]:
    for text in KIN.get(element.name, ()):
        other = (Edit(element.start, element.end, text.encode()),)
        name = text[1:].split(" ")[0]
        yield f"as_{name}", other, other
        yield f"and_{name}", (Edit(element.end, element.end, text.encode()),), ()
        yield f"after_{name}", (Edit(element.start, element.start, text.encode()),), ()

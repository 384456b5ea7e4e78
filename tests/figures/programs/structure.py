"""Changes of what a robot is made of: the tree, names throughout, mimics, materials, limits, masses."""

from __future__ import annotations

from collections.abc import Iterator

import values
from change import HERE, Change, Edit
from document import Attribute, Element

INERTIAL = '<inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>'
LIMIT = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'


def link(name: str, inside: str = INERTIAL) -> str:
    return f'<link name="{name}">{inside}</link>'


def joint(name: str, kind: str, parent: str, child: str, inside: str = LIMIT) -> str:
    return f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{inside}</joint>'


def names(base: str, root: Element) -> Iterator[Change]:
    """A new name wherever it stands, for the first and the last link, the first joint and material."""
    stem = base.removesuffix(".urdf")
    for kind in ("link", "joint", "material"):
        named = [element for element in root.children if element.name == kind and element.get("name")]
        for element in [named[0], named[-1]] if kind == "link" else named[:1]:
            old = element.get("name")
            places = [attribute for attribute in references(root, kind) if attribute.value == old]
            for variant, text, _ in values.new_name(old):
                edits = tuple(Edit(place.value_start, place.value_end, text.encode()) for place in places)
                yield Change(f"{stem}/{old}:named_{variant}", base, f"name {kind} {variant}", edits, edits)
    place = root.attribute("name")
    for variant, text, _ in values.new_name(root.get("name")):
        if place:
            edits = (Edit(place.value_start, place.value_end, text.encode()),)
            yield Change(f"{stem}/robot:named_{variant}", base, f"name robot {variant}", edits, edits)


def references(root: Element, kind: str) -> Iterator[Attribute]:
    """Attributes that define or name a link, joint or material."""
    where = {
        "link": {("link", "name"), ("parent", "link"), ("child", "link"), ("gazebo", "reference")},
        "joint": {("joint", "name"), ("mimic", "joint")},
        "material": {("material", "name")},
    }[kind]
    for element in root.all():
        for attribute in element.attributes:
            if (element.name, attribute.name) in where:
                yield attribute


def tree(base: str, root: Element, data: bytes) -> Iterator[Change]:
    """Additions to `small.urdf`: links one, two, three in a chain of the joints first and second."""
    end = root.inside_end
    top = root.inside

    def at_end(variant: str, text: str, mistake: bool = False) -> Change:
        edits = (Edit(end, end, text.encode()),)
        return Change(f"small/tree:{variant}", base, "tree", edits, () if mistake else edits)

    def place(element: str, inner: str, attribute: str) -> Attribute:
        found = next(child for child in root.children if child.get("name") == element)
        if inner:
            child = found.child(inner)
            assert child
            found = child
        where = found.attribute(attribute)
        assert where
        return where

    def value(variant: str, *edits: tuple[str, str, str, str], mistake: bool = True) -> Change:
        made = []
        for element, inner, attribute, text in edits:
            where = place(element, inner, attribute)
            made.append(Edit(where.value_start, where.value_end, text.encode()))
        return Change(f"small/tree:{variant}", base, "tree", tuple(made), () if mistake else tuple(made))

    for line in (HERE / "additions.txt").read_text("utf-8").splitlines():
        if line[:1] in {"=", "!"}:
            sign, variant, text = line.split(" ", 2)
            yield at_end(variant, text, mistake=sign == "!")
    yield value("child_is_parent", ("first", "child", "link", "one"))
    yield value("second_hangs_on_root", ("second", "parent", "link", "one"), mistake=False)
    yield value("reversed", ("first", "parent", "link", "two"), ("first", "child", "link", "one"))
    yield value("loop_of_two", ("second", "child", "link", "one"), mistake=True)
    yield value("links_one_name", ("three", "", "name", "two"))
    yield value("joints_one_name", ("second", "", "name", "first"))
    yield value("parents_swapped", ("first", "parent", "link", "two"), ("second", "parent", "link", "one"))
    links = [child for child in root.children if child.name == "link"]
    joints = [child for child in root.children if child.name == "joint"]
    for variant, drop in (
        ("no_link", links),
        ("no_joint", joints),
        ("one_link", [*links[1:], *joints]),
        ("one_empty_link", [*links[1:], *joints]),
        ("links_only_first_joint", joints[1:]),
    ):
        edits = tuple(Edit(element.start, element.end, b"") for element in drop)
        if variant == "one_empty_link":
            edits += (Edit(links[0].inside, links[0].inside_end, b""),)
        yield Change(f"small/tree:{variant}", base, "tree", edits, edits)
    turned = data[joints[0].start : joints[-1].end]
    edits = (Edit(top, top, turned), Edit(joints[0].start, joints[-1].end, b""))
    yield Change("small/tree:joints_first", base, "tree", edits, edits)
    yield Change("small/tree:no_tag_between", base, "tree", (Edit(links[0].inside, links[0].inside, b"\n\n"),))


def inside_joint(base: str, root: Element) -> Iterator[Change]:
    """What is put into the joint `second` of `small.urdf`, beside and instead of what it has."""
    second = next(child for child in root.children if child.get("name") == "second")
    limit = second.child("limit")
    assert limit
    at = second.inside

    def put(variant: str, text: str, means: bool = True) -> Change:
        edits = (Edit(at, at, text.encode()),)
        return Change(f"small/second:{variant}", base, "joint", edits, edits if means else ())

    def limits(variant: str, text: str, means: bool = True) -> Change:
        edits = (Edit(limit.start, limit.end, text.encode()),)
        return Change(f"small/second:limit_{variant}", base, "limit", edits, edits if means else ())

    yield put("mimic", '<mimic joint="first"/>')
    yield put("mimic_all", '<mimic joint="first" multiplier="2" offset="0.5"/>')
    yield put("mimic_itself", '<mimic joint="second"/>')
    yield put("mimic_missing", '<mimic joint="nowhere"/>')
    yield put("mimic_link", '<mimic joint="one"/>')
    yield put("mimic_nameless", "<mimic/>", False)
    yield put("mimic_empty", '<mimic joint=""/>')
    yield put("mimic_zero", '<mimic joint="first" multiplier="0"/>')
    yield put("mimics", '<mimic joint="first"/><mimic joint="first" multiplier="2"/>', False)
    yield put("safety", '<safety_controller k_velocity="1"/>')
    yield put("safety_empty", "<safety_controller/>", False)
    yield put("safety_crossed", '<safety_controller soft_lower_limit="1" soft_upper_limit="-1" k_velocity="1"/>')
    yield put("dynamics_empty", "<dynamics/>", False)
    yield put("dynamics_damping", '<dynamics damping="0.5"/>')
    yield put("dynamics_friction", '<dynamics friction="0.5"/>')
    yield put("dynamics_negative_damping", '<dynamics damping="-0.5"/>')
    yield put("dynamics_negative_friction", '<dynamics friction="-0.5"/>')
    yield put("dynamics_spring", '<dynamics damping="0.5" spring_stiffness="2" spring_reference="0.1"/>', False)
    yield put("dynamics_in_namespace", '<dynamics xmlns="urn:x" damping="0.5"/>', False)
    yield put("calibration", '<calibration rising="0"/>')
    yield put("calibration_empty", "<calibration/>", False)
    yield put("origin_empty", "<origin/>")
    yield put("origins", '<origin xyz="1 0 0"/><origin xyz="2 0 0"/>', False)
    yield put("axis_first", '<axis xyz="1 0 0"/>', False)
    yield put("axis_empty_first", "<axis/>", False)
    yield put("parent_first", '<parent link="one"/>', False)
    yield put("child_first", '<child link="one"/>', False)
    yield put("parent_text", "<parent>two</parent>", False)
    yield put(
        "joint_inside", '<joint name="third" type="fixed"><parent link="one"/><child link="four"/></joint>', False
    )
    yield put("disabled", "<hardwareInterface>x</hardwareInterface>", False)
    for variant, text in (
        ("none", ""),
        ("effort", '<limit effort="5" velocity="6"/>'),
        ("equal", '<limit lower="1" upper="1" effort="5" velocity="6"/>'),
        ("zeros", '<limit lower="0" upper="0" effort="5" velocity="6"/>'),
        ("all_zeros", '<limit lower="0" upper="0" effort="0" velocity="0"/>'),
        ("crossed", '<limit lower="1" upper="-1" effort="5" velocity="6"/>'),
        ("without_zero", '<limit lower="1" upper="2" effort="5" velocity="6"/>'),
        ("huge", '<limit lower="-1e16" upper="1e16" effort="5" velocity="6"/>'),
        ("lower_alone", '<limit lower="-1" effort="5" velocity="6"/>'),
        ("upper_alone", '<limit upper="1" effort="5" velocity="6"/>'),
        ("negative_effort", '<limit lower="-2" upper="2" effort="-5" velocity="6"/>'),
        ("negative_velocity", '<limit lower="-2" upper="2" effort="5" velocity="-6"/>'),
        ("zero_effort", '<limit lower="-2" upper="2" effort="0" velocity="6"/>'),
        ("zero_velocity", '<limit lower="-2" upper="2" effort="5" velocity="0"/>'),
        ("tiny_range", '<limit lower="0" upper="1e-12" effort="5" velocity="6"/>'),
        ("acceleration", '<limit lower="-2" upper="2" effort="5" velocity="6" acceleration="7" jerk="8"/>'),
        ("drake_acceleration", '<limit lower="-2" upper="2" effort="5" velocity="6" drake:acceleration="7"/>'),
        ("infinite", '<limit lower="-inf" upper="inf" effort="5" velocity="6"/>'),
    ):
        yield limits(variant, text, variant not in {"infinite", "drake_acceleration"})
    kind = second.attribute("type")
    assert kind
    place = Edit(kind.value_start, kind.value_end, b"")
    for name in values.JOINT_TYPES:
        typed = Edit(place.start, place.end, name.encode())
        for variant, text in (
            ("without_limit", ""),
            ("with_crossed_limit", '<limit lower="1" upper="-1" effort="5" velocity="6"/>'),
            ("with_zero_limit", '<limit lower="0" upper="0" effort="5" velocity="6"/>'),
            ("with_empty_limit", "<limit/>"),
        ):
            edits = (typed, Edit(limit.start, limit.end, text.encode()))
            means = edits if variant != "with_empty_limit" else (typed,)
            yield Change(f"small/second:{name}_{variant}", base, "type and limit", edits, means)
        for xyz in ("0 0 0", "0 0 2", "0 0 1e-9", "0 0 -1", "1 1 0", "0.1 0.2 0.3"):
            axis = second.child("axis")
            assert axis
            edits = (Edit(axis.start, axis.end, f'<axis xyz="{xyz}"/>'.encode()), typed)
            yield Change(f"small/second:{name}_axis_{xyz.replace(' ', '_')}", base, "type and axis", edits, edits)
        axis = second.child("axis")
        assert axis
        edits = (Edit(axis.start, axis.end, b""), typed)
        yield Change(f"small/second:{name}_without_axis", base, "type and axis", edits, edits)
        for variant, text in (
            ("mimic", '<mimic joint="first"/>'),
            ("dynamics", '<dynamics damping="1" friction="1"/>'),
        ):
            edits = (Edit(at, at, text.encode()), typed)
            yield Change(f"small/second:{name}_with_{variant}", base, f"type and {variant}", edits, edits)


def mimics(base: str, root: Element) -> Iterator[Change]:
    """Mimics between the two joints of `small.urdf` and a third one."""
    first, second = [child for child in root.children if child.name == "joint"]
    end = root.inside_end

    def put(variant: str, in_first: str, in_second: str, at_end: str = "", kind: str = "") -> Change:
        edits = [
            Edit(first.inside, first.inside, in_first.encode()),
            Edit(second.inside, second.inside, in_second.encode()),
        ]
        edits = [edit for edit in edits if edit.text]
        if at_end:
            edits.append(Edit(end, end, at_end.encode()))
        typed = first.attribute("type")
        if kind and typed:
            edits.append(Edit(typed.value_start, typed.value_end, kind.encode()))
        return Change(f"small/mimics:{variant}", base, "mimic", tuple(edits), tuple(edits))

    def mimic(name: str) -> str:
        return f'<mimic joint="{name}"/>'

    third = link("four") + joint("third", "revolute", "three", "four", LIMIT + mimic("second"))
    yield put("loop", mimic("second"), mimic("first"))
    yield put("of_later", mimic("second"), "")
    yield put("chain", "", mimic("first"), third)
    yield put("loop_of_three", mimic("third"), mimic("first"), third)
    free = link("four") + joint("third", "revolute", "three", "four")
    yield put("of_last", mimic("third"), "", free)
    yield put("two_of_one", mimic("third"), mimic("third"), free)
    for kind in values.JOINT_TYPES:
        yield put(f"of_{kind}", "", mimic("first"), kind=kind)
        fixed = link("four") + joint("third", kind, "three", "four", LIMIT + mimic("first"))
        yield put(f"by_{kind}", "", "", fixed)
    yield put("by_fixed_of_missing", "", "", link("four") + joint("third", "fixed", "three", "four", mimic("nowhere")))


def tensor(xx: str, yy: str, zz: str, xy: str = "0", xz: str = "0", yz: str = "0") -> str:
    return f'<inertia ixx="{xx}" ixy="{xy}" ixz="{xz}" iyy="{yy}" iyz="{yz}" izz="{zz}"/>'


def inertials() -> Iterator[tuple[str, str, bool]]:
    """A name, an inertial, and whether it means what it says."""
    good = tensor("0.1", "0.1", "0.1")
    yield "none", "", True
    yield "empty", "<inertial/>", False
    yield "mass_alone", '<inertial><mass value="1"/></inertial>', True
    yield "inertia_alone", f"<inertial>{good}</inertial>", True
    for variant, mass in (("zero", "0"), ("negative", "-1"), ("tiny", "1e-16"), ("small", "1e-6")):
        yield f"mass_{variant}", f'<inertial><mass value="{mass}"/>{good}</inertial>', True
    yield "all_zero", f'<inertial><mass value="0"/>{tensor("0", "0", "0")}</inertial>', True
    for variant, values_of in (
        ("zero", ("0", "0", "0")),
        ("negative", ("-0.1", "0.1", "0.1")),
        ("negatives", ("-0.1", "-0.1", "-0.1")),
        ("one_zero", ("0", "0.1", "0.1")),
        ("tiny", ("1e-16", "1e-16", "1e-16")),
        ("small", ("1e-9", "1e-9", "1e-9")),
        ("triangle", ("0.1", "0.1", "0.3")),
        ("triangle_equal", ("0.1", "0.1", "0.2")),
        ("triangle_nearly", ("0.1", "0.1", "0.2000001")),
        ("triangle_turned", ("0.1", "0.1", "0.1", "0.09")),
        ("indefinite", ("0.1", "0.1", "0.1", "0.3")),
        ("products", ("0.1", "0.1", "0.1", "0.01", "0.02", "0.03")),
    ):
        yield f"inertia_{variant}", f'<inertial><mass value="1"/>{tensor(*values_of)}</inertial>', True
    yield "inertia_empty", '<inertial><mass value="1"/><inertia/></inertial>', False
    diagonal = '<inertia ixx="0.1" iyy="0.1" izz="0.1"/>'
    yield "inertia_diagonal", f'<inertial><mass value="1"/>{diagonal}</inertial>', True
    yield "mass_text", f"<inertial><mass>1</mass>{good}</inertial>", False
    yield "far", f'<inertial><origin xyz="100 0 0"/><mass value="1"/>{good}</inertial>', True
    yield "twice", 2 * f'<inertial><mass value="2"/>{good}</inertial>', False


def bodies(base: str, root: Element) -> Iterator[Change]:
    """What is put in place of an inertial of `small.urdf`: of its root, of its middle and of its last link."""
    for name in ("one", "two", "three"):
        body = next(child for child in root.children if child.name == "link" and child.get("name") == name)
        inertial = body.child("inertial")
        assert inertial

        for variant, text, means in inertials():
            edits = (Edit(inertial.start, inertial.end, text.encode()),)
            yield Change(f"small/{name}:inertial_{variant}", base, "inertial", edits, edits if means else ())


def materials(base: str, root: Element) -> Iterator[Change]:
    """Materials of `all.urdf`'s visuals: defined nowhere, later, in another link."""
    wood = next(child for child in root.children if child.get("name") == "wood")
    visuals = [visual for child in root.children for visual in child.children if visual.name == "visual"]
    plain = visuals[-1]
    end = root.inside_end

    def put(variant: str, text: str, at_end: str = "", drop: bool = False) -> Change:
        edits = [Edit(plain.inside, plain.inside, text.encode())] if text else []
        if at_end:
            edits.append(Edit(end, end, at_end.encode()))
        if drop:
            edits.append(Edit(wood.start, wood.end, b""))
        return Change(f"all/materials:{variant}", base, "material", tuple(edits), tuple(edits))

    blue = '<color rgba="0 0 1 1"/>'
    yield put("undefined", '<material name="nowhere"/>')
    yield put("of_robot", '<material name="grey"/>')
    yield put("of_earlier_link", '<material name="red"/>')
    yield put("defined_later", '<material name="late"/>', f'<material name="late">{blue}</material>')
    shown = f'<visual><geometry><box size="1 1 1"/></geometry><material name="late">{blue}</material></visual>'
    later = f'<link name="last">{shown}</link>' + joint("end", "fixed", "tool", "last", "")
    yield put("defined_in_later_link", '<material name="late"/>', later)
    yield put("again_equal", '<material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>')
    yield put("again_other", f'<material name="grey">{blue}</material>')
    yield put("again_other_local", f'<material name="red">{blue}</material>')
    for name in ("red", "late", ""):
        again = later.replace('"late"', f'"{name}"')
        first = f'<material name="{name}"><color rgba="0 1 0 1"/></material>'
        yield put(f"again_in_later_link_{name or 'empty'}", first if name != "red" else "", again)
    yield put("nameless", f"<material>{blue}</material>")
    yield put("name_empty", f'<material name="">{blue}</material>')
    yield put("nothing", "<material/>")
    yield put("three_values", '<material name="new"><color rgba="1 0 0"/></material>')
    yield put("five_values", '<material name="new"><color rgba="1 0 0 1 1"/></material>')
    yield put("color_empty", '<material name="new"><color/></material>')
    yield put("texture", '<material name="new"><texture filename="part.png"/></material>')
    yield put("texture_missing", '<material name="new"><texture filename="missing.png"/></material>')
    yield put("texture_odd", '<material name="new"><texture filename="odd.stl"/></material>')
    yield put("texture_empty", '<material name="new"><texture/></material>')
    yield put("texture_package", '<material name="new"><texture filename="package://nowhere/part.png"/></material>')
    yield put("color_and_texture", f'<material name="new">{blue}<texture filename="part.png"/></material>')
    yield put("two", f'<material name="grey"/><material name="new">{blue}</material>')
    yield put("used_but_dropped", "", "", drop=True)

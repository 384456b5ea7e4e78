"""Compares what `<gazebo>` elements of a URDF become in our SDF with libsdformat's own conversion of the same URDF.

    g++ -std=c++17 tests/figures/exports/convert.cpp -o convert $(pkg-config --cflags --libs sdformat12)
    python3 tests/figures/exports/gazebo.py ./convert ROBOT.urdf ROBOT.sdf

Fixed joints are preserved in the conversion, and links without mass are given one: libsdformat leaves them out otherwise.
Compared are gravity, damping, self-collision, sensors and other elements of links, surfaces of collisions, materials of
visuals, physics of joints, and plugins of the model. Defaults that libsdformat fills in are not differences, nor are the
collisions of contact sensors (those of our files have names of their own) and the noise of IMUs where SDF 1.4 had it, which
is left out with a note. Exits with 1 where something differs.
"""

import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET

MASS = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
DEFAULTS = {("cfm", "0"), ("erp", "0.2"), ("spring_reference", "0"), ("spring_stiffness", "0"), ("topic", "__default_topic__")}
OTHERWISE = {("contact", "collision"), ("imu", "noise")}
OF_LINKS = ("gravity", "velocity_decay", "self_collide", "sensor", "projector", "light", "plugin", "gripper")


def plain(text):
    def word(word):
        try:
            return f"{float(word):.9g}"
        except ValueError:
            return {"true": "1", "false": "0"}.get(word.lower(), word)

    return " ".join(word(of) for of in (text or "").split())


def tree(element):
    """An element without the order of attributes and children, defaults and what is ours to say otherwise."""
    children = [tree(child) for child in element if (element.tag, child.tag) not in OTHERWISE]
    children = sorted(child for child in children if child)
    own = (element.tag, tuple(sorted(element.items())), plain(element.text), tuple(children))
    is_default = (own[0], own[2]) in DEFAULTS
    is_empty = own[1:] == ((), "", ()) and element.tag in ("surface", "contact", "friction", "ode", "limit", "dynamics", "physics")
    return None if is_empty or is_default else own


def some(element, *tags):
    found = [tree(child) for tag in tags for child in element.findall(tag)]
    return sorted(of for of in found if of)


def converted(convert, urdf):
    root = ET.parse(urdf).getroot()
    for link in root.findall("link"):
        mass = link.find("inertial/mass")
        if mass is None or float(mass.get("value")) < 1e-3:
            for inertial in link.findall("inertial"):
                link.remove(inertial)
            link.append(ET.fromstring(MASS))
    for joint in root.findall("joint"):
        if joint.get("type") == "fixed":
            gazebo = ET.SubElement(root, "gazebo", reference=joint.get("name"))
            ET.SubElement(gazebo, "preserveFixedJoint").text = "true"
    with tempfile.NamedTemporaryFile("w", suffix=".urdf", delete=False) as file:
        file.write(ET.tostring(root, encoding="unicode"))
    text = subprocess.run([convert, file.name], capture_output=True, text=True, check=True).stdout
    os.unlink(file.name)
    # Prefixes that only the source declares.
    return ET.fromstring(re.sub(r"(</?)(\w+):", r"\1\2_", text)).find("model")


def compare(convert, urdf, sdf):
    theirs, ours = converted(convert, urdf), ET.parse(sdf).getroot().find("model")
    counts = {True: 0, False: 0}

    def check(what, a, b):
        if a or b:
            counts[a == b] += 1
        if a != b:
            print(f"{what}\n  libsdformat {a}\n  urdd        {b}")

    def both(tag):
        a, b = ({of.get("name"): of for of in model.findall(tag)} for model in (theirs, ours))
        return [(name, a[name], b[name]) for name in a if name in b]

    links = both("link")
    for name, a, b in links:
        for tag in OF_LINKS:
            check(f"link {name}: {tag}", some(a, tag), some(b, tag))
        for shape, tags in (("collision", ("surface", "max_contacts", "laser_retro")), ("visual", ("material/script",))):
            for of_ours in b.findall(shape) if a.find(shape) is not None else []:
                check(f"link {name}: {shape}", some(a.find(shape), *tags), some(of_ours, *tags))
    for name, a, b in both("joint"):
        check(f"joint {name}", some(a, "physics", "axis/dynamics/spring_stiffness"), some(b, "physics", "axis/dynamics/spring_stiffness"))
    check("model", some(theirs, "plugin"), some(ours, "plugin"))
    print(f"{urdf}: {len(links)} links of {len(theirs.findall('link'))}, {counts[True]} the same, {counts[False]} differ")
    return counts[False] == 0 and bool(links)


if __name__ == "__main__":
    sys.exit(0 if compare(*sys.argv[1:4]) else 1)

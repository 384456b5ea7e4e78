"""Rules about elements, attributes and names."""
from model import *


LIMIT = {"lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"}
SHAPES = {"mesh": {"filename", "scale"}, "box": {"size"}, "cylinder": {"radius", "length"},
          "capsule": {"radius", "length"}, "sphere": {"radius"}}
KNOWN = {  # element -> (attributes, children); children None: not looked into
    "robot": ({"name", "version"}, {"link", "joint", "material", "transmission", "gazebo", "ros2_control"}),
    "link": ({"name", "type"}, {"inertial", "visual", "collision"}),
    "inertial": (set(), {"origin", "mass", "inertia"}),
    "visual": ({"name"}, {"origin", "geometry", "material"}),
    "collision": ({"name"}, {"origin", "geometry"}),
    "geometry": (set(), set(SHAPES)),
    "material": ({"name"}, {"color", "texture"}),
    "joint": ({"name", "type"}, {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic", "safety_controller", "calibration"}),
    "origin": ({"xyz", "rpy", "quat_xyzw"}, set()),
    "mass": ({"value"}, set()),
    "inertia": ({"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, set()),
    "color": ({"rgba"}, set()),
    "texture": ({"filename"}, set()),
    "parent": ({"link"}, set()),
    "child": ({"link"}, set()),
    "axis": ({"xyz"}, set()),
    "limit": (LIMIT, set()),
    "dynamics": ({"damping", "friction"}, set()),
    "mimic": ({"joint", "multiplier", "offset"}, set()),
    "safety_controller": ({"soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"}, set()),
    "calibration": ({"rising", "falling", "reference_position"}, set()),
    **{k: (v, set()) for k, v in SHAPES.items()},
}
ELEMENT_NAMES = set(KNOWN)
# Legal extensions that readers other than urdfdom know: (in element, name) for elements, (on element, name) for attributes.
EXTENSION_ELEMENTS = {
    "robot": {"sensor", "mujoco", "loop_joint", "force_element", "frame", "collision_filter_group", "group", "group_state", "disable_collisions",
              "passive_joint", "end_effector", "virtual_joint", "model_state", "property", "deformable", "gripper"},
    "link": {"contact", "self_collision_checking", "audio_source", "sensor", "gazebo", "inertia_scaling", "friction_anchor", "laser_inertia", "self_collision"},
    "joint": {"transmission", "gazebo", "sensor", "hardware", "drive"},
    "visual": {"verbose"},
    "collision": {"verbose", "contact_coefficients", "surface", "contact", "material"},
    "geometry": {"plane", "cdf", "sdf", "ellipsoid", "superellipsoid", "cone", "heightmap", "convex", "empty"},
    "material": {"specular", "ambient", "emissive", "shininess", "script", "diffuse"},
}
EXTENSION_ATTRIBUTES = {
    "collision": {"concave", "group", "mask"}, "visual": {"concave"}, "link": {"concave"},
    "inertia": {"iyx", "izx", "izy"},                     # the same tensor's other half
    "dynamics": {"coulomb_window", "coulomb", "stiffness", "rotor_inertia", "armature", "spring_reference", "spring_stiffness"},
    "limit": {"k_velocity", "k_position"}, "mesh": {"convex"}, "robot": {"scale"},
}


def distance(a, b):
    """Edits (insert, delete, replace, swap of neighbours) from a to b."""
    rows = [list(range(len(b) + 1))]
    for i, x in enumerate(a, 1):
        row = [i]
        for j, y in enumerate(b, 1):
            best = min(rows[-1][j] + 1, row[-1] + 1, rows[-1][j - 1] + (x != y))
            if i > 1 and j > 1 and x == b[j - 2] and a[i - 2] == y:
                best = min(best, rows[-2][j - 2] + 1)
            row.append(best)
        rows.append(row)
    return rows[-1][-1]


def nearest(name, known):
    """The known name that `name` is a misspelling of, or None: 1 edit away (2 where both have 6 letters), case ignored, or its beginning (5 letters)."""
    best = min(known, key=lambda k: (distance(name.lower(), k.lower()), k), default=None)
    if best is None:
        return None
    longer = [k for k in known if len(name) >= 5 and k.lower().startswith(name.lower())]
    if len(longer) == 1:
        return longer[0]
    allowed = 2 if min(len(name), len(best)) >= 6 else 1 if min(len(name), len(best)) >= 3 else 0
    return best if distance(name.lower(), best.lower()) <= allowed else None


def unknowns(robot):
    """(owner, context element, 'element'|'attribute', name, line) of everything that URDF and its known extensions do not define."""
    def owner(element):
        while tag(element) not in ("link", "joint", "material", "robot") or (tag(element) == "material" and tag(element.getparent()) != "robot"):
            element = element.getparent()
        return where(tag(element), element.get("name", "")) if tag(element) != "robot" else "robot"

    def walk(element):
        kind = tag(element)
        attributes, inside = KNOWN[kind]
        for name in element.attrib:
            if name.startswith("{") or ":" in name:
                continue
            if name not in attributes and name not in EXTENSION_ATTRIBUTES.get(kind, ()):
                yield owner(element), kind, "attribute", name, element.sourceline
        for c in element:
            name = tag(c)
            if not name or ":" in name:
                continue
            if name in inside:
                if name not in ("transmission", "gazebo", "ros2_control"):
                    yield from walk(c)
            elif name not in EXTENSION_ELEMENTS.get(kind, ()):
                yield owner(element), kind, "element", name, c.sourceline
    yield from walk(robot.xml)


@rule("LNT040", "misspelt")
def misspelt(robot):
    """An unknown element or attribute that is nearly a known one of the same place."""
    for owner, context, what, name, line in unknowns(robot):
        known = KNOWN[context][0] if what == "attribute" else KNOWN[context][1]
        near = nearest(name, known)
        if near:
            yield owner, f"unknown {what} `{name}` in `{context}`; did you mean `{near}`?", {"context": context, "what": what, "name": name, "near": near, "line": line}


@rule("LNT046", "misplaced")
def misplaced(robot):
    """An unknown element or attribute that URDF knows in another place, and that is no misspelling."""
    elsewhere = {a: k for k, (attributes, _) in KNOWN.items() for a in attributes}
    seen = set()
    for owner, context, what, name, line in unknowns(robot):
        known = KNOWN[context][0] if what == "attribute" else KNOWN[context][1]
        if nearest(name, known) or (owner, context, name) in seen:
            continue
        seen.add((owner, context, name))
        if what == "element" and name in ELEMENT_NAMES:
            places = sorted(k for k, (_, c) in KNOWN.items() if name in c)
            yield owner, f"`{name}` in `{context}` is ignored: it belongs in {', '.join(places)}", {"context": context, "what": what, "name": name, "line": line}
        elif what == "attribute" and name in elsewhere and name not in ("name", "type", "value", "link", "joint"):
            yield owner, f"attribute `{name}` of `{context}` is ignored: it belongs to `{elsewhere[name]}`", {"context": context, "what": what, "name": name, "line": line}


@rule("LNT047", "unknown-element-or-attribute")
def unknown_element_or_attribute(robot):
    """All other unknown elements and attributes."""
    elsewhere = {a for attributes, _ in KNOWN.values() for a in attributes} - {"name", "type", "value", "link", "joint"}
    for owner, context, what, name, line in unknowns(robot):
        known = KNOWN[context][0] if what == "attribute" else KNOWN[context][1]
        if nearest(name, known) or (what == "element" and name in ELEMENT_NAMES) or (what == "attribute" and name in elsewhere):
            continue
        yield owner, f"unknown {what} `{name}` in `{context}` is ignored", {"context": context, "what": what, "name": name, "line": line}


@rule("LNT051", "xacro-not-expanded")
def xacro_not_expanded(robot):
    """A .urdf with an element of the prefix `xacro`, or an attribute with `${` or `$(`. No other rule reads such a file."""
    if robot.xacro:
        yield "robot", "this is a xacro file, not a URDF: programs ignore its `xacro:` elements and take `${...}` as text", {}


@rule("LNT041", "material-not-defined")
def material_not_defined(robot):
    """Once a material: a visual's `material` with a name and neither colour nor texture, where no material of the robot has this name and
    no visual defines it in a link whose name sorts before (urdfdom's order), or earlier in the same link."""
    defined = {m.get("name") for m in children(robot.xml, "material")}
    anywhere = {m.get("name") for link in robot.links.values() for v in link.visuals for m in children(v, "material") if len(m)}
    told = set()
    for name in sorted(robot.links):
        for visual in robot.links[name].visuals:
            material = child(visual, "material")
            if material is None:
                continue
            full = child(material, "color") is not None or child(material, "texture") is not None
            key = material.get("name")
            if full:
                defined.add(key)
            elif key and key not in defined and key not in told:
                told.add(key)
                late = key in anywhere
                yield where("link", name), f"material `{key}` is not defined" + (" before, only in a link of a later name" if late else ""), {"material": key, "kind": "late" if late else "nowhere"}


def transmission_joints(robot):
    for transmission in children(robot.xml, "transmission"):
        for joint in transmission.iter("joint"):
            if joint.get("name"):
                yield transmission, joint.get("name")


@rule("LNT042", "transmission-unknown-joint")
def transmission_unknown_joint(robot):
    """`transmission` names a joint that the robot does not have."""
    for transmission, name in transmission_joints(robot):
        if name not in robot.joints:
            yield where("transmission", transmission.get("name", "")), f"joint `{name}` does not exist", {"joint": name, "near": nearest(name, robot.joints)}


@rule("LNT043", "ros2-control-unknown-joint")
def ros2_control_unknown_joint(robot):
    """A `joint` of `ros2_control` that the robot does not have."""
    for control in children(robot.xml, "ros2_control"):
        for joint in children(control, "joint"):
            name = joint.get("name")
            if name is not None and name not in robot.joints:
                yield where("ros2_control", control.get("name", "")), f"joint `{name}` does not exist", {"joint": name, "near": nearest(name, robot.joints)}


@rule("LNT044", "gazebo-reference-unknown")
def gazebo_reference_unknown(robot):
    """`gazebo reference` that is neither a link nor a joint."""
    for element in children(robot.xml, "gazebo"):
        name = element.get("reference")
        if name is not None and name != "" and name not in robot.links and name not in robot.joints:
            yield where("gazebo", name), f"`{name}` is neither a link nor a joint", {"near": nearest(name, [*robot.links, *robot.joints])}


def srdf_files(robot):
    """SRDFs of this robot: beside it with the same stem, in a `srdf` folder beside it or beside its folder, with the same stem or,
    where the SRDF's robot has the URDF's robot name."""
    found = []
    for folder in (robot.path.parent, robot.path.parent / "srdf", robot.path.parent.parent / "srdf"):
        if folder.is_dir():
            for path in sorted(folder.glob("*.srdf")):
                found.append(path)
    return found


@rule("LNT045", "srdf-unknown-name")
def srdf_unknown_name(robot):
    """An SRDF of the same robot (same robot name and same stem up to the ending) names links or joints that the URDF does not have."""
    for path in srdf_files(robot):
        try:
            xml = etree.parse(str(path), etree.XMLParser(resolve_entities=False, no_network=True)).getroot()
        except (etree.XMLSyntaxError, OSError):
            continue
        if xml.get("name") != robot.name or path.stem.lower() != robot.path.stem.lower():
            continue
        missing = {}
        virtual = {v.get("name") for v in xml.iter("virtual_joint")}
        for element in xml.iter():
            context = tag(element)
            if context == "disable_collisions" or context == "enable_collisions":
                names = [("link", element.get("link1")), ("link", element.get("link2"))]
            elif context == "chain":
                names = [("link", element.get("base_link")), ("link", element.get("tip_link"))]
            elif context == "link" or context == "joint":
                names = [(context, element.get("name"))]
            elif context == "passive_joint":
                names = [("joint", element.get("name"))]
            elif context == "end_effector":
                names = [("link", element.get("parent_link"))]
            elif context == "virtual_joint":
                names = [("link", element.get("child_link"))]
            else:
                continue
            for kind, name in names:
                known = robot.links if kind == "link" else robot.joints
                if name and name not in known and name not in virtual and (context, kind, name) not in missing:
                    missing[(context, kind, name)] = element.sourceline
        names = {}
        for (context, kind, name), line in missing.items():
            names.setdefault((kind, name), (line, []))[1].append(context)
        for (kind, name), (line, contexts) in names.items():
            yield where("srdf", path.name), f"{kind} `{name}` does not exist ({', '.join(contexts)})", {"name": name, "contexts": contexts, "line": line}


@rule("LNT008", "inertial-incomplete")
def inertial_incomplete(robot):
    """`inertial` without `mass` or `inertia`, or one of their attributes: MuJoCo refuses the file, PyBullet too without `mass` or `inertia`."""
    for link in robot.links.values():
        if link.inertial is None:
            continue
        mass, inertia = child(link.inertial, "mass"), child(link.inertial, "inertia")
        missing = []
        if mass is None:
            missing.append("`mass`")
        elif mass.get("value") is None:
            missing.append("`value` of `mass`")
        if inertia is None:
            missing.append("`inertia`")
        else:
            missing += [f"`{k}`" for k in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz") if inertia.get(k) is None]
        if missing:
            yield where("link", link.name), f"`inertial` has no {', no '.join(missing)}: MuJoCo refuses the file, urdfdom (ROS) drops the inertial", {"missing": missing}


COUNTS = {"origin": {"xyz": 3, "rpy": 3, "quat_xyzw": 4}, "axis": {"xyz": 3}, "mass": {"value": 1}, "color": {"rgba": 4},
          "inertia": dict.fromkeys(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), 1), "mesh": {"scale": 3}, "box": {"size": 3},
          "cylinder": {"radius": 1, "length": 1}, "capsule": {"radius": 1, "length": 1}, "sphere": {"radius": 1},
          "limit": dict.fromkeys(LIMIT, 1), "dynamics": {"damping": 1, "friction": 1}, "mimic": {"multiplier": 1, "offset": 1},
          "safety_controller": dict.fromkeys(("soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"), 1)}


@rule("LNT054", "number-not-readable")
def number_not_readable(robot):
    """A numeric attribute of URDF (in links, joints, materials) that is not as many numbers as it should be, separated by white space;
    `inf` and `nan` are numbers here."""
    for top in children(robot.xml, "link", "joint", "material"):
        for element in top.iter():
            for name, n in COUNTS.get(tag(element), {}).items():
                text = element.get(name)
                if text is None or tag(element.getparent()) == "gazebo":
                    continue
                parts = text.split()
                if len(parts) != n or not all(NUMBER.match(p) or re.match(r"[+-]?(inf|infinity|nan)\Z", p, re.I) for p in parts):
                    yield where(tag(top), top.get("name", "")), f"`{name}=\"{text[:60]}\"` of `{tag(element)}` is not {n} number{'s' if n > 1 else ''}", {
                        "element": tag(element), "attribute": name, "text": text[:80], "line": element.sourceline}


@rule("LNT048", "color-out-of-range")
def color_out_of_range(robot):
    """A number of `rgba` below 0 or above 1 (0 to 255 is the usual mistake)."""
    for element in robot.xml.iter("color"):
        rgba = numbers(element.get("rgba"), 4)
        if rgba and any(v < 0 or v > 1.001 for v in rgba):
            material = element.getparent()
            yield where("material", material.get("name", "")), f"rgba {element.get('rgba')} is outside of 0 to 1", {"rgba": rgba, "line": element.sourceline}

#!/usr/bin/env python3
"""A minimal URDD producer: a URDF in, a URDD of conformance class Core out.

Written from SPEC.md and the published schemas, with Python's standard library alone, to show how little it takes.
Numbers in brackets are clauses of SPEC.md. It repairs nothing: a URDF that has no URDD as it is [6.1.3 to 6.1.8], and
any with a DOCTYPE, is refused, with exit status 1 and nothing at out_dir.

    python3 minimal_producer.py robot.urdf out_dir
"""
import hashlib
import json
import math
import os
import re
import sys
from xml.parsers import expat

NUM_SAMPLED = 16  # sampled configurations in kinematics_samples_module: any number will do [9.2]
MAX_EXPLICIT_LINKS = 300  # up to here connections_module spells out every path [6.4.6]
MAX_LINKS_IN_PATHS = 2_000_000  # unless the paths hold more links than this
MODULES = {  # each module, with the modules that it is derived from, in the order of the table [2.2.1]
    "urdf_module": [],
    "dof_module": ["urdf_module"],
    "chain_module": ["urdf_module"],
    "connections_module": ["chain_module"],
    "bounds_module": ["urdf_module", "dof_module"],
    "kinematics_samples_module": ["dof_module", "chain_module", "bounds_module"],
}


class Refused(Exception):
    """Why a URDF has no URDD."""


def demand(condition, why):
    if not condition:
        raise Refused(why)


# ---- XML. Unknown elements are kept as they stand in the file [6.1.1], so we ask expat where elements begin and end.

MAX_BYTES, MAX_LEVELS, MAX_ELEMENTS, MAX_ATTRIBUTES, MAX_PREFIXES = 64 << 20, 256, 500_000, 256, 64  # [6.1.8]


class Element:
    def __init__(self, tag, attributes):
        self.tag, self.attributes, self.children, self.xml = tag, attributes, [], None
        self.get = attributes.get

    def required(self, key):
        demand(key in self.attributes, f"<{self.tag}> without {key}")
        return self.attributes[key]

    def all(self, tag):
        return [child for child in self.children if child.tag == tag]

    def first(self, tag):
        return next(iter(self.all(tag)), None)

    def others(self, known):
        return [child.xml for child in self.children if child.tag not in known.split()]


def parse_xml(data):
    demand(len(data) <= MAX_BYTES, f"more than {MAX_BYTES} bytes")
    data = data.decode("utf-8-sig").encode()
    declared = re.match(rb"""<\?xml\s+version\s*=\s*["']([^"']*)["'](?:\s+encoding\s*=\s*["']([^"']*))?""", data)
    if declared:
        demand(re.fullmatch(rb"1\.[0-9]+", declared[1]), f"XML of version {declared[1]!r}")
        demand(re.fullmatch(rb"(?i)utf-?8", declared[2] or b"utf-8"), f"the encoding {declared[2]!r}")
    start_tag = re.compile(rb"""<(?:[^>"']|"[^"]*"|'[^']*')*>""")
    parser, stack, top, prefixes = expat.ParserCreate("utf-8"), [], Element("", {}), set()
    count = 0

    def start(tag, attributes):
        nonlocal count
        count += 1
        element = Element(tag, attributes)
        (stack[-1][0] if stack else top).children.append(element)
        stack.append((element, parser.CurrentByteIndex))
        prefixes.update(key for key in attributes if key.startswith("xmlns:"))
        demand(len(stack) <= MAX_LEVELS and count <= MAX_ELEMENTS, "too many levels or elements")
        demand(len(attributes) <= MAX_ATTRIBUTES and len(prefixes) <= MAX_PREFIXES, "too many attributes or prefixes")

    def end(_tag):
        element, begin = stack.pop()
        opening = start_tag.match(data, begin)
        closed = opening[0].endswith(b"/>")
        element.xml = data[begin:opening.end() if closed else data.index(b">", parser.CurrentByteIndex) + 1].decode()

    def document_type(*_):
        raise Refused("a DOCTYPE")

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.StartDoctypeDeclHandler = document_type
    parser.Parse(data, True)
    expat.ParserCreate("utf-8", " ").Parse(data, True)  # once more, for namespaces
    return top.children[0]


# ---- urdf_module: all of the URDF; what it leaves out is null [6.1]

NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?|[+-]?(?i:inf|infinity|nan)")


def vector(element, key, count):
    """`count` numbers of an attribute; null where it is absent, or where one is not finite [6.1.8]."""
    if element is None or element.get(key) is None:
        return None
    words = re.findall(r"[^ \t\r\n]+", element.get(key))
    demand(len(words) == count and all(map(NUMBER.fullmatch, words)),
           f"<{element.tag} {key}={element.get(key)!r}>: {count} number(s) wanted")
    values = [float(word) for word in words]
    return values if all(map(math.isfinite, values)) else None


def numbers(element, keys):
    if element is None:
        return None
    return {key: (vector(element, key, 1) or [None])[0] for key in keys.split()}


def size(shape, key, count):
    shape.required(key)
    values = vector(shape, key, count)
    demand(values, f"<{shape.tag} {key}={shape.get(key)!r}> is not finite")
    return values


def complete(value):
    """The object, or null where something in it that cannot be null is missing."""
    return None if value is None or None in value.values() else value


def read_origin(parent):
    element = parent.first("origin")
    return element and {"xyz": vector(element, "xyz", 3), "rpy": vector(element, "rpy", 3),
                        "quat_xyzw": vector(element, "quat_xyzw", 4)}


def read_geometry(geometry):
    for shape in geometry.children if geometry else []:
        if shape.tag == "mesh":
            return {"Mesh": {"filename": shape.required("filename"), "scale": vector(shape, "scale", 3)}}
        if shape.tag == "box":
            return {"Box": {"size": size(shape, "size", 3)}}
        if shape.tag in ("cylinder", "capsule", "sphere"):
            keys = ["radius"] if shape.tag == "sphere" else ["radius", "length"]
            return {shape.tag.capitalize(): {key: size(shape, key, 1)[0] for key in keys}}
    return None


def read_material(element):
    color, texture = element.first("color"), element.first("texture")
    return {"name": element.get("name"), "color": color and complete({"rgba": vector(color, "rgba", 4)}),
            "texture": texture and complete({"filename": texture.get("filename")})}


def read_part(element):  # a visual or collision element
    part = {"name": element.get("name"), "origin": read_origin(element),
            "geometry": read_geometry(element.first("geometry"))}
    if element.tag == "visual":
        part["material"] = element.first("material") and read_material(element.first("material"))
    return part


PARTS = "inertial visual collision"


def read_link(element):
    inertial = element.first("inertial")
    return {
        "name": element.required("name"),
        "inertial": inertial and {"origin": read_origin(inertial),
                                  "mass": complete(numbers(inertial.first("mass"), "value")),
                                  "inertia": numbers(inertial.first("inertia"), "ixx ixy ixz iyy iyz izz")},
        "visual": [read_part(part) for part in element.all("visual")],
        "collision": [read_part(part) for part in element.all("collision")],
        "unknown_elements": element.others(PARTS),
    }


def read_joint(element):
    axis, mimic, kind = element.first("axis"), element.first("mimic"), element.required("type")
    demand(kind in TYPES, f"the joint type {kind!r}")
    for end in ("parent", "child"):
        demand(element.first(end), f"a joint without {end}")
    soft = "soft_lower_limit soft_upper_limit k_position k_velocity"
    return {
        "name": element.required("name"),
        "joint_type": kind.capitalize(),
        "origin": read_origin(element),
        "parent": {"link": element.first("parent").required("link")},
        "child": {"link": element.first("child").required("link")},
        "axis": axis and {"xyz": vector(axis, "xyz", 3)},
        "limit": numbers(element.first("limit"), "lower upper effort velocity acceleration deceleration jerk"),
        "dynamics": numbers(element.first("dynamics"), "damping friction"),
        "mimic": mimic and {"joint": mimic.required("joint"), **numbers(mimic, "multiplier offset")},
        "safety_controller": numbers(element.first("safety_controller"), soft),
        "calibration": numbers(element.first("calibration"), "rising falling"),
        "unknown_elements": element.others(
            "origin parent child axis limit dynamics mimic safety_controller calibration"),
    }


def has_quaternions(version):  # [6.1.9]
    parts = re.fullmatch(r"[ \t\r\n]*([0-9]+)\.([0-9]+)[ \t\r\n]*", version or "")
    return parts is not None and tuple(map(int, parts.groups())) >= (1, 1)


def urdf_module(robot):
    demand(robot.tag == "robot", f"the root element is {robot.tag!r}")
    if has_quaternions(robot.get("version")):
        parts = [part for link in robot.all("link") for part in link.children if part.tag in PARTS.split()]
        for origin in (part.first("origin") for part in parts + robot.all("joint")):
            demand(not origin or None in (origin.get("rpy"), origin.get("quat_xyzw")), "an origin with two rotations")
    return {
        "name": robot.required("name"),
        "version": robot.get("version"),
        "links": [read_link(element) for element in robot.all("link")],
        "joints": [read_joint(element) for element in robot.all("joint")],
        "materials": [read_material(element) for element in robot.all("material")],
        "unknown_elements": robot.others("link joint material"),
    }


# ---- dof_module [6.2]

DOFS_OF_TYPE = {  # what follows the joint's name [6.2.5]; all but /trans_… and a prismatic joint's are angles [5.8]
    "Fixed": [], "Revolute": [""], "Continuous": [""], "Prismatic": [""], "Planar": ["/trans_x", "/trans_y", "/rot"],
    "Floating": ["/trans_x", "/trans_y", "/trans_z", "/rot_x", "/rot_y", "/rot_z"],
    "Spherical": ["/rot_x", "/rot_y", "/rot_z"],
}


TYPES = [name.lower() for name in DOFS_OF_TYPE]


def is_mimic(joint):
    return joint["mimic"] is not None and joint["joint_type"] != "Fixed"


def resolve_mimic(joint, by_name, depth=0):
    """(joint at the end of the chain, multiplier, offset) [5.10]"""
    if not is_mimic(joint):
        return joint, 1.0, 0.0
    demand(depth <= len(by_name), f"mimic joints go in a circle at {joint['name']!r}")
    demand(joint["mimic"]["joint"] in by_name, f"{joint['name']!r} follows a joint that is not there")
    demand(len(DOFS_OF_TYPE[joint["joint_type"]]) == 1, f"{joint['name']!r} follows another, and has several DOFs")
    end, multiplier, offset = resolve_mimic(by_name[joint["mimic"]["joint"]], by_name, depth + 1)
    own = 1.0 if joint["mimic"]["multiplier"] is None else joint["mimic"]["multiplier"]
    return end, own * multiplier, own * offset + (joint["mimic"]["offset"] or 0.0)


def dof_module(urdf):
    dofs, dofs_of_joint, mimics = [], [], []
    for idx, joint in enumerate(urdf["joints"]):
        first = len(dofs)
        for suffix in [] if is_mimic(joint) else DOFS_OF_TYPE[joint["joint_type"]]:
            length = joint["joint_type"] == "Prismatic" or suffix.startswith("/trans")
            dofs.append({"name": joint["name"] + suffix, "joint_idx": idx, "joint_name": joint["name"],
                         "quantity": "Length" if length else "Angle"})
        dofs_of_joint.append(list(range(first, len(dofs))))
    place = {joint["name"]: idx for idx, joint in enumerate(urdf["joints"])}
    demand(len(place) == len(urdf["joints"]), "two joints of one name")
    for joint in urdf["joints"]:
        end, multiplier, offset = resolve_mimic(joint, {j["name"]: j for j in urdf["joints"]})
        demand(not is_mimic(joint) or len(DOFS_OF_TYPE[end["joint_type"]]) < 2,
               f"{joint['name']!r} follows several DOFs")
        demand(math.isfinite(multiplier) and math.isfinite(offset), f"the mimic of {joint['name']!r} is not finite")
        driver = (dofs_of_joint[place[end["name"]]] or [None])[0]
        resolved = {"dof_idx": driver, "multiplier": multiplier, "offset": offset}
        mimics.append(resolved if is_mimic(joint) else None)
    return {"num_dofs": len(dofs), "dof_idx_to_joint_idx_mapping": [dof["joint_idx"] for dof in dofs],
            "joint_idx_to_dof_idxs_mapping": dofs_of_joint, "joint_idx_to_mimic_mapping": mimics, "dofs": dofs}


# ---- Rotations as unit quaternions (w, x, y, z); a pose is (position, quaternion) [5.4, 5.5]

def multiply(a, b):
    (aw, ax, ay, az), (bw, bx, by, bz) = a, b
    return (aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw)


def rotate(q, v):
    return multiply(multiply(q, (0.0, *v)), (q[0], -q[1], -q[2], -q[3]))[1:]


def turn(axis, angle):
    return (math.cos(angle / 2), *(math.sin(angle / 2) * c for c in axis))


def turn_by_vector(v):
    angle = math.hypot(*v)
    return turn([c / angle for c in v], angle) if angle > 0 else (1.0, 0.0, 0.0, 0.0)


def compose(a, b):
    return [p + r for p, r in zip(a[0], rotate(a[1], b[0]))], multiply(a[1], b[1])


def write_pose(position, q):
    sign = next((math.copysign(1.0, c) for c in q if c != 0), 1.0)  # the first that is not 0 is positive
    return {"position": list(position), "quaternion_wxyz": [sign * c / math.hypot(*q) for c in q]}


# ---- chain_module [6.3] and connections_module [6.4]

def chain_module(urdf):
    names = [link["name"] for link in urdf["links"]]
    links = [{"name": name, "link_idx": idx, "parent_joint_idx": None, "parent_link_idx": None,
              "children_joint_idxs": [], "children_link_idxs": []} for idx, name in enumerate(names)]
    joints = []
    quaternions = has_quaternions(urdf["version"])
    demand(len(set(names)) == len(names), "two links of one name")
    for idx, joint in enumerate(urdf["joints"]):
        for end in ("parent", "child"):
            demand(joint[end]["link"] in names, f"{joint['name']!r}: the link {joint[end]['link']!r} is not there")
        parent, child = (names.index(joint[end]["link"]) for end in ("parent", "child"))
        origin, axis = joint["origin"] or {}, None
        x, y, z, w = quaternions and origin.get("quat_xyzw") or [0.0] * 4
        if x * x + y * y + z * z + w * w > 0:  # [6.1.9]; write_pose gives it length 1
            rotation = (w, x, y, z)
        else:
            roll, pitch, yaw = origin.get("rpy") or [0.0] * 3
            rotation = multiply(turn((0, 0, 1), yaw), multiply(turn((0, 1, 0), pitch), turn((1, 0, 0), roll)))
        if joint["joint_type"] in ("Revolute", "Continuous", "Prismatic", "Planar"):
            axis = (joint["axis"] or {}).get("xyz") or [1.0, 0.0, 0.0]  # [5.7]
            demand(2.0**-1022 <= sum(c * c for c in axis) < math.inf, f"the axis of {joint['name']!r} has no direction")
            axis = [c / math.hypot(*axis) for c in axis]
        joints.append({"joint_name": joint["name"], "joint_idx": idx,
                       "parent_link_name": names[parent], "parent_link_idx": parent,
                       "child_link_name": names[child], "child_link_idx": child, "joint_type": joint["joint_type"],
                       "origin": write_pose(origin.get("xyz") or [0.0] * 3, rotation), "axis": axis})
        links[parent]["children_joint_idxs"].append(idx)
        links[parent]["children_link_idxs"] = sorted(links[parent]["children_link_idxs"] + [child])
        demand(links[child]["parent_joint_idx"] is None, f"the link {names[child]!r} is the child of two joints")
        links[child].update(parent_joint_idx=idx, parent_link_idx=parent)
    levels = [[link["link_idx"] for link in links if link["parent_joint_idx"] is None]]
    while below := sorted(child for idx in levels[-1] for child in links[idx]["children_link_idxs"]):
        levels.append(below)
    demand(len(levels[0]) == 1 and sorted(sum(levels, [])) == list(range(len(links))), "not a tree with one root")
    return {"links_in_chain": links, "joints_in_chain": joints,
            "kinematic_hierarchy": levels, "root_idx": levels[0][0]}


def connections_module(chain):
    roots = [None] * len(chain["links_in_chain"])  # root paths
    for link in (chain["links_in_chain"][idx] for level in chain["kinematic_hierarchy"] for idx in level):
        is_root = link["parent_link_idx"] is None
        above = {"links": [], "joints": []} if is_root else roots[link["parent_link_idx"]]
        roots[link["link_idx"]] = {"links": above["links"] + [link["link_idx"]],
                                   "joints": above["joints"] + ([] if is_root else [link["parent_joint_idx"]])}

    def shared(i, j):  # how many links the two root paths share
        return sum(a == b for a, b in zip(roots[i]["links"], roots[j]["links"]))

    def path(i, j):
        up, down, n = roots[i], roots[j], shared(i, j)
        return {"links": up["links"][n - 1:][::-1] + down["links"][n:],
                "joints": up["joints"][n - 1:][::-1] + down["joints"][n - 1:]}

    def descend(i, j):
        depth = len(roots[i]["links"])
        return [i] if i == j else roots[j]["links"][depth:] if shared(i, j) == depth else None

    def matrix(element):
        return [[element(i, j) for j in range(len(roots))] for i in range(len(roots))]

    # The path from i to j: what the two root paths have below the last link that they share, and that link.
    explicit = len(roots) <= MAX_EXPLICIT_LINKS and MAX_LINKS_IN_PATHS >= sum(
        len(a["links"]) + len(b["links"]) - 2 * shared(i, j) + 1 for i, a in enumerate(roots) for j, b in enumerate(roots))
    return {"root_paths": roots,
            "lowest_common_ancestors": matrix(lambda i, j: roots[i]["links"][shared(i, j) - 1]),
            "link_to_link_paths": matrix(path) if explicit else None,
            "link_connection_paths": matrix(descend) if explicit else None}


# ---- bounds_module [6.5]

def bounds_module(urdf, dof):
    rows = []
    for entry in dof["dofs"]:
        joint = urdf["joints"][entry["joint_idx"]]
        limit = joint["limit"] or {}
        lower, upper, effort, velocity = map(limit.get, ("lower", "upper", "effort", "velocity"))
        default = math.pi if entry["quantity"] == "Angle" else 1.0
        limited = joint["joint_type"] in ("Revolute", "Prismatic") and (lower is not None or upper is not None)
        single = len(DOFS_OF_TYPE[joint["joint_type"]]) == 1
        rows.append(([lower or 0.0, upper or 0.0] if limited else [-default, default], limited,
                     velocity if single else None, effort if single else None))
    bounds, limited, velocity, effort = map(list, zip(*rows)) if rows else ([], [], [], [])
    return {"bounds": bounds, "dof_lower_bounds": [b[0] for b in bounds], "dof_upper_bounds": [b[1] for b in bounds],
            "dof_limited": limited, "dof_velocity_limits": velocity, "dof_effort_limits": effort}


# ---- kinematics_samples_module [9]

def motion(kind, axis, q):
    nowhere, still = [0.0] * 3, (1.0, 0.0, 0.0, 0.0)
    if kind in ("Revolute", "Continuous"):
        return nowhere, turn(axis, q[0])
    if kind == "Prismatic":
        return [q[0] * c for c in axis], still
    if kind == "Planar":  # the in-plane basis is (ex, ey), turned by the shortest arc from z to the axis [5.9]
        x, y, z = axis
        w = 1 + z if z > 0 else (x * x + y * y) / (1 - z)  # 1 + z, without loss of digits near -z
        if math.hypot(x, y) < 1e-10:  # counts as +z or -z
            arc = (1.0, 0.0, 0.0, 0.0) if z > 0 else (0.0, 1.0, 0.0, 0.0)
        else:
            norm = math.hypot(w, x, y)
            arc = (w / norm, -y / norm, x / norm, 0.0)
        return rotate(arc, (q[0], q[1], 0.0)), turn(axis, q[2])
    if kind == "Floating":
        return q[:3], turn_by_vector(q[3:])
    return nowhere, turn_by_vector(q) if kind == "Spherical" else still


def forward_kinematics(chain, dof, q):
    poses = {chain["root_idx"]: ([0.0] * 3, (1.0, 0.0, 0.0, 0.0))}
    for link in (chain["links_in_chain"][idx] for level in chain["kinematic_hierarchy"][1:] for idx in level):
        joint = chain["joints_in_chain"][link["parent_joint_idx"]]
        values = [q[idx] for idx in dof["joint_idx_to_dof_idxs_mapping"][joint["joint_idx"]]]
        if mimic := dof["joint_idx_to_mimic_mapping"][joint["joint_idx"]]:
            driver = 0.0 if mimic["dof_idx"] is None else q[mimic["dof_idx"]]
            values = [mimic["multiplier"] * driver + mimic["offset"]]
        at_zero = compose(poses[link["parent_link_idx"]], list(joint["origin"].values()))
        poses[link["link_idx"]] = compose(at_zero, motion(joint["joint_type"], joint["axis"], values))
    return [write_pose(*poses[idx]) for idx in range(len(poses))]


def u(k, i):  # [9.3]
    mask = 2**64 - 1
    z = (k * 2**32 + i + 1) * 0x9E3779B97F4A7C15 & mask
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9 & mask
    z = (z ^ z >> 27) * 0x94D049BB133111EB & mask
    return ((z ^ z >> 31) >> 11) * 2.0**-53


def uniform_rotation_vector(u1, u2, u3):
    a, b = math.sqrt(u1), math.sqrt(1 - u1)
    w, *xyz = (a * math.cos(2 * math.pi * u3), b * math.sin(2 * math.pi * u2),
               b * math.cos(2 * math.pi * u2), a * math.sin(2 * math.pi * u3))
    sine = math.hypot(*xyz)
    factor = 2 * math.atan2(sine, abs(w)) / sine if sine > 0 else 0.0
    return [math.copysign(factor, w) * c for c in xyz]


def kinematics_samples_module(dof, chain, bounds):
    lower, upper, every = bounds["dof_lower_bounds"], bounds["dof_upper_bounds"], range(dof["num_dofs"])
    vectors = [i for i in every if dof["dofs"][i]["name"] == dof["dofs"][i]["joint_name"] + "/rot_x"]
    samples = []

    def add(kind, k, value, rotation_vector):
        q = [value(i) for i in every]
        for i in vectors:
            q[i:i + 3] = rotation_vector(i)
        poses = forward_kinematics(chain, dof, q)
        demand(all(map(math.isfinite, sum((pose["position"] + pose["quaternion_wxyz"] for pose in poses), []))),
               f"a pose in the configuration {kind} is not finite")
        samples.append({"kind": kind, "sample_idx": k, "configuration": q, "link_poses": poses})

    add("Zero", None, lambda i: 0.0, lambda i: [0.0, 0.0, 0.0])
    add("Middle", None, lambda i: (lower[i] + upper[i]) / 2, lambda i: [0.0, 0.0, 0.0])
    add("Lower", None, lambda i: lower[i], lambda i: [-math.pi, 0.0, 0.0])
    add("Upper", None, lambda i: upper[i], lambda i: [math.pi, 0.0, 0.0])
    for k in range(NUM_SAMPLED):
        add("Sampled", k, lambda i: lower[i] + u(k, i) * (upper[i] - lower[i]),
            lambda i: uniform_rotation_vector(u(k, i), u(k, i + 1), u(k, i + 2)))
    return {"samples": samples}


# ---- JSON and YAML [3]

def to_text(value, indent="\n"):
    """JSON that is YAML too: the same bytes serve as module.json and as module.yaml."""
    deeper = indent + " "
    if isinstance(value, dict) and value:
        return "{" + ",".join(f'{deeper}"{key}": {to_text(v, deeper)}' for key, v in value.items()) + indent + "}"
    if isinstance(value, list) and any(isinstance(element, (dict, list)) for element in value):
        return "[" + ",".join(deeper + to_text(element, deeper) for element in value) + indent + "]"
    if isinstance(value, list):  # innermost lists on one line
        return "[" + ", ".join(map(to_text, value)) + "]"
    if isinstance(value, float):
        text = json.dumps(value + 0.0, allow_nan=False)  # + 0.0: no negative zero [3.1.3]
        return text.replace("e", ".0e") if "." not in text else text  # YAML 1.1 takes 1e-07 for a string [3.2.3]
    text = json.dumps(value, ensure_ascii=False)
    # What YAML wants escaped and JSON does not: controls, and what some readers take for the end of a line.
    return re.sub("[\x7f-\xa0\u2028\u2029\ufeff\ufffe\uffff]", lambda c: f"\\u{ord(c[0]):04x}", text)


# ---- The directory [2]

def main(urdf_path, out_dir):
    with open(urdf_path, "rb") as file:
        source = file.read()
    urdf = urdf_module(parse_xml(source))
    dof, chain = dof_module(urdf), chain_module(urdf)
    bounds = bounds_module(urdf, dof)
    documents = {"urdf_module": urdf, "dof_module": dof, "chain_module": chain, "bounds_module": bounds,
                 "connections_module": connections_module(chain),
                 "kinematics_samples_module": kinematics_samples_module(dof, chain, bounds)}
    os.makedirs(out_dir)  # a folder of our own: nothing is left over in it from another run

    def write(path, data):
        full_path = os.path.join(out_dir, *path.split("/"))
        os.makedirs(os.path.dirname(full_path), exist_ok=True)
        with open(full_path, "wb") as file:
            file.write(data)
        return {"path": path, "size": len(data), "sha256": hashlib.sha256(data).hexdigest()}

    modules = []
    for name, depends_on in MODULES.items():
        text = to_text(documents[name]).encode() + b"\n"
        contents = [("VERSION", b"1.0.0\n"), ("module.json", text), ("module.yaml", text)]  # in byte order [2.7]
        modules.append({"name": name, "version": "1.0.0", "path": name, "depends_on": depends_on,
                        "files": [write(f"{name}/{file}", data) for file, data in contents]})
    file_name = re.sub(r"[\\:\x00-\x1f\x7f-\x9f]", "_", os.path.basename(urdf_path))  # [2.8]
    root_metadata = {
        "urdd_version": "1.0.0", "robot_name": urdf["name"], "conformance_class": "Core",
        "generator": {"name": "minimal_producer.py", "version": "1.0.0"},
        "source": {"Urdf": write(file_name, source)}, "modules": modules,
    }
    write("urdd.json", to_text(root_metadata).encode() + b"\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except (Refused, UnicodeDecodeError, expat.ExpatError) as why:
        sys.exit(f"{sys.argv[1]}: refused: {why}")

"""Rules about joints."""
from model import *


@rule("LNT010", "limits-look-like-degrees")
def limits_look_like_degrees(robot):
    """Revolute; the larger bound between 25 and 720 in size, and not +-50, +-100 or +-500, which mean `unlimited`."""
    for joint in robot.joints.values():
        lower, upper = joint.bound("lower"), joint.bound("upper")
        if joint.type != "revolute" or lower is None or upper is None:
            continue
        size = max(abs(lower), abs(upper))
        if 25 <= size <= 720 and not (lower == -upper and size in (50, 100, 500)):
            yield where("joint", joint.name), (
                f"limits {lower:g} to {upper:g} look like degrees; in radians {math.radians(lower):.4f} to {math.radians(upper):.4f}"), {
                "lower": lower, "upper": upper}


@rule("LNT011", "zero-outside-limits")
def zero_outside_limits(robot):
    """Revolute or prismatic, no mimic, lower <= upper, and 0 more than 1e-6 outside."""
    for joint in robot.joints.values():
        if joint.type not in ("revolute", "prismatic") or joint.mimic is not None or joint.limit is None:
            continue
        lower, upper = joint.bound("lower") or 0.0, joint.bound("upper") or 0.0
        if lower <= upper and (lower > 1e-6 or upper < -1e-6):
            yield where("joint", joint.name), f"position 0 is outside of the limits {lower:g} to {upper:g}", {"lower": lower, "upper": upper}


@rule("LNT012", "axis-not-unit")
def axis_not_unit(robot):
    """A joint with an axis; its length differs from 1 by more than 1e-3 (0.71 0.71 0 passes no more; rounding to 3 digits does)."""
    for joint in robot.joints.values():
        if joint.type in WITH_AXIS and joint.axis is not None:
            length = math.sqrt(sum(v * v for v in joint.axis))
            if length > 0 and abs(length - 1) > 1e-3:
                yield where("joint", joint.name), f"axis {joint.axis_element.get('xyz')} has length {length:.6g}, not 1", {
                    "length": length, "type": joint.type}


@rule("LNT013", "absurd-velocity-or-effort")
def absurd_velocity_or_effort(robot):
    """One degree of freedom, no mimic: velocity or effort negative; just one of the two 0 on a joint that can move."""
    for joint in robot.joints.values():
        if joint.type not in ONE_DOF or joint.limit is None or joint.mimic is not None:
            continue
        velocity, effort = joint.bound("velocity"), joint.bound("effort")
        lower, upper = joint.bound("lower") or 0.0, joint.bound("upper") or 0.0
        if joint.type != "continuous" and lower == upper:
            continue
        for name, value, other in (("velocity", velocity, effort), ("effort", effort, velocity)):
            if value is None:
                continue
            if value < 0:
                yield where("joint", joint.name), f"{name} limit {value:g} is negative", {"kind": f"{name}-negative"}
            elif value == 0 and other not in (None, 0.0):
                yield where("joint", joint.name), f"{name} limit is 0: programs that keep to it cannot move the joint", {"kind": f"{name}-zero"}


@rule("LNT014", "continuous-with-limits")
def continuous_with_limits(robot):
    """Continuous, lower < upper are both there."""
    for joint in robot.joints.values():
        lower, upper = joint.bound("lower"), joint.bound("upper")
        if joint.type == "continuous" and lower is not None and upper is not None and lower < upper:
            yield where("joint", joint.name), f"a continuous joint has limits {lower:g} to {upper:g}, which most programs ignore", {
                "lower": lower, "upper": upper}


@rule("LNT015", "name-refused")
def name_refused(robot):
    """Names that a program refuses or renames."""
    for kind, names in (("link", robot.links), ("joint", robot.joints)):
        for name in names:
            if name == "":
                yield where(kind, name), "the name is empty", {"kind": "empty"}
            elif name.startswith("/"):
                yield where(kind, name), "tf2 refuses names that start with a slash", {"kind": "slash"}
            elif "::" in name or re.match(r"__.*__\Z", name):
                yield where(kind, name), "SDFormat (Gazebo) reserves `::` and `__NAME__`", {"kind": "sdf"}
            elif kind == "joint" and name in robot.links:
                yield where(kind, name), "a link has the same name: SDFormat (Gazebo) refuses a joint and a link of one name", {"kind": "same"}
    for name in robot.links:
        if name == "world" and name in robot.above:
            yield where("link", name), "`world` is reserved in SDFormat and MuJoCo for the world itself; this link is not the root", {"kind": "world"}


@rule("LNT016", "axis-missing")
def axis_missing(robot):
    """Revolute, continuous, prismatic or planar without `axis`, or `axis` without `xyz`."""
    for joint in robot.joints.values():
        if joint.type in WITH_AXIS and get(joint.axis_element, "xyz") is None:
            yield where("joint", joint.name), f"{joint.type} joint without an axis: readers take 1 0 0", {"type": joint.type}


@rule("LNT017", "limit-incomplete")
def limit_incomplete(robot):
    """`limit` of a joint without `effort` or `velocity`: urdfdom refuses the file."""
    for joint in robot.joints.values():
        if joint.limit is None:
            continue
        missing = [k for k in ("effort", "velocity") if joint.limit.get(k) is None]
        if missing:
            yield where("joint", joint.name), f"`limit` has no {' and no '.join(missing)}: urdfdom (ROS) refuses the file", {"missing": missing}


@rule("LNT018", "angle-looks-like-degrees")
def angle_looks_like_degrees(robot):
    """`rpy` of an origin with an element of 7 or more in size that is a multiple of 5."""
    for element in robot.xml.iter("origin"):
        rpy = numbers(element.get("rpy"), 3)
        if rpy and any(abs(v) >= 7 and abs(v / 5 - round(v / 5)) < 1e-9 for v in rpy):
            parent = element.getparent()
            owner = parent if parent.get("name") and tag(parent) in ("joint", "link") else parent.getparent()
            yield where(tag(owner), owner.get("name", "")), f"`rpy=\"{element.get('rpy')}\"` of {tag(parent)} looks like degrees", {"rpy": rpy}

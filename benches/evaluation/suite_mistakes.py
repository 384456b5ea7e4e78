"""The small mistakes that `suite_kill_rate.py` puts into a copy of the validator, one at a time.

`expression(...)` replaces a text of a file, an expression, by another expression. `constant(...)` gives a constant
another value, wherever it is used. The text must be in the file exactly once. `group` says when it was written:
"before" the cases of `tests/rules/numbers` were there, or "after". `equivalent` says why no case can notice it.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Mistake:
    group: str
    family: str
    what: str
    file: str
    right: str
    wrong: str
    is_constant: bool = False
    equivalent: str = ""


VALIDATE = "crates/urdd-validate/src/"
TOLERANCE = VALIDATE + "tolerance.rs"
RULES = VALIDATE + "rules/"


def expression(group, family, what, file, right, wrong, equivalent=""):
    return Mistake(group, family, what, file, right, wrong, False, equivalent)


def constant(group, family, what, file, name, wrong, equivalent=""):
    return Mistake(group, family, what, file, name, wrong, True, equivalent)


# Written before anyone looked at which cases the list of numbers gives.
BEFORE = [
    constant("before", "KIN", "positions to 3e-9 of the reach", TOLERANCE, "POSITION_OF_REACH", "3e-9"),
    constant("before", "CHN", "rotations to 3e-9", TOLERANCE, "ROTATION", "3e-9"),
    constant("before", "BND", "numbers to 3e-9", TOLERANCE, "NUMBER_RELATIVE", "3e-9"),
    constant("before", "BND", "numbers to 3e-12 absolute", TOLERANCE, "NUMBER_ABSOLUTE", "3e-12"),
    expression("before", "KIN", "reach without prismatic travel", TOLERANCE,
               "lower.abs().max(upper.abs())", "0.0"),
    expression("before", "KIN", "planar axes count as z up to 1e-6", "crates/urdd-kinematics/src/rotation.rs",
               "radius < PLANAR_AXIS_EPSILON", "radius < 1e-6"),
    constant("before", "MSH", "resolution of meshes times 4", TOLERANCE, "MESH_VERTEX", "32.0 * 1.1920929e-7"),
    constant("before", "MSH", "plain meshes placed to 1e-5 m", TOLERANCE, "PLACING", "1e-5"),
    constant("before", "MSH", "pieces reach out by 8 %", TOLERANCE, "PIECE_OUT_OF_HULL", "0.08"),
    constant("before", "MSH", "flat faces of primitives 6 % inside", TOLERANCE, "PRIMITIVE_SAG", "0.06"),
    expression("before", "MSH", "primitives may face inward", VALIDATE + "solids/placed.rs",
               "primitive.faces_outward(vectors, tolerance)", "true"),
    expression("before", "MSH", "surface_tolerance ignored", RULES + "meshes/pieces_leave_surface.rs",
               "promised.map_or(most, |promised| promised.clamp(0.0, most))", "most"),
    constant("before", "MSH", "coverage to 15 %", TOLERANCE, "COVER_WITHOUT_PROMISE", "0.15"),
    constant("before", "SHP", "boxes and spheres to 3e-6", TOLERANCE, "HULL_IN_VOLUME", "3e-6"),
    constant("before", "SHP", "distances to 3e-5", TOLERANCE, "DISTANCE", "3e-5"),
    constant("before", "SHP", "contact up to 0.0011 m", VALIDATE + "views/shape_pair.rs", "CONTACT", "0.0011"),
    expression("before", "SHP", "the default configuration is all zeros",
               "crates/urdd-kinematics/src/configurations.rs",
               "0.0_f64.max(f64::min(a, b)).min(f64::max(a, b))", "0.0 * (a + b)"),
    expression("before", "URD", "no limit of prefixes", "crates/urdd-xml/src/count.rs",
               "prefixes.len() > MOST_PREFIXES", "false"),
    constant("before", "URD", "one attribute more than allowed", "crates/urdd-xml/src/limits.rs",
             "MOST_ATTRIBUTES", "257"),
    constant("before", "CHN", "unit vectors to 3e-9", TOLERANCE, "UNIT_NORM", "3e-9"),
    expression("before", "CON", "paths may be left out from 300 links on", RULES + "connections/explicit_paths_missing.rs",
               "links > EXPLICIT_UP_TO", "links >= EXPLICIT_UP_TO"),
    constant("before", "MSH", "names cut at 65 characters", RULES + "meshes/mesh_file_name.rs", "MAX_SLUG", "65"),
    expression("before", "BND", "effort compared with velocity", RULES + "bounds/speed_or_effort_differs.rs",
               "limit.and_then(|limit| limit.effort)", "limit.and_then(|limit| limit.velocity)"),
    expression("before", "KIN", "the pose of the last link ignored", RULES + "kinematics/sample_pose_wrong.rs",
               "zip(&sample.link_poses).enumerate()",
               "zip(&sample.link_poses).take(sample.link_poses.len() - 1).enumerate()"),
    expression("before", "DIR", "dependencies too many are fine", RULES + "directory/wrong_dependencies.rs",
               "set == right.iter().copied().collect()", "right.iter().all(|name| set.contains(name))"),
    expression("before", "LRN", "200 collisions are too few", RULES + "learned/counts_few.rs",
               "count.0 < EVALUATION_MIN", "count.0 <= EVALUATION_MIN"),
    expression("before", "LRN", "counts off by three times as much", RULES + "learned/counts_differ.rs",
               "among.div_ceil(PER_TOLERANCE)", "3 * among.div_ceil(PER_TOLERANCE)"),
    expression("before", "MSH", "which way triangles face is not compared", VALIDATE + "solids/surface.rs",
               "here[facing] > there[facing]", "false"),
    expression("before", "SRC", "mimics stay within limits to 3e-6", RULES + "source/mimic_leaves_limits.rs",
               "MIMIC_LIMIT * own.0.abs().max(own.1.abs())", "3.0 * MIMIC_LIMIT * own.0.abs().max(own.1.abs())"),
    expression("before", "URD", "roll and yaw exchanged in the reference", VALIDATE + "reference/mod.rs",
               "UnitQuaternion::from_euler_angles(roll, pitch, yaw)",
               "UnitQuaternion::from_euler_angles(yaw, pitch, roll)"),
]

MISTAKES = BEFORE

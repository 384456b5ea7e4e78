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
    expression("before", "MSH", "surface_tolerance ignored", RULES + "meshes/pieces.rs",
               "promised.map_or(most, |promised| promised.clamp(0.0, most))", "most"),
    constant("before", "MSH", "coverage to 15 %", TOLERANCE, "COVER_WITHOUT_PROMISE", "0.15"),
    constant("before", "SHP", "boxes and spheres to 3e-6", TOLERANCE, "HULL_IN_VOLUME", "3e-6"),
    constant("before", "SHP", "distances to 3e-5", TOLERANCE, "DISTANCE", "3e-5"),
    constant("before", "SHP", "contact up to 0.0011 m", VALIDATE + "views/tangled.rs", "CONTACT", "0.0011"),
    expression("before", "SHP", "the default configuration is all zeros",
               "crates/urdd-kinematics/src/configurations.rs",
               "0.0_f64.max(f64::min(a, b)).min(f64::max(a, b))", "0.0 * (a + b)"),
    expression("before", "URD", "no limit of prefixes", "crates/urdd-xml/src/check.rs",
               "prefixes.len() > MAX_PREFIXES", "false"),
    constant("before", "URD", "one attribute more than allowed", "crates/urdd-xml/src/error.rs",
             "MAX_ATTRIBUTES", "257"),
    constant("before", "CHN", "unit vectors to 3e-9", TOLERANCE, "UNIT_NORM", "3e-9"),
    expression("before", "CON", "paths may be left out from 300 links on", RULES + "connections.rs",
               "links > EXPLICIT_UP_TO", "links >= EXPLICIT_UP_TO"),
    constant("before", "MSH", "names cut at 65 characters", RULES + "meshes/lists.rs", "MAX_SLUG", "65"),
    expression("before", "BND", "effort compared with velocity", RULES + "bounds.rs",
               "limit.and_then(|limit| limit.effort)", "limit.and_then(|limit| limit.velocity)"),
    expression("before", "KIN", "the pose of the last link ignored", RULES + "kinematics/poses.rs",
               "shift > tolerance || turn > ROTATION",
               "link + 1 < poses.len() && (shift > tolerance || turn > ROTATION)"),
    expression("before", "DIR", "dependencies too many are fine", RULES + "directory/metadata.rs",
               "set == right.iter().copied().collect()", "right.iter().all(|name| set.contains(name))"),
    expression("before", "LRN", "200 collisions are too few", RULES + "learned/results.rs",
               "count.0 < EVALUATION_MIN", "count.0 <= EVALUATION_MIN"),
    expression("before", "LRN", "counts off by three times as much", RULES + "learned/results.rs",
               "among.div_ceil(PER_TOLERANCE)", "3 * among.div_ceil(PER_TOLERANCE)"),
    expression("before", "MSH", "which way triangles face is not compared", "crates/urdd-geometry/src/surface.rs",
               "here[facing] > there[facing]", "false"),
    expression("before", "SRC", "mimics stay within limits to 3e-6", RULES + "source/limits.rs",
               "MIMIC_LIMIT * own.0.abs().max(own.1.abs())", "3.0 * MIMIC_LIMIT * own.0.abs().max(own.1.abs())"),
    expression("before", "URD", "roll and yaw exchanged in the reference", VALIDATE + "reference/mod.rs",
               "UnitQuaternion::from_euler_angles(roll, pitch, yaw)",
               "UnitQuaternion::from_euler_angles(yaw, pitch, roll)"),
]

# Written after the cases were there.
AFTER = [
    expression("after", "BND", "the upper column compared with lower bounds", RULES + "bounds.rs",
               "pair[column]", "pair[0]"),
    expression("after", "BND", "a joint with a limit counts as limited", RULES + "bounds.rs",
               "limited = joint.position_limits().is_some()", "limited = joint.limit.is_some()"),
    expression("after", "CHN", "children in any order", RULES + "chain/links.rs",
               "*right == written", "{ let mut any = written.clone(); any.sort_unstable(); *right == any }"),
    expression("after", "CHN", "the last level ignored", RULES + "chain/links.rs",
               "*right != written", "depth + 1 < levels.len() && *right != written"),
    expression("after", "CHN", "rotations of origins not compared", RULES + "chain/joints.rs",
               "!within(distance, ROTATION)", "false"),
    expression("after", "CHN", "the sign of a quaternion is that of w alone", RULES + "chain/joints.rs",
               "is_negative(&quaternion)", "(quaternion[0] < 0.0)"),
    expression("after", "URD", "any axis but zero has a direction", RULES + "urdf/tree.rs",
               "axis.iter().map(|x| x * x).sum::<f64>().is_normal()", "axis != [0.0; 3]"),
    expression("after", "URD", "mimics may follow joints of many DOFs", RULES + "urdf/tree.rs",
               "driver.num_dofs() > 1", "false"),
    expression("after", "SRC", "lower may not equal upper", RULES + "source/limits.rs",
               "lower > upper", "lower >= upper"),
    expression("after", "SRC", "effort or velocity 0 is enough", RULES + "source/limits.rs",
               "limit.effort == Some(0.0) && limit.velocity == Some(0.0)",
               "limit.effort == Some(0.0) || limit.velocity == Some(0.0)"),
    expression("after", "MSH", "the preferred geometry is always used", RULES + "meshes/geometry.rs",
               "usable.has(link, preferred)", "true"),
    expression("after", "MSH", "visual or collision not compared in references",
               RULES + "meshes/originals.rs", "expected != actual",
               "(expected.0, expected.2, expected.3) != (actual.0, actual.2, actual.3)"),
    expression("after", "MSH", "a file may be listed twice", RULES + "meshes/originals.rs",
               "before >= after", "before > after"),
    expression("after", "MSH", "vertices of hulls to ten times the resolution", RULES + "meshes/geometry.rs",
               "mesh_resolution(extent(mesh))", "10.0 * mesh_resolution(extent(mesh))"),
    expression("after", "MSH", "every second point of the surface is compared", RULES + "meshes/pieces.rs",
               "step(points, faces)", "2"),
    expression("after", "SHP", "a radius of 0 is fine", RULES + "shapes/fit.rs",
               "*radius <= 0.0", "*radius < 0.0"),
    expression("after", "SHP", "reaches too short are fine", RULES + "shapes/fit.rs",
               "value < expected - shortfall", "false"),
    expression("after", "SHP", "lower sides of boxes need not touch", VALIDATE + "views/enclosure.rs",
               "half[axis] - reach > off.1", "end && half[axis] - reach > off.1"),
    expression("after", "SHP", "a mean may be above the largest", VALIDATE + "views/tangled.rs",
               "self.mean <= self.max + self.tolerance", "true"),
    expression("after", "SHP", "adjacent only where the child has the lower index", RULES + "shapes/reasons.rs",
               "joined.contains(&ordered(a, b))", "joined.contains(&(b, a))"),
    expression("after", "SHP", "Default is not judged where apart", RULES + "shapes/reasons.rs",
               "distance > CONTACT + tolerance", "false"),
    expression("after", "LRN", "biases ignored in overflow", RULES + "learned/numbers.rs",
               "bias.abs() + products.sum::<f64>()", "products.sum::<f64>()"),
    expression("after", "LRN", "training may not end just before the evaluation", RULES + "learned/results.rs",
               "range.end > u64::from(EVALUATION_FIRST)", "range.end >= u64::from(EVALUATION_FIRST)"),
    expression("after", "DIR", "files may be listed twice", RULES + "directory/metadata.rs",
               "files[*i].path <= files[i - 1].path", "files[*i].path < files[i - 1].path"),
    expression("after", "DIR", "letter case of ASCII alone", RULES + "directory/files.rs",
               "name.to_lowercase()", "name.to_ascii_lowercase()"),
    expression("after", "DIR", "only .urdf in small letters is a URDF", RULES + "directory/metadata.rs",
               "FileType::Urdf.is_of(Path::new(path))", 'path.ends_with(".urdf")'),
    expression("after", "KIN", "the smaller bound is the size of a configuration",
               RULES + "prelude.rs",
               "lower.abs().max(upper.abs())", "lower.abs().min(upper.abs())"),
    expression("after", "KIN", "w may not be below 0 by rounding", RULES + "kinematics/poses.rs",
               "w < -UNIT_NORM", "w < 0.0"),
    expression("after", "CMP", "a part may be attached to another link", RULES + "composition.rs",
               "parent != link", "false"),
    constant("after", "EXT", "schemas of one byte more", VALIDATE + "views/extension_schema.rs",
             "MAX_SCHEMA_BYTES", "(1 << 20) + 1"),
]

MISTAKES = BEFORE + AFTER

//! When two numbers agree (SPEC 5.6). Every tolerance has a name and a derivation here.

use nalgebra::{Isometry3, Matrix3};

use urdd_document::robot::Robot;
use urdd_document::tree::Tree;
use urdd_format::urdf::JointType;

/// Positions agree within this fraction of the robot's reach. Two ways to compute a pose through 2,000 joints in
/// binary64 differ by about 1e-13 of the reach. A digit lost in the seventh place, as by binary32, is detected.
pub const POSITION_OF_REACH: f64 = 1e-9;

/// Rotations agree within this Frobenius norm of R - R' over sqrt 2, which is the angle between them in rad if it is
/// small. Derived like the tolerance of positions.
pub const ROTATION: f64 = 1e-9;

/// Copied numbers agree within this fraction of the larger absolute value: a copy with ten digits or more.
pub const NUMBER_RELATIVE: f64 = 1e-9;

/// Copied numbers agree within this difference, so that zero may be written as 1e-17.
pub const NUMBER_ABSOLUTE: f64 = 1e-12;

/// Tolerance of the norm of unit quaternions and unit vectors.
pub const UNIT_NORM: f64 = 1e-9;

/// Reach of a robot without extent, m, so that tolerances stay above rounding.
pub const LEAST_REACH: f64 = 1e-3;

/// A mimic joint leaves its limits if it exceeds them by more than this fraction of the larger one. Limits are written
/// with about six digits, and those of a driver and its mimic are rounded separately.
pub const MIMIC_LIMIT: f64 = 1e-6;

/// An inertia tensor is positive definite if its smallest principal moment exceeds this fraction of the largest. Real
/// bodies are far above (a rod of 1 m, 0.1 mm thick: 1.5e-8). Below it, a tensor written with nine digits may be
/// singular.
pub const INERTIA_DEFINITE: f64 = 1e-9;

/// A principal moment may exceed the sum of the others by this fraction of itself: the moments of a flat plate satisfy
/// the triangle inequality with equality, and are written rounded.
pub const INERTIA_TRIANGLE: f64 = 1e-6;

/// Whether two numbers that should be copies agree. A number that is not finite agrees only with its equal.
pub fn numbers_agree(a: f64, b: f64) -> bool {
    let tolerance = number_tolerance(a, b);
    a == b || (tolerance.is_finite() && (a - b).abs() <= tolerance)
}

/// Maximum difference of two numbers that should be copies.
pub fn number_tolerance(a: f64, b: f64) -> f64 {
    (NUMBER_RELATIVE * a.abs().max(b.abs())).max(NUMBER_ABSOLUTE)
}

/// The distance of two rotations: the Frobenius norm of their difference over sqrt 2.
pub fn rotation_distance(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    (a - b).norm() / std::f64::consts::SQRT_2
}

/// The distance of two poses: of the positions, m, and [`rotation_distance`] of the rotations.
pub fn pose_distance(a: &Isometry3<f64>, b: &Isometry3<f64>) -> (f64, f64) {
    let matrix = |pose: &Isometry3<f64>| *pose.rotation.to_rotation_matrix().matrix();
    let shift = (a.translation.vector - b.translation.vector).norm();
    (shift, rotation_distance(&matrix(a), &matrix(b)))
}

/// The angle between two rotations, rad, for messages: a distance d of [`rotation_distance`] is
/// 2 sin(angle / 2).
pub fn angle_of_distance(distance: f64) -> f64 {
    2.0 * (distance / 2.0).min(1.0).asin()
}

/// The robot's reach, m: the largest sum of joint offsets along a root path, including the largest travel of its
/// prismatic joints, and at least [`LEAST_REACH`].
pub fn reach(robot: &Robot, tree: &Tree) -> f64 {
    let mut reach = vec![0.0_f64; robot.links.len()];
    for &link in &tree.order {
        let (Some(joint), Some(parent)) = (tree.parent_joint[link], tree.parent_link[link]) else {
            continue;
        };
        let joint = &robot.joints[joint];
        let travel = match (joint.joint_type, joint.position_limits()) {
            (JointType::Prismatic, Some((lower, upper))) => lower.abs().max(upper.abs()),
            (JointType::Prismatic | JointType::Planar | JointType::Floating, _) => 1.0,
            _ => 0.0,
        };
        let offset = joint.origin.xyz.iter().map(|x| x * x).sum::<f64>().sqrt();
        reach[link] = reach[parent] + offset + travel;
    }
    reach.into_iter().fold(LEAST_REACH, f64::max)
}

/// Vertices of meshes agree within this fraction of the largest coordinate used in placing them: eight steps of
/// binary32, the precision of the files. A producer may therefore rotate, scale and move in binary32, and write seven
/// digits.
pub const MESH_VERTEX: f64 = 8.0 * 1.1920929e-7;

/// Maximum distance of corresponding vertices, m; `extent` is the largest coordinate, m.
pub fn mesh_resolution(extent: f64) -> f64 {
    extent * MESH_VERTEX
}

/// A mesh is in place if its vertices are within this distance, m, even if they are known more precisely: no program
/// that moves a robot can tell the difference.
pub const PLACING: f64 = 1e-6;

/// The same for small meshes, as a fraction of the largest coordinate.
pub const PLACING_RELATIVE: f64 = 1e-4;

/// Maximum distance of the vertices of a plain mesh from their places, m.
pub fn placing_resolution(extent: f64) -> f64 {
    mesh_resolution(extent).max(PLACING.min(PLACING_RELATIVE * extent))
}

/// A piece may reach out of its link's hull by this fraction of the hull's diagonal. Common programs round or simplify
/// pieces or fit them to voxels, and reach out by up to 1.3 %.
pub const PIECE_OUT_OF_HULL: f64 = 0.02;

/// Below this fraction, nothing is reported.
pub const PIECE_BARELY_OUT_OF_HULL: f64 = 1e-4;

/// A piece may reach out of its hull by this many resolutions, whatever the hull's diagonal: what has no width in binary32
/// gets some, to be a body.
pub const SPLINTER: f64 = 8.0;

/// Tolerance of a normal in an STL file compared with that of the triangle's corners. Normals computed before the
/// corners are rounded, or in binary32, differ by about 1e-6, more on small triangles.
pub const STL_NORMAL: f64 = 1e-3;

/// The flat faces of a tessellated cylinder, capsule or sphere may be inside the true surface by this fraction of the
/// radius, as for a circle of 16 corners (1 - cos(pi / 16) = 1.9 %).
pub const PRIMITIVE_SAG: f64 = 0.02;

/// A tessellated shape, a box too, must have at least this fraction of the true area: an end cap of 16 corners has
/// 97.4 %, a sphere with faces 2 % inside has 96 %.
pub const PRIMITIVE_AREA: f64 = 0.95;

/// Convex pieces without a stated tolerance cover a link's surface within this fraction of the diagonal of its bounding
/// box.
pub const COVER_WITHOUT_PROMISE: f64 = 0.05;

/// A hull or piece may reach out of its box or sphere by this fraction: eight steps of binary32, the precision of mesh
/// vertices, so that boxes may be computed before or after that rounding.
pub const HULL_IN_VOLUME: f64 = 1e-6;

/// A box is needlessly large if its volume exceeds this multiple of the smallest one. Boxes along principal axes, or
/// found by a coarse search, are within a tenth on most parts of robots.
pub const NEEDLESSLY_LARGE_BOX: f64 = 1.1;

/// A sphere is needlessly large if its radius exceeds this multiple of the smallest one: the error of Ritter's
/// algorithm, the common approximation.
pub const NEEDLESSLY_LARGE_SPHERE: f64 = 1.05;

/// Distances between shapes agree within this fraction of the largest possible distance of their points. Common
/// libraries are no more precise: FCL stops at 1e-6 and is up to 3e-6 off on hulls of robots. Vertices are also
/// binary32.
pub const DISTANCE: f64 = 1e-5;

/// Tolerance of the distance of two shapes, m: `reach` is the robot's reach, `shapes` the sum of the shapes' reaches
/// from their links' origins.
pub fn distance_tolerance(reach: f64, shapes: f64) -> f64 {
    DISTANCE * (2.0 * reach + shapes)
}

/// The reach of a sphere in a legacy module may be too small by this fraction of the radius: it was measured at the
/// corners of a sphere of about fifty segments, which are up to 1 - cos(pi / 50) = 0.2 % of the radius inside.
pub const LEGACY_SPHERE_SHORTFALL: f64 = 5e-3;

/// Assumed number of samples of a legacy module, which does not state it. Only affects rounding.
pub const LEGACY_SAMPLES: u32 = 10_000;

/// How far a mean of `samples` distances may be outside their minimum and maximum; `largest` is the larger absolute
/// value of these. Each addition and the division rounds by at most half an epsilon of the running sum, so naive
/// summation stays within samples * epsilon / 2 of the largest. This is twice that.
pub fn mean_tolerance(samples: u32, largest: f64) -> f64 {
    f64::from(samples) * f64::EPSILON * largest
}

/// A loop is closed within this angle, rad, and this fraction of the reach; a coupling holds within this fraction of its
/// summands. As rotations and positions.
pub const CLOSED: f64 = 1e-9;

/// The sum of a coupling may always be this far from 0.
pub const LEAST_SUM: f64 = 1e-12;

/// A loop that closes only within more than this fraction of the reach, or this angle, rad, is loose.
pub const LOOSE: f64 = 1e-6;

/// A sphere of a link may stick out of its outer one by this fraction of the outer radius: as positions.
pub const SPHERE_IN_SPHERE: f64 = 1e-9;

/// A point of a piece may be outside of spheres that cover it by this fraction of the distance of the piece's farthest vertex
/// from the link's origin: eight steps of binary32, as for bounding spheres.
pub const SPHERES_COVER: f64 = 1e-6;

/// Lengths of the fit of spheres agree within this fraction of the diagonal of the box around the link's pieces.
pub const FIT_LENGTH: f64 = 1e-6;

/// Or within this fraction of the distance of the farthest vertex from the link's origin: a step of binary32. Distances are
/// computed in that frame.
pub const FIT_LENGTH_FAR: f64 = 1e-7;

/// Fractions of the surface outside of spheres agree within this: a point or two of very many may be on either side.
pub const FIT_FRACTION: f64 = 1e-4;

//! When two numbers agree (SPEC 5.6). Every tolerance has a name here, and its derivation.

use nalgebra::Matrix3;

use urdd_document::robot::Robot;
use urdd_document::tree::Tree;
use urdd_format::urdf::JointType;

/// Positions agree within this part of the robot's reach. Two ways to compute a pose through
/// 2,000 joints in binary64 differ by some 1e-13 of the reach; a digit that was lost in the
/// seventh place, as by binary32, shows.
pub const POSITION_OF_REACH: f64 = 1e-9;

/// Rotations agree within this Frobenius norm of R - R' over sqrt 2, which for small angles is the
/// angle between them in rad. As for positions.
pub const ROTATION: f64 = 1e-9;

/// Numbers that are copied agree within this part of the larger absolute value: a copy written
/// with ten digits or more.
pub const NUMBER_RELATIVE: f64 = 1e-9;

/// Numbers that are copied agree within this, so that a zero may be written as 1e-17.
pub const NUMBER_ABSOLUTE: f64 = 1e-12;

/// Unit quaternions and unit vectors have a norm within this of 1.
pub const UNIT_NORM: f64 = 1e-9;

/// Reach of a robot that has none, m, so that tolerances stay above rounding.
pub const LEAST_REACH: f64 = 1e-3;

/// A mimic joint leaves its limits when it does so by more than this part of the largest of them:
/// limits are written with six digits or so, and a driver's with other roundings than its mimic's.
pub const MIMIC_LIMIT: f64 = 1e-6;

/// An inertia tensor is positive definite when its smallest principal moment is more than this
/// part of the largest. Real bodies stay far above (a rod of 1 m, 0.1 mm thick: 1.5e-8); below it
/// a tensor that is written with nine digits can as well be singular.
pub const INERTIA_DEFINITE: f64 = 1e-9;

/// A principal moment may be larger than the sum of the others by this part of itself: the moments
/// of a flat plate fulfil the triangle inequality with equality, and are written rounded.
pub const INERTIA_TRIANGLE: f64 = 1e-6;

/// Whether two numbers that should be copies of each other agree.
pub fn numbers_agree(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= number_tolerance(a, b)
}

/// How far two numbers that should be copies of each other may be apart.
pub fn number_tolerance(a: f64, b: f64) -> f64 {
    (NUMBER_RELATIVE * a.abs().max(b.abs())).max(NUMBER_ABSOLUTE)
}

/// How far two rotations are apart: the Frobenius norm of the difference over sqrt 2.
pub fn rotation_distance(a: &Matrix3<f64>, b: &Matrix3<f64>) -> f64 {
    (a - b).norm() / std::f64::consts::SQRT_2
}

/// The angle between two rotations, rad, for messages: a distance d of [`rotation_distance`] is
/// 2 sin(angle / 2).
pub fn angle_of_distance(distance: f64) -> f64 {
    2.0 * (distance / 2.0).min(1.0).asin()
}

/// The robot's reach, m: the largest sum of joint offsets along a root path, with the largest
/// travel of the prismatic joints on it, and at least [`LEAST_REACH`].
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

/// Vertices of meshes agree within this part of the largest coordinate that took part in placing
/// them: eight steps of binary32, in which files hold them, so that a producer may turn, scale and
/// move in binary32 too, and write seven digits.
pub const MESH_VERTEX: f64 = 8.0 * 1.1920929e-7;

/// How far vertices of meshes may be apart, m, where `extent` is the largest coordinate, m.
pub fn mesh_resolution(extent: f64) -> f64 {
    extent * MESH_VERTEX
}

/// A mesh is in its place where its vertices are within this of it, m, though they be known better: what no
/// program that moves a robot can tell.
pub const PLACING: f64 = 1e-6;

/// The same for what is small, as a part of its largest coordinate.
pub const PLACING_RELATIVE: f64 = 1e-4;

/// How far vertices of a plain mesh may be from their places, m.
pub fn placing_resolution(extent: f64) -> f64 {
    mesh_resolution(extent).max(PLACING.min(PLACING_RELATIVE * extent))
}

/// A piece may reach out of its link's hull by this part of the hull's diagonal: programs in use that make pieces
/// round, simplify, or fit them to voxels, and leave it by up to 1.3 %.
pub const PIECE_OUT_OF_HULL: f64 = 0.02;

/// And below this part nothing is said of it.
pub const PIECE_BARELY_OUT_OF_HULL: f64 = 1e-4;

/// A normal in an STL file may be this far from that of the triangle's corners: those who compute it
/// before they round the corners, or in binary32, are off by some 1e-6, more on small triangles.
pub const STL_NORMAL: f64 = 1e-3;

/// The flat faces of a tessellated cylinder, capsule or sphere may lie inside the true surface by
/// this part of the radius: a circle of 16 corners does (1 - cos(pi / 16) = 1.9 %).
pub const PRIMITIVE_SAG: f64 = 0.02;

/// And have this part of the true area at least: an end cap of 16 corners has 97.4 %, a sphere with
/// faces 2 % inside 96 %.
pub const PRIMITIVE_AREA: f64 = 0.95;

/// Convex pieces that promise nothing cover a link's surface within this part of the diagonal of the
/// box around it.
pub const COVER_WITHOUT_PROMISE: f64 = 0.05;

/// A hull or piece may reach this part farther than its box or sphere: eight steps of binary32, in
/// which mesh vertices are written, so that boxes may be computed from either side of that rounding.
pub const HULL_IN_VOLUME: f64 = 1e-6;

/// A box is needlessly large when its volume is more than this many times that of the least one. Boxes
/// along principal axes, or found by a coarse search, come within a tenth on most parts of robots.
pub const NEEDLESSLY_LARGE_BOX: f64 = 1.1;

/// A sphere is needlessly large when its radius is more than this many times that of the least one: what
/// Ritter's approximation, the common one, is wrong by.
pub const NEEDLESSLY_LARGE_SPHERE: f64 = 1.05;

/// Distances of shapes agree within this part of the farthest that any two of their points can be apart.
/// Well-known libraries come no nearer: FCL stops at 1e-6 and ends up to 3e-6 off on hulls of robots.
/// Besides, vertices are binary32.
pub const DISTANCE: f64 = 1e-5;

/// How far distances of two shapes may be apart, m: `reach` is the robot's, and `shapes` what the two
/// reach from the origins of their links, together.
pub fn distance_tolerance(reach: f64, shapes: f64) -> f64 {
    DISTANCE * (2.0 * reach + shapes)
}

/// The reach of a sphere in a legacy module may fall short by this part of the radius: it was
/// measured at the corners of a sphere of some fifty segments, which lie up to 1 - cos(pi / 50) =
/// 0.2 % of the radius inside.
pub const LEGACY_SPHERE_SHORTFALL: f64 = 5e-3;

/// Number of samples that a legacy module is taken to have, where only rounding hangs on it: none says.
pub const LEGACY_SAMPLES: u32 = 10_000;

/// How far a mean of `samples` distances may lie outside their smallest and largest, `largest` being
/// the larger absolute value of these: each of the additions and the division rounds by at most half
/// an epsilon of the running sum, so naive summation stays within samples * epsilon / 2 of the largest;
/// twice that.
pub fn mean_tolerance(samples: u32, largest: f64) -> f64 {
    f64::from(samples) * f64::EPSILON * largest
}

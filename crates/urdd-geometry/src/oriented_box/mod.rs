//! Oriented boxes of least volume about convex hulls.

mod arc;
mod calipers;
mod queue;
mod search;
mod shadow;
mod vectors;

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use super::hull::ConvexHull;
use search::{TIE, smallest_boxes};
use shadow::Caster;

/// A box that may be turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    /// The centre, metres.
    pub centre: [f64; 3],
    /// Half of each side length, metres, along the box's own x, y and z.
    pub half_extents: [f64; 3],
    /// From the box's axes to those in which `centre` is given. The scalar part is not negative.
    pub rotation: UnitQuaternion<f64>,
}

impl OrientedBox {
    /// The box of least volume about a hull; of least area, if the hull is flat.
    ///
    /// Of the 24 ways to name a box's axes it is the one that turns least, by 63 degrees at most: so
    /// roll, pitch and yaw are never near the pole. Of boxes within 1e-6 of the least volume it is
    /// also the one that turns least; the axis-aligned one, if that is among them.
    ///
    /// The search stops when nothing promises more than 1e-6 of the volume, or when its budget is
    /// spent. Against a dense walk of all arcs, links of robots were 2e-6 off at worst. With half the
    /// budget, random needles 100 times as long as thick were up to 4e-4 off.
    ///
    /// Each vertex of the hull is inside: its coordinates in the box, computed in doubles as
    /// `R^T (p - centre)`, are not beyond the half extents. Another order of operations may differ
    /// in the last digit.
    pub fn around(hull: &ConvexHull) -> Self {
        let aligned = Self::with_rotation(hull, UnitQuaternion::identity());
        let candidates = if hull.is_flat() {
            let mut caster = Caster::new(hull);
            let normal = caster.largest_normal();
            caster.smallest_box(&normal).into_iter().collect()
        } else {
            smallest_boxes(hull, f64::INFINITY)
        };
        let least = candidates
            .iter()
            .map(|c| c.volume)
            .fold(f64::INFINITY, f64::min);
        if !hull.is_flat() && aligned.volume() <= least * (1.0 + TIE) {
            return aligned;
        }
        let turns_least = candidates
            .iter()
            .map(|candidate| nearest_to_identity(&candidate.axes))
            // The first of equals: the order of the candidates is that of the search.
            .reduce(|best, other| {
                if other.trace() > best.trace() {
                    other
                } else {
                    best
                }
            });
        let Some(matrix) = turns_least else {
            return aligned;
        };
        let rotation = Rotation3::from_matrix_unchecked(matrix);
        let found = Self::with_rotation(hull, canonical(&UnitQuaternion::from(rotation)));
        if hull.is_flat() && aligned.area() <= found.area() * (1.0 + TIE) {
            return aligned;
        }
        found
    }

    /// Whether a box that is not larger than `volume`, cubic metres, holds a hull that is not flat.
    ///
    /// The search is that of [`Self::around`], but nothing is looked at that promises no such box: much less work
    /// where `volume` is near the least.
    pub fn exists_within(hull: &ConvexHull, volume: f64) -> bool {
        !smallest_boxes(hull, volume).is_empty()
    }

    /// The smallest box of this orientation about a hull.
    fn with_rotation(hull: &ConvexHull, rotation: UnitQuaternion<f64>) -> Self {
        let to_box = rotation.to_rotation_matrix().into_inner().transpose();
        let vertices = || hull.mesh().vertices.iter().map(|p| Vector3::from(*p));
        let first = vertices().next().unwrap_or_default();
        // From a vertex on, to keep the digits of what is small and far away.
        let offsets = || vertices().map(|p| to_box * (p - first));
        let low = offsets().fold(Vector3::zeros(), |low: Vector3<f64>, p| low.inf(&p));
        let high = offsets().fold(Vector3::zeros(), |high: Vector3<f64>, p| high.sup(&p));
        let centre = first + to_box.transpose() * ((low + high) * 0.5);
        let reach = |half: Vector3<f64>, p: Vector3<f64>| half.sup(&(to_box * (p - centre)).abs());
        let half_extents = vertices().fold(Vector3::zeros(), reach);
        Self {
            centre: centre.map(|x| x + 0.0).into(),
            half_extents: half_extents.into(),
            rotation,
        }
    }

    /// Cubic metres.
    pub fn volume(&self) -> f64 {
        8.0 * self.half_extents.iter().product::<f64>()
    }

    /// Square metres.
    pub fn area(&self) -> f64 {
        let [x, y, z] = self.half_extents;
        8.0 * (x * y + y * z + z * x)
    }

    /// The eight corners, metres.
    pub fn corners(&self) -> [[f64; 3]; 8] {
        let half = Vector3::from(self.half_extents);
        std::array::from_fn(|i| {
            let sign = |bit: usize| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
            let offset = half.component_mul(&Vector3::new(sign(0), sign(1), sign(2)));
            (Vector3::from(self.centre) + self.rotation * offset).into()
        })
    }
}

/// Of the 24 right-handed ways to name and direct three axes, the rotation by the smallest angle,
/// which is that of the largest trace.
fn nearest_to_identity(axes: &[Vector3<f64>; 3]) -> Matrix3<f64> {
    let orders = [
        [0, 1, 2],
        [1, 2, 0],
        [2, 0, 1],
        [0, 2, 1],
        [2, 1, 0],
        [1, 0, 2],
    ];
    let mut best = Matrix3::from_columns(axes);
    for order in orders {
        let [x, y, z] = order.map(|k| axes[k]);
        for (sign_x, sign_y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let (x, y) = (x * sign_x, y * sign_y);
            let z = z * x.cross(&y).dot(&z).signum();
            let matrix = Matrix3::from_columns(&[x, y, z]);
            if matrix.trace() > best.trace() {
                best = matrix;
            }
        }
    }
    best
}

/// The quaternion of a rotation whose scalar part is not negative; without negative zeros.
fn canonical(rotation: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    let q = rotation.quaternion();
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    UnitQuaternion::new_normalize(Quaternion::from(q.coords.map(|x| sign * x + 0.0)))
}

//! Shared data of the cut search: the planes to try, and growing hulls.

use rayon::join;

use super::field::{Field, Known};
use super::growing_hull::GrowingHull;
use super::part::{Part, Plane};
use super::vector::Bounds;

/// Weight of a hull's bulk relative to its standoff. Deep narrow hollows have little standoff, but must still be cut.
const BULK: f64 = 0.1;

/// Thickness t of the bulk, in unit coordinates (1 is half the link's largest extent).
const THICKNESS: f64 = 1e-3;

/// Radius of the octahedron that hulls of the search start from, in unit coordinates.
pub(super) const SEED: f64 = 1e-4;

/// Minimum outward step that grows a hull of the search, as a fraction of the part's largest extent. For a cylinder,
/// the lost volume is below 2 %.
const STEP: f64 = 2.5e-3;

/// Three orthonormal axes, of which the last is normal to the planes, and the flat coordinates to try along it,
/// ascending.
pub(super) type Frame = ([[f64; 3]; 3], Vec<f64>);

/// Parameters of the planes to try; the same for all parts of a link.
pub(super) struct Places {
    pub frames: Vec<Frame>,
    /// Points without a triangle this near to a plane are also projected into it.
    pub reach: f64,
    /// Points this near to a plane count as in it.
    pub eps: f64,
    /// Distances to the surface.
    pub field: Field,
}

/// The identity frame.
pub(super) const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Places {
    /// The standoff of a hull in the coordinates of `frame`; faces in one of the planes do not count.
    pub fn standoff(&self, hull: &mut Grower, frame: &[[f64; 3]; 3], planes: &[Plane]) -> f64 {
        self.field.standoff(&hull.hull, frame, planes, &mut hull.known)
    }

    /// What `new` makes of the parts below and above a plane; `None` if one of them has no surface.
    pub fn split<T: Send>(
        &self,
        part: &Part,
        plane: &Plane,
        new: impl Fn(Part) -> T + Sync,
    ) -> Option<[T; 2]> {
        let [below, above] = part.split(plane, self.eps, self.reach);
        if below.triangles.is_empty() || above.triangles.is_empty() {
            return None;
        }
        let (below, above) = join(|| new(below), || new(above));
        Some([below, above])
    }

    /// Standoff and bulk.
    pub fn cost(&self, hull: &mut Grower, frame: &[[f64; 3]; 3], planes: &[Plane]) -> f64 {
        self.standoff(hull, frame, planes) + bulk(&hull.hull)
    }
}

/// The bulk of a hull: a fraction of V + t A / 2.
pub(super) fn bulk(hull: &GrowingHull) -> f64 {
    BULK * (hull.volume() + THICKNESS * hull.area() / 2.0)
}

/// A growing hull for the search.
#[derive(Clone)]
pub(super) struct Grower {
    pub hull: GrowingHull,
    pub step: f64,
    known: Known,
}

impl Grower {
    /// An empty hull; `extent` is the largest extent of the points to come.
    pub fn new(extent: f64) -> Self {
        Grower {
            hull: GrowingHull::default(),
            step: (STEP * extent).max(4.0 * SEED),
            known: Known::default(),
        }
    }

    /// The hull of all points.
    pub fn of(points: &[[f64; 3]]) -> Self {
        let mut hull = Grower::new(Bounds::of(points.iter().copied()).extent());
        hull.add(points);
        hull
    }

    pub fn add(&mut self, points: &[[f64; 3]]) {
        for &p in points {
            if self.hull.points.is_empty() {
                self.hull = GrowingHull::seed(p, SEED);
            } else {
                self.hull.insert(p, self.step);
            }
        }
    }
}

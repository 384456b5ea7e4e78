//! What the search for a cut works with: where planes are tried, and hulls that grow.

use super::field::Field;
use super::growing_hull::GrowingHull;
use super::part::Plane;

/// Weight of a hull's bulk beside its standoff. Deep narrow hollows have little standoff, and still are to be cut.
const BULK: f64 = 0.1;

/// Thickness t of the bulk, in units (half the link's largest extent).
const THICKNESS: f64 = 1e-3;

/// Radius of the octahedron that hulls of the search start from.
pub(super) const SEED: f64 = 1e-4;

/// The least step out that grows hulls of the search, as a part of the part's largest extent: what is
/// left out of a cylinder's volume is less than two hundredths.
const STEP: f64 = 2.5e-3;

/// Three orthogonal unit vectors, the last across the planes; coordinates along it to try, ascending.
pub(super) type Frame = ([[f64; 3]; 3], Vec<f64>);

/// Where and how planes are tried; the same for all parts of a link.
pub(super) struct Places {
    pub frames: Vec<Frame>,
    /// Points without a triangle this near to a plane are put into it too.
    pub reach: f64,
    /// Points this near to a plane count as lying in it.
    pub eps: f64,
    /// Distances to the surface.
    pub field: Field,
}

/// The frame of unit coordinates.
pub(super) const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Places {
    /// The standoff of a hull whose coordinates are along `frame`; faces in one of the planes have none.
    pub fn standoff(&self, hull: &mut Grower, frame: &[[f64; 3]; 3], planes: &[Plane]) -> f64 {
        self.field
            .standoff(&hull.hull, frame, planes, &mut hull.known)
    }

    /// Standoff and bulk.
    pub fn cost(&self, hull: &mut Grower, frame: &[[f64; 3]; 3], planes: &[Plane]) -> f64 {
        self.standoff(hull, frame, planes) + bulk(&hull.hull)
    }
}

/// What a hull costs wherever it stands: a part of V + t A / 2.
pub(super) fn bulk(hull: &GrowingHull) -> f64 {
    BULK * (hull.volume() + THICKNESS * hull.area() / 2.0)
}

/// A hull that points are put into, for the search.
#[derive(Clone)]
pub(super) struct Grower {
    pub hull: GrowingHull,
    pub step: f64,
    /// What is known of its faces.
    known: Vec<([u16; 3], f64)>,
}

impl Grower {
    /// Nothing yet; `extent` is the largest of what will come.
    pub fn new(extent: f64) -> Self {
        Grower {
            hull: GrowingHull::default(),
            step: (STEP * extent).max(4.0 * SEED),
            known: Vec::new(),
        }
    }

    pub fn add(&mut self, p: [f64; 3]) {
        if self.hull.points.is_empty() {
            self.hull = GrowingHull::seed(p, SEED);
        } else {
            self.hull.insert(p, self.step);
        }
    }
}

/// A box about points.
pub(super) struct Bounds {
    pub low: [f64; 3],
    pub high: [f64; 3],
}

impl Bounds {
    pub fn new(points: &[[f64; 3]]) -> Self {
        let mut out = Bounds {
            low: [f64::INFINITY; 3],
            high: [f64::NEG_INFINITY; 3],
        };
        for p in points {
            out.low = [0, 1, 2].map(|a| out.low[a].min(p[a]));
            out.high = [0, 1, 2].map(|a| out.high[a].max(p[a]));
        }
        out
    }

    pub fn extent(&self) -> f64 {
        (0..3)
            .map(|a| self.high[a] - self.low[a])
            .fold(0.0, f64::max)
    }
}

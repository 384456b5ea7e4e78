//! What the search for a cut works with: where planes are tried, and hulls that grow.

use super::growing_hull::GrowingHull;

/// Thickness t of the cost, in units (half the link's largest extent).
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
}

/// V + t A / 2 of a hull.
pub(super) fn cost(hull: &GrowingHull) -> f64 {
    hull.volume() + THICKNESS * hull.area() / 2.0
}

/// A hull that points are put into, for the search.
#[derive(Clone)]
pub(super) struct Grower {
    pub hull: GrowingHull,
    pub step: f64,
}

impl Grower {
    /// Nothing yet; `extent` is the largest of what will come.
    pub fn new(extent: f64) -> Self {
        Grower {
            hull: GrowingHull::default(),
            step: (STEP * extent).max(4.0 * SEED),
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

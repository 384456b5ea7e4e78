//! Convex hulls, exact.
//!
//! Quickhull (C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The Quickhull Algorithm for Convex Hulls,
//! ACM Transactions on Mathematical Software 22, 1996), with exact predicates in place of its
//! tolerances: nothing is merged or moved. Triangles in one plane are joined before the end, so what
//! comes out are the corners of the hull and nothing else.
//!
//! parry3d's `convex_hull` was tried first. It is as fast, and right on meshes as robots have them,
//! but what is thinner than about 1e-4 of its length it takes for flat, or for a line: points are
//! then left outside by up to that much, or a "hull" of two vertices comes back.

mod facets;
mod flat;
pub mod predicates;
mod quickhull;
mod slivers;

use super::mesh::Mesh;
use predicates::{Point, in_range};
use quickhull::Start;

/// The convex hull of a set of points.
///
/// - Each vertex equals one of the points (a negative zero comes out as zero), and is a corner of
///   the hull: none lies on the segment or face between others. Sorted by x, then y, then z.
/// - No point lies outside a face, by exact arithmetic, but for slivers: see
///   [`ConvexHull::THINNEST`], and [`ConvexHull::OUTSIDE`] for the bound.
/// - Closed and wound outwards: each edge is in two triangles, once in each direction.
/// - Points in one plane have a *flat* hull: their polygon, once from each side.
/// - It depends on the set of points only, not on their order or on how often each is given.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexHull {
    mesh: Mesh,
    flat: bool,
}

/// Why a set of points has no hull with a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HullError {
    /// There are no points.
    #[error("there are no points")]
    Empty,
    /// A coordinate is NaN, infinite, or outside what arithmetic on lengths can hold.
    #[error(
        "point {point} has a coordinate that is neither 0 nor between 1e-60 and 1e60 m in size"
    )]
    OutOfRange {
        /// Which of the points given.
        point: usize,
    },
    /// All points are the same.
    #[error("all points are one")]
    Point,
    /// All points are on one line.
    #[error("all points lie on one line")]
    Line,
    /// More points than a triangle's 32-bit indices can tell apart.
    #[error("more than 4,294,967,294 points")]
    TooMany,
}

impl ConvexHull {
    /// Triangles thinner than this, height over length, have no normal that doubles could tell: its
    /// error is about 2^-52 over this number. Their middle corner is left out, which moves the hull
    /// inwards by at most this part of the triangle's length, less than single precision resolves
    /// (2^-24 = 6e-8). Only hulls that would become flat that way keep such triangles.
    pub const THINNEST: f64 = 1e-8;

    /// How far outside the plane of a triangle, computed in doubles, a point may be, as a part of
    /// the hull's extent: [`Self::THINNEST`] for a corner left out (twice, should one go that
    /// another was held against), and 2^-52 / 1e-8 = 2e-8 for each of the two roundings of a normal.
    pub const OUTSIDE: f64 = 6e-8;

    /// The hull of the points.
    ///
    /// # Errors
    /// [`HullError`]: a coordinate out of range, or no three points off one line.
    pub fn new(points: &[Point]) -> Result<Self, HullError> {
        if u32::try_from(points.len()).is_ok_and(|n| n < u32::MAX) {
            // Adding 0 turns -0.0 into 0.0.
            let points: Vec<Point> = points.iter().map(|p| p.map(|x| x + 0.0)).collect();
            if let Some(point) = points.iter().position(|p| !p.iter().all(|x| in_range(*x))) {
                return Err(HullError::OutOfRange { point });
            }
            Self::of_checked(&points)
        } else {
            Err(HullError::TooMany)
        }
    }

    /// The exact hull, and then that of its corners without slivers, as long as this is solid.
    fn of_checked(points: &[Point]) -> Result<Self, HullError> {
        let mut hull = Self::exact(points)?;
        for _ in 0..slivers::ROUNDS {
            if hull.flat {
                break;
            }
            let Some(kept) = slivers::without_slivers(&hull.mesh, Self::THINNEST) else {
                break;
            };
            match Self::exact(&kept) {
                Ok(simpler) if !simpler.flat => hull = simpler,
                _ => break,
            }
        }
        Ok(hull)
    }

    fn exact(points: &[Point]) -> Result<Self, HullError> {
        let (triangles, flat) = match quickhull::start(points)? {
            Start::Plane(triangle) => (flat::triangulate(points, triangle), true),
            Start::Tetrahedron(corners) => {
                let grown = quickhull::grow(points, corners);
                (facets::triangulate(points, &grown), false)
            }
        };
        let mesh = facets::canonical(points, triangles);
        Ok(Self { mesh, flat })
    }

    /// The hull as a mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The hull as a mesh.
    pub fn into_mesh(self) -> Mesh {
        self.mesh
    }

    /// Whether all points are in one plane, exactly: a polygon seen from both sides.
    pub fn is_flat(&self) -> bool {
        self.flat
    }
}

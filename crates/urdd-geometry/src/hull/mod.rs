//! Exact convex hulls.
//!
//! Quickhull (C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The Quickhull Algorithm for Convex Hulls, ACM Transactions on
//! Mathematical Software 22, 1996) with exact predicates instead of tolerances: no points are merged or moved. A final
//! step joins coplanar triangles, so the result contains only the corners of the hull.
//!
//! parry3d's `convex_hull` is as fast, and correct on typical robot meshes. But it treats a shape thinner than about
//! 1e-4 of its length as flat or as a line: points then remain outside by up to that much, or the "hull" has two
//! vertices.

pub(crate) mod facets;
pub mod predicates;
pub(crate) mod quickhull;

pub use quickhull::HullError;

use nalgebra::Vector3;

use super::mesh::Mesh;
use predicates::{Point, in_range};
use quickhull::Start;

/// The convex hull of a set of points.
///
/// - Each vertex equals one of the points (-0 becomes 0) and is a corner of the hull: no vertex is on the segment or
///   face between others. Vertices are sorted by x, then y, then z.
/// - No point is outside a face, by exact arithmetic, except for slivers: see [`ConvexHull::THINNEST`], and
///   [`ConvexHull::OUTSIDE`] for the bound.
/// - Closed and wound outward: each edge is in two triangles, once in each direction.
/// - Coplanar points have a *flat* hull: their polygon, once for each side.
/// - The result depends only on the set of points, not on their order or on duplicates.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexHull {
    mesh: Mesh,
    flat: bool,
}

impl ConvexHull {
    /// Minimum height over length of a triangle. Doubles cannot determine the normal of a thinner one: its error is
    /// about 2^-52 over this number. The middle corner of such a triangle is removed. That moves the hull inward by at
    /// most this fraction of the triangle's length, less than single precision resolves (2^-24 = 6e-8). Such triangles
    /// remain only in hulls that would otherwise become flat.
    pub const THINNEST: f64 = 1e-8;

    /// How far a point may be outside the plane of a triangle, computed in doubles, as a fraction of the hull's extent.
    /// It sums [`Self::THINNEST`] for a removed corner (twice, if a corner is removed that another was measured
    /// against) and 2^-52 / 1e-8 = 2e-8 for each of the two roundings of a normal.
    pub const OUTSIDE: f64 = 6e-8;

    /// The hull of the points.
    ///
    /// # Errors
    /// [`HullError`] if there are no or too many points, a coordinate is out of range, or all points coincide or are
    /// collinear.
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

    /// The exact hull, then repeatedly the hull of its corners without slivers, while that is not flat.
    fn of_checked(points: &[Point]) -> Result<Self, HullError> {
        let mut hull = Self::exact(points)?;
        for _ in 0..ROUNDS {
            if hull.flat {
                break;
            }
            let Some(kept) = without_slivers(&hull.mesh, Self::THINNEST) else { break };
            match Self::exact(&kept) {
                Ok(simpler) if !simpler.flat => hull = simpler,
                _ => break,
            }
        }
        Ok(hull)
    }

    fn exact(points: &[Point]) -> Result<Self, HullError> {
        let (triangles, flat) = match quickhull::start(points)? {
            Start::Plane(triangle) => (facets::triangulate_flat(points, triangle), true),
            Start::Tetrahedron(corners) => {
                let grown = quickhull::grow(points, corners).into_triangles();
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

    /// Whether all points are exactly coplanar: the hull is then a two-sided polygon.
    pub fn is_flat(&self) -> bool {
        self.flat
    }
}

/// Maximum number of removal rounds. Each round removes about half of a row of such corners.
const ROUNDS: usize = 32;

/// The vertices, except those closer to the segment between two others than `thinnest` times its length, judged by the
/// mesh's triangles; `None` if all remain.
fn without_slivers(mesh: &Mesh, thinnest: f64) -> Option<Vec<Point>> {
    let mut dropped = vec![false; mesh.vertices.len()];
    let mut anchored = vec![false; mesh.vertices.len()];
    for triangle in &mesh.triangles {
        let corners = triangle.map(|i| Vector3::from(mesh.vertices[i as usize]));
        // Squared length of the edge opposite corner k.
        let opposite = |k: usize| (corners[(k + 2) % 3] - corners[(k + 1) % 3]).norm_squared();
        let apex = (0..3).max_by(|j, k| opposite(*j).total_cmp(&opposite(*k))).unwrap_or(0);
        let area = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).norm();
        if area >= thinnest * opposite(apex) {
            continue;
        }
        let [apex, from, to] = [0, 1, 2].map(|k| triangle[(apex + k) % 3] as usize);
        // The ends of the segment stay in this round: the apex is dropped because it is close to them.
        if !anchored[apex] && !dropped[from] && !dropped[to] {
            dropped[apex] = true;
            anchored[from] = true;
            anchored[to] = true;
        }
    }
    dropped.contains(&true).then(|| {
        let kept = mesh.vertices.iter().zip(&dropped).filter(|(_, dropped)| !**dropped);
        kept.map(|(vertex, _)| *vertex).collect()
    })
}

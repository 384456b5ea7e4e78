//! Exact convex hulls.
//!
//! Quickhull (C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The Quickhull Algorithm for Convex Hulls, ACM Transactions on
//! Mathematical Software 22, 1996) with exact predicates instead of tolerances: no points are merged or moved. A final
//! step joins coplanar triangles, so the result contains only the corners of the hull.
//!
//! parry3d's `convex_hull` is as fast, and correct on typical robot meshes. But it treats a shape thinner than about
//! 1e-4 of its length as flat or as a line: points then remain outside by up to that much, or the "hull" has two
//! vertices.

pub(crate) mod quickhull;

use nalgebra::Vector3;

use crate::mesh::{Mesh, from_lowest};
use crate::polygon::fan;
use quickhull::{Point, Start, Triangle, in_range, lexicographic, side_of_plane, turn};

pub use quickhull::HullError;

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
        if points.len() >= u32::MAX as usize {
            return Err(HullError::TooMany);
        }
        // Adding 0 turns -0.0 into 0.0.
        let points: Vec<Point> = points.iter().map(|p| p.map(|x| x + 0.0)).collect();
        if let Some(point) = points.iter().position(|p| !p.iter().all(|x| in_range(*x))) {
            return Err(HullError::OutOfRange { point });
        }
        Self::of_checked(&points)
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
            Start::Plane(triangle) => (triangulate_flat(points, triangle), true),
            Start::Tetrahedron(corners) => {
                let grown = quickhull::grow(points, corners).into_triangles();
                (triangulate(points, &grown), false)
            }
        };
        let mesh = canonical(points, triangles);
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

/// Joins coplanar triangles to facets, drops points that are not corners, and triangulates the facets again.
fn triangulate(points: &[Point], triangles: &[Triangle]) -> Vec<[u32; 3]> {
    let (facet, sizes) = facet_of_each(points, triangles);
    // For each point, the number of facets that meet there; 0 inside a facet.
    let mut meetings = vec![0_u32; points.len()];
    let mut result = Vec::with_capacity(triangles.len());
    // The edges of facets with several triangles: (facet, from, to).
    let mut outline: Vec<[u32; 3]> = Vec::new();
    for (triangle, &f) in triangles.iter().zip(&facet) {
        let is_whole = sizes[f as usize] == 1;
        if is_whole {
            result.push(triangle.corners);
        }
        for k in 0..3 {
            if is_whole || facet[triangle.neighbours[k] as usize] != f {
                let from = triangle.corners[k];
                meetings[from as usize] += 1;
                if !is_whole {
                    outline.push([f, from, triangle.corners[(k + 1) % 3]]);
                }
            }
        }
    }
    outline.sort_unstable();
    for edges in outline.chunk_by(|e, g| e[0] == g[0]) {
        let mut polygon = walk(edges);
        polygon.retain(|p| meetings[*p as usize] >= 3);
        // Start at the lexicographically first corner, so that the result does not depend on the triangle order.
        let at = |k: usize| &points[polygon[k] as usize];
        let first = (0..polygon.len()).min_by(|j, k| lexicographic(at(*j), at(*k)));
        polygon.rotate_left(first.unwrap_or(0));
        cut(&polygon, &mut result);
    }
    result
}

/// The facet of each triangle, and the number of triangles of each facet.
fn facet_of_each(points: &[Point], triangles: &[Triangle]) -> (Vec<u32>, Vec<u32>) {
    let mut facet = vec![u32::MAX; triangles.len()];
    let mut sizes = Vec::new();
    let mut open = Vec::new();
    for seed in 0..triangles.len() {
        if facet[seed] != u32::MAX {
            continue;
        }
        let this = sizes.len() as u32;
        let mut size = 0;
        facet[seed] = this;
        open.push(seed);
        while let Some(t) = open.pop() {
            size += 1;
            let Triangle { corners, neighbours } = &triangles[t];
            let [a, b, c] = corners.map(|i| points[i as usize]);
            for n in neighbours.map(|n| n as usize) {
                if facet[n] != u32::MAX {
                    continue;
                }
                let mut others = triangles[n].corners.into_iter();
                let opposite = others.find(|p| !corners.contains(p));
                let level =
                    opposite.is_some_and(|p| side_of_plane(a, b, c, points[p as usize]).is_eq());
                if level {
                    facet[n] = this;
                    open.push(n);
                }
            }
        }
        sizes.push(size);
    }
    (facet, sizes)
}

/// The corners along a closed loop of edges (facet, from, to), sorted by `from`.
fn walk(edges: &[[u32; 3]]) -> Vec<u32> {
    let mut polygon = Vec::with_capacity(edges.len());
    let mut edge = edges.first();
    while let Some([_, from, to]) = edge {
        polygon.push(*from);
        if polygon.len() == edges.len() {
            break;
        }
        edge = edges.binary_search_by_key(to, |e| e[1]).ok().map(|e| &edges[e]);
    }
    polygon
}

/// Triangulates a convex polygon by repeated bisection. Of the simple methods, it gives the fewest thin triangles on
/// round faces.
fn cut(polygon: &[u32], triangles: &mut Vec<[u32; 3]>) {
    let [first, .., last] = *polygon else { return };
    if polygon.len() < 3 {
        return;
    }
    let middle = polygon.len() / 2;
    triangles.push([first, polygon[middle], last]);
    cut(&polygon[..=middle], triangles);
    cut(&polygon[middle..], triangles);
}

/// The mesh in canonical order: vertices sorted by value, each triangle rotated to start at its lowest index, triangles
/// sorted.
fn canonical(points: &[Point], triangles: Vec<[u32; 3]>) -> Mesh {
    // The rank of each point among the vertices; 0 until it is known.
    let mut rank = vec![u32::MAX; points.len()];
    for p in triangles.as_flattened() {
        rank[*p as usize] = 0;
    }
    let mut order: Vec<u32> = (0..points.len() as u32).filter(|p| rank[*p as usize] == 0).collect();
    order.sort_unstable_by(|p, q| lexicographic(&points[*p as usize], &points[*q as usize]));
    for (new, p) in order.iter().enumerate() {
        rank[*p as usize] = new as u32;
    }
    let mut triangles: Vec<[u32; 3]> = triangles
        .into_iter()
        .map(|triangle| from_lowest(triangle.map(|p| rank[p as usize])))
        .collect();
    triangles.sort_unstable();
    let vertices = order.iter().map(|p| points[*p as usize]).collect();
    Mesh { vertices, triangles }
}

/// The polygon's triangles, front and back. `triangle` is three points that are not collinear.
pub(crate) fn triangulate_flat(points: &[Point], triangle: [u32; 3]) -> Vec<[u32; 3]> {
    let mut corners = outline(points, triangle);
    let mut triangles: Vec<[u32; 3]> = fan(&corners).collect();
    // The two fans start from different corners and share no diagonal, so no edge is in four triangles.
    let step = corners.len().min(1);
    corners.rotate_left(step);
    triangles.extend(fan(&corners).map(|[a, b, c]| [a, c, b]));
    triangles
}

/// The polygon's corners in order: the monotone chain on the projection along the axis closest to the plane's normal.
/// The projection preserves lines and betweenness.
fn outline(points: &[Point], triangle: [u32; 3]) -> Vec<u32> {
    let [a, b, c] = triangle.map(|i| points[i as usize]);
    let shadows = [[1, 2], [2, 0], [0, 1]];
    let size =
        |[i, j]: [usize; 2]| ((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i])).abs();
    // Rounding can make the largest area 0, so only projections with an exact non-zero orientation qualify.
    let best = shadows
        .into_iter()
        .filter(|[i, j]| turn([a[*i], a[*j]], [b[*i], b[*j]], [c[*i], c[*j]]).is_ne())
        .max_by(|s, t| size(*s).total_cmp(&size(*t)));
    let Some([i, j]) = best else { return Vec::new() };
    let shadow = |p: u32| [points[p as usize][i], points[p as usize][j]];
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by(|p, q| {
        let ([px, py], [qx, qy]) = (shadow(*p), shadow(*q));
        px.total_cmp(&qx)
            .then(py.total_cmp(&qy))
            .then_with(|| lexicographic(&points[*p as usize], &points[*q as usize]))
    });
    order.dedup_by(|p, q| shadow(*p) == shadow(*q));
    monotone_chain(&order, |u, v, p| turn(shadow(u), shadow(v), shadow(p)).is_gt())
}

/// The corners of the convex hull of sorted points, counterclockwise: Andrew's monotone chain.
pub(crate) fn monotone_chain<P: Copy>(
    sorted: &[P],
    turns_left: impl Fn(P, P, P) -> bool,
) -> Vec<P> {
    let mut polygon = Vec::with_capacity(sorted.len() + 1);
    for backwards in [false, true] {
        let fixed = polygon.len();
        for k in 0..sorted.len() {
            let p = sorted[if backwards { sorted.len() - 1 - k } else { k }];
            while let [.., u, v] = polygon[fixed..]
                && !turns_left(u, v, p)
            {
                polygon.pop();
            }
            polygon.push(p);
        }
        polygon.pop();
    }
    polygon
}

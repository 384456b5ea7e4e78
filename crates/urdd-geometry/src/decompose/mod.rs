//! Convex decomposition of arbitrary triangle meshes.
//!
//! A link's mesh is arbitrary CAD output: several shells, open, self-intersecting, with internal parts. So the
//! algorithm does not need an inside. A *piece* is the convex hull of a part of the surface, and the parts make up the
//! whole surface. By construction no point of the surface is outside the pieces, except by
//! [`Settings::surface_tolerance`], which allows pieces with fewer vertices.
//!
//! 1. `surface`: welds equal vertices and drops invalid triangles.
//! 2. A proxy of it with some 1,500 points, used only by the search.
//! 3. `field`: points inside the body, if it has an inside, so that parts count with what they enclose, and distances
//!    from the surface.
//! 4. `search`: planes cut the proxy, always where a cut lowers the summed standoff of the hulls most (`cut`), into 1.5
//!    times as many blocks as wanted. If the first cuts save little, two alternatives are tried. If everything deep in
//!    the hull is flat, as in boxes without lids, a second tree is first cut along those faces. The tree whose merged
//!    blocks cost less is kept.
//! 5. `merge`: merges blocks, the cheapest pair first, while there are too many or a merge costs nearly nothing.
//!    Cutting far and merging back finds what one greedy pass does not.
//! 6. `assign`: clips the surface itself by the same planes and assigns it to the groups.
//! 7. `choose`: selects few points of each group whose hull contains the rest; `ConvexHull` makes the piece. Drops flat
//!    pieces that another piece contains, and joins splinters to the piece beside them.
//!
//! The quality measure is the *standoff*: the mean distance of the decomposition's outside from the surface. It is the
//! integral of that distance over the pieces' faces, without faces inside other pieces or in cuts, where another piece
//! continues. This is the error of a collision check. Volume alone would overrate deep narrow hollows, which hardly
//! matter, relative to wide ones. A little volume stays in the cost, because it shows gains that only later cuts will
//! bring. Top-down cuts with hulls as parts follow Wei et al., "Approximate convex decomposition for 3D meshes with
//! collision-aware concavity and tree search" (CoACD, 2022). The measure and the sweep are our own.
//!
//! The same input gives the same bytes for any number of threads: parallel tasks are independent, and their results are
//! combined in a fixed order.

mod assign;
mod choose;
mod cut;
mod field;
mod growing_hull;
mod part;
mod search;
mod slices;
mod surface;

use rayon::prelude::*;

use super::Mesh;
use super::hull::ConvexHull;

/// Settings of the decomposition.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Maximum number of pieces for one mesh; at least 1.
    pub max_pieces: usize,
    /// Minimum standoff that a piece must save: the mean distance from the pieces' outside to the surface, as a
    /// fraction of half the mesh's largest extent. 0 uses all pieces.
    pub fat_tolerance: f64,
    /// Sufficient mean distance from the pieces' outside to the surface, metres, as estimated by the search. No further
    /// pieces are made once it is reached. 0 disables this limit.
    pub standoff_tolerance: f64,
    /// Maximum distance of a surface point outside the pieces, metres, unless [`Settings::relative_surface_tolerance`]
    /// is stricter.
    pub surface_tolerance: f64,
    /// The same as a fraction of half the mesh's largest extent, for small meshes.
    pub relative_surface_tolerance: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            max_pieces: 7,
            fat_tolerance: 1e-4,
            standoff_tolerance: 0.0,
            surface_tolerance: 2e-4,
            relative_surface_tolerance: 4e-3,
        }
    }
}

impl Settings {
    fn tolerance(&self, surface: &surface::Surface) -> f64 {
        self.surface_tolerance.min(self.relative_surface_tolerance * surface.scale).max(0.0)
    }

    /// The `surface_tolerance` that [`decompose`] would return for the mesh, without decomposing it.
    pub fn surface_tolerance_of(&self, mesh: &Mesh) -> f64 {
        surface::Surface::new(mesh).map_or(0.0, |surface| self.tolerance(&surface))
    }
}

/// The result of [`decompose`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Decomposition {
    /// Convex, closed meshes in a fixed order. A flat part gives a flat two-sided polygon. Empty only if no triangle of
    /// the mesh has an area.
    pub pieces: Vec<Mesh>,
    /// Maximum distance of a surface point outside the pieces, metres: the requested tolerance or less.
    pub surface_tolerance: f64,
    /// Number of dropped triangles, with an index out of range or a non-finite coordinate.
    pub ignored_triangles: usize,
}

/// Maximum number of flat coordinates per axis.
const MAX_FLATS: usize = 20;

/// Points this near to a plane are in it, in unit coordinates. Flat faces of CAD models deviate by some f32 rounding
/// errors.
const ON_PLANE: f64 = 2e-5;

/// The same for the proxy, as a fraction of its cell size.
const ON_PLANE_PROXY: f64 = 0.15;

/// A flat piece counts as contained in another if it protrudes by at most this fraction of the surface tolerance.
const HELD: f64 = 0.01;

/// Pieces cut along faces first replace the others if they cost less than this fraction of them.
const BETTER: f64 = 0.9;

/// Decomposes a mesh into convex pieces that contain its whole surface.
///
/// Each piece is inside the convex hull of the mesh, up to the rounding of clipped points to f32.
pub fn decompose(mesh: &Mesh, settings: &Settings) -> Decomposition {
    let Some(surface) = surface::Surface::new(mesh) else {
        return Decomposition {
            ignored_triangles: mesh.triangles.len(),
            ..Decomposition::default()
        };
    };
    let most = settings.max_pieces.max(1);
    let (mut part, cell) = surface::proxy(&surface);
    let flood = field::Flood::new(&part);
    let (inner, reach) =
        flood.as_ref().map_or((Vec::new(), 0.0), |flood| (flood.centres(), flood.cell / 2.0));
    let body = part.points.clone();
    part.inner = inner.clone();
    let places = slices::Places {
        frames: cut::frames(surface::flat_coordinates(&surface, MAX_FLATS)),
        reach,
        eps: (ON_PLANE_PROXY * cell).max(ON_PLANE),
        field: field::Field::new(&part),
    };
    let enough = settings.standoff_tolerance / surface.scale;
    let limits =
        search::Limits { most: most.saturating_add(most / 2), fat: settings.fat_tolerance, enough };
    let joined = |found: search::Search| {
        let limits = search::MergeLimits {
            most,
            free: settings.fat_tolerance * found.area,
            enough: enough * found.area,
        };
        (search::merge(found.leaves, &places, &limits), found.nodes)
    };
    let first = search::search(part.clone(), &places, &limits);
    let area = first.area;
    let (mut groups, mut nodes) = joined(first);
    if groups.standoff > settings.fat_tolerance.max(enough) * area
        && let Some(found) = search::along_faces(part, area, &places, &limits)
    {
        let other = joined(found);
        if other.0.cost < BETTER * groups.cost {
            (groups, nodes) = other;
        }
    }
    let count = groups.of.iter().max().map_or(1, |g| g + 1);
    let tolerance = settings.tolerance(&surface);
    let parts = assign::assign(
        &surface,
        &assign::Inside::new(&inner, reach, &body),
        &nodes,
        &groups.of,
        count,
        ON_PLANE,
    );
    let pieces: Vec<ConvexHull> = parts
        .par_iter()
        .filter(|hand| !hand.points.is_empty())
        // A group of collinear points has no hull: its triangles have no area.
        .filter_map(|hand| {
            let hull = ConvexHull::new(&choose::choose(&hand.points, tolerance)).ok()?;
            // Points inside alone that enclose nothing are not a piece of the body.
            let is_body = || !hull.is_flat() && !choose::is_thin(hull.mesh());
            (hand.has_surface || is_body()).then_some(hull)
        })
        .collect();
    Decomposition {
        pieces: choose::without_held(pieces, HELD * tolerance, tolerance),
        surface_tolerance: tolerance,
        ignored_triangles: surface.ignored,
    }
}

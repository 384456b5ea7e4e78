//! Convex decomposition of arbitrary triangle meshes.
//!
//! A link's mesh is whatever a CAD program wrote: several shells, open, crossing itself, with parts
//! inside. So nothing here needs an inside: a *piece* is the convex hull of a part of the surface, and
//! the parts make up the whole surface. Hence no point of it lies outside the pieces, by construction
//! (but for [`Settings::surface_tolerance`], which buys pieces with fewer vertices).
//!
//! 1. `clean`: equal vertices become one, what is no triangle is left out.
//! 2. `proxy`: a stand-in with some 1,500 points, for the search only.
//! 3. `inside`: points inside the body, where it has an inside, so that parts count with what they enclose;
//!    `field`: distances from the surface.
//! 4. `search`: the stand-in is cut by planes, always there where a cut lowers the summed standoff of the
//!    hulls most (`cut`), into half as many blocks again as wanted. Where the first cuts save little, two are followed.
//!    Where all that lies deep in the hull is flat, as in boxes without lids, a second tree is cut along those faces
//!    first (`faces`): the one of which the joined blocks cost less is kept.
//! 5. `merge`: blocks are joined again, the cheapest pair first, while there are too many or a join
//!    costs nearly nothing. Cutting far and joining back finds what one greedy pass does not.
//! 6. `assign`: the surface itself is clipped by the same planes and handed out to the groups.
//! 7. `choose`: few points of each group whose hull holds the rest; `ConvexHull` makes the piece. Flat ones that another
//!    piece holds are left out (`held`).
//!
//! What a decomposition is judged by is how far its outside stands off the surface on average: the integral over
//! the pieces' faces of the distance to the surface, but for faces inside and in cuts, where another piece goes on.
//! That is what a collision check gets wrong. Volume alone counts deep narrow hollows, which hardly matter, for more
//! than wide ones; a little of it is kept, since it tells of gains that only the cuts after the next will bring.
//! Top-down cuts with hulls for parts are those of Wei et al., "Approximate convex decomposition for 3D meshes with
//! collision-aware concavity and tree search" (CoACD, 2022); the measure and the sweep are our own.
//!
//! The same input gives the same bytes for any number of threads: parallel parts are independent, and
//! their results are put together in a fixed order.

mod assign;
mod choose;
mod clean;
mod cut;
mod faces;
mod field;
mod grower;
mod growing_hull;
mod held;
mod inside;
mod merge;
mod part;
mod planes;
mod proxy;
mod search;
mod slices;
mod support;
mod vector;

use rayon::prelude::*;

use super::Mesh;
use super::hull::ConvexHull;

/// How finely to decompose.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Most pieces for one mesh; at least 1.
    pub max_pieces: usize,
    /// How much standoff a piece must save to be worth having: the mean distance from the pieces' outside to the
    /// surface, as a part of half the mesh's largest extent. 0 uses all pieces.
    pub fat_tolerance: f64,
    /// So small a mean distance from the pieces' outside to the surface is enough, metres: no piece is made beyond
    /// those needed for that, as the search estimates it. 0 goes on.
    pub standoff_tolerance: f64,
    /// How far a point of the surface may lie outside the pieces, metres, if
    /// [`Settings::relative_surface_tolerance`] is not stricter.
    pub surface_tolerance: f64,
    /// The same as a part of half the mesh's largest extent, for small meshes.
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
    fn tolerance(&self, surface: &clean::Surface) -> f64 {
        self.surface_tolerance
            .min(self.relative_surface_tolerance * surface.scale)
            .max(0.0)
    }

    /// What [`decompose`] would give as the mesh's `surface_tolerance`, without the work.
    pub fn surface_tolerance_of(&self, mesh: &Mesh) -> f64 {
        clean::Surface::new(mesh).map_or(0.0, |surface| self.tolerance(&surface))
    }
}

/// What [`decompose`] returns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Decomposition {
    /// Convex, closed meshes in a fixed order. A flat part gives a flat two-sided polygon. None only
    /// where the mesh has no triangle with an area.
    pub pieces: Vec<Mesh>,
    /// How far a point of the surface may lie outside the pieces, metres: what was asked for, or less.
    pub surface_tolerance: f64,
    /// Triangles left out: an index out of range, or a coordinate that is not a finite number.
    pub ignored_triangles: usize,
}

/// Most flat coordinates kept along an axis.
const MOST_FLATS: usize = 20;

/// Points this near to a plane lie in it, in units: flat faces of CAD are no flatter than some roundings of f32.
const ON_PLANE: f64 = 2e-5;

/// The same for the stand-in, as a part of its cells.
const ON_PLANE_PROXY: f64 = 0.15;

/// A flat piece that reaches so little out of another, as a part of the surface's tolerance, is held by it.
const HELD: f64 = 0.01;

/// Pieces cut along faces first are to cost less than this part of the others, to be taken for them.
const BETTER: f64 = 0.9;

/// Divides a mesh into convex pieces that hold its whole surface.
///
/// Each piece lies in the hull of the mesh, but for the rounding of clipped points to f32.
pub fn decompose(mesh: &Mesh, settings: &Settings) -> Decomposition {
    let Some(surface) = clean::Surface::new(mesh) else {
        return Decomposition {
            ignored_triangles: mesh.triangles.len(),
            ..Decomposition::default()
        };
    };
    let most = settings.max_pieces.max(1);
    let (mut part, cell) = proxy::proxy(&surface);
    let flood = inside::Flood::new(&part);
    let (inner, reach) = flood.as_ref().map_or((Vec::new(), 0.0), |flood| {
        (flood.centres(), flood.cell / 2.0)
    });
    let body = part.points.clone();
    part.inner = inner.clone();
    let places = grower::Places {
        frames: cut::frames(proxy::flat_coordinates(&surface, MOST_FLATS)),
        reach,
        eps: (ON_PLANE_PROXY * cell).max(ON_PLANE),
        field: field::Field::new(&part),
    };
    let enough = settings.standoff_tolerance / surface.scale;
    let limits = search::Limits {
        most: most.saturating_add(most / 2),
        fat: settings.fat_tolerance,
        enough,
    };
    let joined = |found: search::Search| {
        let limits = merge::Limits {
            most,
            free: settings.fat_tolerance * found.area,
            enough: enough * found.area,
        };
        (merge::merge(found.leaves, &places, &limits), found.nodes)
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
        .filter(|points| !points.is_empty())
        // A group of nothing but collinear points has no hull: its triangles have no area.
        .filter_map(|points| ConvexHull::new(&choose::choose(points, tolerance)).ok())
        .collect();
    Decomposition {
        pieces: held::without_held(pieces, HELD * tolerance),
        surface_tolerance: tolerance,
        ignored_triangles: surface.ignored,
    }
}

//! The pieces of links, and the pairs of pieces that are not skipped: SPEC 8.8.5.

use std::cmp::Ordering;

use super::meshes::written::WrittenMesh;
use urdd_format::link_shapes_skips::LinkShapesSkipsModule;
use urdd_geometry::Mesh;
use urdd_geometry::convex::ShapeError;

/// The pieces of all links.
pub(super) struct CheckedPieces<'a> {
    pub pieces: &'a [Vec<WrittenMesh>],
    pub skips: &'a LinkShapesSkipsModule,
    /// The place of each link in the matrix over full shapes.
    full: Vec<Option<usize>>,
    /// The link of each piece.
    links: Vec<usize>,
}

impl<'a> CheckedPieces<'a> {
    pub fn new(pieces: &'a [Vec<WrittenMesh>], skips: &'a LinkShapesSkipsModule) -> Self {
        let mut full = vec![None; pieces.len()];
        for (place, link) in skips.full_shapes.iter().enumerate() {
            if let Some(full) = full.get_mut(link.get()) {
                *full = Some(place);
            }
        }
        let links = pieces.iter().enumerate();
        let links = links.flat_map(|(link, pieces)| pieces.iter().map(move |_| link)).collect();
        CheckedPieces { pieces, skips, full, links }
    }

    /// Whether contacts of two pieces, by their numbers among those of all links, count.
    pub fn is_checked(&self, a: usize, b: usize) -> bool {
        match &self.skips.decomposition_convex_hulls_skips {
            Some(rows) => !rows[a][b],
            None => match [a, b].map(|piece| self.full[self.links[piece]]) {
                [Some(a), Some(b)] => !self.skips.full_convex_hulls_skips[a][b],
                _ => false,
            },
        }
    }

    /// Each piece, with its link, in an order that its file does not decide: pieces of an earlier run are read from their
    /// files, with vertices in another order, and the last digits of what is computed depend on that.
    pub fn in_order(&self) -> Vec<(usize, Mesh)> {
        let pieces = self.pieces.iter().flatten().zip(&self.links);
        pieces.map(|(piece, link)| (*link, in_order(&piece.mesh))).collect()
    }

    /// What is said of a piece that cannot be measured.
    pub fn fault(&self, (piece, error): (usize, ShapeError)) -> String {
        let of = self.skips.decomposition_shapes.get(piece);
        let of = of.map_or_else(String::new, |of| {
            format!(" piece {} of link {}", of.piece_idx, of.link_idx)
        });
        format!("distances cannot be computed for{of}: {error}")
    }
}

/// The mesh with its vertices ascending, each once, and its triangles ascending, each from its least vertex on.
fn in_order(mesh: &Mesh) -> Mesh {
    let order = |a: &[f64; 3], b: &[f64; 3]| {
        a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).fold(Ordering::Equal, Ordering::then)
    };
    let mut vertices = mesh.vertices.clone();
    vertices.sort_by(order);
    vertices.dedup();
    let place = |vertex: u32| {
        let point = &mesh.vertices[vertex as usize];
        let found = vertices.binary_search_by(|other| order(other, point));
        u32::try_from(found.unwrap_or_default()).unwrap_or(u32::MAX)
    };
    let from_least = |[a, b, c]: [u32; 3]| {
        [[a, b, c], [b, c, a], [c, a, b]].into_iter().min().unwrap_or([a, b, c])
    };
    let triangles = mesh.triangles.iter().map(|of| from_least(of.map(place)));
    let mut triangles: Vec<[u32; 3]> = triangles.collect();
    triangles.sort_unstable();
    Mesh { vertices, triangles }
}

//! The pairs of links that a model is of: SPEC 8.8.5.

use crate::document::shape_matrices::{at, skips};
use crate::document::shapes::Shapes;
use crate::format::registry::ModuleKind;
use crate::geometry::convex::BodyPairs;
use crate::validate::context::Context;
use crate::validate::skip::SkipReason;

/// Whether two shapes are skipped: two pieces, or where there is no matrix over these, the hulls of their links.
struct Skipped<'a> {
    pieces: Option<&'a [Vec<bool>]>,
    full: &'a [Vec<bool>],
    shapes: Shapes,
}

impl<'a> Skipped<'a> {
    fn new(context: &'a Context) -> Option<Self> {
        let [full, _, _, pieces, _, _] = skips(context.document(ModuleKind::LinkShapesSkips)?)?;
        Some(Self {
            pieces: pieces.map(AsRef::as_ref),
            full: full?,
            shapes: context.shapes()?,
        })
    }

    /// Of two pieces, by their places among all pieces.
    fn is(&self, a: usize, b: usize) -> bool {
        if let Some(rows) = self.pieces {
            return at(rows, a, b).unwrap_or(true);
        }
        let of = |piece: usize| {
            let link = self.shapes.pieces.get(piece)?.0;
            self.shapes.full.iter().position(|full| *full == link)
        };
        let full = of(a).zip(of(b));
        full.and_then(|(a, b)| at(self.full, a, b)).unwrap_or(true)
    }
}

/// The pairs of links that are not skipped, each with the lower link first.
pub fn not_skipped(context: &Context) -> Option<Vec<[usize; 2]>> {
    let skipped = Skipped::new(context)?;
    let pieces = &skipped.shapes.pieces;
    let mut pairs = Vec::new();
    for (i, (a, _)) in pieces.iter().enumerate() {
        for (j, (b, _)) in pieces.iter().enumerate().skip(i + 1) {
            if a != b && !skipped.is(i, j) {
                pairs.push([*a.min(b), *a.max(b)]);
            }
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    Some(pairs)
}

/// The pieces, with the pairs that are not skipped.
///
/// # Errors
/// Why there are none.
pub fn pieces(context: &Context) -> Result<BodyPairs, SkipReason> {
    let open = || SkipReason::Kinematics("there are no pieces to take distances of".to_owned());
    let skipped = Skipped::new(context).ok_or_else(open)?;
    let kind = ModuleKind::ConvexDecompositionMeshes;
    let meshes = skipped.shapes.pieces.iter().map(|(link, piece)| {
        let mesh = context.solids().mesh(kind, *link, *piece)?;
        Some((*link, mesh.vertices.as_slice()))
    });
    let meshes: Vec<(usize, &[[f64; 3]])> = meshes.collect::<Option<_>>().ok_or_else(open)?;
    let mut pairs = BodyPairs::new(meshes)
        .map_err(|(piece, error)| SkipReason::Kinematics(format!("piece {piece}: {error}")))?;
    for links in not_skipped(context).ok_or_else(open)? {
        pairs.add(links, |a, b| !skipped.is(a, b));
    }
    Ok(pairs)
}

//! The pairs of links of a model: SPEC 8.8.5.

use std::ops::Range;

use crate::solids::Solids;
use urdd_document::shape_matrices::{at, skips};
use urdd_document::shapes::Shapes;
use urdd_document::urdd::Urdd;
use urdd_findings::skip::SkipReason;
use urdd_format::registry::ModuleKind;
use urdd_geometry::convex::BodyPairs;

/// Maximum number of pairs of pieces: each takes 16 bytes.
const MOST: usize = 20_000_000;

/// A link with pieces.
struct Link {
    link: usize,
    /// The indices of its pieces.
    pieces: Range<usize>,
    /// Its rows of the matrix; none without a hull.
    rows: Range<usize>,
}

/// What is skipped: by the matrix over pieces or, without one, by that over the hulls of links.
struct Skipped<'a> {
    matrix: &'a [Vec<bool>],
    is_of_pieces: bool,
    /// In their order.
    links: Vec<Link>,
}

impl<'a> Skipped<'a> {
    fn new(urdd: &'a Urdd, shapes: &Shapes) -> Option<Self> {
        let [full, _, _, of_pieces, _, _] = skips(urdd.document(ModuleKind::LinkShapesSkips)?)?;
        let full = full?;
        let mut links: Vec<Link> = Vec::new();
        for own in shapes.pieces.chunk_by(|a, b| a.0 == b.0) {
            let (link, first) = (own[0].0, links.last().map_or(0, |last| last.pieces.end));
            let pieces = first..first + own.len();
            let hull = shapes.full.iter().position(|full| *full == link);
            let row = hull.map_or(0..0, |row| row..row + 1);
            let rows = if of_pieces.is_some() { pieces.clone() } else { row };
            links.push(Link { link, pieces, rows });
        }
        let is_of_pieces = of_pieces.is_some();
        Some(Self { matrix: of_pieces.unwrap_or(full), is_of_pieces, links })
    }

    fn is_checked(&self, i: usize, j: usize) -> bool {
        at(self.matrix, i, j) == Some(false)
    }

    /// The pairs of links that are not skipped, the lower link first.
    fn not_skipped(&self) -> impl Iterator<Item = [&Link; 2]> {
        let each = self.links.iter().enumerate();
        let pairs = each.flat_map(|(place, a)| {
            let after = &self.links[place + 1..];
            after.iter().map(move |b| [a, b])
        });
        pairs.filter(|[a, b]| a.rows.clone().any(|i| b.rows.clone().any(|j| self.is_checked(i, j))))
    }
}

/// The pairs of links that are not skipped, the lower link first.
pub fn not_skipped(urdd: &Urdd) -> Option<Vec<[usize; 2]>> {
    let skipped = Skipped::new(urdd, &Shapes::new(urdd)?)?;
    Some(skipped.not_skipped().map(|both| both.map(|one| one.link)).collect())
}

/// The pieces, with the pairs that are not skipped.
///
/// # Errors
/// Why there are none.
pub fn pieces(urdd: &Urdd, solids: &Solids) -> Result<BodyPairs, SkipReason> {
    let open = || SkipReason::obstacle("there are no pieces to take distances of");
    let shapes = Shapes::new(urdd).ok_or_else(open)?;
    let skipped = Skipped::new(urdd, &shapes).ok_or_else(open)?;
    let pairs = skipped.not_skipped();
    let count = pairs.map(|[a, b]| a.pieces.len().saturating_mul(b.pieces.len()));
    let count = count.fold(0, usize::saturating_add);
    if count > MOST {
        let why = format!(
            "the pairs of links that are not skipped have {count} pairs of pieces, and distances are taken of {MOST} at most"
        );
        return Err(SkipReason::obstacle(why));
    }
    let kind = ModuleKind::ConvexDecompositionMeshes;
    let meshes = shapes.pieces.iter().map(|(link, piece)| {
        let mesh = solids.mesh(kind, *link, *piece)?;
        Some((*link, mesh.vertices.as_slice()))
    });
    let meshes: Vec<(usize, &[[f64; 3]])> = meshes.collect::<Option<_>>().ok_or_else(open)?;
    let mut pairs = BodyPairs::new(meshes)
        .map_err(|(piece, error)| SkipReason::obstacle(format!("piece {piece}: {error}")))?;
    for both in skipped.not_skipped() {
        let is_checked = |a, b| !skipped.is_of_pieces || skipped.is_checked(a, b);
        pairs.add(both.map(|one| one.link), is_checked);
    }
    Ok(pairs)
}

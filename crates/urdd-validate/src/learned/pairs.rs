//! The pairs of links of a model: SPEC 8.8.5.

use std::collections::HashMap;
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

/// Whether two shapes are skipped: two pieces or, without a matrix over pieces, the hulls of their links.
struct Skipped<'a> {
    pieces: Option<&'a [Vec<bool>]>,
    full: &'a [Vec<bool>],
    /// Index of the hull of each link that has one.
    hulls: HashMap<usize, usize>,
    /// The links with pieces, in order, and the indices of their pieces.
    links: Vec<(usize, Range<usize>)>,
}

impl<'a> Skipped<'a> {
    fn new(urdd: &'a Urdd, shapes: &Shapes) -> Option<Self> {
        let [full, _, _, pieces, _, _] = skips(urdd.document(ModuleKind::LinkShapesSkips)?)?;
        let hulls = shapes.full.iter().enumerate();
        let mut links: Vec<(usize, Range<usize>)> = Vec::new();
        for (place, (link, _)) in shapes.pieces.iter().enumerate() {
            match links.last_mut().filter(|(last, _)| last == link) {
                Some((_, places)) => places.end = place + 1,
                None => links.push((*link, place..place + 1)),
            }
        }
        Some(Self {
            pieces: pieces.map(AsRef::as_ref),
            full: full?,
            hulls: hulls.map(|(place, link)| (*link, place)).collect(),
            links,
        })
    }

    /// For two pieces, by their indices among all pieces; `None` if only hulls of links are listed.
    fn of_pieces(&self, a: usize, b: usize) -> Option<bool> {
        Some(at(self.pieces?, a, b).unwrap_or(true))
    }

    /// For the hulls of two links.
    fn of_hulls(&self, a: usize, b: usize) -> bool {
        let places = self.hulls.get(&a).zip(self.hulls.get(&b));
        let skipped = places.and_then(|(a, b)| at(self.full, *a, *b));
        skipped.unwrap_or(true)
    }

    /// The pairs of links that are not skipped, by their indices in `links`, the lower link first.
    fn not_skipped(&self) -> impl Iterator<Item = [&(usize, Range<usize>); 2]> {
        let each = self.links.iter().enumerate();
        let pairs = each.flat_map(|(place, a)| {
            let after = &self.links[place + 1..];
            after.iter().map(move |b| [a, b])
        });
        pairs.filter(|[a, b]| match self.pieces {
            Some(_) => a.1.clone().any(|i| {
                let mut others = b.1.clone();
                others.any(|j| self.of_pieces(i, j) == Some(false))
            }),
            None => !self.of_hulls(a.0, b.0),
        })
    }
}

/// The pairs of links that are not skipped, the lower link first.
pub fn not_skipped(urdd: &Urdd) -> Option<Vec<[usize; 2]>> {
    let skipped = Skipped::new(urdd, &Shapes::new(urdd)?)?;
    let pairs = skipped.not_skipped().map(|[a, b]| [a.0, b.0]);
    Some(pairs.collect())
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
    let count = pairs.map(|[a, b]| a.1.len().saturating_mul(b.1.len()));
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
    for [a, b] in skipped.not_skipped() {
        pairs.add([a.0, b.0], |a, b| !skipped.of_pieces(a, b).unwrap_or(false));
    }
    Ok(pairs)
}

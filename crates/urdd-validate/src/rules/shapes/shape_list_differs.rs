use crate::rules::prelude::*;
use urdd_document::shape_matrices::{V1_MATRIX_MODULES, shape_lists};
use urdd_format::index::{LinkIdx, PieceIdx};
use urdd_format::shapes::PieceShape;

declare_rule! {
    /// `full_shapes` or `decomposition_shapes` does not say what the matrices' indices stand for.
    ///
    /// The full shapes are the links that have a hull, ascending; the decomposition shapes are the
    /// convex pieces, links ascending, pieces in order. By these lists a program finds the pair that an
    /// element is about.
    ///
    /// Write the lists from `convex_hull_meshes_module` and `convex_decomposition_meshes_module`; where
    /// those have changed, write the matrices again too.
    SHP010 "shape-list-differs", Error, clause "8.1", since "0.1.0",
    phase References, needs [
        Version1, Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes), SHAPE_MATRICES,
        PIECES_LISTED, NotFailed(SHP002), NO_PIECE_TWICE,
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let shapes = context.shapes()?;
    let index = |index: usize| u32::try_from(index).unwrap_or(u32::MAX);
    let full: Vec<LinkIdx> = shapes.full.iter().map(|l| LinkIdx(index(*l))).collect();
    let pieces = shapes.pieces.iter().map(|(link, piece)| PieceShape {
        link_idx: LinkIdx(index(*link)),
        piece_idx: PieceIdx(index(*piece)),
    });
    let pieces: Vec<PieceShape> = pieces.collect();
    for (_, module, document) in context.documents(V1_MATRIX_MODULES) {
        let Some((stated_full, stated_pieces)) = shape_lists(document) else {
            continue;
        };
        let link = |link: &LinkIdx| format!("link {link}");
        let piece = |of: &PieceShape| format!("piece {} of link {}", of.piece_idx, of.link_idx);
        let full = first_fault(module, "/full_shapes", &full, stated_full, link);
        let at = "/decomposition_shapes";
        let pieces = first_fault(module, at, &pieces, stated_pieces, piece);
        for fault in full.into_iter().chain(pieces) {
            findings.report(fault);
        }
    }
    Some(())
}

/// The first difference: those after it usually follow from it.
fn first_fault<T: PartialEq>(
    module: &Module,
    pointer: &str,
    right: &[T],
    stated: &[T],
    text: impl Fn(&T) -> String,
) -> Option<Finding> {
    let longest = right.len().max(stated.len());
    let at = (0..longest).find(|at| right.get(*at) != stated.get(*at))?;
    let shown = |element: Option<&T>| element.map_or("the end of the list".to_owned(), &text);
    let place = stated.get(at).map_or(String::new(), |_| format!("/{at}"));
    let message = format!(
        "from shape {at} on this is not the list of shapes: {} are stated, and the mesh modules have {}",
        stated.len(),
        right.len()
    );
    let finding = finding_in(module, format!("{pointer}{place}"), message);
    let finding = finding.expected(shown(right.get(at)));
    Some(finding.actual(shown(stated.get(at))))
}

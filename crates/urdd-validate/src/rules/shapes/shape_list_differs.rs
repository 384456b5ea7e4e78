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
        let mut compare = |pointer: &str, fault: Option<Fault>| {
            if let Some(fault) = fault {
                Finding::of(module, pointer.to_owned() + &fault.place, fault.message)
                    .expected(fault.expected)
                    .actual(fault.actual)
                    .report(findings);
            }
        };
        let link = |link: &LinkIdx| format!("link {link}");
        compare("/full_shapes", first_fault(&full, stated_full, link));
        let piece = |of: &PieceShape| format!("piece {} of link {}", of.piece_idx, of.link_idx);
        compare(
            "/decomposition_shapes",
            first_fault(&pieces, stated_pieces, piece),
        );
    }
    Some(())
}

struct Fault {
    place: String,
    message: String,
    expected: String,
    actual: String,
}

/// The first difference: those after it usually follow from it.
fn first_fault<T: PartialEq>(
    right: &[T],
    stated: &[T],
    text: impl Fn(&T) -> String,
) -> Option<Fault> {
    let longest = right.len().max(stated.len());
    let at = (0..longest).find(|at| right.get(*at) != stated.get(*at))?;
    let shown = |element: Option<&T>| element.map_or("the end of the list".to_owned(), &text);
    Some(Fault {
        place: stated.get(at).map_or(String::new(), |_| format!("/{at}")),
        message: format!(
            "from shape {at} on this is not the list of shapes: {} are stated, and the mesh modules have {}",
            stated.len(),
            right.len()
        ),
        expected: shown(right.get(at)),
        actual: shown(stated.get(at)),
    })
}

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
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
        Version1,
        Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes),
        AnyModule(&[
            Kind::LinkShapesDistanceStatistics,
            Kind::LinkShapesSimpleSkips,
            Kind::LinkShapesSkips,
        ]),
        PIECES_LISTED,
        NotFailed(SHP002),
        NO_PIECE_TWICE,
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some(shapes) = context.shapes() else {
        return;
    };
    let index = |index: usize| u32::try_from(index).unwrap_or(u32::MAX);
    let full: Vec<LinkIdx> = shapes.full.iter().map(|l| LinkIdx(index(*l))).collect();
    let pieces: Vec<PieceShape> = shapes
        .pieces
        .iter()
        .map(|(link, piece)| PieceShape {
            link_idx: LinkIdx(index(*link)),
            piece_idx: PieceIdx(index(*piece)),
        })
        .collect();
    let piece_text =
        |piece: &PieceShape| format!("piece {} of link {}", piece.piece_idx, piece.link_idx);
    for kind in V1_MATRIX_MODULES {
        let (Some(document), Some(module)) = (context.document(*kind), context.module(*kind))
        else {
            continue;
        };
        let Some((stated_full, stated_pieces)) = shape_lists(document) else {
            continue;
        };
        let file = module.file("module.json");
        let link_text = |link: &LinkIdx| format!("link {link}");
        compare(
            &file,
            "/full_shapes",
            &full,
            stated_full,
            link_text,
            findings,
        );
        compare(
            &file,
            "/decomposition_shapes",
            &pieces,
            stated_pieces,
            piece_text,
            findings,
        );
    }
}

/// Reports the first difference: those after it most often follow from it.
fn compare<T: PartialEq>(
    file: &str,
    pointer: &str,
    expected: &[T],
    stated: &[T],
    text: impl Fn(&T) -> String,
    findings: &mut Findings,
) {
    let longest = expected.len().max(stated.len());
    let Some(at) = (0..longest).find(|at| expected.get(*at) != stated.get(*at)) else {
        return;
    };
    let place = match at < stated.len() {
        true => format!("{pointer}/{at}"),
        false => pointer.to_owned(),
    };
    let shown = |element: Option<&T>| element.map_or("the end of the list".to_owned(), &text);
    findings.report(
        Finding::at(
            file,
            place,
            format!(
                "from shape {at} on this is not the list of shapes: {} are stated, and the mesh modules have {}",
                stated.len(),
                expected.len()
            ),
        )
        .expected(shown(expected.get(at)))
        .actual(shown(stated.get(at))),
    );
}

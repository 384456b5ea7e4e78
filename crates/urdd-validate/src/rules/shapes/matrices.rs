//! The lists of shapes, and the matrices over them as such.

use crate::rules::prelude::*;
use crate::views::tangled::{Tangled, diagonal_sound, of_pair, pairs, symmetric_at};
use urdd_document::shape_matrices::{
    Elements, MATRIX_MODULES, Matrix, V1_MATRIX_MODULES, at, matrices, reasons, shape_lists, skips,
};
use urdd_document::shapes::{LIST_MODULES, Shapes, entry_counts};
use urdd_format::index::{LinkIdx, PieceIdx};
use urdd_format::shapes::PieceShape;

declare_rule! {
    /// A list of boxes, spheres or distances does not hold one entry per link.
    ///
    /// The place in the list is the link index: where an entry is missing or too many, every later link
    /// gets another link's shape. Most often the module is stale: it was written before a link was
    /// added or removed.
    ///
    /// Write the link shape modules again from the same URDF as `urdf_module`, with null (or an empty
    /// list) for links without a hull.
    SHP001 "shape-list-length", Error, clause "8.2", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), SHAPE_LISTS, LINKS_NAMED], check shape_list_length,

    /// A link with a hull has no box, sphere or distance here, or one without a hull has one.
    ///
    /// Boxes, spheres and distances are those of the link's convex hull: a link has all of them or
    /// none. Where one is missing, a collision check that uses it passes over the link.
    ///
    /// Write the link shape modules again from the hulls that are there.
    SHP002 "shape-presence-differs", Error, clause "8.2", since "0.1.0",
    phase References, needs [Module(Kind::ConvexHullMeshes), SHAPE_LISTS, MESHES_LISTED, NotFailed(SHP001)],
    check shape_presence_differs,

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
    ], check shape_list_differs,

    /// A matrix over shapes is not square, or not of the number of shapes.
    ///
    /// Row i and column i stand for shape i: the links that have a hull, in link order, or the convex
    /// pieces, link by link. In a matrix of another size, indices mean other shapes than its reader
    /// thinks. Most often the module is stale: hulls or pieces were made again, and it was not.
    ///
    /// Write the module again from the hulls and pieces that are there. Until sizes are right, the other rules
    /// on matrices are skipped.
    SHP005 "matrix-size", Error, clause "8.4", since "0.1.0",
    phase References, needs [
        Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes), SHAPE_MATRICES_OR_MODELS,
        MESHES_LISTED, NoneFailed(&[MSH004, SHP002, SHP010]), NO_PIECE_TWICE,
    ], check matrix_size,

    /// A shape has a distance to itself, or is not to be skipped against itself.
    ///
    /// A shape is always in contact with itself: on the diagonal, distances are 0 and skips true. Where
    /// they are not, a program that runs over all pairs reports a robot in collision with itself for ever.
    ///
    /// Write 0, or true, on the diagonal.
    SHP007 "diagonal-wrong", Error, clause "8.4", since "0.1.0",
    phase References, needs [SHAPE_MATRICES, NotFailed(SHP005)], check diagonal_wrong,

    /// A matrix over convex pieces is null, though the robot has few enough of them.
    ///
    /// Such a matrix may be left out only above 500 pieces, where it would be very large. Up to that
    /// number programs count on it.
    ///
    /// Write the matrix.
    SHP015 "piece-matrix-missing", Error, clause "8.4", since "0.1.0",
    phase References, needs [Version1, Module(Kind::ConvexDecompositionMeshes), SHAPE_MATRICES, PIECES_LISTED],
    check piece_matrix_missing,

    /// A matrix over shapes is not symmetric: a pair has one value one way round and another the other.
    ///
    /// The distance of A to B is that of B to A, and a check that is skipped between A and B is skipped
    /// between B and A. With an asymmetric skip matrix, whether a collision is seen depends on the order
    /// in which a program happens to name the pair. Most often one of two elements was edited by hand.
    ///
    /// Set both elements of each pair. In `link_shapes_skips_module`, the message says which of the two
    /// is not what the other modules give: that one is the edit. Where the edit is meant, set both to it;
    /// else set both back.
    SHP006 "asymmetric-matrix", Error, clause "8.4", since "0.1.0",
    phase References, needs [SHAPE_MATRICES_OR_MODELS, NotFailed(SHP005)], check asymmetric_matrix,
}

fn shape_list_length(context: &Context, findings: &mut Findings) -> Option<()> {
    let links = context.robot()?.links.len();
    for (_, module, document) in context.documents(LIST_MODULES) {
        let lists = entry_counts(document);
        let lists = lists.iter().map(|list| (list.key, list.links.len()));
        let Some(wrong) = wrong_lengths(&lists.collect::<Vec<_>>(), links) else { continue };
        let length = wrong.length;
        let message = match wrong.are_all {
            true => format!(
                "the lists here have {length} entries, but urdf_module has {links} links: the module is stale; write it again from the same robot"
            ),
            false => format!("one entry per link is needed: {}", wrong.in_words),
        };
        finding_in(module, wrong.pointer, message)
            .values(format!("{links} entries (links of urdf_module)"), format!("{length} entries"))
            .report(findings);
    }
    Some(())
}

fn shape_presence_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let hulls = context.meshes(Kind::ConvexHullMeshes)?;
    for (_, module, document) in context.documents(LIST_MODULES) {
        let mut lists = entry_counts(document);
        lists.retain(|list| list.kind.is_of_links());
        for link in 0..hulls.num_links() {
            let hull = hulls.count(link) > 0;
            let mut wrong = lists.iter().filter(|list| {
                let entry = list.links.get(link);
                entry.is_some_and(|entry| entry.is_empty() == hull)
            });
            // A link is one mistake, though it shows in every list of the module.
            let Some(first) = wrong.next() else { continue };
            let also = match wrong.count() {
                0 => String::new(),
                n => format!(", nor as it should be in {n} more lists of this module"),
            };
            let (has, but, expected, actual) = match hull {
                true => ("a hull", "no entry", "an entry", "null"),
                false => ("no hull", "an entry", "null", "an entry"),
            };
            let label = context.link_label(link);
            let message =
                format!("{label} has {has} in convex_hull_meshes_module, but {but} here{also}");
            let finding = finding_in(module, first.pointer(link, 0), message);
            findings.report(finding.values(expected, actual));
        }
    }
    Some(())
}

fn shape_list_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let shapes = context.shapes()?;
    let index = |index: usize| u32::try_from(index).unwrap_or(u32::MAX);
    let full: Vec<LinkIdx> = shapes.full.iter().map(|l| LinkIdx(index(*l))).collect();
    let pieces = shapes.pieces.iter().map(|(link, piece)| PieceShape {
        link_idx: LinkIdx(index(*link)),
        piece_idx: PieceIdx(index(*piece)),
    });
    let pieces: Vec<PieceShape> = pieces.collect();
    for (_, module, document) in context.documents(V1_MATRIX_MODULES) {
        let Some((stated_full, stated_pieces)) = shape_lists(document) else { continue };
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
    Some(finding.values(shown(right.get(at)), shown(stated.get(at))))
}

fn matrix_size(context: &Context, findings: &mut Findings) -> Option<()> {
    let shapes = context.shapes()?;
    for (_, module, document) in context.documents(MATRIX_MODULES) {
        let matrices = matrices(document);
        let wrong = |matrix: &Matrix| wrong_size(module, matrix, &shapes);
        let mut wrong = matrices.iter().filter_map(wrong);
        // A stale module is one mistake, though it shows in every matrix.
        let Some(mut first) = wrong.next() else { continue };
        let others = wrong.count();
        if others > 0 {
            let also = format!("; {others} more matrices of this module are of wrong sizes too");
            first.message += &also;
        }
        first.message += ": write the module again";
        findings.report(first.count(1 + others));
    }
    Some(())
}

fn wrong_size(module: &Module, matrix: &Matrix, shapes: &Shapes) -> Option<Finding> {
    let rows = matrix.elements?.row_lengths();
    let size = shapes.count(matrix.kind);
    let what = if matrix.kind.is_of_links() { "links with a hull" } else { "convex pieces" };
    if rows.len() != size {
        let message = format!("there are {size} {what}, and {} rows here", rows.len());
        let finding = finding_in(module, &matrix.pointer, message);
        let rows = format!("{} rows", rows.len());
        return Some(finding.values(format!("{size} rows of {size}"), rows));
    }
    let row = rows.iter().position(|length| *length != size)?;
    let length = rows.get(row)?;
    let message = format!("there are {size} {what}, and {length} elements in this row");
    let finding = finding_in(module, format!("{}/{row}", matrix.pointer), message);
    Some(finding.counts(size, length, "elements"))
}

fn diagonal_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    for (_, module, document) in context.documents(MATRIX_MODULES) {
        for matrix in matrices(document) {
            let Some(elements) = matrix.elements else { continue };
            let tangled = Tangled::new(elements);
            for i in 0..elements.rows() {
                // SHP006 reports a row with more faults.
                if diagonal_sound(elements, i) || tangled.asymmetric(i) {
                    continue;
                }
                let expected = match elements {
                    Elements::Distances(_) => "0",
                    _ => "true",
                };
                let message = format!(
                    "this is the element of shape {i} and itself, which is always {expected}"
                );
                let finding = finding_in(module, format!("{}/{i}/{i}", matrix.pointer), message);
                findings.report(finding.values(expected, elements.text(i, i)));
            }
        }
    }
    Some(())
}

/// Number of pieces up to which matrices over them are required (SPEC 8.4).
const REQUIRED_UP_TO: usize = 500;

fn piece_matrix_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    let meshes = context.meshes(Kind::ConvexDecompositionMeshes)?;
    let pieces: usize = (0..meshes.num_links()).map(|link| meshes.count(link)).sum();
    if pieces > REQUIRED_UP_TO {
        return Some(());
    }
    for (_, module, document) in context.documents(V1_MATRIX_MODULES) {
        let mut missing = matrices(document);
        missing.retain(|matrix| matrix.elements.is_none());
        let missing: Vec<String> = missing.into_iter().map(|matrix| matrix.pointer).collect();
        // A module written without them is one mistake.
        if let Some(first) = missing.first() {
            let message = format!(
                "with {pieces} convex pieces the matrices over them are required, and null here: {}",
                missing.join(", ")
            );
            let finding = finding_in(module, first, message).count(missing.len());
            findings.report(finding.values("a matrix", "null"));
        }
    }
    Some(())
}

fn asymmetric_matrix(context: &Context, findings: &mut Findings) -> Option<()> {
    let shapes = context.shapes();
    for (kind, module, document) in context.documents(MATRIX_MODULES) {
        for matrix in matrices(document) {
            let Some(elements) = matrix.elements else { continue };
            let name = |shape: usize| match &shapes {
                Some(shapes) => shapes.describe(context, matrix.kind, shape),
                None => shape.to_string(),
            };
            let mut fold = Fold::new(findings);
            for (i, j) in pairs(elements.rows()) {
                if symmetric_at(elements, i, j) {
                    continue;
                }
                let edited = edited_half(context, kind, &matrix, i, j);
                fold.add(|| {
                    let (i, j) = edited.unwrap_or((i, j));
                    let (a, b) = (name(i), name(j));
                    let pointer = format!("{}/{i}/{j}", matrix.pointer);
                    let mirror = format!("{}/{j}/{i}", matrix.pointer);
                    let (here, there) = (elements.text(i, j), elements.text(j, i));
                    if edited.is_some() {
                        let message = format!(
                            "shapes {a} and {b} are skipped in one half of the matrix only: this half is an edit, \
                             {mirror} is what the simple skips give; set both to the edit, or both back"
                        );
                        return finding_in(module, pointer, message)
                            .expected(format!("the same as at {mirror}"))
                            .actual(format!("{here}, and {there} there"));
                    }
                    let message = format!(
                        "shapes {a} and {b} have different values in the two halves of the matrix: make them equal"
                    );
                    let finding = finding_in(module, pointer, message)
                        .values(format!("{there}, as at {mirror}"), here);
                    match elements {
                        Elements::Distances(_) | Elements::Models(_) => {
                            finding.tolerance(NUMBER_RELATIVE)
                        }
                        Elements::Skips(_) | Elements::Reasons(_) => finding,
                    }
                });
            }
        }
    }
    Some(())
}

/// Of two elements of a skip matrix that differ, the place of the edited one. `None` in other modules, and if the value
/// before the edits is unknown.
fn edited_half(
    context: &Context,
    module: Kind,
    matrix: &Matrix,
    i: usize,
    j: usize,
) -> Option<(usize, usize)> {
    let (Kind::LinkShapesSkips, Some(Elements::Skips(rows))) = (module, matrix.elements) else {
        return None;
    };
    let simple = context.document(Kind::LinkShapesSimpleSkips)?;
    let place = matrix.kind as usize;
    let before = match context.document(module)? {
        ModuleDocument::LinkShapesSkips(skips) => {
            let reason = of_pair(reasons(simple)?[place]?, i, j)?;
            let mut skipped = skips.skipped_reasons.iter();
            skipped.any(|skipped| skipped.of_pair() == reason)
        }
        _ => of_pair(skips(simple)?[place]?, i, j)?,
    };
    if at(rows, i, j)? == before { Some((j, i)) } else { Some((i, j)) }
}

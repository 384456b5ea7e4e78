use crate::rules::prelude::*;
use urdd_document::shape_matrices::{V1_MATRIX_MODULES, shape_lists};
use urdd_document::shapes::{LIST_MODULES, entry_counts};
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

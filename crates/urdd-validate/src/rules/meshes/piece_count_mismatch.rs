use crate::rules::prelude::*;
use urdd_document::shapes::{LIST_MODULES, entry_counts};

declare_rule! {
    /// Modules disagree about the number of convex pieces of a link.
    ///
    /// Piece k of a link is the same piece in `convex_decomposition_meshes_module`, in the boxes and
    /// spheres, and in the distances. Where one of them has more or fewer, boxes belong to other
    /// pieces than their places say. Most often the meshes were decomposed again and the link shape
    /// modules were not.
    ///
    /// Write the link shape modules again from the convex pieces that are there.
    MSH004 "piece-count-mismatch", Error, clause "7.7", since "0.1.0",
    phase References, needs [
        Module(Kind::ConvexDecompositionMeshes), SHAPE_LISTS, MESHES_LISTED, NotFailed(SHP001), NO_PIECE_TWICE,
    ],
}

/// The number of pieces of each link, by a list of a module.
struct Counted<'a> {
    module: &'a Module,
    key: &'static str,
    counts: Vec<usize>,
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let pieces = context.meshes(Kind::ConvexDecompositionMeshes)?;
    let links = 0..pieces.num_links();
    let mut lists = vec![Counted {
        module: context.module(Kind::ConvexDecompositionMeshes)?,
        key: pieces.lists.first().map_or("", |list| list.key),
        counts: links.clone().map(|link| pieces.count(link)).collect(),
    }];
    for (_, module, document) in context.documents(LIST_MODULES) {
        let of_pieces = entry_counts(document).into_iter().filter(|list| !list.kind.is_of_links());
        lists.extend(of_pieces.map(|list| Counted {
            module,
            key: list.key,
            counts: list.links.iter().map(Vec::len).collect(),
        }));
    }
    for link in links {
        let counts = lists.iter().filter_map(|list| Some((*list.counts.get(link)?, list)));
        // One finding per link, reported at the first list that differs from most lists.
        let usual = most_common(counts.clone().map(|(count, _)| count));
        let mut odd = counts.filter(|(count, _)| *count != usual);
        let Some((count, first)) = odd.next() else { continue };
        let also = match odd.count() {
            0 => String::new(),
            n => format!(" (and {n} more lists)"),
        };
        let message = format!(
            "{} has {count} convex pieces here{also} and {usual} in the other modules that list them: write the link shape modules again from convex_decomposition_meshes_module",
            context.link_label(link)
        );
        finding_in(first.module, format!("/{}/{link}", first.key), message)
            .counts(usual, count, "entries")
            .report(findings);
    }
    Some(())
}

/// The most frequent number; of several, the first.
pub fn most_common(numbers: impl Iterator<Item = usize>) -> usize {
    let mut seen: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
    for (place, number) in numbers.enumerate() {
        seen.entry(number).or_insert((0, place)).0 += 1;
    }
    let best =
        seen.into_iter().max_by_key(|(_, (times, place))| (*times, std::cmp::Reverse(*place)));
    best.map_or(0, |(number, _)| number)
}

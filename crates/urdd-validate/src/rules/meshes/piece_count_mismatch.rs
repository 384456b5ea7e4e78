use std::collections::BTreeMap;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::shapes::{LIST_MODULES, entry_counts};
use urdd_format::registry::ModuleKind;

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
        Module(Kind::ConvexDecompositionMeshes),
        AnyModule(&[Kind::LinkShapesApproximations, Kind::LinkShapesMaxDistanceFromOrigin]),
        MESHES_LISTED,
        NotFailed(SHP001),
        NO_PIECE_TWICE,
    ],
    check check,
}

/// A list of pieces by link.
struct Counted {
    kind: ModuleKind,
    key: &'static str,
    counts: Vec<usize>,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some(pieces) = context.meshes(ModuleKind::ConvexDecompositionMeshes) else {
        return;
    };
    let mut lists = vec![Counted {
        kind: ModuleKind::ConvexDecompositionMeshes,
        key: pieces.lists.first().map_or("", |list| list.key),
        counts: (0..pieces.num_links())
            .map(|link| pieces.count(link))
            .collect(),
    }];
    for kind in LIST_MODULES {
        let Some(document) = context.document(*kind) else {
            continue;
        };
        for list in entry_counts(document) {
            if !list.kind.is_of_links() {
                lists.push(Counted {
                    kind: *kind,
                    key: list.key,
                    counts: list.links.iter().map(Vec::len).collect(),
                });
            }
        }
    }
    for link in 0..pieces.num_links() {
        let counts: Vec<(usize, &Counted)> = lists
            .iter()
            .filter_map(|list| Some((*list.counts.get(link)?, list)))
            .collect();
        // One link, one mistake: told at the first list that is not as most are.
        let usual = most_common(counts.iter().map(|(count, _)| *count));
        let Some((count, odd)) = counts.iter().find(|(count, _)| *count != usual) else {
            continue;
        };
        let Some(module) = context.module(odd.kind) else {
            continue;
        };
        let others = counts.iter().filter(|(count, _)| *count != usual).count() - 1;
        let also = match others {
            0 => String::new(),
            n => format!(" (and {n} more lists)"),
        };
        findings.report(
            Finding::at(
                module.file("module.json"),
                format!("/{}/{link}", odd.key),
                format!(
                    "{} has {count} convex pieces here{also} and {usual} in the other modules that list them: write the link shape modules again from convex_decomposition_meshes_module",
                    context.link_label(link)
                ),
            )
            .expected(format!("{usual} entries"))
            .actual(format!("{count} entries")),
        );
    }
}

/// The number that comes most often; of several, the first.
fn most_common(numbers: impl Iterator<Item = usize>) -> usize {
    let mut seen: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
    for (place, number) in numbers.enumerate() {
        seen.entry(number).or_insert((0, place)).0 += 1;
    }
    let best = seen
        .into_iter()
        .max_by_key(|(_, (times, place))| (*times, std::cmp::Reverse(*place)));
    best.map_or(0, |(number, _)| number)
}

#[cfg(test)]
mod tests {
    use super::most_common;

    #[test]
    fn the_number_that_comes_most_often_and_first() {
        assert_eq!(most_common([3, 2, 2].into_iter()), 2);
        assert_eq!(most_common([3, 2, 2, 3].into_iter()), 3);
        assert_eq!(most_common([7].into_iter()), 7);
        assert_eq!(most_common(std::iter::empty()), 0);
    }
}

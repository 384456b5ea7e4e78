use crate::rules::prelude::*;
use crate::views::tangled::{Tangled, of_pair, sound_pairs};
use urdd_document::shape_matrices::{Elements, reasons, skips, skips_pointer};

declare_rule! {
    /// A skip does not follow from the reason of the pair and the edits.
    ///
    /// A pair is skipped where its reason in `link_shapes_simple_skips_module` is one of
    /// `skipped_reasons`; then `edits` apply, in order. A skip that neither gives has no reason on
    /// record, and is lost when the module is written again.
    ///
    /// Record the change in `edits`, by the names of the two links, and run `urdd generate` again, which
    /// writes the matrices from it.
    SHP013 "skips-not-from-edits", Error, clause "8.7", since "0.1.0",
    phase References, needs [
        Version1, Module(Kind::Urdf), ModuleV1(Kind::LinkShapesSimpleSkips), ModuleV1(Kind::LinkShapesSkips),
        Passed(SHP005), NotFailed(SHP012), Passed(SHP014),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesSkips;
    let document = context.document(kind)?;
    let edited = document!(context, LinkShapesSkips)?;
    let shapes = context.shapes()?;
    let robot = context.robot()?;
    // Each edit sets all pairs of its two links, so the last of several counts.
    let mut last: HashMap<(usize, usize), (usize, bool)> = HashMap::new();
    for (place, edit) in edited.edits.iter().enumerate() {
        if let (Some(a), Some(b)) = (robot.link(&edit.link_a), robot.link(&edit.link_b)) {
            last.insert((a.min(b), a.max(b)), (place, edit.skip));
        }
    }
    let simple = reasons(context.document(Kind::LinkShapesSimpleSkips)?)?;
    for ((kind, simple), rows) in ShapeKind::ALL.into_iter().zip(simple).zip(skips(document)?) {
        let (Some(simple), Some(rows)) = (simple, rows) else {
            continue;
        };
        let tangled_simple = Tangled::new(Elements::Reasons(simple));
        let mut fold = Fold::new(findings);
        for (i, j, skip) in sound_pairs(rows, Elements::Skips) {
            let Some((a, b)) = shapes.link(kind, i).zip(shapes.link(kind, j)) else {
                continue;
            };
            let edit = last.get(&(a.min(b), a.max(b))).copied();
            // SHP006 reports a pair whose two reasons differ.
            let reason = of_pair(simple, i, j).filter(|_| !tangled_simple.pair(i, j));
            let by_reason = reason.map(|reason| {
                let mut skipped = edited.skipped_reasons.iter();
                skipped.any(|skipped| skipped.of_pair() == reason)
            });
            let expected = edit.map(|(_, skip)| skip).or(by_reason);
            if expected.is_none_or(|expected| expected == skip) {
                continue;
            }
            fold.add(|| {
                let why = match (edit, reason) {
                    (Some((place, skip)), _) => format!("/edits/{place} says {skip}"),
                    (None, reason) => format!(
                        "no edit concerns it, and its reason, {}, is {}one of `skipped_reasons`",
                        reason.map_or("unknown", |reason| reason.as_str()),
                        if skip { "not " } else { "" }
                    ),
                };
                let [a, b] = [i, j].map(|shape| shapes.describe(context, kind, shape));
                let pointer = format!("{}/{i}/{j}", skips_pointer(document, kind));
                let message = format!("the pair of shapes {a} and {b}: {why}");
                finding_in(Kind::LinkShapesSkips, pointer, message).values(!skip, skip)
            });
        }
    }
    Some(())
}

use std::collections::HashMap;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use crate::views::tangled::Tangled;
use urdd_document::shape_matrices::{Elements, at, reasons, skips, skips_pointer};
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::shape_kind::ShapeKind;

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
        Version1,
        Module(Kind::Urdf),
        Module(Kind::LinkShapesSimpleSkips),
        Module(Kind::LinkShapesSkips),
        Passed(SHP005),
        NotFailed(SHP012),
        Passed(SHP014),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesSkips;
    let (Some(document), Some(module), Some(shapes), Some(robot)) = (
        context.document(kind),
        context.module(kind),
        context.shapes(),
        context.robot(),
    ) else {
        return;
    };
    let simple = context
        .document(ModuleKind::LinkShapesSimpleSkips)
        .and_then(reasons);
    let (ModuleDocument::LinkShapesSkips(edited), Some(simple), Some(six)) =
        (document, simple, skips(document))
    else {
        return;
    };
    // Each edit sets all pairs of its two links, so of several the last counts.
    let mut last: HashMap<(usize, usize), (usize, bool)> = HashMap::new();
    for (place, edit) in edited.edits.iter().enumerate() {
        if let (Some(a), Some(b)) = (robot.link(&edit.link_a), robot.link(&edit.link_b)) {
            last.insert((a.min(b), a.max(b)), (place, edit.skip));
        }
    }
    for ((kind, simple), rows) in ShapeKind::ALL.into_iter().zip(simple).zip(six) {
        let (Some(simple), Some(rows)) = (simple, rows) else {
            continue;
        };
        let tangled = Tangled::new(Elements::Skips(rows));
        let tangled_simple = Tangled::new(Elements::Reasons(simple));
        let mut fold = Fold::new(findings);
        for i in 0..rows.len() {
            for j in i + 1..rows.len() {
                let (Some(skip), Some(mirror)) = (at(rows, i, j), at(rows, j, i)) else {
                    continue;
                };
                let (Some(a), Some(b)) = (shapes.link(kind, i), shapes.link(kind, j)) else {
                    continue;
                };
                let edit = last.get(&(a.min(b), a.max(b))).copied();
                // A pair whose two elements differ is SHP006's, here and in the reasons.
                let reason = at(simple, i, j).filter(|reason| {
                    at(simple, j, i) == Some(*reason) && !tangled_simple.pair(i, j)
                });
                let by_reason = reason.map(|reason| {
                    let mut skipped = edited.skipped_reasons.iter();
                    skipped.any(|skipped| skipped.of_pair() == reason)
                });
                let expected = edit.map(|(_, skip)| skip).or(by_reason);
                let right = expected.is_none_or(|expected| expected == skip);
                if skip != mirror || right || tangled.pair(i, j) {
                    continue;
                }
                fold.add(|| {
                    let why = match (edit, reason) {
                        (Some((place, skip)), _) => format!("/edits/{place} says {skip}"),
                        (None, reason) => format!(
                            "no edit is about it, and its reason, {}, is {}one of `skipped_reasons`",
                            reason.map_or("unknown", |reason| reason.as_str()),
                            if skip { "not " } else { "" }
                        ),
                    };
                    Finding::at(
                        module.file("module.json"),
                        format!("{}/{i}/{j}", skips_pointer(document, kind)),
                        format!(
                            "the pair of shapes {} and {}: {why}",
                            shapes.describe(context, kind, i),
                            shapes.describe(context, kind, j)
                        ),
                    )
                    .expected(!skip)
                    .actual(skip)
                });
            }
        }
        fold.finish();
    }
}

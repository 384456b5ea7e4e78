use crate::rules::prelude::*;
use crate::views::tangled::{Tangled, of_pair, sound_pairs};
use urdd_document::shape_matrices::{Elements, reasons, skips, skips_pointer};

declare_rule! {
    /// A simple skip is not what the distance statistics say.
    ///
    /// A pair is skipped when both shapes are on one link, or when they are always in contact: their
    /// largest sampled distance is at most 0.001 m. A skip too many hides collisions; one too few makes
    /// a program report a collision that is there in every configuration. Most often one of the two
    /// modules is stale.
    ///
    /// Write the simple skips again from the statistics, or both again.
    SHP011 "simple-skip-wrong", Error, clause "8.6", since "0.1.0",
    phase References, needs [
        Module(Kind::LinkShapesDistanceStatistics), Module(Kind::LinkShapesSimpleSkips), Passed(SHP005),
    ], check simple_skip_wrong,

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
    ], check skips_not_from_edits,

    /// An edit of the skips names a link that the robot does not have.
    ///
    /// The edit does nothing, and the collision checks that a person wanted skipped, or not skipped,
    /// are as they were. Most often a link was renamed.
    ///
    /// Write the link's name as `urdf_module` has it, or take the edit out.
    SHP014 "unknown-link-in-edit", Error, clause "8.7", since "0.1.0",
    phase References, needs [
        Version1, Module(Kind::Urdf), ModuleV1(Kind::LinkShapesSkips), NotFailed(CHN001), LINKS_NAMED,
    ], check unknown_link_in_edit,

    /// `skipped_reasons` repeats a reason, or the reasons are out of order.
    ///
    /// The order is `SameLink`, `Always`, `Adjacent`, `Default`, `Never`. It makes no difference to
    /// readers. With one order, the same choice is the same text, and differences between two URDDs are
    /// real ones.
    ///
    /// Name each reason once, in this order. (`urdd generate --skip` does it.)
    SHP027 "skipped-reasons-disordered", Error, clause "8.7", since "0.2.0",
    phase References, needs [Version1, ModuleV1(Kind::LinkShapesSkips)], check skipped_reasons_disordered,
}

fn simple_skip_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesSimpleSkips;
    let document = context.document(kind)?;
    let shapes = context.shapes()?;
    let statistics = context.statistics()?;
    for (kind, rows) in by_kind(skips(document)?) {
        let stated = statistics[kind as usize].as_ref().map(Pairs::new);
        let mut fold = Fold::new(findings);
        for (i, j, skip) in sound_pairs(rows, Elements::Skips) {
            let same_link = shapes.link(kind, i) == shapes.link(kind, j);
            let pair = stated.as_ref().and_then(|stated| stated.read(i, j));
            let expected = match same_link {
                true => Some(true),
                false => pair.filter(Pair::in_order).as_ref().and_then(Pair::always),
            };
            if expected.is_none_or(|expected| expected == skip) {
                continue;
            }
            fold.add(|| {
                let why = match (same_link, pair) {
                    (false, Some(pair)) => {
                        format!("their largest sampled distance is {}", metres(pair.max))
                    }
                    _ => "both are on one link".to_owned(),
                };
                let [a, b] = [i, j].map(|shape| shapes.describe(context, kind, shape));
                let not = if skip { "not " } else { "" };
                let pointer = format!("{}/{i}/{j}", skips_pointer(document, kind));
                let message = format!("shapes {a} and {b} are {not}to be skipped: {why}");
                finding_in(Kind::LinkShapesSimpleSkips, pointer, message).values(!skip, skip)
            });
        }
    }
    Some(())
}

fn skips_not_from_edits(context: &Context, findings: &mut Findings) -> Option<()> {
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
        let (Some(simple), Some(rows)) = (simple, rows) else { continue };
        let tangled_simple = Tangled::new(Elements::Reasons(simple));
        let mut fold = Fold::new(findings);
        for (i, j, skip) in sound_pairs(rows, Elements::Skips) {
            let Some((a, b)) = shapes.link(kind, i).zip(shapes.link(kind, j)) else { continue };
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

fn unknown_link_in_edit(context: &Context, findings: &mut Findings) -> Option<()> {
    let skips = document!(context, LinkShapesSkips)?;
    let robot = context.robot()?;
    for (place, edit) in skips.edits.iter().enumerate() {
        for (key, name) in [("link_a", &edit.link_a), ("link_b", &edit.link_b)] {
            if robot.link(name).is_none() {
                let message = "the robot has no link of this name";
                finding_in(Kind::LinkShapesSkips, format!("/edits/{place}/{key}"), message)
                    .values("the name of a link of urdf_module", format!("`{name}`"))
                    .report(findings);
            }
        }
    }
    Some(())
}

fn skipped_reasons_disordered(context: &Context, findings: &mut Findings) -> Option<()> {
    let stated = &document!(context, LinkShapesSkips)?.skipped_reasons;
    let mut ordered = stated.clone();
    ordered.sort();
    ordered.dedup();
    if ordered != *stated {
        let words = |reasons: &[_]| {
            let words: Vec<String> = reasons.iter().map(ToString::to_string).collect();
            words.join(", ")
        };
        let message = "name each reason once, in the order of SPEC 8.6";
        let finding = finding_in(Kind::LinkShapesSkips, "/skipped_reasons", message);
        findings.report(finding.values(words(&ordered), words(stated)));
    }
    Some(())
}

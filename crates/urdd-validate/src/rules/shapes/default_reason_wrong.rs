use crate::context::Context;
use crate::distances::tolerances::Tolerances;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use crate::views::shape_pair::CONTACT;
use crate::views::tangled::Tangled;
use urdd_document::shape_matrices::{Elements, at, reasons};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::readable::metres;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::ShapeKind;

declare_rule! {
    /// A pair of shapes is in contact in the default configuration and its reason is not `Default`, or
    /// the other way round.
    ///
    /// In the default configuration every DOF is 0, or the bound nearest to 0. Shapes that touch
    /// there, as those of neighbouring links often do, have the reason `Default`, and are skipped
    /// unless a person says otherwise. One pair too few is a collision that a robot at rest
    /// reports; one too many is a collision that no program sees.
    ///
    /// Compute the distances in the default configuration (SPEC 9.4) from the present shapes, and write
    /// the reasons again.
    SHP026 "default-reason-wrong", Error, clause "8.6", since "0.2.0",
    phase Statistics, needs [
        Version1,
        Module(Kind::Urdf),
        Module(Kind::Dof),
        Module(Kind::Chain),
        Module(Kind::Bounds),
        Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes),
        Module(Kind::LinkShapesApproximations),
        Module(Kind::LinkShapesDistanceStatistics),
        Module(Kind::LinkShapesSimpleSkips),
        NotFailed(DIR030),
        NotFailed(SHP012),
        // Poses.
        Passed(URD004), Passed(URD006), NotFailed(DOF003), NotFailed(DOF004), NotFailed(DOF005), NotFailed(DOF007),
        NotFailed(CHN001), NotFailed(CHN002), NotFailed(CHN003), NotFailed(CHN006), NotFailed(CHN007), NotFailed(CHN008),
        NotFailed(CHN009), NotFailed(CHN010), NotFailed(KIN001),
        NotFailed(BND001), NotFailed(BND002), NotFailed(BND003), NotFailed(BND006),
        // Shapes.
        NotFailed(MSH001), NotFailed(MSH004), NotFailed(MSH005), NotFailed(MSH007),
        NotFailed(MSH017), NotFailed(MSH018), NotFailed(MSH019), NotFailed(MSH020), NotFailed(MSH021), NotFailed(MSH022),
        NotFailed(SHP001), NotFailed(SHP002), NotFailed(SHP003), Passed(SHP005), NotFailed(SHP010), NotFailed(SHP016),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let kind = ModuleKind::LinkShapesSimpleSkips;
    let (Some(module), Some(six), Some(shapes)) = (
        context.module(kind),
        context.document(kind).and_then(reasons),
        context.shapes(),
    ) else {
        return;
    };
    let distances = match context.distances() {
        Ok(distances) => distances,
        Err(reason) => return findings.skip(reason.clone()),
    };
    for ((kind, rows), found) in ShapeKind::ALL.into_iter().zip(six).zip(distances.kinds()) {
        let (Some(rows), Some(found)) = (rows, found) else {
            continue;
        };
        let set = found.shapes();
        let at_default = distances.at_default_configuration(found);
        let tolerances = Tolerances::new(context, context.solids(), &shapes, kind);
        let tangled = Tangled::new(Elements::Reasons(rows));
        let mut fold = Fold::new(findings);
        for i in 0..rows.len() {
            for j in i + 1..rows.len() {
                // A pair whose two elements differ is SHP006's.
                let (Some(reason), Some(mirror)) = (at(rows, i, j), at(rows, j, i)) else {
                    continue;
                };
                let stated = reason == SkipReason::Default;
                let after = matches!(reason, SkipReason::Never | SkipReason::None);
                if reason != mirror || !(stated || after) || tangled.pair(i, j) {
                    continue;
                }
                let (Some(a), Some(b)) = (set.place(i), set.place(j)) else {
                    continue;
                };
                let Some(distance) = at(&at_default, a, b) else {
                    continue;
                };
                let tolerance = tolerances.pair(i, j);
                let wrong = match stated {
                    true => distance > CONTACT + tolerance,
                    false => distance + tolerance < CONTACT,
                };
                if !wrong {
                    continue;
                }
                fold.add(|| {
                    Finding::at(
                        module.file("module.json"),
                        format!("/reasons/{}/{i}/{j}", kind.key()),
                        format!(
                            "shapes {} and {} are {} apart in the default configuration, and {CONTACT} m or less is contact",
                            shapes.describe(context, kind, i),
                            shapes.describe(context, kind, j),
                            metres(distance)
                        ),
                    )
                    .expected(match stated {
                        true => "Never or None",
                        false => "Default",
                    })
                    .actual(reason)
                    .tolerance(tolerance)
                });
            }
        }
        fold.finish();
    }
}

use crate::rules::prelude::*;
use crate::views::shape_pair::CONTACT;
use crate::views::tangled::sound_pairs;
use urdd_document::shape_matrices::{Elements, at, reasons};
use urdd_format::link_shapes_simple_skips::SkipReason;

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
        Version1, Module(Kind::Urdf), Module(Kind::Dof), Module(Kind::Chain), Module(Kind::Bounds),
        Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes),
        Module(Kind::LinkShapesApproximations), Module(Kind::LinkShapesDistanceStatistics),
        ModuleV1(Kind::LinkShapesSimpleSkips), NoneFailed(&[DIR030, SHP012]), POSES_KNOWN, BOUNDS_SOUND,
        PIECES_LISTED, NoneFailed(&[MSH005, MSH017, MSH018, MSH019, MSH020, MSH021, MSH022]), SHAPES_LISTED,
        NotFailed(SHP003), Passed(SHP005), NoneFailed(&[SHP010, SHP016]),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesSimpleSkips;
    let six = reasons(context.document(kind)?)?;
    let shapes = context.shapes()?;
    let distances = findings.or_skip(context.distances())?;
    for ((kind, rows), found) in ShapeKind::ALL.into_iter().zip(six).zip(&distances.kinds) {
        let (Some(rows), Some(found)) = (rows, found) else {
            continue;
        };
        let at_default = distances.at_default_configuration(found);
        let tolerances = Tolerances::new(context, context.solids(), &shapes, kind);
        let mut fold = Fold::new(findings);
        for (i, j, reason) in sound_pairs(rows, Elements::Reasons) {
            let stated = reason == SkipReason::Default;
            if !stated && !matches!(reason, SkipReason::Never | SkipReason::None) {
                continue;
            }
            let places = found.shapes.place(i).zip(found.shapes.place(j));
            let Some(distance) = places.and_then(|(a, b)| at(&at_default, a, b)) else {
                continue;
            };
            let tolerance = tolerances.pair(i, j);
            let (wrong, expected) = match stated {
                true => (distance > CONTACT + tolerance, "Never or None"),
                false => (distance + tolerance < CONTACT, "Default"),
            };
            if wrong {
                fold.add(|| {
                    let [a, b] = [i, j].map(|shape| shapes.describe(context, kind, shape));
                    let pointer = format!("/reasons/{}/{i}/{j}", kind.key());
                    let message = format!(
                        "shapes {a} and {b} are {} apart in the default configuration, and {CONTACT} m or less is contact",
                        metres(distance)
                    );
                    let finding = finding_in(Kind::LinkShapesSimpleSkips, pointer, message);
                    finding.values(expected, reason).tolerance(tolerance)
                });
            }
        }
    }
    Some(())
}

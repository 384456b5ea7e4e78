use crate::rules::prelude::*;
use crate::views::tangled::{CONTACT, Tangled, of_pair, sound_pairs};
use urdd_document::shape_matrices::{Elements, at, reasons, skips};
use urdd_format::chain::ChainModule;
use urdd_format::link_shapes_simple_skips::SkipReason;

declare_rule! {
    /// The reason given for a pair of shapes is not the first that applies.
    ///
    /// The reasons, in their order: `SameLink`; `Always` in contact (largest sampled distance at most
    /// 0.001 m); `Adjacent`, connected by a joint; `Default`, in contact in the default configuration;
    /// `Never` in contact (smallest distance more than 0.001 m); `None` of these. Which pairs a collision
    /// check skips follows from them.
    ///
    /// Write the reasons again from `chain_module` and the distance statistics. (`Default` is held to the
    /// meshes: SHP026.)
    SHP012 "skip-reason-wrong", Error, clause "8.6", since "0.1.0",
    phase References, needs [
        Version1, Module(Kind::Chain), Module(Kind::LinkShapesDistanceStatistics),
        ModuleV1(Kind::LinkShapesSimpleSkips), NotFailed(CHN002), Passed(SHP005),
    ], check skip_reason_wrong,

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
    ], check default_reason_wrong,
}

fn skip_reason_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesSimpleSkips;
    let document = context.document(kind)?;
    let shapes = context.shapes()?;
    let joined = joined(context.chain()?);
    let (six, skips, reasons) = (context.statistics()?, skips(document)?, reasons(document)?);
    for (((kind, statistics), skips), rows) in
        ShapeKind::ALL.into_iter().zip(six).zip(skips).zip(reasons)
    {
        let Some(rows) = rows else { continue };
        let tangled = Tangled::new(Elements::Reasons(rows));
        let stated = statistics.as_ref().map(Pairs::new);
        let mut fold = Fold::new(findings);
        for (i, j) in (0..rows.len()).flat_map(|i| (i..rows.len()).map(move |j| (i, j))) {
            let links = shapes.link(kind, i).zip(shapes.link(kind, j));
            // SHP006 reports a pair whose two elements differ.
            let (Some(reason), Some((a, b))) = (of_pair(rows, i, j), links) else { continue };
            let pair = stated.as_ref().and_then(|stated| stated.read(i, j));
            let expected = match (a == b, pair.filter(Pair::in_order)) {
                (true, _) => Some(SkipReason::SameLink),
                (false, Some(pair)) => first_reason(&pair, joined.contains(&ordered(a, b))),
                (false, None) => None,
            };
            let Some(expected) = expected else { continue };
            // SHP026 judges whether the pair is in contact in the default configuration.
            let after_default = matches!(expected, SkipReason::Never | SkipReason::None);
            if reason == SkipReason::Default && after_default {
                continue;
            }
            // SHP011 reports a wrong skip.
            let skipped = matches!(expected, SkipReason::SameLink | SkipReason::Always);
            let skip = skips.and_then(|skips| at(skips, i, j)).unwrap_or(skipped);
            if tangled.pair(i, j) || reason == expected || (i != j && skip != skipped) {
                continue;
            }
            fold.add(|| {
                let [a, b] = [i, j].map(|shape| shapes.describe(context, kind, shape));
                let pointer = format!("/reasons/{}/{i}/{j}", kind.key());
                let message =
                    format!("for shapes {a} and {b} this is not the first reason that applies");
                finding_in(Kind::LinkShapesSimpleSkips, pointer, message).literals(expected, reason)
            });
        }
    }
    Some(())
}

/// The first reason that applies to shapes of two links; `None` if that depends on rounding.
fn first_reason(pair: &Pair, adjacent: bool) -> Option<SkipReason> {
    if pair.always()? {
        return Some(SkipReason::Always);
    }
    if adjacent {
        return Some(SkipReason::Adjacent);
    }
    Some(if pair.never()? { SkipReason::Never } else { SkipReason::None })
}

/// Two links, the lower first.
pub fn ordered(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}

/// The pairs of links that a joint connects.
pub fn joined(chain: &ChainModule) -> HashSet<(usize, usize)> {
    let joints = chain.joints_in_chain.iter();
    joints.map(|of| ordered(of.parent_link_idx.get(), of.child_link_idx.get())).collect()
}

fn default_reason_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let kind = Kind::LinkShapesSimpleSkips;
    let six = reasons(context.document(kind)?)?;
    let shapes = context.shapes()?;
    let distances = findings.or_skip(context.distances())?;
    for ((kind, rows), found) in ShapeKind::ALL.into_iter().zip(six).zip(&distances.kinds) {
        let (Some(rows), Some(found)) = (rows, found) else { continue };
        let at_default = distances.at_default_configuration(found);
        let tolerances = Tolerances::new(context, context.solids(), &shapes, kind);
        let mut fold = Fold::new(findings);
        for (i, j, reason) in sound_pairs(rows, Elements::Reasons) {
            let stated = reason == SkipReason::Default;
            if !stated && !matches!(reason, SkipReason::Never | SkipReason::None) {
                continue;
            }
            let places = found.shapes.place(i).zip(found.shapes.place(j));
            let Some(distance) = places.and_then(|(a, b)| at(&at_default, a, b)) else { continue };
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

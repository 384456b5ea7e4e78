use std::collections::HashSet;

use crate::context::Context;
use crate::distances::other_reasons::OtherReasons;
use crate::distances::plan;
use crate::distances::poses::Poses;
use crate::distances::shape_set::ShapeSet;
use crate::distances::tolerances::Tolerances;
use crate::finding::{Finding, Findings};
use crate::fold::Fold;
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use crate::views::judged;
use crate::views::shape_pair::CONTACT;
use crate::views::tangled::Tangled;
use urdd_document::shape_matrices::{Elements, at, skips, skips_pointer, statistics};
use urdd_document::shapes::Shapes;
use urdd_format::readable::metres;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::shape_kind::ShapeKind;

declare_rule! {
    /// A pair of shapes is skipped, and is in contact in some configurations and apart in others.
    ///
    /// A skip says that contact of the two means nothing, since they always are in contact. Where
    /// they come apart and meet again, contact is a collision, and no program will see it: the
    /// robot is driven into itself. Most often the module is stale, or was sampled with joints that
    /// stood still.
    ///
    /// The first 96 sampled configurations are looked at, or fewer where that is much work. Sample again,
    /// and write the skips from the statistics. What a person decides is recorded in `edits` of
    /// `link_shapes_skips_module`, and is free.
    SHP025 "skipped-pair-moves-apart", Error, clause "8.6", since "0.1.0",
    phase Statistics, needs [
        AnyModule(&[Kind::LinkShapesSimpleSkips, Kind::LinkShapesSkips]),
        Module(Kind::Urdf),
        Module(Kind::Dof),
        Module(Kind::Chain),
        Module(Kind::Bounds),
        Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes),
        Module(Kind::LinkShapesApproximations),
        POSES_KNOWN, BOUNDS_SOUND_IN_VERSION_1,
        PIECES_LISTED, OWN_FILES_IN_VERSION_1,
        SHAPES_LISTED, NotFailed(SHP003), Passed(SHP005), NotFailed(SHP010),
        // What these find makes skips wrong too.
        NotFailedInV1(SHP017), NotFailed(SHP011), NotFailed(SHP013), NotFailed(SHP023), NotFailed(SHP024),
    ],
    check check,
}

/// How many configurations are looked at, eight at a time; with less work each, about a tenth of a
/// second in all.
const CONFIGURATIONS: u64 = 96;
const WORK: u64 = 100_000_000;

fn check(context: &Context, findings: &mut Findings) {
    // Without simple skips, those that no edit is about are in the other module, with others.
    let modules = [
        ModuleKind::LinkShapesSimpleSkips,
        ModuleKind::LinkShapesSkips,
    ];
    let usable = modules.into_iter().find_map(|kind| {
        let document = context.document(kind)?;
        Some((context.module(kind)?, document, skips(document)?))
    });
    let (Some((module, document, six)), Some(shapes)) = (usable, context.shapes()) else {
        return;
    };
    let Some(edited) = edited(context, document) else {
        return findings.skip(SkipReason::EditsNotRecorded);
    };
    let poses = match Poses::new(context) {
        Ok(poses) => poses,
        Err(reason) => return findings.skip(reason),
    };
    let statistics = context
        .document(ModuleKind::LinkShapesDistanceStatistics)
        .and_then(statistics);
    let sampled = statistics.and_then(|six| six.iter().flatten().find_map(|one| one.num_samples));
    let mut skipped = Vec::new();
    for (kind, rows) in ShapeKind::ALL.into_iter().zip(six) {
        let Some(rows) = rows else {
            continue;
        };
        skipped.push((kind, pairs(rows, &shapes, kind, &poses, &edited)));
    }
    let work: u64 = skipped
        .iter()
        .map(|(_, pairs)| pairs.len() as u64 * plan::HULL)
        .sum();
    let eights = (WORK / (8 * work.max(1))).clamp(1, CONFIGURATIONS / 8);
    let n = u32::try_from(8 * eights).unwrap_or(8);
    let motion = match poses.motion(0..sampled.map_or(n, |sampled| n.min(sampled.max(1)))) {
        Ok(motion) => motion,
        Err(reason) => return findings.skip(reason),
    };
    let known = context.distances().ok();
    let known = |kind: ShapeKind| {
        let of = known?.kinds().iter().flatten();
        of.map(|of| of.shapes()).find(|set| set.kind() == kind)
    };
    for (kind, pairs) in skipped {
        if pairs.is_empty() {
            continue;
        }
        let made;
        let set = match known(kind) {
            Some(set) => set,
            None => {
                made = ShapeSet::new(context, context.solids(), &shapes, kind, false);
                &made
            }
        };
        let tolerances = Tolerances::new(context, context.solids(), &shapes, kind);
        let judged = judged::shapes(context, findings, &shapes, kind);
        let judged = |shape: usize| judged.get(shape).copied().unwrap_or(true);
        let mut fold = Fold::new(findings);
        let by_reason = OtherReasons::new(context, document, &poses, set);
        for (i, j) in pairs {
            if by_reason.may_skip(&shapes, (i, j)) {
                continue;
            }
            let pair = set.pair(i, j, &motion).filter(|_| judged(i) && judged(j));
            let Some(distances) = pair else {
                continue;
            };
            let apart = CONTACT + tolerances.pair(i, j);
            let met = distances.iter().position(|distance| *distance <= CONTACT);
            let mut numbered = distances.iter().enumerate();
            let farthest = numbered.by_ref().max_by(|a, b| a.1.total_cmp(b.1));
            let (Some(met), Some((parted, most))) = (met, farthest.filter(|(_, d)| **d > apart))
            else {
                continue;
            };
            fold.add(|| {
                Finding::at(
                    module.file("module.json"),
                    format!("{}/{i}/{j}", skips_pointer(document, kind)),
                    format!(
                        "shapes {} and {} are skipped, and are in contact in sampled configuration {met} and {} apart in {parted}",
                        shapes.describe(context, kind, i),
                        shapes.describe(context, kind, j),
                        metres(*most)
                    ),
                )
                .expected(false)
                .actual(true)
            });
        }
        fold.finish();
    }
}

/// The pairs of links that a person's edits are about; `None` where these are not recorded.
fn edited(context: &Context, document: &ModuleDocument) -> Option<HashSet<(usize, usize)>> {
    let ModuleDocument::LinkShapesSkips(module) = document else {
        let recorded = !matches!(document, ModuleDocument::LegacyLinkShapesSkips(_));
        return recorded.then(HashSet::new);
    };
    let robot = context.robot()?;
    let links = module.edits.iter().filter_map(|edit| {
        let (a, b) = (robot.link(&edit.link_a)?, robot.link(&edit.link_b)?);
        Some((a.min(b), a.max(b)))
    });
    Some(links.collect())
}

/// The pairs that are skipped and can move against each other, but for those of edits.
fn pairs(
    rows: &[Vec<bool>],
    shapes: &Shapes,
    kind: ShapeKind,
    poses: &Poses,
    edited: &HashSet<(usize, usize)>,
) -> Vec<(usize, usize)> {
    let tangled = Tangled::new(Elements::Skips(rows));
    let mut pairs = Vec::new();
    for i in 0..rows.len() {
        for j in i + 1..rows.len() {
            // A pair whose two elements differ is SHP006's.
            if at(rows, i, j) != Some(true) || at(rows, j, i) != Some(true) || tangled.pair(i, j) {
                continue;
            }
            if let (Some(a), Some(b)) = (shapes.link(kind, i), shapes.link(kind, j))
                && !poses.is_rigid(a, b)
                && !edited.contains(&(a.min(b), a.max(b)))
            {
                pairs.push((i, j));
            }
        }
    }
    pairs
}

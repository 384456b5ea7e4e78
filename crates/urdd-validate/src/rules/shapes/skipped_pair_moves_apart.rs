use crate::reference::distances::plan;
use crate::reference::distances::poses::Poses;
use crate::reference::distances::shape_set::ShapeSet;
use crate::rules::prelude::*;
use crate::views::judged::JudgedShapes;
use crate::views::tangled::{CONTACT, sound_pairs};
use urdd_document::shape_matrices::{Elements, at, skips, skips_pointer};
use urdd_document::shapes::Shapes;
use urdd_format::link_shapes_skips::SkippedReason;

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
        AnyModule(&[Kind::LinkShapesSimpleSkips, Kind::LinkShapesSkips]), Module(Kind::Urdf), Module(Kind::Dof),
        Module(Kind::Chain), Module(Kind::Bounds), Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesApproximations), POSES_KNOWN,
        BOUNDS_SOUND_IN_VERSION_1, PIECES_LISTED, OWN_FILES_IN_VERSION_1, SHAPES_LISTED, NotFailed(SHP003),
        Passed(SHP005), NotFailed(SHP010),
        // Their faults make skips wrong too.
        NotFailedInV1(SHP017), NoneFailed(&[SHP011, SHP013, SHP023, SHP024]),
    ],
}

/// Number of configurations, eight at a time. Fewer if they take more work than this; in total about a tenth of a second.
const CONFIGURATIONS: u64 = 96;
const WORK: u64 = 100_000_000;

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    // Without simple skips, the other module contains those that no edit is about, among others.
    let modules = [Kind::LinkShapesSimpleSkips, Kind::LinkShapesSkips];
    let (_, module, document) = context.documents(&modules).next()?;
    let shapes = context.shapes()?;
    let edited = edited(context, document).ok_or(skip::EDITS_NOT_RECORDED);
    let edited = findings.or_skip(edited)?;
    let poses = findings.or_skip(Poses::new(context))?;
    let mut skipped = Vec::new();
    for (kind, rows) in by_kind(skips(document)?) {
        skipped.push((kind, movable_pairs(rows, &shapes, kind, &poses, &edited)));
    }
    let statistics = context.statistics().into_iter().flatten().flatten();
    let sampled = statistics.into_iter().find_map(|one| one.num_samples);
    let pairs: usize = skipped.iter().map(|(_, pairs)| pairs.len()).sum();
    let work = pairs as u64 * plan::HULL;
    let eights = (WORK / (8 * work.max(1))).clamp(1, CONFIGURATIONS / 8);
    let n = u32::try_from(8 * eights).unwrap_or(8);
    let n = sampled.map_or(n, |sampled| n.min(sampled.max(1)));
    let motion = findings.or_skip(poses.motion(0..n))?;
    let known = context.distances().ok();
    let known = |kind: ShapeKind| {
        let mut known = known?.kinds.iter().flatten().map(|of| &of.shapes);
        known.find(|set| set.kind == kind)
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
        let judged = JudgedShapes::new(context, findings, &shapes, kind);
        let by_reason = OtherReasons::new(context, document, &poses, set);
        let mut fold = Fold::new(findings);
        for (i, j) in pairs {
            if by_reason.may_skip(&shapes, (i, j)) || !judged.pair(i, j) {
                continue;
            }
            let Some(distances) = set.pair(i, j, &motion) else { continue };
            let apart = CONTACT + tolerances.pair(i, j);
            let met = distances.iter().position(|distance| *distance <= CONTACT);
            let farthest = distances.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
            let farthest = farthest.filter(|(_, distance)| **distance > apart);
            if let Some((met, (parted, most))) = met.zip(farthest) {
                fold.add(|| {
                    let [a, b] = [i, j].map(|shape| shapes.describe(context, kind, shape));
                    let pointer = format!("{}/{i}/{j}", skips_pointer(document, kind));
                    let message = format!(
                        "shapes {a} and {b} are skipped, and are in contact in sampled configuration {met} and {} apart in {parted}",
                        metres(*most)
                    );
                    finding_in(module, pointer, message).values(false, true)
                });
            }
        }
    }
    Some(())
}

/// The pairs of links that edits are about; `None` if edits are not recorded.
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

/// The skipped pairs that can move relative to each other, without those of edits.
fn movable_pairs(
    rows: &[Vec<bool>],
    shapes: &Shapes,
    kind: ShapeKind,
    poses: &Poses,
    edited: &HashSet<(usize, usize)>,
) -> Vec<(usize, usize)> {
    let skipped = sound_pairs(rows, Elements::Skips).filter(|(_, _, skip)| *skip);
    let movable = skipped.filter(|(i, j, _)| {
        let links = shapes.link(kind, *i).zip(shapes.link(kind, *j));
        links.is_some_and(|(a, b)| !poses.is_rigid(a, b) && !edited.contains(&(a.min(b), a.max(b))))
    });
    movable.map(|(i, j, _)| (i, j)).collect()
}

/// The reasons other than `Always` for which `link_shapes_skips_module` may skip a pair.
struct OtherReasons<'a> {
    set: &'a ShapeSet,
    /// The pairs of links connected by a joint, if these are skipped.
    adjacent: HashSet<(usize, usize)>,
    /// The distances in the default configuration, if pairs in contact there are skipped.
    at_default: Option<Vec<Vec<f64>>>,
}

impl<'a> OtherReasons<'a> {
    fn new(context: &Context, document: &ModuleDocument, poses: &Poses, set: &'a ShapeSet) -> Self {
        let skipped = |reason: SkippedReason| match document {
            ModuleDocument::LinkShapesSkips(module) => module.skipped_reasons.contains(&reason),
            _ => false,
        };
        let chain = context.chain().filter(|_| skipped(SkippedReason::Adjacent));
        let joints = chain.iter().flat_map(|chain| &chain.joints_in_chain);
        let adjacent = joints.map(|joint| {
            let (a, b) = (joint.parent_link_idx.get(), joint.child_link_idx.get());
            (a.min(b), a.max(b))
        });
        let motion = poses.default_motion().ok().filter(|_| skipped(SkippedReason::Default));
        OtherReasons {
            set,
            adjacent: adjacent.collect(),
            at_default: motion.map(|motion| set.statistics(&motion).min),
        }
    }

    /// Whether a pair may be skipped for one of these reasons.
    fn may_skip(&self, shapes: &Shapes, (i, j): (usize, usize)) -> bool {
        let kind = self.set.kind;
        let links = shapes.link(kind, i).zip(shapes.link(kind, j));
        let adjacent = links.is_some_and(|(a, b)| self.adjacent.contains(&(a.min(b), a.max(b))));
        let places = self.set.place(i).zip(self.set.place(j));
        let distance =
            (self.at_default.as_ref().zip(places)).and_then(|(rows, (a, b))| at(rows, a, b));
        // A pair within the tolerance may be skipped.
        adjacent || distance.is_some_and(|distance| distance <= 2.0 * CONTACT)
    }
}

use crate::reference::distances::ShapeSet;
use crate::reference::samples::{self, Poses};
use crate::rules::prelude::*;
use crate::rules::shapes::reasons::{joined, ordered};
use crate::views::judged::JudgedShapes;
use crate::views::tangled::{CONTACT, Tangled, of_pair, sound_pairs};
use urdd_document::shape_matrices::{Elements, at, reasons, skips, skips_pointer};
use urdd_document::shapes::Shapes;
use urdd_format::link_shapes_skips::SkippedReason;

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
    ], check skipped_pair_moves_apart,
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
            last.insert(ordered(a, b), (place, edit.skip));
        }
    }
    let simple = reasons(context.document(Kind::LinkShapesSimpleSkips)?)?;
    for ((kind, simple), rows) in ShapeKind::ALL.into_iter().zip(simple).zip(skips(document)?) {
        let (Some(simple), Some(rows)) = (simple, rows) else { continue };
        let tangled_simple = Tangled::new(Elements::Reasons(simple));
        let mut fold = Fold::new(findings);
        for (i, j, skip) in sound_pairs(rows, Elements::Skips) {
            let Some((a, b)) = shapes.link(kind, i).zip(shapes.link(kind, j)) else { continue };
            let edit = last.get(&ordered(a, b)).copied();
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

/// Number of configurations, eight at a time. Fewer if they take more work than this; in total about a tenth of a second.
const CONFIGURATIONS: u64 = 96;
const WORK: u64 = 100_000_000;

fn skipped_pair_moves_apart(context: &Context, findings: &mut Findings) -> Option<()> {
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
    let work = pairs as u64 * samples::HULL;
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
        let made = match known(kind) {
            Some(_) => None,
            None => Some(ShapeSet::new(context, context.solids(), &shapes, kind, false)),
        };
        let Some(set) = known(kind).or(made.as_ref()) else { continue };
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
    let links = module
        .edits
        .iter()
        .filter_map(|edit| Some(ordered(robot.link(&edit.link_a)?, robot.link(&edit.link_b)?)));
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
        links.is_some_and(|(a, b)| !poses.is_rigid(a, b) && !edited.contains(&ordered(a, b)))
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
        let motion = poses.default_motion().ok().filter(|_| skipped(SkippedReason::Default));
        OtherReasons {
            set,
            adjacent: chain.map(joined).unwrap_or_default(),
            at_default: motion.map(|motion| set.statistics(&motion).min),
        }
    }

    /// Whether a pair may be skipped for one of these reasons.
    fn may_skip(&self, shapes: &Shapes, (i, j): (usize, usize)) -> bool {
        let kind = self.set.kind;
        let links = shapes.link(kind, i).zip(shapes.link(kind, j));
        let adjacent = links.is_some_and(|(a, b)| self.adjacent.contains(&ordered(a, b)));
        let places = self.set.place(i).zip(self.set.place(j));
        let distance =
            (self.at_default.as_ref().zip(places)).and_then(|(rows, (a, b))| at(rows, a, b));
        // A pair within the tolerance may be skipped.
        adjacent || distance.is_some_and(|distance| distance <= 2.0 * CONTACT)
    }
}

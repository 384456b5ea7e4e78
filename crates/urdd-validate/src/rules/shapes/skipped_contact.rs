use crate::distances::plan;
use crate::distances::poses::Poses;
use crate::rules::prelude::*;
use crate::views::tangled::sound_pairs;
use urdd_document::shape_matrices::{Elements, reasons, skips, skips_pointer};
use urdd_format::link_shapes_simple_skips::SkipReason as PairReason;

declare_rule! {
    /// A pair of links is skipped because it touches in the default configuration, and is apart in others.
    ///
    /// Programs that check for self-collision leave the pair out. Where the two meet again, a
    /// configuration counts as free and the robot hits itself. Of some robots that is as wanted:
    /// neighbours whose hulls always nearly touch. Of others the default configuration is just not
    /// one that the robot can have.
    ///
    /// The message says in how many of the sampled configurations the two touch. To check the
    /// pair, add an edit with `"skip": false`. To skip it knowingly, add one with `"skip": true` and
    /// the reason. `urdd generate --reference NAME` takes a named configuration instead of the
    /// default one.
    SHP028 "skipped-contact", Info, clause "8.7", since "1.3.0",
    phase Statistics, needs [
        Module(Kind::Urdf), Module(Kind::Dof), Module(Kind::Chain), Module(Kind::Bounds),
        Module(Kind::ConvexHullMeshes), Module(Kind::ConvexDecompositionMeshes),
        Module(Kind::LinkShapesApproximations), Module(Kind::LinkShapesDistanceStatistics),
        ModuleV1(Kind::LinkShapesSimpleSkips), ModuleV1(Kind::LinkShapesSkips),
        NoneFailed(&[DIR030, SHP012, SHP013, SHP014, SHP024, SHP026]), POSES_KNOWN, BOUNDS_SOUND,
        PIECES_LISTED, NoneFailed(&[MSH005, MSH017, MSH018, MSH019, MSH020, MSH021, MSH022]), SHAPES_LISTED,
        NotFailed(SHP003), Passed(SHP005), NoneFailed(&[SHP010, SHP016]),
    ],
}

/// Number of configurations, eight at a time. Fewer if they take more work than this; about a tenth of a second.
const CONFIGURATIONS: u64 = 1000;
const WORK: u64 = 100_000_000;

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let module = document!(context, LinkShapesSkips)?;
    let document = context.document(Kind::LinkShapesSkips)?;
    let shapes = context.shapes()?;
    let distances = findings.or_skip(context.distances())?;
    let six = reasons(context.document(Kind::LinkShapesSimpleSkips)?)?;
    let skipped = skips(document)?;
    // Pieces are the kind to check where they are there.
    let kinds = [ShapeKind::Pieces, ShapeKind::Hulls];
    let (kind, rows, skipped, set) = kinds.into_iter().find_map(|kind| {
        let set = &distances.kinds[kind as usize].as_ref()?.shapes;
        Some((kind, six[kind as usize]?, skipped[kind as usize]?, set))
    })?;
    let robot = context.robot()?;
    let decided: HashSet<(usize, usize)> = (module.edits.iter())
        .filter_map(|edit| {
            let (a, b) = (robot.link(&edit.link_a)?, robot.link(&edit.link_b)?);
            Some((a.min(b), a.max(b)))
        })
        .collect();
    let mut pairs: BTreeMap<(usize, usize), Vec<(usize, usize)>> = BTreeMap::new();
    let mut always = HashSet::new();
    for (i, j, reason) in sound_pairs(rows, Elements::Reasons) {
        let is_skipped = skipped.get(i).and_then(|row| row.get(j)) == Some(&true);
        if matches!(reason, PairReason::Default | PairReason::Always) {
            let (a, b) = (shapes.link(kind, i)?, shapes.link(kind, j)?);
            let links = (a.min(b), a.max(b));
            if reason == PairReason::Always {
                always.insert(links);
            } else if is_skipped {
                pairs.entry(links).or_default().push((i, j));
            }
        }
    }
    pairs.retain(|links, _| !decided.contains(links) && !always.contains(links));
    let of_shapes: usize = pairs.values().map(Vec::len).sum();
    let work = of_shapes as u64 * plan::HULL;
    let eights = (WORK / (8 * work.max(1))).clamp(1, CONFIGURATIONS / 8);
    let statistics = context.statistics().into_iter().flatten().flatten();
    let sampled = statistics.into_iter().find_map(|one| one.num_samples)?;
    let n = u32::try_from(8 * eights).unwrap_or(8).min(sampled);
    let motion = findings.or_skip(Poses::new(context).and_then(|poses| poses.motion(0..n)))?;
    let mut fold = Fold::new(findings);
    for ((a, b), of_links) in pairs {
        let mut touches = vec![false; n as usize];
        for (i, j) in &of_links {
            for (touches, distance) in
                touches.iter_mut().zip(set.pair(*i, *j, &motion).unwrap_or_default())
            {
                *touches |= distance <= 0.0;
            }
        }
        let touching = touches.iter().filter(|touches| **touches).count();
        // Links that touch in all samples are as those that always do.
        if touching == touches.len() {
            continue;
        }
        fold.add(|| {
            let [a, b] = [a, b].map(|link| robot.links[link].name.as_str());
            let (i, j) = of_links[0];
            let message = format!(
                "links `{a}` and `{b}` touch in the default configuration and are skipped; they touch in {touching} of {n} sampled configurations, which count as free"
            );
            finding_in(Kind::LinkShapesSkips, format!("{}/{i}/{j}", skips_pointer(document, kind)), message)
        });
    }
    Some(())
}

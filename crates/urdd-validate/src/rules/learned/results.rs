//! What the model is of, what it gives, and how often that is right.

use sha2::{Digest, Sha256};

use crate::reference::learned::{self, Network, PER_TOLERANCE};
use crate::rules::prelude::*;
use urdd_document::meshes::MeshFormat;
use urdd_format::index::Count;
use urdd_format::rate::Rate;
use urdd_format::self_collision_model::{
    CONFIRMATION_COUNT, CONFIRMATION_FIRST, EVALUATION_COUNT, EVALUATION_FIRST, EVALUATION_MIN,
    SampleRange,
};

declare_rule! {
    /// The self-collision model was trained on another robot, other pieces or other skips than those that are here.
    ///
    /// Its clearances are of what was there then, and so are the rates that it states.
    ///
    /// Train it again: `urdd generate --modules all,self_collision_model`. After an edit of the skips a model is stale
    /// too. Another producer: `trained_on` is the digest that SPEC 8.8.7 defines.
    LRN006 "model-of-other-geometry", Error, clause "8.8.7", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::Dof), Module(Kind::Chain), Module(Kind::Bounds),
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesSkips), RootMetadata, Passed(DIR011),
        Passed(DIR014), POSES_KNOWN, BOUNDS_SOUND, PIECES_LISTED, NotFailed(SHP013),
    ], check other_geometry,

    /// The pairs of the self-collision model are not the pairs of links that are not skipped.
    ///
    /// A pair that is missing can collide without the model's knowledge; one too many makes free configurations count
    /// as collisions.
    ///
    /// List every pair of links of which two pieces are not skipped, in `pairs`, or, where it is never near, in
    /// `other_pairs`.
    LRN007 "model-pairs-differ", Error, clause "8.8.5", since "0.2.0",
    phase References, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesSkips), PIECES_LISTED, Passed(SHP005),
        NoneFailed(&[SHP010, SHP013, LRN001, LRN006]),
    ], check pairs_differ,

    /// The self-collision model does not give the clearances that its test vectors say.
    ///
    /// Either the network's numbers are not those that were trained, or the producer evaluates it otherwise than this
    /// specification says; then its counts are of something else too.
    ///
    /// Look at the order of the inputs, at the hyperbolic tangent after every layer but the last, and at the margin,
    /// which is subtracted. `examples/self_collision_model.py` is a short consumer to compare with.
    LRN008 "model-output-differs", Error, clause "8.8.6", since "0.2.0",
    phase Kinematics, needs [Version1, Module(Kind::SelfCollisionModel), Passed(LRN003), Passed(LRN004), Passed(LRN005)],
    check output_differs,

    /// The counts of the self-collision model cannot be: they are larger than what they count among, or the model was
    /// made on configurations that the specification keeps for counting.
    ///
    /// Rates on configurations that a model has seen say nothing about those that it has not.
    ///
    /// Take `training` and `calibration` from different parts of the sequence of SPEC 9.3, both below 2^31, and count
    /// again.
    LRN009 "model-counts-impossible", Error, clause "8.8.8", since "0.2.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel)], check counts_impossible,

    /// The rates of the self-collision model rest on too few collisions, or too few free configurations.
    ///
    /// Where 3 in 1,000 configurations collide, a model that clears everything is right in 997 of 1,000. Its miss rate is
    /// 100 %, and only many collisions show that.
    ///
    /// Leave the model out. It saves nothing for a robot that hardly ever collides with itself, or nearly always does.
    LRN012 "model-counts-few", Error, clause "8.8.9", since "1.0.0",
    phase References, needs [Version1, Module(Kind::SelfCollisionModel), Passed(LRN009)], check counts_few,

    /// The counts of the self-collision model are not those of the configurations that the specification fixes.
    ///
    /// A planner counts on the share of collisions that a model misses. SPEC 8.8.9 defines the configurations, so the
    /// validator counts all of them again.
    ///
    /// Count again, with the margins and numbers as they are in the document, the pairs and pieces of SPEC 8.8.5, and
    /// sampled configurations 2^31 to 2^31 + 49,999 of SPEC 9.3. Where the robot has so many convex pieces that counting
    /// takes too much work, the model is reported as not verified; `--deep` allows more.
    LRN010 "model-counts-differ", Error, clause "8.8.9", since "0.2.0",
    phase Statistics, needs [
        Version1, Module(Kind::SelfCollisionModel), Module(Kind::ConvexHullMeshes),
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesSkips), POSES_KNOWN, BOUNDS_SOUND,
        PIECES_LISTED, NoneFailed(&[MSH020, MSH021, MSH022]), Passed(LRN003), Passed(LRN004),
        Passed(LRN005), NoneFailed(&[LRN006, LRN007, LRN008]), Passed(LRN009), Passed(LRN012),
    ], check counts_differ,

    /// On other configurations the self-collision model is worse than it says.
    ///
    /// A producer can fit a model to the configurations that its counts are of. So the validator counts twice more: on
    /// configurations that the specification fixes, and on some that follow from the model's own numbers, which no
    /// training can know. The model is at fault where the 95 % intervals of the two rates do not overlap, and the rate
    /// that the validator finds is the worse.
    ///
    /// Train without the configurations from 2^31 on, and do not choose between models by them. The rates of about one
    /// in a hundred honest models are not confirmed by chance; train such a model again from other weights.
    LRN011 "model-rates-not-met", Error, clause "8.8.12", since "0.2.0",
    phase Statistics, needs [Version1, Module(Kind::SelfCollisionModel), Passed(LRN010)], check rates_not_met,
}

/// The modules whose documents are part of the digest.
const TRAINED_ON: [Kind; 4] = [Kind::Dof, Kind::Chain, Kind::Bounds, Kind::LinkShapesSkips];

fn other_geometry(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let metadata = context.metadata()?;
    let pieces = context.meshes(Kind::ConvexDecompositionMeshes)?;
    let documents = TRAINED_ON.map(|kind| format!("{}/module.json", kind.folder()));
    let glbs = pieces.paths().filter(|(_, path)| path.format == Some(MeshFormat::Glb));
    let glbs = glbs.map(|(_, path)| path.path.to_owned());
    let mut text = String::new();
    for path in documents.into_iter().chain(glbs) {
        let mut entries = metadata.modules.iter().flat_map(|module| &module.files);
        let Some(file) = entries.find(|file| file.path == path) else { return Some(()) };
        text += file.sha256.as_str();
        text.push('\n');
    }
    let expected = urdd_directory::writer::sha256(&Sha256::digest(text));
    if expected != model.trained_on {
        let message = "the model was trained on other files than those of this URDD";
        finding_in(Kind::SelfCollisionModel, "/trained_on", message)
            .values(expected.as_str(), model.trained_on.as_str())
            .report(findings);
    }
    Some(())
}

fn pairs_differ(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let expected: BTreeSet<[usize; 2]> = learned::not_skipped(context)?.into_iter().collect();
    let outputs = model.pairs.iter().map(|of| [of.link_a_idx.get(), of.link_b_idx.get()]);
    let others = model.other_pairs.iter().map(|of| [of.link_a_idx.get(), of.link_b_idx.get()]);
    let found: BTreeSet<[usize; 2]> = outputs.clone().chain(others.clone()).collect();
    let named = |[a, b]: [usize; 2]| {
        let (a, b) = (context.link_label(a), context.link_label(b));
        format!("{a} and {b}")
    };
    let outputs = outputs.enumerate().map(|(place, pair)| ("pairs", place, pair));
    let others = others.enumerate().map(|(place, pair)| ("other_pairs", place, pair));
    let mut fold = Fold::new(findings);
    for (list, place, pair) in outputs.chain(others) {
        if !expected.contains(&pair) {
            fold.add(|| {
                let message = format!("{} are skipped", named(pair));
                finding_in(Kind::SelfCollisionModel, format!("/{list}/{place}"), message)
            });
        }
    }
    drop(fold);
    let mut fold = Fold::new(findings);
    for pair in expected.difference(&found) {
        fold.add(|| {
            let message = format!("{} are not skipped, and not among the pairs", named(*pair));
            finding_in(Kind::SelfCollisionModel, "/pairs", message)
        });
    }
    Some(())
}

/// Tolerance of a clearance, as a fraction of the larger absolute value or of the clip distance.
const TOLERANCE: f64 = 1e-9;

fn output_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let network = Network::new(model);
    for (place, vector) in model.test_vectors.iter().enumerate() {
        let found = network.clearances(&vector.configuration);
        for (pair, (expected, actual)) in found.iter().zip(&vector.clearances).enumerate() {
            let scale = expected.abs().max(actual.abs());
            let tolerance = TOLERANCE * scale.max(model.clip_distance.abs());
            let off = actual - expected;
            // NaN is reported too.
            if off.abs() <= tolerance {
                continue;
            }
            let pointer = format!("/test_vectors/{place}/clearances/{pair}");
            let message = "this is not what the network gives in this configuration";
            finding_in(Kind::SelfCollisionModel, pointer, message)
                .values(expected, actual)
                .tolerance(tolerance)
                .off_by(off, "m")
                .report(findings);
            return Some(());
        }
    }
    Some(())
}

fn counts_impossible(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let stated = &model.evaluation;
    let all = u64::from(stated.num_colliding.0) + u64::from(stated.num_free.0);
    if all != u64::from(EVALUATION_COUNT) {
        let message = "`num_colliding` and `num_free` together are not all configurations";
        let finding = finding_in(Kind::SelfCollisionModel, "/evaluation", message);
        findings.report(finding.values(EVALUATION_COUNT, all));
    }
    let colliding = ("num_colliding", stated.num_colliding);
    let missed = ("num_missed", stated.num_missed);
    let near = ("num_near_contact", stated.num_near_contact);
    let near_missed = ("num_near_contact_missed", stated.num_near_contact_missed);
    let cleared = ("num_cleared", stated.num_cleared);
    let free = ("num_free", stated.num_free);
    for ((key, count), (what, most)) in [
        (missed, colliding),
        (near, colliding),
        (near_missed, near),
        (near_missed, missed),
        (cleared, free),
    ] {
        if count.0 > most.0 {
            let message = format!("this is more than `{what}`");
            let finding =
                finding_in(Kind::SelfCollisionModel, format!("/evaluation/{key}"), message);
            findings.report(finding.values(format!("at most {most}"), count));
        }
    }
    let range = |of: &SampleRange| {
        let first = u64::from(of.first_sample_idx.0);
        first..first + u64::from(of.num_configurations.0)
    };
    let (training, calibration) = (range(&model.training), range(&model.calibration));
    let mut report = |key: &str, message: &str| {
        finding_in(Kind::SelfCollisionModel, format!("/{key}"), message).report(findings);
    };
    for (key, range) in [("training", &training), ("calibration", &calibration)] {
        if range.is_empty() {
            report(key, "it has no configuration");
        } else if range.end > u64::from(EVALUATION_FIRST) {
            report(key, "configurations from 2^31 on are reserved for counting");
        }
    }
    if training.start < calibration.end && calibration.start < training.end {
        let message = "some of these configurations are also in `training`";
        report("calibration", message);
    }
    Some(())
}

fn counts_few(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let stated = &model.evaluation;
    for (key, what, count) in [
        ("num_colliding", "collisions", stated.num_colliding),
        ("num_free", "free configurations", stated.num_free),
    ] {
        if count.0 < EVALUATION_MIN {
            let message = format!("too few {what} to state a rate");
            finding_in(Kind::SelfCollisionModel, format!("/evaluation/{key}"), message)
                .values(format!("at least {EVALUATION_MIN}"), count)
                .report(findings);
        }
    }
    Some(())
}

fn counts_differ(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let judge = findings.or_skip(context.model_judge())?;
    let found = findings.or_skip(judge.count(EVALUATION_FIRST, EVALUATION_COUNT))?;
    let stated = &model.evaluation;
    let (colliding, near) = (found.num_colliding, found.num_near_contact);
    let (missed, near_missed) = (found.num_missed, found.num_near_contact_missed);
    let (cleared, free) = (found.num_cleared, found.num_free);
    for (key, stated, found, among) in [
        ("num_colliding", stated.num_colliding, colliding, EVALUATION_COUNT),
        ("num_missed", stated.num_missed, missed, colliding.0),
        ("num_near_contact", stated.num_near_contact, near, colliding.0),
        ("num_near_contact_missed", stated.num_near_contact_missed, near_missed, near.0),
        ("num_cleared", stated.num_cleared, cleared, free.0),
    ] {
        let pointer = format!("/evaluation/{key}");
        let kind = Kind::SelfCollisionModel;
        report_counted_again(kind, pointer, [stated, found], among, findings);
    }
    Some(())
}

/// Reports a number of configurations among so many, where counting again gives another one.
pub fn report_counted_again(
    kind: Kind,
    pointer: String,
    [stated, found]: [Count; 2],
    among: u32,
    findings: &mut Findings,
) {
    let tolerance = among.div_ceil(PER_TOLERANCE);
    if found.0.abs_diff(stated.0) > tolerance {
        let message = "counting these configurations again gives a different number";
        finding_in(kind, pointer, message)
            .values(found, stated)
            .tolerance(f64::from(tolerance))
            .report(findings);
    }
}

fn rates_not_met(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let judge = findings.or_skip(context.model_judge())?;
    let stated = &model.evaluation;
    for first in [CONFIRMATION_FIRST, learned::second_confirmation(model)] {
        let found = findings.or_skip(judge.count(first, CONFIRMATION_COUNT))?;
        let last = first + (CONFIRMATION_COUNT - 1);
        let mut report = |key: &str, what: &str, stated: Rate, found: Rate| {
            let message = format!("{what} on sampled configurations {first} to {last} than stated");
            finding_in(Kind::SelfCollisionModel, format!("/evaluation/{key}"), message)
                .values(found.to_string(), stated.to_string())
                .report(findings);
        };
        let (stated_misses, misses) = (stated.miss_rate(), found.miss_rate());
        if misses.is_above(&stated_misses) {
            let what = "the model misses more collisions";
            report("num_missed", what, stated_misses, misses);
        }
        let (stated_clears, clears) = (stated.clear_rate(), found.clear_rate());
        if stated_clears.is_above(&clears) {
            let what = "the model clears fewer free configurations";
            report("num_cleared", what, stated_clears, clears);
        }
    }
    Some(())
}

use sha2::{Digest, Sha256};

use crate::reference::learned::network::Network;
use crate::reference::learned::pairs;
use crate::rules::prelude::*;
use urdd_document::meshes::MeshFormat;

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
    let expected: BTreeSet<[usize; 2]> = pairs::not_skipped(context)?.into_iter().collect();
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

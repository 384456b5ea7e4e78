use sha2::{Digest, Sha256};

use crate::rules::prelude::*;
use urdd_document::meshes::Format;

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
    ],
}

/// The modules whose documents are part of the digest.
const TRAINED_ON: [Kind; 4] = [Kind::Dof, Kind::Chain, Kind::Bounds, Kind::LinkShapesSkips];

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let model = document!(context, SelfCollisionModel)?;
    let metadata = context.metadata()?;
    let pieces = context.meshes(Kind::ConvexDecompositionMeshes)?;
    let documents = TRAINED_ON.map(|kind| format!("{}/module.json", kind.folder()));
    let glbs = pieces.paths().filter(|(_, path)| path.format == Some(Format::Glb));
    let glbs = glbs.map(|(_, path)| path.path.to_owned());
    let mut text = String::new();
    for path in documents.into_iter().chain(glbs) {
        let mut entries = metadata.modules.iter().flat_map(|module| &module.files);
        let Some(file) = entries.find(|file| file.path == path) else {
            return Some(());
        };
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

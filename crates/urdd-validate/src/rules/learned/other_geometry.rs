use sha2::{Digest, Sha256};

use super::subject;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::meshes::Format;
use urdd_format::registry::ModuleKind;

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
        Module(Kind::ConvexDecompositionMeshes), Module(Kind::LinkShapesSkips), RootMetadata,
        Passed(DIR011), Passed(DIR014), POSES_KNOWN, BOUNDS_SOUND, PIECES_LISTED, NotFailed(SHP013),
    ],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some((module, model)), Some(metadata), Some(pieces)) = (
        subject(context),
        context.metadata(),
        context.meshes(ModuleKind::ConvexDecompositionMeshes),
    ) else {
        return;
    };
    let documents = [
        ModuleKind::Dof,
        ModuleKind::Chain,
        ModuleKind::Bounds,
        ModuleKind::LinkShapesSkips,
    ];
    let documents = documents.map(|kind| format!("{}/module.json", kind.folder()));
    let paths = pieces.paths().map(|(_, path)| path);
    let files = paths.filter(|path| path.format == Some(Format::Glb));
    let files = files.map(|path| path.path.to_owned());
    let mut text = String::new();
    for path in documents.into_iter().chain(files) {
        let entries = metadata.modules.iter().flat_map(|module| &module.files);
        let Some(file) = entries.into_iter().find(|file| file.path == path) else {
            return;
        };
        text += file.sha256.as_str();
        text.push('\n');
    }
    let expected = urdd_directory::writer::sha256(&Sha256::digest(text));
    if expected != model.trained_on {
        findings.report(
            Finding::at(
                module.file("module.json"),
                "/trained_on",
                "the model was trained on other files than those of this URDD",
            )
            .expected(expected.as_str())
            .actual(model.trained_on.as_str()),
        );
    }
}

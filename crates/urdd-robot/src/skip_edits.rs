//! The effect of a user's skip edits on a URDD.

use super::Robot;
use super::edited_files::Files;
use super::error::RobotError;
use super::robot::usable;
use super::shapes::ShapeKind;
use super::skips::Skips;
use urdd_format::link_shapes_skips::{LinkShapesSkipsModule, SkipEdit, SkippedReason};
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_format::skips::skips_module;

const SKIPS: ModuleKind = ModuleKind::LinkShapesSkips;
const SIMPLE: ModuleKind = ModuleKind::LinkShapesSimpleSkips;

/// A skips module with new edits, and the files of the URDD that change.
#[derive(Debug)]
pub struct EditedSkips {
    /// `link_shapes_skips_module`.
    pub module: LinkShapesSkipsModule,
    /// Changed files by path relative to the root: the module's JSON and YAML, and `urdd.json` with their sizes and
    /// hashes.
    pub files: Files,
    /// Whether the URDD has a self-collision model. It was trained with the previous skips and must be regenerated.
    pub model_is_stale: bool,
}

impl EditedSkips {
    /// The skips between shapes of a kind with the edits applied; `before` are those of the robot.
    pub fn skips(&self, kind: ShapeKind, before: &Skips) -> Skips {
        before.of_module(kind, self.module.clone())
    }
}

impl Robot {
    /// Replaces the URDD's skip edits and, if given, its skipped reasons. Returns the changed files and writes nothing.
    ///
    /// # Errors
    /// [`RobotError::Unknown`] if an edit names an unknown link; [`RobotError::Missing`] and [`RobotError::Unusable`]
    /// if `urdf_module`, `link_shapes_simple_skips_module` or `link_shapes_skips_module` of version 1 is missing or
    /// unusable; [`RobotError::Metadata`] if `urdd.json` is.
    pub fn with_skip_edits(
        &self,
        edits: Vec<SkipEdit>,
        skipped_reasons: Option<Vec<SkippedReason>>,
    ) -> Result<EditedSkips, RobotError> {
        let part = self.part(&[ModuleKind::Urdf, SIMPLE, SKIPS])?;
        let documents = (part.document(SIMPLE), part.document(SKIPS));
        let (
            Some(ModuleDocument::LinkShapesSimpleSkips(simple)),
            Some(ModuleDocument::LinkShapesSkips(now)),
        ) = documents
        else {
            usable(&part, SIMPLE)?;
            return Err(RobotError::Missing(SKIPS));
        };
        let described = part.robot().ok_or(RobotError::Missing(ModuleKind::Urdf))?;
        let links = described.links.iter();
        let names: Vec<String> = links.map(|link| link.name.clone()).collect();
        for edit in &edits {
            for link in [&edit.link_a, &edit.link_b] {
                if described.link(link).is_none() {
                    super::names::index("link", &names, link)?;
                }
            }
        }
        let reasons = skipped_reasons.unwrap_or_else(|| now.skipped_reasons.clone());
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let module = skips_module(simple, reasons, edits, &names);
        let files = self.edited_files(SKIPS, serde_json::to_value(&module))?;
        let model_is_stale = part.listing().has_folder(ModuleKind::SelfCollisionModel.folder());
        Ok(EditedSkips { module, files, model_is_stale })
    }
}

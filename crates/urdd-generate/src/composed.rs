//! A robot composed of other robots; `combine` writes its URDF.

use std::path::PathBuf;

use super::given::Given;
use urdd_format::composition::CompositionModule;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::named_configurations::ConfigurationEdit;

/// The inputs of a composed robot besides its URDF.
#[derive(Debug, Clone)]
pub struct Composed {
    /// The file name shown in notes and errors.
    pub shown: String,
    /// The folder that relative mesh file names refer to.
    pub folder: PathBuf,
    /// The skip edits of its parts. The edits of the URDD that is replaced follow them.
    pub edits: Vec<SkipEdit>,
    /// The named configurations of its parts. Those of the URDD that is replaced take precedence.
    pub configurations: Vec<ConfigurationEdit>,
    /// The skip reasons to use when no URDD is replaced and the settings give none.
    pub skipped_reasons: Option<Vec<SkippedReason>>,
    /// How the robot was composed: the content of its `composition_module`.
    pub composition: CompositionModule,
}

impl Composed {
    /// What its parts give.
    pub(super) fn given(&self) -> Given<'_> {
        Given {
            edits: &self.edits,
            configurations: &self.configurations,
            skipped_reasons: self.skipped_reasons.as_ref(),
            composition: Some(&self.composition),
            origin: None,
        }
    }
}

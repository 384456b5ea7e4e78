//! A robot composed of other robots; `combine` writes its URDF.

use std::collections::HashSet;
use std::path::PathBuf;

use super::donor::edits::Decisions;
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
    /// The user's decisions: those of the parts, then `there`, those of the URDD that is replaced; without one
    /// `is_new` is true.
    pub(super) fn decisions(&self, is_new: bool, mut there: Decisions) -> Decisions {
        if let (true, Some(reasons)) = (is_new, &self.skipped_reasons) {
            there.skipped_reasons.clone_from(reasons);
        }
        let words = |edit: &SkipEdit| {
            let [a, b, reason] = [&edit.link_a, &edit.link_b, &edit.reason].map(String::clone);
            (a, b, edit.skip, reason)
        };
        let own: HashSet<_> = self.edits.iter().map(words).collect();
        there.edits.retain(|edit| !own.contains(&words(edit)));
        there.edits.splice(..0, self.edits.iter().cloned());
        let names: HashSet<_> = there.configurations.iter().map(|edit| &edit.name).collect();
        let new = self.configurations.iter();
        let new: Vec<_> = new.filter(|edit| !names.contains(&edit.name)).cloned().collect();
        there.configurations.extend(new);
        there
    }
}

//! What comes with a robot besides its URDF: from its parts, or from the description that it was imported from.

use std::collections::HashSet;

use serde_json::Value;

use super::donor::edits::Decisions;
use urdd_format::composition::CompositionModule;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::named_configurations::ConfigurationEdit;

/// What comes with a robot besides its URDF.
#[derive(Default, Clone, Copy)]
pub(super) struct Given<'a> {
    /// Edits of skips. Those of the URDD that is replaced follow them.
    pub edits: &'a [SkipEdit],
    /// Named configurations. Those of the URDD that is replaced take precedence.
    pub configurations: &'a [ConfigurationEdit],
    /// The skip reasons to use when no URDD is replaced and the settings give none.
    pub skipped_reasons: Option<&'a Vec<SkippedReason>>,
    /// How the robot was composed, if it was.
    pub composition: Option<&'a CompositionModule>,
    /// The original, if the robot was imported.
    pub origin: Option<&'a Value>,
}

impl Given<'_> {
    /// The user's decisions: those given, then `there`, those of the URDD that is replaced; without one `is_new` is true.
    pub fn decisions(&self, is_new: bool, mut there: Decisions) -> Decisions {
        if let (true, Some(reasons)) = (is_new, self.skipped_reasons) {
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

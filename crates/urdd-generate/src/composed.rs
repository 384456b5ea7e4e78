//! A robot that was put together from others: `combine` writes its URDF.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::edits::Decisions;
use super::error::GenerateError;
use super::old::Old;
use super::robot::{Generated, Progress, make};
use super::settings::Settings;
use super::source;
use urdd_directory::path::portable;
use urdd_format::composition::CompositionModule;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};

/// What a robot that was put together has besides its URDF.
#[derive(Debug, Clone)]
pub struct Composed {
    /// What stands for the file in notes and errors.
    pub shown: String,
    /// The folder in which relative names of meshes begin.
    pub folder: PathBuf,
    /// Edits of skips that its parts have; edits of the URDD that is replaced come after them.
    pub edits: Vec<SkipEdit>,
    /// The reasons for which pairs are skipped, where there is no URDD that is replaced and the settings say
    /// nothing.
    pub skipped_reasons: Option<Vec<SkippedReason>>,
    /// How it was put together: what becomes its `composition_module`.
    pub composition: CompositionModule,
}

impl Composed {
    /// What people decided about the skips: those of the parts, and those of the URDD that is replaced.
    pub(super) fn decisions(&self, old: Option<&Old>, mut there: Decisions) -> Decisions {
        if let (None, Some(reasons)) = (old, &self.skipped_reasons) {
            there.skipped_reasons.clone_from(reasons);
        }
        let words = |edit: &SkipEdit| {
            let [a, b, reason] = [&edit.link_a, &edit.link_b, &edit.reason].map(String::clone);
            (a, b, edit.skip, reason)
        };
        let own: HashSet<_> = self.edits.iter().map(words).collect();
        there.edits.retain(|edit| !own.contains(&words(edit)));
        there.edits.splice(..0, self.edits.iter().cloned());
        there
    }
}

/// Makes a URDD of a robot that was put together, as [`generate_text`](super::generate_text) does of any;
/// the URDF is carried under the robot's name.
///
/// # Errors
/// As [`generate`](super::generate).
pub fn generate_composed(
    urdf: Vec<u8>,
    composed: &Composed,
    target: &Path,
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Generated, GenerateError> {
    let mut source = source::load_text(urdf, &composed.shown, &composed.folder)?;
    source.file_name = portable(&format!("{}.urdf", source.reading.robot.name));
    make(None, &source, Some(composed), target, settings, progress)
}

//! Which parts may be taken up.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::error::{CombineError, PartFault};
use super::recipe::Recipe;
use super::sources::SourceKind;
use crate::Settings;
use urdd_directory::cancellation::Cancelled;

/// Asks of each part that is a URDD which errors a validator finds in it, in words. Returns the ids of those in which it
/// finds any and that are taken all the same, with [`Settings::force`]: nothing of their URDDs is to be taken over.
///
/// # Errors
/// [`CombineError::Part`] for a part that is not there or may not be taken, and without `force` for one with errors;
/// where it is asked to stop.
pub fn check_parts(
    recipe: &Recipe,
    settings: &Settings,
    find_errors: impl Fn(&Path) -> Result<Vec<String>, Cancelled>,
) -> Result<BTreeSet<String>, CombineError> {
    let mut distrusted = BTreeSet::new();
    let mut known: BTreeMap<PathBuf, Vec<String>> = BTreeMap::new();
    for part in &recipe.parts {
        settings.cancellation.check().map_err(super::cancelled)?;
        let source = recipe.source(part, settings)?;
        if source.kind != SourceKind::Urdd {
            continue;
        }
        let codes = match known.get(&source.path) {
            Some(codes) => codes.clone(),
            None => find_errors(&source.path).map_err(super::cancelled)?,
        };
        known.insert(source.path, codes.clone());
        if codes.is_empty() {
            continue;
        }
        if !settings.force {
            return Err(CombineError::Part {
                id: part.id.text.clone(),
                source_path: part.source.display().to_string(),
                fault: PartFault::Fails { codes },
            });
        }
        distrusted.insert(part.id.text.clone());
    }
    Ok(distrusted)
}

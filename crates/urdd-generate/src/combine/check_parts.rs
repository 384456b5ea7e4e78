//! Checks the parts before they are used.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::error::{CombineError, PartFault};
use super::recipe::Recipe;
use super::sources::SourceKind;
use crate::Settings;
use urdd_directory::cancellation::Cancelled;

/// Validates each part that is a URDD: `find_errors` returns its errors as text. With [`Settings::force`], parts with
/// errors are accepted; their ids are returned, and their URDDs must not be reused.
///
/// # Errors
/// [`CombineError::Part`] for a part that is missing or may not be used, and without `force` for one with errors; an
/// error if cancelled.
pub fn check_parts(
    recipe: &Recipe,
    settings: &Settings,
    find_errors: impl Fn(&Path) -> Result<Vec<String>, Cancelled>,
) -> Result<BTreeSet<String>, CombineError> {
    let mut distrusted = BTreeSet::new();
    let mut known: BTreeMap<PathBuf, Vec<String>> = BTreeMap::new();
    for part in &recipe.parts {
        settings.cancellation.check()?;
        let source = recipe.source(part, settings)?;
        if source.kind != SourceKind::Urdd {
            continue;
        }
        let codes = match known.get(&source.path) {
            Some(codes) => codes.clone(),
            None => find_errors(&source.path)?,
        };
        known.insert(source.path, codes.clone());
        if codes.is_empty() {
            continue;
        }
        if !settings.force {
            return Err(part.refused(PartFault::Fails { codes }));
        }
        distrusted.insert(part.id.text.clone());
    }
    Ok(distrusted)
}

//! Which parts may be taken up.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::error::{CombineError, PartFault};
use super::part::{SourceKind, source_kind};
use super::recipe::Recipe;
use crate::cancellation::Cancelled;

/// Asks of each part that is a URDD which errors a validator finds in it, in words. Gives the ids of those in which it
/// finds any and that are taken all the same, with `force`: nothing of their URDDs is to be taken over.
///
/// # Errors
/// [`CombineError::Part`] for a part that is not there, and without `force` for one with errors; where it is asked to
/// stop.
pub fn check_parts(
    recipe: &Recipe,
    force: bool,
    find_errors: impl Fn(&Path) -> Result<Vec<String>, Cancelled>,
) -> Result<BTreeSet<String>, CombineError> {
    let mut distrusted = BTreeSet::new();
    let mut known: BTreeMap<PathBuf, Vec<String>> = BTreeMap::new();
    for part in &recipe.parts {
        let refused = |fault| CombineError::Part {
            id: part.id.text.clone(),
            source_path: part.source.display().to_string(),
            fault,
        };
        if source_kind(&part.source).map_err(refused)? != SourceKind::Urdd {
            continue;
        }
        let codes = match known.get(&part.source) {
            Some(codes) => codes.clone(),
            None => find_errors(&part.source).map_err(super::cancelled)?,
        };
        known.insert(part.source.clone(), codes.clone());
        if codes.is_empty() {
            continue;
        }
        if !force {
            return Err(refused(PartFault::Fails { codes }));
        }
        distrusted.insert(part.id.text.clone());
    }
    Ok(distrusted)
}

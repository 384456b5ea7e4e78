//! The reference configuration: a named configuration that takes the place of the default configuration where pairs of
//! links that touch are skipped. SPEC 8.6 knows the default configuration alone, so edits of skips say the rest.

use super::donor::edits::Decisions;
use super::error::ReferenceFault;
use super::named::Named;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::named_configurations::NamedConfiguration;
use urdd_format::short::Short;

/// The word for the default configuration, where no configuration has this name.
const DEFAULT: &str = "default";

/// The configuration of this name; `None` for the default configuration, or where none is asked for.
pub(super) fn of(
    name: Option<&str>,
    named: &Named,
) -> Result<Option<NamedConfiguration>, ReferenceFault> {
    let Some(name) = name else {
        return Ok(None);
    };
    if let Some((_, problem)) = named.lost.iter().find(|(of, _)| of == name) {
        return Err(ReferenceFault::Position(problem.clone()));
    }
    let all = &named.configurations;
    if let Some(found) = all.iter().find(|one| one.name.as_str() == name) {
        return Ok(Some(found.clone()));
    }
    if name == DEFAULT {
        return Ok(None);
    }
    let known = all.iter().map(|one| Short::of(one.name.as_str())).collect();
    Err(ReferenceFault::Unknown { name: Short::of(name), known })
}

/// A person's decisions without what followed from an earlier reference. Without a new one, pairs that touch in the default
/// configuration are skipped again.
pub(super) fn taken(mut decisions: Decisions, is_new: bool) -> Decisions {
    decisions.edits.retain(|edit| edit.reference().is_none());
    if !is_new {
        decisions.skipped_reasons.push(SkippedReason::Default);
    }
    decisions
}

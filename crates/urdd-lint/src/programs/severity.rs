//! How bad it is that programs do something.

use std::collections::HashSet;

use urdd_format::report::Severity;
use urdd_programs::Deed;

use super::faults::Said;

/// Whether a program has no robot because of it.
pub fn is_refused(said: &Said) -> bool {
    said.deed >= Deed::Refuses
}

/// Where the settings name programs (`has_chosen`): an error if one of these refuses the file, a warning if one reads it
/// otherwise, an information if only others do. Else an error if ROS or two of the others refuse it, or a warning.
pub fn severity(said: &[Said], has_chosen: bool) -> Severity {
    if !has_chosen {
        let refusing = said.iter().filter(|one| is_refused(one));
        let families: HashSet<&str> = refusing.map(|one| one.program.family()).collect();
        let is_error = families.contains("ROS") || families.len() > 1;
        return if is_error { Severity::Error } else { Severity::Warning };
    }
    let mut chosen = said.iter().filter(|one| one.is_chosen).peekable();
    match (chosen.peek().is_some(), chosen.any(is_refused)) {
        (_, true) => Severity::Error,
        (true, false) => Severity::Warning,
        (false, false) => Severity::Info,
    }
}

//! Orders the places of a finding.

use super::finding::{Finding, Place};

/// Puts the worst place of a finding first, by magnitude.
pub fn worst_first(finding: &mut Finding) {
    // A magnitude that is not finite is the worst.
    let size = |place: &Place| match &place.magnitude {
        None => f64::NEG_INFINITY,
        Some(magnitude) => magnitude.value.unwrap_or(f64::INFINITY),
    };
    finding.more.sort_by(|a, b| size(b).total_cmp(&size(a)));
    let Some(worst) = finding.more.first_mut() else {
        return;
    };
    if size(worst) > size(&finding.place) {
        std::mem::swap(&mut finding.place, worst);
        if let Some(message) = finding.place.message.take() {
            let first = std::mem::replace(&mut finding.message, message);
            for other in &mut finding.more {
                match &other.message {
                    None => other.message = Some(first.clone()),
                    Some(same) if *same == finding.message => other.message = None,
                    Some(_) => {}
                }
            }
        }
        // Sorts the former first place in among the others.
        finding.more.sort_by(|a, b| size(b).total_cmp(&size(a)));
    }
}

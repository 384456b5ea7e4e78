//! Which of many places of a finding comes first.

use super::finding::{Finding, Magnitude};

/// Puts the worst place of a finding first, where its places say how bad they are.
pub(super) fn worst_first(finding: &mut Finding) {
    let size = |magnitude: Option<Magnitude>| match magnitude {
        None => f64::NEG_INFINITY,
        // What is not a number at all is as bad as it gets.
        Some(Magnitude { value, .. }) if value.is_nan() => f64::INFINITY,
        Some(Magnitude { value, .. }) => value,
    };
    finding
        .more
        .sort_by(|a, b| size(b.magnitude).total_cmp(&size(a.magnitude)));
    let Some(worst) = finding.more.first_mut() else {
        return;
    };
    if size(worst.magnitude) > size(finding.magnitude) {
        std::mem::swap(&mut finding.place, &mut worst.place);
        std::mem::swap(&mut finding.expected, &mut worst.expected);
        std::mem::swap(&mut finding.actual, &mut worst.actual);
        std::mem::swap(&mut finding.magnitude, &mut worst.magnitude);
        if let Some(message) = worst.message.take() {
            let first = std::mem::replace(&mut finding.message, message);
            for other in &mut finding.more {
                match &other.message {
                    None => other.message = Some(first.clone()),
                    Some(same) if *same == finding.message => other.message = None,
                    Some(_) => {}
                }
            }
        }
        // The one that was first goes to its place among the others.
        finding
            .more
            .sort_by(|a, b| size(b.magnitude).total_cmp(&size(a.magnitude)));
    }
}

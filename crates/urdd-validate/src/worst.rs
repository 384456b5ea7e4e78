//! Orders the places of a finding.

use super::finding::{Finding, Place};

/// Puts the worst place of a finding first, by magnitude.
pub(super) fn worst_first(finding: &mut Finding) {
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

#[cfg(test)]
mod tests {
    use super::super::finding::Findings;
    use super::*;

    #[test]
    fn the_worst_place_comes_first() {
        let mut findings = Findings::default();
        for (i, off) in [(0, 0.2), (1, -0.7), (2, 0.1), (3, f64::NAN)] {
            let finding = Finding::at("a.json", format!("/m/{i}"), format!("{i} is wrong"));
            findings.report(finding.actual(i).off_by(off, "m"));
        }
        let mut findings = findings.take();
        findings.iter_mut().for_each(worst_first);
        let [found] = &findings[..] else { panic!("one finding") };
        assert_eq!(found.place.pointer.as_deref(), Some("/m/3"));
        assert_eq!(found.message, "3 is wrong");
        let others: Vec<_> = found.more.iter().map(|o| o.actual.as_deref()).collect();
        assert_eq!(others, [Some("1"), Some("0"), Some("2")]);
        let words: Vec<_> = found.more.iter().map(|o| o.message.as_deref()).collect();
        let expected = ["1 is wrong", "0 is wrong", "2 is wrong"].map(Some);
        assert_eq!(words, expected);
    }
}

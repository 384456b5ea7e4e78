//! Orders the places of a finding.

use super::finding::{Finding, Magnitude};

/// Puts the worst place of a finding first, if its places have magnitudes.
pub(super) fn worst_first(finding: &mut Finding) {
    let size = |magnitude: Option<Magnitude>| match magnitude {
        None => f64::NEG_INFINITY,
        // NaN is the worst.
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
        // The former first place moves to its position among the others.
        finding
            .more
            .sort_by(|a, b| size(b.magnitude).total_cmp(&size(a.magnitude)));
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
        let [found] = &findings[..] else {
            panic!("one finding")
        };
        assert_eq!(found.place.pointer.as_deref(), Some("/m/3"));
        assert_eq!(found.message, "3 is wrong");
        let others: Vec<_> = found.more.iter().map(|o| o.actual.as_deref()).collect();
        assert_eq!(others, [Some("1"), Some("0"), Some("2")]);
        let words: Vec<_> = found.more.iter().map(|o| o.message.as_deref()).collect();
        let expected = ["1 is wrong", "0 is wrong", "2 is wrong"].map(Some);
        assert_eq!(words, expected);
    }
}

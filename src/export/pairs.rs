//! Pairs of links that need no check.
//!
//! A URDD decides for pairs of shapes; most formats know links. Two links are in contact where a shape of the one is in
//! contact with a shape of the other: so a pair of links is `Always` in contact where one of their pairs of shapes is,
//! `Default` where one is in contact in the default configuration, and `Never` only where none ever was.

use std::collections::{BTreeMap, HashMap};

use crate::format::link_shapes_simple_skips::SkipReason;
use crate::format::link_shapes_skips::{SkipEdit, SkippedReason};
use crate::robot::{Robot, RobotError, ShapeKind};

/// Two links that both have shapes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LinkPair {
    /// Their indices, ascending.
    pub links: [usize; 2],
    /// Why; `None` where the URDD does not say.
    pub reason: Option<SkipReason>,
    /// What a person decided last.
    pub edit: Option<SkipEdit>,
    /// Whether it needs no check.
    pub disabled: bool,
    /// Whether it is disabled though the URDD checks some of its pairs of shapes.
    pub whole: bool,
}

/// Every pair of links with shapes, by index.
pub(super) fn pairs(
    robot: &Robot,
    names: &[String],
    kind: ShapeKind,
    reasons: Option<&[SkippedReason]>,
) -> Result<Vec<LinkPair>, RobotError> {
    let skips = robot.skips(kind)?;
    let chosen = reasons.or(skips.skipped_reasons());
    let index: HashMap<&str, usize> = names
        .iter()
        .enumerate()
        .map(|(link, name)| (name.as_str(), link))
        .collect();
    let mut last: HashMap<[usize; 2], &SkipEdit> = HashMap::new();
    for edit in skips.edits() {
        let ends = [&edit.link_a, &edit.link_b].map(|name| index.get(name.as_str()).copied());
        if let [Some(a), Some(b)] = ends {
            last.insert([a.min(b), a.max(b)], edit);
        }
    }
    let mut found: BTreeMap<[usize; 2], Vec<(Option<SkipReason>, bool)>> = BTreeMap::new();
    let places = skips.places();
    for i in 0..places.len() {
        for j in i + 1..places.len() {
            let (a, b) = (places[i].0, places[j].0);
            if a != b {
                let seen = (skips.reason(i, j), skips.is_skipped(i, j));
                found.entry([a.min(b), a.max(b)]).or_default().push(seen);
            }
        }
    }
    let pair = |(links, seen): ([usize; 2], Vec<(Option<SkipReason>, bool)>)| {
        let reason = together(seen.iter().map(|(reason, _)| *reason));
        let all_skipped = seen.iter().all(|(_, skipped)| *skipped);
        let edit = last.get(&links).map(|edit| (*edit).clone());
        let disabled = match (&edit, chosen, reason) {
            (Some(edit), _, _) => edit.skip,
            (None, Some(chosen), Some(reason)) => {
                chosen.iter().any(|skipped| skipped.of_pair() == reason)
            }
            _ => all_skipped,
        };
        LinkPair {
            links,
            reason,
            edit,
            disabled,
            whole: disabled && !all_skipped && reasons.is_none(),
        }
    };
    Ok(found.into_iter().map(pair).collect())
}

/// The reason of two links, out of those of their shapes.
fn together(reasons: impl Iterator<Item = Option<SkipReason>>) -> Option<SkipReason> {
    let reasons: Vec<SkipReason> = reasons.collect::<Option<_>>()?;
    let first = [
        SkipReason::Always,
        SkipReason::Adjacent,
        SkipReason::Default,
    ];
    let first = first.into_iter().find(|reason| reasons.contains(reason));
    let never = || reasons.iter().all(|reason| *reason == SkipReason::Never);
    Some(match first {
        Some(reason) => reason,
        None if never() => SkipReason::Never,
        None => SkipReason::None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use SkipReason::{Adjacent, Always, Default as Resting, Never, None as Sometimes};

    #[test]
    fn a_pair_of_links_is_what_its_shapes_make_it() {
        let of = |reasons: &[SkipReason]| together(reasons.iter().copied().map(Some));
        assert_eq!(of(&[Never, Never]), Some(Never));
        assert_eq!(of(&[Never, Sometimes]), Some(Sometimes));
        assert_eq!(of(&[Never, Resting, Sometimes]), Some(Resting));
        assert_eq!(of(&[Adjacent, Always]), Some(Always));
        assert_eq!(of(&[Adjacent, Adjacent]), Some(Adjacent));
        assert_eq!(together([Some(Never), None].into_iter()), None);
    }
}

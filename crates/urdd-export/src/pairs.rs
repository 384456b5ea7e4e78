//! Pairs of links that need no collision check.
//!
//! A URDD skips pairs of shapes; most formats skip pairs of links. Two links are in contact if any shape of one is in
//! contact with any shape of the other. So a pair of links is `Always` in contact if one of their pairs of shapes is,
//! `Default` if one is in contact in the default configuration, and `Never` only if none ever was.
//!
//! If the URDD skips some pairs of the links' shapes and checks others, the pair is *mixed*. A link-level format
//! disables it, or keeps it on request ([`Choices::keep_pairs`](crate::Choices::keep_pairs)). Either is wrong for some of the shapes.

use std::collections::{BTreeMap, HashMap};

use crate::Layout;
use urdd_directory::account::{Account, AccountError};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_robot::Skips;

/// Two links that both have shapes.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkPair {
    /// Their indices, ascending.
    pub links: [usize; 2],
    /// Their names, in the order of the indices.
    pub names: [String; 2],
    /// The skip reason; `None` if the URDD does not record one.
    pub reason: Option<SkipReason>,
    /// The user's last edit of the pair.
    pub edit: Option<SkipEdit>,
    /// Whether a link-level format disables the pair.
    pub disabled: bool,
    /// The pairs of shapes, if the pair is mixed.
    pub mixed: Option<MixedPair>,
}

/// A pair of links with both skipped and checked pairs of shapes. A pair of shapes is a piece of the first link and a
/// piece of the second.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MixedPair {
    /// The pairs of shapes that the URDD skips, sorted.
    pub skipped: Vec<[usize; 2]>,
    /// The pairs of shapes that it checks, sorted.
    pub checked: Vec<[usize; 2]>,
    /// The contacts in sampled configurations. `None` if not counted: for pairs that differ only by the reason `Never`,
    /// and without bounds.
    pub contacts: Option<Contacts>,
}

/// The numbers of sampled configurations (SPEC 9.3, from the first one on) in which shapes of two links touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Contacts {
    /// Configurations with a contact of shapes that the URDD checks.
    pub checked: usize,
    /// Configurations with a contact of shapes that the URDD skips.
    pub skipped: usize,
    /// Number of configurations evaluated.
    pub samples: u32,
}

/// The user's last edit of each pair of links, by their indices in `links`, ascending.
pub(super) fn last_edits<'e>(
    edits: &'e [SkipEdit],
    links: &[String],
) -> HashMap<[usize; 2], &'e SkipEdit> {
    let indices: HashMap<&str, usize> = links.iter().map(String::as_str).zip(0..).collect();
    let pair = |edit: &'e SkipEdit| {
        let [a, b] = [&edit.link_a, &edit.link_b].map(|name| indices.get(name.as_str()).copied());
        Some((ascending(a?, b?), edit))
    };
    edits.iter().filter_map(pair).collect()
}

pub(super) fn ascending(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// Decides on pairs of shapes: by the user's last edit, else by the requested reasons, else by the URDD.
pub(super) struct Decision<'a> {
    skips: &'a Skips,
    pub edits: HashMap<[usize; 2], &'a SkipEdit>,
    reasons: Option<&'a [SkippedReason]>,
}

impl<'a> Decision<'a> {
    pub fn new(skips: &'a Skips, links: &[String], reasons: Option<&'a [SkippedReason]>) -> Self {
        Decision { skips, edits: last_edits(skips.edits(), links), reasons }
    }

    pub fn is_skipped(&self, i: usize, j: usize) -> bool {
        let [a, b] = [i, j].map(|shape| self.skips.places()[shape].0);
        let edit = self.edits.get(&ascending(a, b));
        match (edit, self.reasons, self.skips.reason(i, j)) {
            (Some(edit), _, _) => edit.skip,
            (None, Some(reasons), Some(reason)) => has(reasons, reason),
            _ => self.skips.is_skipped(i, j),
        }
    }
}

fn has(reasons: &[SkippedReason], reason: SkipReason) -> bool {
    reasons.iter().any(|one| one.of_pair() == reason)
}

/// Charges the names in all pairs of shapes, and adds to the account what a URDD has of them: the names, and a number for each
/// pair. Names may be long: `bytes` is the sum of those of all shapes.
///
/// # Errors
/// If the account does not have what the pairs take, or the run was cancelled.
pub fn charge(bytes: usize, shapes: usize, account: &Account) -> Result<(), AccountError> {
    /// In memory, in elements and in the text.
    const COPIES: usize = 4;
    /// Bytes of a pair in a module, at least.
    const PAIR: usize = 4;
    account.deposit(bytes.saturating_add(shapes.saturating_mul(shapes).saturating_mul(PAIR)));
    account.charge(bytes.saturating_mul(shapes).saturating_mul(COPIES))
}

/// Every pair of links with shapes, sorted by index. Does not count contacts.
pub(super) fn pairs(
    skips: &Skips,
    layout: &Layout,
    names: &[String],
    reasons: Option<&[SkippedReason]>,
    keep_pairs: bool,
    account: &Account,
) -> Result<Vec<LinkPair>, AccountError> {
    let places = skips.places();
    charge(places.iter().map(|(link, _)| names[*link].len()).sum(), places.len(), account)?;
    let decision = Decision::new(skips, names, reasons);
    let chosen = reasons.or(skips.skipped_reasons());
    let mut found: BTreeMap<[usize; 2], Vec<Seen>> = BTreeMap::new();
    for i in 0..places.len() {
        for j in i + 1..places.len() {
            let [a, b] = [i, j].map(|shape| layout.shape(places[shape]));
            let [first, second] = if a.0 < b.0 { [a, b] } else { [b, a] };
            let links = [first.0, second.0];
            if links[0] == links[1] {
                continue;
            }
            let edit = decision.edits.get(&ascending(places[i].0, places[j].0));
            found.entry(links).or_default().push(Seen {
                pieces: [first.1, second.1],
                reason: skips.reason(i, j),
                skipped: decision.is_skipped(i, j),
                is_asked_for: edit.is_some_and(|edit| !edit.skip),
            });
        }
    }
    let pair = |(links, seen): ([usize; 2], Vec<Seen>)| {
        let reason = together(seen.iter().map(|seen| seen.reason));
        let mixed = mixed(&seen);
        let disabled = match mixed {
            None => seen.iter().all(|seen| seen.skipped),
            Some(_) => {
                let is_chosen = |(reasons, reason)| has(reasons, reason);
                let is_kept = keep_pairs || seen.iter().any(|seen| seen.is_asked_for);
                !is_kept && chosen.zip(reason).is_some_and(is_chosen)
            }
        };
        Some(LinkPair {
            links,
            names: [names.get(links[0])?.clone(), names.get(links[1])?.clone()],
            reason,
            edit: decision.edits.get(&links).map(|edit| (*edit).clone()),
            disabled,
            mixed,
        })
    };
    Ok(found.into_iter().filter_map(pair).collect())
}

struct Seen {
    pieces: [usize; 2],
    reason: Option<SkipReason>,
    skipped: bool,
    /// Whether a person wants it checked: of joined links, one edit need not be of all.
    is_asked_for: bool,
}

fn mixed(seen: &[Seen]) -> Option<MixedPair> {
    let of = |skipped: bool| {
        let some = seen.iter().filter(|seen| seen.skipped == skipped);
        let mut pieces: Vec<[usize; 2]> = some.map(|seen| seen.pieces).collect();
        pieces.sort_unstable();
        pieces
    };
    let (skipped, checked) = (of(true), of(false));
    (!skipped.is_empty() && !checked.is_empty()).then_some(MixedPair {
        skipped,
        checked,
        contacts: None,
    })
}

/// The reason of two links, combined from those of their shapes.
pub fn together(reasons: impl Iterator<Item = Option<SkipReason>>) -> Option<SkipReason> {
    let reasons: Vec<SkipReason> = reasons.collect::<Option<_>>()?;
    let first = [SkipReason::Always, SkipReason::Adjacent, SkipReason::Default];
    let first = first.into_iter().find(|reason| reasons.contains(reason));
    let never = || reasons.iter().all(|reason| *reason == SkipReason::Never);
    Some(match first {
        Some(reason) => reason,
        None if never() => SkipReason::Never,
        None => SkipReason::None,
    })
}

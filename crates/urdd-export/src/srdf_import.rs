//! Imports an SRDF as skip edits.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use urdd_xml::Node;

use super::error::unknown;
use super::pairs::{ascending, last_edits};
use crate::{LeftOut, Srdf, SrdfError};
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_robot::{Robot, RobotError, ShapeKind};

/// A robot's edits after an SRDF import.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedSkips {
    /// The existing edits, in their order, followed by those of the SRDF.
    pub edits: Vec<SkipEdit>,
    /// Number of edits that the SRDF adds.
    pub added: usize,
    /// Number of pairs of the SRDF that need no edit.
    pub already: usize,
    /// Number of pairs that the URDD skips and the SRDF does not list: they stay skipped.
    pub unlisted: usize,
    /// The elements of the SRDF that were left out, as MoveIt does: each with its line and what is wrong.
    pub wrong: Vec<String>,
}

/// Reads an SRDF: `<disable_collisions>`, `<disable_default_collisions>` and `<enable_collisions>`, in the order in
/// which MoveIt applies them. Existing edits remain. If one contradicts the SRDF, `force` lets the SRDF override it. Elements
/// without a link, or with one that the robot does not have, are left out.
///
/// # Errors
/// If the text is not an SRDF of the robot, or contradicts an edit without `force`.
pub fn import_srdf(robot: &Robot, text: &str, force: bool) -> Result<ImportedSkips, SrdfError> {
    let srdf = Srdf::of(text, &robot.description()?.name)?;
    let links = robot.link_names()?;
    let by_name: HashMap<&str, usize> = links.iter().map(String::as_str).zip(0..).collect();
    let mut wrong = LeftOut::new(&srdf);
    let mut link = |node: Node, attribute: &'static str| {
        let name = wrong.attribute(node, attribute)?;
        let known = by_name.get(name).copied();
        if known.is_none() {
            let all = links.iter().map(String::as_str);
            wrong.add(node, ("link", name), || unknown("link", name, all));
        }
        known
    };
    // Pairs of links, lower index first: whether they are skipped, and why.
    let mut wanted: BTreeMap<[usize; 2], (bool, String)> = BTreeMap::new();
    let mut defaults = BTreeSet::new();
    for node in srdf.elements("disable_default_collisions") {
        defaults.extend(link(node, "link"));
    }
    for of in defaults {
        for other in (0..links.len()).filter(|other| *other != of) {
            wanted.insert(ascending(of, other), (true, "SRDF: default".to_owned()));
        }
    }
    for (name, skip) in [("enable_collisions", false), ("disable_collisions", true)] {
        for node in srdf.elements(name) {
            let (Some(a), Some(b)) = (link(node, "link1"), link(node, "link2")) else {
                continue;
            };
            let reason = match node.attribute("reason") {
                Some(reason) if !reason.trim().is_empty() => format!("SRDF: {}", reason.trim()),
                _ => "SRDF".to_owned(),
            };
            if a != b {
                wanted.insert(ascending(a, b), (skip, reason));
            }
        }
    }
    let now = skipped_now(robot)?;
    let there = robot.skips(ShapeKind::Hulls)?.edits().to_vec();
    let last = last_edits(&there, links);
    let mut imported = ImportedSkips {
        edits: there.clone(),
        added: 0,
        already: 0,
        unlisted: 0,
        wrong: wrong.in_words(),
    };
    for (pair, (skip, reason)) in &wanted {
        // A link without shapes needs no edit.
        let Some(all_are) = now.get(pair) else {
            continue;
        };
        if *all_are == Some(*skip) {
            imported.already += 1;
            continue;
        }
        if let Some(edit) = last.get(pair).filter(|_| !force) {
            let [a, b, reason] =
                [&edit.link_a, &edit.link_b, &edit.reason].map(|text| text.escape_debug());
            return Err(SrdfError::Edited(format!(
                "an edit of `{a}` and `{b}` that contradicts the SRDF (\"{reason}\"); --force lets the SRDF decide"
            )));
        }
        imported.added += 1;
        imported.edits.push(SkipEdit {
            link_a: links[pair[0]].clone(),
            link_b: links[pair[1]].clone(),
            skip: *skip,
            reason: reason.clone(),
        });
    }
    let unlisted = now.iter().filter(|(pair, skipped)| {
        **skipped == Some(true) && !wanted.get(*pair).is_some_and(|(skip, _)| *skip)
    });
    imported.unlisted = unlisted.count();
    Ok(imported)
}

/// For each pair of links with shapes: true if all their pairs of shapes, of all kinds, are skipped, false if none is,
/// `None` if some are.
fn skipped_now(robot: &Robot) -> Result<BTreeMap<[usize; 2], Option<bool>>, RobotError> {
    let mut found: BTreeMap<[usize; 2], BTreeSet<bool>> = BTreeMap::new();
    for kind in ShapeKind::ALL {
        let skips = robot.skips(kind)?;
        let places = skips.places();
        for i in 0..places.len() {
            for j in 0..i {
                let of = ascending(places[i].0, places[j].0);
                if of[0] != of[1] {
                    found.entry(of).or_default().insert(skips.is_skipped(i, j));
                }
            }
        }
    }
    let all = found.into_iter().map(|(pair, said)| {
        let one = (said.len() == 1).then(|| said.contains(&true));
        (pair, one)
    });
    Ok(all.collect())
}

//! Imports an SRDF as skip edits.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use roxmltree::Node;
use thiserror::Error;

use super::pairs::{ascending, last_edits};
use super::srdf_merge::{SrdfError, elements, parse_of};
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_robot::{Robot, RobotError, ShapeKind};

/// Errors of an SRDF import.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// Not an SRDF, or the SRDF of another robot.
    #[error(transparent)]
    Srdf(#[from] SrdfError),
    /// An element lacks the name of a link.
    #[error("line {line}: `<{element}>` has no `{attribute}`")]
    NoLink {
        /// The line, from 1.
        line: u32,
        /// The element.
        element: &'static str,
        /// The missing attribute.
        attribute: &'static str,
    },
    /// A query on the robot failed, or it has no such link.
    #[error("{}{error}", line.map_or(String::new(), |line| format!("line {line}: ")))]
    Robot {
        /// The line, from 1, if the error concerns one.
        line: Option<u32>,
        /// Why.
        error: RobotError,
    },
    /// The SRDF contradicts an existing edit.
    #[error(
        "the URDD has an edit of `{}` and `{}` that contradicts the SRDF (\"{}\"); --force lets the SRDF decide", link_a.escape_debug(), link_b.escape_debug(), reason.escape_debug()
    )]
    Edited {
        /// One link.
        link_a: String,
        /// The other.
        link_b: String,
        /// The edit's reason.
        reason: String,
    },
}

impl From<RobotError> for ImportError {
    fn from(error: RobotError) -> Self {
        ImportError::Robot { line: None, error }
    }
}

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
}

/// Reads an SRDF: `<disable_collisions>`, `<disable_default_collisions>` and `<enable_collisions>`, in the order in
/// which MoveIt applies them. Existing edits remain. If one contradicts the SRDF, `force` lets the SRDF override it.
///
/// # Errors
/// If the text is not an SRDF of the robot, names a link that the robot does not have, or contradicts an edit without
/// `force`.
pub fn import_srdf(robot: &Robot, text: &str, force: bool) -> Result<ImportedSkips, ImportError> {
    let document = parse_of(text, &robot.description()?.name)?;
    let root = document.root_element();
    let links = robot.link_names()?;
    let names = links.iter().map(String::as_str).zip(0..);
    let by_name: HashMap<&str, usize> = names.collect();
    // Called only for errors: each call counts lines from the beginning of the text.
    let line = |node: Node| document.text_pos_at(node.range().start).row;
    let link = |node: Node, element: &'static str, attribute: &'static str| {
        let name = node.attribute(attribute).ok_or_else(|| ImportError::NoLink {
            line: line(node),
            element,
            attribute,
        })?;
        let known = by_name.get(name).copied();
        let unknown = |error| ImportError::Robot { line: Some(line(node)), error };
        known.map_or_else(|| robot.link(name).map_err(unknown), Ok)
    };
    // Pairs of links, lower index first: whether they are skipped, and why.
    let mut wanted: BTreeMap<[usize; 2], (bool, String)> = BTreeMap::new();
    let mut defaults = BTreeSet::new();
    for node in elements(root, "disable_default_collisions") {
        defaults.insert(link(node, "disable_default_collisions", "link")?);
    }
    for of in defaults {
        for other in (0..links.len()).filter(|other| *other != of) {
            wanted.insert(ascending(of, other), (true, "SRDF: default".to_owned()));
        }
    }
    for (name, skip) in [("enable_collisions", false), ("disable_collisions", true)] {
        for node in elements(root, name) {
            let of = [link(node, name, "link1")?, link(node, name, "link2")?];
            let reason = match node.attribute("reason") {
                Some(reason) if !reason.trim().is_empty() => format!("SRDF: {}", reason.trim()),
                _ => "SRDF".to_owned(),
            };
            if of[0] != of[1] {
                wanted.insert(ascending(of[0], of[1]), (skip, reason));
            }
        }
    }
    let now = skipped_now(robot)?;
    let there = robot.skips(ShapeKind::Hulls)?.edits().to_vec();
    let last = last_edits(&there, links);
    let mut imported = ImportedSkips { edits: there.clone(), added: 0, already: 0, unlisted: 0 };
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
            return Err(ImportError::Edited {
                link_a: edit.link_a.clone(),
                link_b: edit.link_b.clone(),
                reason: edit.reason.clone(),
            });
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

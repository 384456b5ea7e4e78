//! `urdd diff` as a library: each change is named at its place, and nothing else is.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod bad_input;
mod beside;
mod by_rules;
mod findings;
mod loops;
mod parses;
mod same;
mod single_changes;
mod urdd_changes;

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::Path;

use testkit::trials::trials;
use urdd_diff::{Options, Side, compare};
use urdd_format::diff_report::{DiffReport, Presence, ValueChange};

/// Without findings.
fn quick() -> Options {
    Options { without_findings: true, ..Options::default() }
}

fn open(path: &Path) -> Side {
    Side::open(path, &quick()).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn differences(before: &Path, after: &Path) -> DiffReport {
    compare(&open(before), &open(after), 0.0).unwrap()
}

/// The first change of each kind, and the last one where `URDD_TRIALS` is above 1: the others repeat what these show.
fn few<Change>(changes: impl IntoIterator<Item = (String, Change)>) -> Vec<Change> {
    let mut kinds: BTreeMap<String, (Change, Option<Change>)> = BTreeMap::new();
    for (kind, change) in changes {
        match kinds.entry(kind) {
            Entry::Vacant(entry) => _ = entry.insert((change, None)),
            Entry::Occupied(mut entry) => entry.get_mut().1 = Some(change),
        }
    }
    let both = kinds.into_values();
    both.flat_map(|(first, last)| std::iter::once(first).chain(last.filter(|_| trials(1) > 1)))
        .collect()
}

/// Adds a part that differs, and its fields.
fn add(places: &mut Vec<String>, part: &str, presence: Presence, changes: &[ValueChange]) {
    if presence != Presence::Changed {
        places.push(format!("{part}/{presence}"));
    }
    places.extend(changes.iter().map(|change| format!("{part}/{}", change.field)));
}

/// Every difference of a report as `list/part/field` or `list/part/presence`, without what follows from others: poses.
fn places(report: &DiffReport) -> Vec<String> {
    let mut places = Vec::new();
    add(&mut places, "robot/", Presence::Changed, &report.robot);
    for link in &report.links {
        let name = format!("links/{}", link.name);
        add(&mut places, &name, link.presence, &link.changes);
        for geometry in &link.geometry {
            add(&mut places, &name, Presence::Changed, &geometry.changes);
        }
    }
    for (list, parts) in [
        ("joints", &report.joints),
        ("materials", &report.materials),
        ("other", &report.other_elements),
        ("loops", &report.loops),
    ] {
        for part in parts {
            let name = format!("{list}/{}", part.name);
            add(&mut places, &name, part.presence, &part.changes);
        }
    }
    for dof in &report.dofs {
        let name = format!("dofs/{}", dof.name);
        add(&mut places, &name, dof.presence, &dof.changes);
        if dof.presence == Presence::Changed && dof.index_before != dof.index_after {
            places.push(format!("{name}/index"));
        }
    }
    for pair in report.pairs.iter().flatten() {
        let [a, b] = &pair.links;
        let kinds = pair.shapes.join(",");
        places.push(format!("pairs/{a}-{b}/{}/{kinds}", pair.change));
    }
    for (list, parts) in [
        ("configurations", &report.configurations),
        ("srdf", &report.srdf),
        ("setup", &report.setup),
        ("lost", &report.lost),
    ] {
        for part in parts.iter().flatten() {
            let name = format!("{list}/{}", part.name);
            add(&mut places, &name, part.presence, &part.changes);
        }
    }
    for module in report.modules.iter().flatten() {
        places.push(format!("modules/{}/{}", module.name, module.presence));
    }
    places
}

use std::collections::BTreeSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_document::paths::{self, Place};

declare_rule! {
    /// Mesh paths begin with a robot's folder name and are relative to the folder above the URDD.
    ///
    /// That was usual before version 1. Such a URDD cannot be renamed; and one whose paths lead
    /// into another URDD, as those of composed robots do, works only beside that one.
    ///
    /// Keep the folder's name, and keep the URDDs together that belong together. In version 1 paths
    /// are relative to the URDD's own root.
    LEG002 "parent-relative-paths", Info, clause "10.2", since "0.1.0",
    phase References, needs [Legacy],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let mut count = 0;
    let mut first = None;
    let mut siblings = BTreeSet::new();
    for path in paths::all(context) {
        if !path.from_parent() {
            continue;
        }
        count += 1;
        if let Place::Sibling { folder, .. } = path.place(context) {
            siblings.insert(folder);
        }
        first.get_or_insert(path);
    }
    let Some(first) = first else {
        return;
    };
    let message = if siblings.is_empty() {
        format!("{count} mesh paths begin with the folder's own name: do not rename the folder")
    } else {
        let mut names: Vec<&str> = siblings.iter().copied().take(5).collect();
        if siblings.len() > names.len() {
            names.push("and others");
        }
        format!(
            "of {count} mesh paths some lead into other folders beside this one: keep it beside {}, under these names",
            names.join(", ")
        )
    };
    findings.report(
        Finding::at(first.file(), first.pointer.clone(), message)
            .actual(format!("{:?}", first.path)),
    );
}

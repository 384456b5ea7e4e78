use std::collections::BTreeSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_document::entries;

declare_rule! {
    /// `depends_on` does not name the modules that the module is derived from.
    ///
    /// Programs go by it when they decide what to write again after a change, and what to load with a
    /// module. A name too few leaves a module stale.
    ///
    /// Write the names of the table in SPEC §12, each once. (An extension names whatever it was
    /// derived from.)
    DIR018 "wrong-dependencies", Error, clause "2.10", since "0.1.0",
    phase Files, needs [Version1, RootMetadata, NotFailed(DIR021), NotFailed(DIR030)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    for entry in entries::all(context) {
        let stated: BTreeSet<&str> = entry.entry.depends_on.iter().map(String::as_str).collect();
        let twice = stated.len() < entry.entry.depends_on.len();
        let right: Option<BTreeSet<&str>> = entry
            .kind
            .map(|kind| kind.depends_on().iter().map(|kind| kind.name()).collect());
        if !twice && right.as_ref().is_none_or(|right| *right == stated) {
            continue;
        }
        let message = if twice {
            "a module is named twice: name each once".to_owned()
        } else {
            format!(
                "these are not the modules that {} is derived from",
                entry.entry.name
            )
        };
        let mut finding = Finding::at(ROOT_METADATA, entry.pointer("depends_on"), message)
            .actual(words(entry.entry.depends_on.iter().map(String::as_str)));
        if let Some(kind) = entry.kind {
            finding = finding.expected(words(kind.depends_on().iter().map(|kind| kind.name())));
        }
        findings.report(finding);
    }
}

fn words<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<&str> = names.take(20).collect();
    if names.is_empty() {
        "none".to_owned()
    } else {
        names.join(", ")
    }
}

use std::collections::HashSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_document::entries;

declare_rule! {
    /// A module is derived from one that is not in the URDD.
    ///
    /// Its numbers mean nothing without the other: matrices over shapes are of no use to a program
    /// that cannot know the shapes. Nor can anybody check it.
    ///
    /// Write the missing module, or leave out the one that needs it.
    DIR017 "dependency-missing", Error, clause "2.10", since "0.1.0",
    phase Files, needs [Version1, RootMetadata],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let entries = entries::all(context);
    let names: HashSet<&str> = entries
        .iter()
        .flat_map(|entry| [entry.entry.name.as_str()])
        .chain(entries.iter().filter_map(|entry| Some(entry.kind?.name())))
        .chain(context.modules().iter().map(|module| module.name()))
        .collect();
    for entry in &entries {
        for (place, name) in entry.entry.depends_on.iter().enumerate() {
            let needed = entries::version_1_kinds().find(|kind| kind.name() == name);
            let told_elsewhere = match entry.kind {
                // A name that should not be there at all is DIR018's.
                Some(kind) if needed.is_none_or(|needed| !kind.depends_on().contains(&needed)) => {
                    true
                }
                // A module that the conformance class asks for is DIR019's.
                _ => needed
                    .and_then(|needed| needed.class())
                    .is_some_and(|class| Some(class) <= context.class()),
            };
            if names.contains(name.as_str()) || told_elsewhere {
                continue;
            }
            findings.report(
                Finding::at(
                    ROOT_METADATA,
                    entry.pointer(&format!("depends_on/{place}")),
                    format!(
                        "{} is derived from {name}, which is not in the URDD: write that too, or leave this one out",
                        entry.entry.name
                    ),
                )
                .expected(format!("a module {name}"))
                .actual("none"),
            );
        }
    }
}

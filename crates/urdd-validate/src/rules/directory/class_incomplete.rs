use std::collections::HashSet;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_document::entries;
use urdd_format::registry::{ModuleKind, Profile};

declare_rule! {
    /// A module of the conformance class is not there.
    ///
    /// The class is what a program goes by: one that needs meshes takes any URDD of class Geometry,
    /// and must find all four mesh modules there. (`--class`, or `class` in the settings, holds a
    /// URDD to that class, whatever it claims.)
    ///
    /// Write the missing modules, or claim a lower class.
    DIR019 "class-incomplete", Error, clause "12.1", since "0.1.0",
    phase Files, needs [],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let Some(class) = context.class() else {
        return;
    };
    // A module may be there as a folder or by the word of urdd.json; where one of the two is missing,
    // DIR002 and DIR003 tell.
    let listed: HashSet<ModuleKind> = entries::all(context)
        .iter()
        .filter_map(|entry| entry.kind)
        .collect();
    let missing: Vec<&str> = entries::version_1_kinds()
        .filter(|kind| kind.class().is_some_and(|asked| asked <= class))
        .filter(|kind| context.module(*kind).is_none() && !listed.contains(kind))
        .map(|kind| kind.name())
        .collect();
    if missing.is_empty() {
        return;
    }
    let message = format!(
        "the class {class} asks for {} that {} not there: {}",
        if missing.len() == 1 {
            "a module"
        } else {
            "modules"
        },
        if missing.len() == 1 { "is" } else { "are" },
        missing.join(", ")
    );
    let claimed = context
        .metadata()
        .is_some_and(|metadata| metadata.conformance_class == class);
    let finding = match (claimed, context.profile()) {
        (true, Profile::V1) => Finding::at(ROOT_METADATA, "/conformance_class", message),
        _ => Finding::in_directory(message),
    };
    findings.report(finding.count(missing.len()));
}

use crate::rules::prelude::*;

declare_rule! {
    /// A module of the conformance class is not there.
    ///
    /// Programs rely on the class: one that needs meshes takes any URDD of class Geometry, and must
    /// find all four mesh modules there. (`--class`, or `class` in the settings, holds a URDD to that
    /// class, whatever it claims.)
    ///
    /// Write the missing modules, or claim a lower class.
    DIR019 "class-incomplete", Error, clause "12.1", since "0.1.0",
    phase Files, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let Some(class) = context.class() else {
        return Some(());
    };
    // A module may be a folder or an entry of urdd.json; DIR002 and DIR003 report that one of the two is missing.
    let entries = entries::all(context);
    let listed: HashSet<Kind> = entries.iter().filter_map(|entry| entry.kind).collect();
    let missing: Vec<&str> = entries::version_1_kinds()
        .filter(|kind| kind.class().is_some_and(|asked| asked <= class))
        .filter(|kind| context.module(*kind).is_none() && !listed.contains(kind))
        .map(|kind| kind.name())
        .collect();
    let (what, are) = match missing.len() {
        0 => return Some(()),
        1 => ("a module", "is"),
        _ => ("modules", "are"),
    };
    let all = missing.join(", ");
    let message = format!("the class {class} requires {what} that {are} missing: {all}");
    let metadata = context.metadata();
    let claimed = metadata.is_some_and(|metadata| metadata.conformance_class == class);
    let finding = match (claimed, context.profile()) {
        (true, Profile::V1) => Finding::at(ROOT_METADATA, "/conformance_class", message),
        _ => Finding::in_directory(message),
    };
    findings.report(finding.count(missing.len()));
    Some(())
}

use crate::rules::prelude::*;
use urdd_document::paths::Place;

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let paths = paths::all(context);
    let paths: Vec<_> = paths.iter().filter(|path| path.from_parent()).collect();
    let Some(first) = paths.first() else {
        return Some(());
    };
    let siblings = paths.iter().filter_map(|path| match path.place(context) {
        Place::Sibling { folder, .. } => Some(folder),
        _ => None,
    });
    let siblings: BTreeSet<&str> = siblings.collect();
    let count = paths.len();
    let message = if siblings.is_empty() {
        format!("{count} mesh paths begin with the folder's own name: do not rename the folder")
    } else {
        let mut names: Vec<&str> = siblings.iter().copied().take(5).collect();
        if siblings.len() > names.len() {
            names.push("and others");
        }
        format!(
            "some of {count} mesh paths lead into other folders beside this one: keep it beside {}, under these names",
            names.join(", ")
        )
    };
    let finding = Finding::at(first.file(), &first.pointer, message);
    findings.report(finding.actual(format!("{:?}", first.path)));
    Some(())
}

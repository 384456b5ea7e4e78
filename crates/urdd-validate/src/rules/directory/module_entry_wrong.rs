use crate::rules::prelude::*;

declare_rule! {
    /// An entry of `modules` has a name and a path that do not belong together, or is there twice.
    ///
    /// Some programs look a module up by its name, others by its folder. Every module has one folder
    /// that the specification gives it, and its name is the last part of that.
    ///
    /// Give each module one entry, with the name and the folder of the table in SPEC §12.
    DIR021 "module-entry-wrong", Error, clause "2.6", since "0.1.0",
    phase Files, needs [Version1, RootMetadata],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let (mut names, mut paths) = (HashSet::new(), HashSet::new());
    for entry in listed_modules(context)? {
        let (name, path) = (entry.entry.name.as_str(), entry.entry.path.as_str());
        // DIR015 reports an invalid path.
        if path::check(path).is_err() {
            continue;
        }
        let twice = !names.insert(name) || !paths.insert(path);
        let last = path.rsplit('/').next().unwrap_or(path);
        let (key, message, expected) = match entry.kind {
            Some(kind) if kind.name() != name => {
                let message = "this is not the name of the module in this folder";
                ("name", message, kind.name())
            }
            Some(kind) if kind.folder() != path => {
                let message = "this is not the folder that the module has";
                ("path", message, kind.folder())
            }
            _ if last != name => ("name", "the name is not the last part of the path", last),
            _ if twice => ("name", "the module is listed twice", "one entry"),
            _ => continue,
        };
        let actual = if key == "path" { path } else { name };
        finding_in(&entry, key, message).values(expected, format!("{actual:?}")).report(findings);
    }
    Some(())
}

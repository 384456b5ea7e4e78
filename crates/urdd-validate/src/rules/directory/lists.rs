use crate::rules::prelude::*;

declare_rule! {
    /// An entry of `modules` has a name and a path that do not belong together, or is there twice.
    ///
    /// Some programs look a module up by its name, others by its folder. Every module has one folder
    /// that the specification gives it, and its name is the last part of that.
    ///
    /// Give each module one entry, with the name and the folder of the table in SPEC §12.
    DIR021 "module-entry-wrong", Error, clause "2.6", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check module_entry_wrong,

    /// `modules` or a `files` list of `urdd.json` is not in order, or names a file twice.
    ///
    /// One order for all makes the same URDD the same bytes, whoever writes it: differences between
    /// two versions show what changed and nothing else.
    ///
    /// Put modules in the order of the table in SPEC §12, extensions after them by name; sort files
    /// by path, byte by byte, each once.
    DIR026 "list-out-of-order", Error, clause "2.6", since "0.1.0",
    phase Files, needs [Version1, RootMetadata, Passed(DIR021)], check list_out_of_order,
}

fn module_entry_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
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

fn list_out_of_order(context: &Context, findings: &mut Findings) -> Option<()> {
    let entries = listed_modules(context)?;
    // Modules of the specification first, others by name.
    let place = |index: usize| {
        let entry = entries.get(index)?;
        let name = entry.kind.is_none().then_some(entry.entry.name.as_str());
        Some((entry.kind.is_none(), entry.kind, name))
    };
    if let Some(index) = (1..entries.len()).find(|index| place(*index) < place(index - 1)) {
        let (before, name) = (&entries[index - 1].entry.name, &entries[index].entry.name);
        let message = "the modules are not in the order of the specification's table";
        Finding::at(ROOT_METADATA, format!("/modules/{index}"), message)
            .values(format!("{name} before {before}"), format!("{name} after {before}"))
            .report(findings);
    }
    for entry in &entries {
        let files = &entry.entry.files;
        let Some(place) = (1..files.len()).find(|i| files[*i].path <= files[i - 1].path) else {
            continue;
        };
        // A file with another fault is out of order because of that fault.
        let faulty = |path: &str| !entry.holds(path) || entries::look(context, path).is_err();
        if files.iter().any(|file| faulty(&file.path)) {
            continue;
        }
        let (before, path) = (&files[place - 1].path, &files[place].path);
        let message = match before == path {
            true => "the file is listed twice: list each once",
            false => "the files are not sorted by path, byte by byte",
        };
        let finding = finding_in(entry, format!("files/{place}/path"), message);
        findings.report(finding.values(format!("a path after {before}"), path));
    }
    Some(())
}

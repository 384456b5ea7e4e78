use crate::rules::prelude::*;

declare_rule! {
    /// `modules` or a `files` list of `urdd.json` is not in order, or names a file twice.
    ///
    /// One order for all makes the same URDD the same bytes, whoever writes it: differences between
    /// two versions show what changed and nothing else.
    ///
    /// Put modules in the order of the table in SPEC §12, extensions after them by name; sort files
    /// by path, byte by byte, each once.
    DIR026 "list-out-of-order", Error, clause "2.6", since "0.1.0",
    phase Files, needs [Version1, RootMetadata, Passed(DIR021)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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

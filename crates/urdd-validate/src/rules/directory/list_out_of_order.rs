use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_document::entries;

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
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let entries = entries::all(context);
    // Modules of the specification first (`None` comes after them), others by name.
    let place = |index: usize| {
        let entry = entries.get(index)?;
        let name = entry.kind.is_none().then_some(entry.entry.name.as_str());
        Some((entry.kind.is_none(), entry.kind, name))
    };
    if let Some(index) = (1..entries.len()).find(|index| place(*index) < place(index - 1)) {
        let (before, entry) = (&entries[index - 1].entry.name, &entries[index]);
        findings.report(
            Finding::at(
                ROOT_METADATA,
                format!("/modules/{index}"),
                "the modules are not in the order of the specification's table",
            )
            .expected(format!("{} before {before}", entry.entry.name))
            .actual(format!("{} after {before}", entry.entry.name)),
        );
    }
    for entry in &entries {
        let files = &entry.entry.files;
        let Some(place) = (1..files.len()).find(|i| files[*i].path <= files[i - 1].path) else {
            continue;
        };
        let (before, path) = (&files[place - 1].path, &files[place].path);
        // A file that has a fault of its own stands in the wrong place for that reason.
        let other_fault = files
            .iter()
            .any(|file| !entry.holds(&file.path) || entries::look(context, &file.path).is_err());
        if other_fault {
            continue;
        }
        let message = if before == path {
            "the file is listed twice: list each once"
        } else {
            "the files are not sorted by path, byte by byte"
        };
        findings.report(
            Finding::at(
                ROOT_METADATA,
                entry.pointer(&format!("files/{place}/path")),
                message,
            )
            .expected(format!("a path after {before}"))
            .actual(path),
        );
    }
}

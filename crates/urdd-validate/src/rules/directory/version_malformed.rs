use crate::rules::prelude::*;
use urdd_directory::digest::{Change, compare};

declare_rule! {
    /// A `VERSION` file does not hold a version.
    ///
    /// It must be three numbers joined by dots and nothing else, apart from one line feed at the
    /// end: programs compare the text with the versions that they know, and neither trim it nor
    /// guess.
    ///
    /// Write the version of the module's format, such as `1.0.0`: no `v` before it, no blanks, no
    /// leading zeros, nothing like `-beta` after it.
    DIR006 "version-malformed", Error, clause "2.5", since "0.1.0",
    phase Files, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for module in checked_modules(context) {
        let actual = match &module.version_file {
            VersionFile::Text(text) if Version::new(text.as_str()).is_none() => {
                let shown: String = text.chars().take(40).collect();
                format!("{shown:?}")
            }
            VersionFile::Unreadable(ReadError::TooLarge { size, .. }) => format!("{size} bytes"),
            _ => continue,
        };
        let file = module.file("VERSION");
        if !is_converted(context, &file) {
            let message = "this is not a version: write three numbers joined by dots, and at most one newline after them";
            let finding = Finding::in_file(file, message).expected("a version such as 1.0.0");
            findings.report(finding.actual(actual));
        }
    }
    Some(())
}

/// The modules of the specification, extensions, and the unknown modules that `urdd.json` lists.
fn checked_modules(context: &Context) -> impl Iterator<Item = &Module> {
    let entries = context.metadata().into_iter().flat_map(|metadata| &metadata.modules);
    let listed: HashSet<&str> = entries.map(|entry| entry.path.as_str()).collect();
    context.modules().filter(move |module| {
        entries::is_known(context, module) || listed.contains(module.folder.as_str())
    })
}

/// Whether line endings were converted since the file was listed; DIR014 reports that.
fn is_converted(context: &Context, path: &str) -> bool {
    let modules = context.metadata().into_iter().flat_map(|m| &m.modules);
    modules.flat_map(|module| &module.files).find(|file| file.path == path).is_some_and(|file| {
        let (size, sha256) = (u64::from(file.size.0), file.sha256.as_str());
        compare(context.root(), path, size, sha256) == Some(Change::LineEndings)
    })
}

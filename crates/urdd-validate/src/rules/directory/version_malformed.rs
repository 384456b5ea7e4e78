use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::digest::{Change, compare};
use urdd_directory::root::ReadError;
use urdd_document::entries;
use urdd_document::module::VersionFile;
use urdd_format::root_metadata::Version;

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
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    for module in entries::known_modules(context) {
        let actual = match &module.version_file {
            VersionFile::Text(text) if Version::new(text.as_str()).is_none() => {
                let shown: String = text.chars().take(40).collect();
                format!("{shown:?}")
            }
            VersionFile::Unreadable(ReadError::TooLarge { size, .. }) => format!("{size} bytes"),
            _ => continue,
        };
        if is_converted(context, &module.file("VERSION")) {
            continue;
        }
        findings.report(
            Finding::in_file(
                module.file("VERSION"),
                "this is not a version: write three numbers joined by dots, and at most one newline after them",
            )
            .expected("a version such as 1.0.0")
            .actual(actual),
        );
    }
}

/// Whether line ends were converted since the file was listed, of which DIR014 tells.
fn is_converted(context: &Context, path: &str) -> bool {
    let modules = context.metadata().into_iter().flat_map(|m| &m.modules);
    let mut listed = modules.flat_map(|module| &module.files);
    listed
        .find(|file| file.path == path)
        .and_then(|file| {
            let (size, sha256) = (u64::from(file.size.0), file.sha256.as_str());
            compare(context.root(), path, size, sha256)
        })
        .is_some_and(|change| change == Change::LineEndings)
}

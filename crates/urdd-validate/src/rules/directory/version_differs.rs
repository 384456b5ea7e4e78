use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_document::entries::{self, Entry};
use urdd_document::module::{Module, VersionFile};
use urdd_format::root_metadata::Version;

declare_rule! {
    /// `urdd.json` and a module's `VERSION` name different versions.
    ///
    /// Programs read the one or the other, and then read the same document by different rules. Most
    /// often a module was written again by a newer program, and `urdd.json` was not.
    ///
    /// Write the version of the format that the module has into both.
    DIR007 "version-differs", Error, clause "2.5", since "0.1.0",
    phase Files, needs [Version1, RootMetadata],
    check check,
}

/// The version of the module's `VERSION` file, where it is one and `urdd.json` has another.
pub fn differing<'a>(entry: &Entry<'a>) -> Option<(&'a Module, &'a str)> {
    let module = entry.module?;
    match &module.version_file {
        VersionFile::Text(text)
            if Version::new(text.as_str()).is_some() && text != entry.entry.version.as_str() =>
        {
            Some((module, text))
        }
        _ => None,
    }
}

fn check(context: &Context, findings: &mut Findings) {
    for entry in entries::all(context) {
        let Some((module, version)) = differing(&entry) else {
            continue;
        };
        findings.report(
            Finding::at(
                ROOT_METADATA,
                entry.pointer("version"),
                format!(
                    "{} says {version}: write the version of the module's format into both",
                    module.file("VERSION")
                ),
            )
            .expected(version)
            .actual(&entry.entry.version),
        );
    }
}

use std::collections::BTreeMap;

use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::{Need, declare_rule};
use urdd_directory::discover::ROOT_METADATA;
use urdd_document::entries;
use urdd_format::root_metadata::Source;

declare_rule! {
    /// Two names in one folder differ only in letter case.
    ///
    /// On Windows, on macOS and in many archives the two are one: when the URDD is copied or unpacked
    /// there, one file silently takes the place of the other, and the hashes in `urdd.json` no longer
    /// hold.
    ///
    /// Rename one of the two, and name it in the documents as it is called then.
    DIR027 "names-differ-in-case", Error, clause "2.9", since "0.2.0",
    phase Files, needs [Need::Version1],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let source = context.metadata().and_then(|m| match &m.source {
        Some(Source::Urdf(file)) => Some(file.path.as_str()),
        _ => None,
    });
    // Files in the root that this specification does not name are nobody's business.
    let is_of_urdd = |path: &str| {
        let within = |folder: &str| {
            path.strip_prefix(folder)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
        };
        path == ROOT_METADATA
            || Some(path) == source
            || entries::known_modules(context)
                .any(|module| within(&module.folder) || is_above(path, &module.folder))
    };
    let mut alike: BTreeMap<(&str, String), Vec<&str>> = BTreeMap::new();
    for entry in &context.listing().entries {
        let (folder, name) = entry.path.rsplit_once('/').unwrap_or(("", &entry.path));
        let paths = alike.entry((folder, name.to_lowercase())).or_default();
        paths.push(&entry.path);
    }
    for paths in alike.values() {
        let [first, second, ..] = paths.as_slice() else {
            continue;
        };
        if paths.iter().any(|path| is_of_urdd(path)) {
            findings.report(
                Finding::in_file(
                    *second,
                    format!("this name differs from that of {first} in letter case alone, and many file systems take the two for one: rename one"),
                )
                .count(paths.len() - 1),
            );
        }
    }
}

/// Whether a folder lies above another.
fn is_above(folder: &str, other: &str) -> bool {
    other
        .strip_prefix(folder)
        .is_some_and(|rest| rest.starts_with('/'))
}

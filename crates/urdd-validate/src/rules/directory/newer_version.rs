use std::collections::HashSet;

use super::version_differs;
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_document::entries;
use urdd_format::registry::SPEC_VERSION;

declare_rule! {
    /// Something is of a newer version than this program knows.
    ///
    /// A newer minor version adds keys. What this program does not know it passes over, and checks
    /// the rest by the newest version that it knows: a pass says less than it seems to.
    ///
    /// Check with a newer `urdd`; or, where the version is a mistake, correct it.
    DIR009 "newer-version", Warning, clause "4.2", since "0.1.0",
    phase Files, needs [],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    if let Some(metadata) = context.metadata() {
        let parse = |text: &str| semver::Version::parse(text).ok();
        if let (Some(stated), Some(known)) =
            (parse(metadata.urdd_version.as_str()), parse(SPEC_VERSION))
            && stated.major == known.major
            && stated > known
        {
            findings.report(
                Finding::at(
                    ROOT_METADATA,
                    "/urdd_version",
                    format!(
                        "this program knows the specification up to {SPEC_VERSION}: check with a newer one"
                    ),
                )
                .expected(format!("at most {SPEC_VERSION}"))
                .actual(stated),
            );
        }
    }
    let differing: HashSet<&str> = entries::all(context)
        .iter()
        .filter_map(version_differs::differing)
        .map(|(module, _)| module.folder.as_str())
        .collect();
    for module in entries::known_modules(context) {
        let (true, Some(spec), Some(version)) = (module.newer, module.spec, &module.version) else {
            continue;
        };
        if !differing.contains(module.folder.as_str()) {
            findings.report(
                Finding::in_file(
                    module.file("VERSION"),
                    format!(
                        "the module is newer than this program knows and is checked as {}: check with a newer program",
                        spec.version
                    ),
                )
                .expected(format!("at most {}", spec.version))
                .actual(version),
            );
        }
    }
}

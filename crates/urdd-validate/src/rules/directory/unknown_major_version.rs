use crate::rules::prelude::*;

declare_rule! {
    /// The URDD follows another major version of the specification.
    ///
    /// A new major version may change what anything means, so that this program cannot say whether
    /// the URDD is right; and readers of version 1 must refuse it.
    ///
    /// Check with the `urdd` of that version; or, where the version is a mistake, write `1.0.0`.
    DIR025 "unknown-major-version", Error, clause "4.1", since "0.1.0",
    phase Files, needs [Version1],
}

/// The `urdd_version` of `urdd.json`, if its major number is not 1.
pub fn other_major(context: &Context) -> Option<&str> {
    // Read from the JSON: a document of another major version may not fit the schema.
    let document = context.metadata_file().json.document()?;
    let version = document.value.get("urdd_version")?.as_str()?;
    Version::new(version)?;
    (version.split('.').next() != Some("1")).then_some(version)
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    if let Some(version) = other_major(context) {
        let message = "this program knows version 1 of the specification: check with a program of that version";
        Finding::at(ROOT_METADATA, "/urdd_version", message)
            .values("1.x.y", version)
            .report(findings);
    }
    Some(())
}

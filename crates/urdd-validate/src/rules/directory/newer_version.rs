use super::version_differs;
use crate::rules::prelude::*;
use urdd_format::registry::SPEC_VERSION;

declare_rule! {
    /// Something is of a newer version than this program knows.
    ///
    /// A newer minor version adds keys. This program ignores what it does not know, and checks the rest
    /// by the newest version that it knows: a pass means less than it seems to.
    ///
    /// Check with a newer `urdd`; or, where the version is a mistake, correct it.
    DIR009 "newer-version", Warning, clause "4.2", since "0.1.0",
    phase Files, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let parse = |text: &str| semver::Version::parse(text).ok();
    let stated = context.metadata().and_then(|metadata| parse(metadata.urdd_version.as_str()));
    if let Some((stated, known)) = stated.zip(parse(SPEC_VERSION))
        && stated.major == known.major
        && stated > known
    {
        let message = format!(
            "this program knows the specification up to {SPEC_VERSION}: check with a newer one"
        );
        Finding::at(ROOT_METADATA, "/urdd_version", message)
            .values(format!("at most {SPEC_VERSION}"), stated)
            .report(findings);
    }
    let differing = version_differs::folders(context);
    for module in entries::known_modules(context) {
        if let (true, Some(spec), Some(version)) = (module.newer, module.spec, &module.version)
            && !differing.contains(module.folder.as_str())
        {
            let message = format!(
                "the module is newer than this program knows and is checked as {}: check with a newer program",
                spec.version
            );
            Finding::in_file(module.file("VERSION"), message)
                .values(format!("at most {}", spec.version), version)
                .report(findings);
        }
    }
    Some(())
}

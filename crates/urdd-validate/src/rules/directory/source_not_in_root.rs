use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::path;
use urdd_format::root_metadata::Source;

declare_rule! {
    /// The source URDF is in a folder below the root.
    ///
    /// It must lie in the root folder itself: there people and programs look for the one URDF that a
    /// URDD was made from, and there no module's folder can claim it.
    ///
    /// Move it next to `urdd.json`, and change `source` to its new path.
    DIR028 "source-not-in-root", Error, clause "2.12", since "0.2.0",
    phase Files, needs [Version1, RootMetadata],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let source = context.metadata().and_then(|m| m.source.as_ref());
    let Some(Source::Urdf(file)) = source else {
        return;
    };
    // Of a path that is none, DIR015 tells.
    if path::check(&file.path).is_err() || !file.path.contains('/') {
        return;
    }
    findings.report(
        Finding::at(
            ROOT_METADATA,
            "/source/Urdf/path",
            "the source URDF is not in the root folder: move it there",
        )
        .actual(&file.path),
    );
}

use crate::rules::prelude::*;
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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    // DIR015 reports an invalid path.
    if let Some(Source::Urdf(file)) = &context.metadata()?.source
        && path::check(&file.path).is_ok()
        && file.path.contains('/')
    {
        let message = "the source URDF is not in the root folder: move it there";
        let finding = Finding::at(ROOT_METADATA, "/source/Urdf/path", message);
        findings.report(finding.actual(&file.path));
    }
    Some(())
}

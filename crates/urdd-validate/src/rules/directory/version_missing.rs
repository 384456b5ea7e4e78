use crate::rules::prelude::*;
use urdd_document::module::{JsonFile, VersionFile};
use urdd_format::registry;

declare_rule! {
    /// A module folder has no `VERSION`.
    ///
    /// A reader that does not know a module's version cannot know what its fields mean: the same
    /// field has changed its meaning before (`dof_module` 0.0.1 counts mimic joints, 0.0.2 does not).
    ///
    /// Write the version of the module's format, such as `1.0.0`, into a file `VERSION` beside
    /// `module.json`.
    DIR005 "version-missing", Error, clause "2.4", since "0.1.0",
    phase Files, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for module in entries::known_modules(context) {
        // Before the specification, some modules were published without one.
        let never_had_one = module.kind.and_then(|kind| registry::find(kind, "")).is_some();
        let empty = matches!(module.json, JsonFile::Missing);
        if matches!(module.version_file, VersionFile::Missing) && !never_had_one && !empty {
            let message =
                "the module has no VERSION: write the version of its format into it, such as 1.0.0";
            Finding::in_file(module.file("VERSION"), message).report(findings);
        }
    }
    Some(())
}

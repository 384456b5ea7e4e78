use crate::rules::prelude::*;
use urdd_document::module::JsonFile;

declare_rule! {
    /// A module folder has no `module.json`.
    ///
    /// `module.json` is the module; `VERSION` and `module.yaml` say nothing without it. Such folders
    /// are left behind by a program that stopped half-way, and look to a reader like a module that is
    /// there.
    ///
    /// Write the module again, or delete the folder.
    DIR004 "module-json-missing", Error, clause "2.4", since "0.1.0",
    phase Files, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for module in entries::known_modules(context) {
        if matches!(module.json, JsonFile::Missing) {
            let message =
                "the module has no module.json: write the module again, or delete its folder";
            Finding::in_file(module.file("module.json"), message).report(findings);
        }
    }
    Some(())
}

use super::listed_files;
use crate::rules::prelude::*;
use urdd_document::module::{JsonFile, Mirror};

declare_rule! {
    /// A module has no `module.yaml`.
    ///
    /// YAML is what people read and what some programs load; a URDD that lacks it in places works
    /// for some readers and not for others.
    ///
    /// Write the same document as `module.json`, as YAML, beside it.
    DIR010 "module-yaml-missing", Warning, clause "2.4", since "0.1.0",
    phase Files, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    // DIR011 reports a file that is listed and missing.
    let listed = context.metadata().map(listed_files).unwrap_or_default();
    for module in entries::known_modules(context) {
        let file = module.file("module.yaml");
        if matches!(module.mirror, Mirror::Missing)
            && !matches!(module.json, JsonFile::Missing)
            && !listed.contains(file.as_str())
        {
            let message =
                "the module has no module.yaml: write the document of module.json as YAML too";
            Finding::in_file(file, message).report(findings);
        }
    }
    Some(())
}

use crate::rules::prelude::*;
use urdd_document::module::{JsonFile, Mirror, VersionFile};
use urdd_format::registry;

declare_rule! {
    /// The URDD has no `urdd.json`.
    ///
    /// The root metadata says which robot this is, which version of the specification to read it
    /// by, what it was made from, and what belongs to it. Without it a reader can only guess, and
    /// cannot tell whether a file was changed or left out.
    ///
    /// Write `urdd.json` into the root folder; `urdd schema show root_metadata@1.0.0` shows its schema. Where
    /// the URDD is from before version 1, none of its modules may be of version 1.
    DIR001 "root-metadata-missing", Error, clause "2.2", since "0.1.0",
    phase Files, needs [Version1], check root_metadata_missing,

    /// A module folder has no `module.json`.
    ///
    /// `module.json` is the module; `VERSION` and `module.yaml` say nothing without it. Such folders
    /// are left behind by a program that stopped half-way, and look to a reader like a module that is
    /// there.
    ///
    /// Write the module again, or delete the folder.
    DIR004 "module-json-missing", Error, clause "2.4", since "0.1.0",
    phase Files, needs [], check module_json_missing,

    /// A module folder has no `VERSION`.
    ///
    /// A reader that does not know a module's version cannot know what its fields mean: the same
    /// field has changed its meaning before (`dof_module` 0.0.1 counts mimic joints, 0.0.2 does not).
    ///
    /// Write the version of the module's format, such as `1.0.0`, into a file `VERSION` beside
    /// `module.json`.
    DIR005 "version-missing", Error, clause "2.4", since "0.1.0",
    phase Files, needs [], check version_missing,

    /// A module has no `module.yaml`.
    ///
    /// YAML is what people read and what some programs load; a URDD that lacks it in places works
    /// for some readers and not for others.
    ///
    /// Write the same document as `module.json`, as YAML, beside it.
    DIR010 "module-yaml-missing", Warning, clause "2.4", since "0.1.0",
    phase Files, needs [], check module_yaml_missing,
}

fn root_metadata_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    if matches!(context.metadata_file().json, JsonFile::Missing) {
        let message = "there is no urdd.json: write the root metadata beside the module folders";
        Finding::in_file(ROOT_METADATA, message).report(findings);
    }
    Some(())
}

/// Reports the file of each module for which it `is_missing`.
fn report(
    context: &Context,
    findings: &mut Findings,
    name: &str,
    is_missing: impl Fn(&Module) -> bool,
    message: &str,
) -> Option<()> {
    for module in entries::known_modules(context).filter(|module| is_missing(module)) {
        Finding::in_file(module.file(name), message).report(findings);
    }
    Some(())
}

fn is_empty(module: &Module) -> bool {
    matches!(module.json, JsonFile::Missing)
}

fn module_json_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    let message = "the module has no module.json: write the module again, or delete its folder";
    report(context, findings, "module.json", is_empty, message)
}

fn version_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    let message =
        "the module has no VERSION: write the version of its format into it, such as 1.0.0";
    let is_missing = |module: &Module| {
        // Before the specification, some modules were published without one.
        let never_had_one = module.kind.and_then(|kind| registry::find(kind, "")).is_some();
        matches!(module.version_file, VersionFile::Missing) && !never_had_one && !is_empty(module)
    };
    report(context, findings, "VERSION", is_missing, message)
}

fn module_yaml_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    let message = "the module has no module.yaml: write the document of module.json as YAML too";
    // DIR011 reports a file that is listed and missing.
    let listed = context.metadata().map(listed_files).unwrap_or_default();
    let is_missing = |module: &Module| {
        let is_listed = listed.contains(module.file("module.yaml").as_str());
        matches!(module.mirror, Mirror::Missing) && !is_empty(module) && !is_listed
    };
    report(context, findings, "module.yaml", is_missing, message)
}

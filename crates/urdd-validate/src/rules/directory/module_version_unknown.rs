use super::version_differs;
use crate::rules::prelude::*;
use urdd_format::registry;

declare_rule! {
    /// A module has a version that does not exist, or one from before the specification in a URDD of
    /// version 1.
    ///
    /// What a module's fields mean goes by its version. No program can read a version that was
    /// never published, and nothing of such a module can be checked.
    ///
    /// Write the module in a version that the specification lists, or correct `VERSION`. Modules of
    /// your own are extensions (`x_<vendor>_<name>_module`) and have versions of their own.
    DIR008 "module-version-unknown", Error, clause "4.2", since "0.1.0",
    phase Files, needs [],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let differing = version_differs::folders(context);
    for module in entries::known_modules(context) {
        let (Some(kind), Some(version)) = (module.kind, &module.version) else {
            continue;
        };
        let old = context.profile() == Profile::V1 && module.is_legacy();
        let sound = module.spec.is_some() && !old;
        // DIR006 reports a malformed version, DIR007 a differing one.
        if sound || is_malformed(module) || differing.contains(module.folder.as_str()) {
            continue;
        }
        let message = match old {
            true => format!(
                "version {version} is from before the specification: in a URDD with urdd.json, write the module in a version that the specification lists"
            ),
            false => format!("unknown version {version} of {}", kind.name()),
        };
        Finding::in_file(module.file("VERSION"), message)
            .values(known_versions(kind, context.profile()), version)
            .report(findings);
    }
    Some(())
}

fn is_malformed(module: &Module) -> bool {
    matches!(&module.version_file, VersionFile::Text(text) if Version::new(text.as_str()).is_none())
}

fn known_versions(kind: Kind, profile: Profile) -> String {
    let versions: Vec<&str> = registry::modules()
        .iter()
        .filter(|spec| spec.kind == kind && !spec.version.is_empty())
        .filter(|spec| profile == Profile::Legacy || spec.profile == Profile::V1)
        .map(|spec| spec.version)
        .collect();
    if versions.is_empty() {
        return "no VERSION: the module has none".to_owned();
    }
    versions.join(" or ")
}

use crate::rules::prelude::*;
use urdd_document::legacy::SIMPLE_SKIPS_DEPENDENCIES;

declare_rule! {
    /// A module of the conformance class is not there.
    ///
    /// Programs rely on the class: one that needs meshes takes any URDD of class Geometry, and must
    /// find all four mesh modules there. (`--class`, or `class` in the settings, holds a URDD to that
    /// class, whatever it claims.)
    ///
    /// Write the missing modules, or claim a lower class.
    DIR019 "class-incomplete", Error, clause "12.1", since "0.1.0",
    phase Files, needs [], check class_incomplete,

    /// The URDD follows another major version of the specification.
    ///
    /// A new major version may change what anything means, so that this program cannot say whether
    /// the URDD is right; and readers of version 1 must refuse it.
    ///
    /// Check with the `urdd` of that version; or, where the version is a mistake, write `1.0.0`.
    DIR025 "unknown-major-version", Error, clause "4.1", since "0.1.0",
    phase Files, needs [Version1], check unknown_major_version,

    /// The URDD follows a draft of the format, which `urdd` 0.1.0 or 0.2.0 wrote.
    ///
    /// In the draft of 0.1.0, `link_shapes_skips_module` had no `skipped_reasons`, and the reasons of pairs did
    /// not know `Default`. A program that checks collisions by such a URDD finds neighbouring links of
    /// a robot at rest in collision. In the draft of 0.2.0, `self_collision_model_module` had counts of configurations
    /// that its producer chose (`held_out`), so that its rates could flatter it. What depends on these modules is not
    /// checked.
    ///
    /// Run `urdd generate` again into the same folder, with the same `--modules`: it writes the present format, keeps
    /// your edits of the skips, and makes again only what has changed.
    DIR030 "draft-format", Error, clause "4.4", since "0.2.0",
    phase Files, needs [Version1], check draft_format,
}

fn class_incomplete(context: &Context, findings: &mut Findings) -> Option<()> {
    let Some(class) = context.class() else { return Some(()) };
    // A module may be a folder or an entry of urdd.json; DIR002 and DIR003 report that one of the two is missing.
    let entries = entries::all(context);
    let listed: HashSet<Kind> = entries.iter().filter_map(|entry| entry.kind).collect();
    let missing: Vec<&str> = entries::version_1_kinds()
        .filter(|kind| kind.class().is_some_and(|asked| asked <= class))
        .filter(|kind| context.module(*kind).is_none() && !listed.contains(kind))
        .map(|kind| kind.name())
        .collect();
    let (what, are) = match missing.len() {
        0 => return Some(()),
        1 => ("a module", "is"),
        _ => ("modules", "are"),
    };
    let all = missing.join(", ");
    let message = format!("the class {class} requires {what} that {are} missing: {all}");
    let metadata = context.metadata();
    let claimed = metadata.is_some_and(|metadata| metadata.conformance_class == class);
    let finding = match (claimed, context.profile()) {
        (true, Profile::V1) => Finding::at(ROOT_METADATA, "/conformance_class", message),
        _ => Finding::in_directory(message),
    };
    findings.report(finding.count(missing.len()));
    Some(())
}

/// The `urdd_version` of `urdd.json`, if its major number is not 1.
pub fn other_major(context: &Context) -> Option<&str> {
    // Read from the JSON: a document of another major version may not fit the schema.
    let document = context.metadata_file().json.document()?;
    let version = document.value.get("urdd_version")?.as_str()?;
    Version::new(version)?;
    (version.split('.').next() != Some("1")).then_some(version)
}

fn unknown_major_version(context: &Context, findings: &mut Findings) -> Option<()> {
    if let Some(version) = other_major(context) {
        let message = "this program knows version 1 of the specification: check with a program of that version";
        Finding::at(ROOT_METADATA, "/urdd_version", message)
            .values("1.x.y", version)
            .report(findings);
    }
    Some(())
}

fn draft_format(context: &Context, findings: &mut Findings) -> Option<()> {
    let of_skips = "this was written in the draft format of urdd 0.1.0: run `urdd generate` again \
                    into this folder; edits of the skips are kept";
    let of_model = "this was written in the draft format of urdd 0.2.0: run `urdd generate` again \
                    into this folder, with `--modules all,self_collision_model`";
    let mut is_draft = |kind, key: &str, message: &str| {
        let module = context.module(kind).filter(|module| module.is_draft);
        if let Some(module) = module {
            let finding = finding_in(module, "", message).actual("no such key");
            findings.report(finding.expected(format!("key {key}")));
        }
        module.is_some()
    };
    is_draft(Kind::SelfCollisionModel, "evaluation", of_model);
    if is_draft(Kind::LinkShapesSkips, "skipped_reasons", of_skips) {
        return Some(());
    }
    let names = SIMPLE_SKIPS_DEPENDENCIES.map(Kind::name);
    let kind = Kind::LinkShapesSimpleSkips;
    for entry in entries::all(context) {
        let stated = entry.entry.depends_on.iter().map(String::as_str);
        if entry.kind == Some(kind) && stated.eq(names) {
            let all: Vec<&str> = kind.depends_on().iter().map(|kind| kind.name()).collect();
            let finding = finding_in(&entry, "depends_on", of_skips);
            findings.report(finding.values(all.join(", "), names.join(", ")));
            break;
        }
    }
    Some(())
}

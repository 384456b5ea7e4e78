//! Versions of modules and of the specification, and the modules that a conformance class asks for.

use crate::rules::prelude::*;
use urdd_directory::file_entry::{Change, compare};
use urdd_document::legacy::SIMPLE_SKIPS_DEPENDENCIES;
use urdd_format::registry::{self, SPEC_VERSION};

declare_rule! {
    /// A `VERSION` file does not hold a version.
    ///
    /// It must be three numbers joined by dots and nothing else, apart from one line feed at the
    /// end: programs compare the text with the versions that they know, and neither trim it nor
    /// guess.
    ///
    /// Write the version of the module's format, such as `1.0.0`: no `v` before it, no blanks, no
    /// leading zeros, nothing like `-beta` after it.
    DIR006 "version-malformed", Error, clause "2.5", since "0.1.0",
    phase Files, needs [], check version_malformed,

    /// `urdd.json` and a module's `VERSION` name different versions.
    ///
    /// Programs read the one or the other, and then read the same document by different rules. Most
    /// often a module was written again by a newer program, and `urdd.json` was not.
    ///
    /// Write the version of the format that the module has into both.
    DIR007 "version-differs", Error, clause "2.5", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check version_differs,

    /// A module has a version that does not exist, or one from before the specification in a URDD of
    /// version 1.
    ///
    /// What a module's fields mean goes by its version. No program can read a version that was
    /// never published, and nothing of such a module can be checked.
    ///
    /// Write the module in a version that the specification lists, or correct `VERSION`. Modules of
    /// your own are extensions (`x_<vendor>_<name>_module`) and have versions of their own.
    DIR008 "module-version-unknown", Error, clause "4.2", since "0.1.0",
    phase Files, needs [], check module_version_unknown,

    /// Something is of a newer version than this program knows.
    ///
    /// A newer minor version adds keys. This program ignores what it does not know, and checks the rest
    /// by the newest version that it knows: a pass means less than it seems to.
    ///
    /// Check with a newer `urdd`; or, where the version is a mistake, correct it.
    DIR009 "newer-version", Warning, clause "4.2", since "0.1.0",
    phase Files, needs [], check newer_version,

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

fn version_malformed(context: &Context, findings: &mut Findings) -> Option<()> {
    for module in checked_modules(context) {
        let actual = match &module.version_file {
            VersionFile::Text(text) if Version::new(text.as_str()).is_none() => {
                let shown: String = text.chars().take(40).collect();
                format!("{shown:?}")
            }
            VersionFile::Unreadable(ReadError::TooLarge { size, .. }) => format!("{size} bytes"),
            _ => continue,
        };
        let file = module.file("VERSION");
        if !is_converted(context, &file) {
            let message = "this is not a version: write three numbers joined by dots, and at most one newline after them";
            let finding = Finding::in_file(file, message).expected("a version such as 1.0.0");
            findings.report(finding.actual(actual));
        }
    }
    Some(())
}

/// The modules of the specification, extensions, and the unknown modules that `urdd.json` lists.
pub fn checked_modules(context: &Context) -> impl Iterator<Item = &Module> {
    let entries = context.metadata().into_iter().flat_map(|metadata| &metadata.modules);
    let listed: HashSet<&str> = entries.map(|entry| entry.path.as_str()).collect();
    context.modules().filter(move |module| {
        entries::is_known(context, module) || listed.contains(module.folder.as_str())
    })
}

/// Whether line endings were converted since the file was listed; DIR014 reports that.
fn is_converted(context: &Context, path: &str) -> bool {
    let modules = context.metadata().into_iter().flat_map(|m| &m.modules);
    modules.flat_map(|module| &module.files).find(|file| file.path == path).is_some_and(|file| {
        let (size, sha256) = (u64::from(file.size.0), file.sha256.as_str());
        compare(context.root(), path, size, sha256) == Some(Change::LineEndings)
    })
}

/// The folders of the modules whose versions differ.
fn folders(context: &Context) -> HashSet<&str> {
    let entries = entries::all(context);
    let differing = entries.iter().filter_map(differing);
    differing.map(|(module, _)| module.folder.as_str()).collect()
}

/// The module and the version in its `VERSION` file, if that is a version and differs from the one in `urdd.json`.
fn differing<'a>(entry: &Entry<'a>) -> Option<(&'a Module, &'a str)> {
    let module = entry.module?;
    match &module.version_file {
        VersionFile::Text(text)
            if Version::new(text.as_str()).is_some() && text != entry.entry.version.as_str() =>
        {
            Some((module, text))
        }
        _ => None,
    }
}

fn version_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    for entry in listed_modules(context)? {
        if let Some((module, version)) = differing(&entry) {
            let message = format!(
                "{} says {version}: write the version of the module's format into both",
                module.file("VERSION")
            );
            let finding = finding_in(&entry, "version", message);
            findings.report(finding.values(version, &entry.entry.version));
        }
    }
    Some(())
}

fn module_version_unknown(context: &Context, findings: &mut Findings) -> Option<()> {
    let differing = folders(context);
    for module in entries::known_modules(context) {
        let (Some(kind), Some(version)) = (module.kind, &module.version) else { continue };
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

fn newer_version(context: &Context, findings: &mut Findings) -> Option<()> {
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
    let differing = folders(context);
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

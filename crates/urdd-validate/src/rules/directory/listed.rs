//! Modules and files that `urdd.json` lists and that are missing, and those that are there and not listed.

use crate::rules::prelude::*;
use urdd_document::module::{JsonFile, Mirror, VersionFile, is_extension};
use urdd_format::registry;

declare_rule! {
    /// A module that `urdd.json` lists is not there.
    ///
    /// A program that trusts the list stops, or continues with half a robot. Most often a folder was
    /// deleted, renamed, or left out of an archive.
    ///
    /// Bring the folder back, or take the module out of `modules` (and `depends_on` of others with
    /// it).
    DIR002 "listed-module-missing", Error, clause "2.3", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check listed_module_missing,

    /// A module folder is there that `urdd.json` does not list.
    ///
    /// Programs that go by the list do not see the module, and programs that look for folders do: two
    /// readers see two robots. Its files have no hash either, so that a change of them is not noticed.
    ///
    /// Add the module to `modules` of `urdd.json`, or delete the folder.
    DIR003 "unlisted-module", Error, clause "2.3", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check unlisted_module,

    /// A file that `urdd.json` lists is not there.
    ///
    /// The URDD is not whole: a file was deleted or renamed, or left out of an archive or a commit
    /// (see what `.gitignore` says of mesh files). It may also never have been written.
    ///
    /// Bring the file back, or write `urdd.json` again from what is there.
    DIR011 "listed-file-missing", Error, clause "2.7", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check listed_file_missing,

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

    /// A module is neither in the specification nor an extension.
    ///
    /// It is not checked, and no other program will know it. Nothing is wrong with that.
    ///
    /// To have it checked, make it an extension: name its folder `x_<vendor>_<name>_module`, of
    /// lower-case letters, digits and `_`, put it into the root, and give it a `schema.json`.
    DIR022 "unknown-module", Info, clause "11.2", since "0.1.0",
    phase Files, needs [], check unknown_module,

    /// A module's folder holds a file that neither the module nor `urdd.json` names.
    ///
    /// Most often it is left over from an earlier run (meshes of links that were renamed), or from an
    /// editor. It makes the URDD larger, and people take it for part of the robot.
    ///
    /// Delete it, or keep it outside the module folders: no rule is about files in the root folder
    /// itself. Write a module into a fresh folder, not over an old one.
    DIR013 "stray-file", Warning, clause "2.7", since "0.1.0",
    phase Files, needs [Version1, RootMetadata], check stray_file,

    /// `urdd.json` does not list the files of a module as they are.
    ///
    /// The list is what a program copies, packs or downloads when it wants a module, and what says
    /// that a file is unchanged. A file that is not on it gets lost; one of another folder does not
    /// belong there.
    ///
    /// List `VERSION`, `module.json`, `module.yaml`, every mesh or other file in the module's folder
    /// that the module's document names (for an extension `schema.json`), and nothing outside of it.
    DIR012 "file-list-incomplete", Error, clause "2.7", since "0.1.0",
    phase Files, needs [Version1, RootMetadata, NotFailed(DIR021)], check file_list_incomplete,
}

fn listed_module_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    for entry in listed_modules(context)? {
        let folder = &entry.entry.path;
        // DIR015 reports an invalid path, DIR021 a wrong folder.
        let misplaced = entry.kind.is_some_and(|kind| kind.folder() != folder);
        if misplaced || path::check(folder).is_err() {
            continue;
        }
        let there = context.listing().get(folder).map(|entry| entry.kind);
        let (actual, message) = match there {
            Some(EntryKind::Folder | EntryKind::LinkOut) => continue,
            None => (
                "nothing",
                format!(
                    "the folder {folder} is missing: restore it, or remove the module from the list"
                ),
            ),
            Some(EntryKind::Link) => (
                "a symbolic link",
                format!("{folder} is a symbolic link: put the folder itself there"),
            ),
            Some(_) => {
                ("a file", format!("{folder} is not a folder: put the module's folder there"))
            }
        };
        finding_in(&entry, "path", message).values("a folder", actual).report(findings);
    }
    Some(())
}

fn unlisted_module(context: &Context, findings: &mut Findings) -> Option<()> {
    // By name too: DIR021 reports an entry with the right name and a wrong path.
    let mut listed = HashSet::new();
    for entry in listed_modules(context)? {
        listed.insert(entry.entry.path.as_str());
        listed.insert(entry.entry.name.as_str());
    }
    for module in entries::known_modules(context) {
        if !listed.contains(module.folder.as_str()) && !listed.contains(module.name()) {
            let message =
                "urdd.json does not list this module: add it to `modules`, or delete the folder";
            Finding::in_file(&module.folder, message).report(findings);
        }
    }
    Some(())
}

fn listed_file_missing(context: &Context, findings: &mut Findings) -> Option<()> {
    let mut look = |pointer: String, path: &str, message: &str| {
        if entries::look(context, path) == Err(ReadError::Missing) {
            Finding::at(ROOT_METADATA, pointer, message)
                .values("a file", format!("nothing at {path}"))
                .report(findings);
        }
    };
    if let Some(file) = source(context) {
        let message = "the source URDF is missing: put it into the root folder";
        look("/source/Urdf/path".to_owned(), &file.path, message);
    }
    for entry in listed_modules(context)? {
        // DIR002 reports a missing folder; DIR004 and DIR005 report missing module.json and VERSION files.
        if context.listing().get(&entry.entry.path).is_none() {
            continue;
        }
        for (place, file) in entry.entry.files.iter().enumerate() {
            let own = file.path.strip_prefix(entry.entry.path.as_str());
            if entry.module.is_none() || !matches!(own, Some("/VERSION" | "/module.json")) {
                let pointer = entry.pointer(&format!("files/{place}/path"));
                let message = "the file is missing: restore it, or write urdd.json again from the files that exist";
                look(pointer, &file.path, message);
            }
        }
    }
    Some(())
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

fn unknown_module(context: &Context, findings: &mut Findings) -> Option<()> {
    let mut reported = HashSet::new();
    for module in context.modules() {
        if !entries::is_known(context, module) {
            reported.insert(module.folder.as_str());
            Finding::in_file(&module.folder, message(&module.folder)).report(findings);
        }
    }
    // Folders that are modules only according to urdd.json.
    for entry in entries::all(context) {
        let folder = entry.entry.path.as_str();
        let known = entry.kind.is_some() || is_extension(folder);
        if !known && context.listing().has_folder(folder) && reported.insert(folder) {
            Finding::in_file(folder, message(folder)).report(findings);
        }
    }
    Some(())
}

fn message(folder: &str) -> &'static str {
    let name = folder.rsplit('/').next().unwrap_or(folder);
    if is_extension(name) {
        "this extension is not checked, because it is not in the root folder: move it there"
    } else if name.starts_with("x_") {
        "this module is not checked: the folder of an extension is named x_<vendor>_<name>_module, of lower-case letters, digits and `_`"
    } else {
        "this module is not known and not checked; if it is yours, name its folder x_<vendor>_<name>_module and give it a schema.json"
    }
}

fn stray_file(context: &Context, findings: &mut Findings) -> Option<()> {
    let listed = listed_files(context.metadata()?);
    let paths = paths::all(context);
    let named: HashSet<&str> = paths.iter().map(|path| path.path).collect();
    for module in entries::known_modules(context) {
        // It is unknown which files an extension or a broken document names.
        if module.kind.is_none() || module.document.is_none() || misnames_files(context, module) {
            continue;
        }
        let own = entries::MODULE_FILES.map(|name| module.file(name));
        let stray: Vec<&str> = context
            .listing()
            .below(&module.folder)
            .filter(|entry| matches!(entry.kind, EntryKind::File | EntryKind::Link))
            .filter(|entry| entry.utf8 && !own.contains(&entry.path))
            .map(|entry| entry.path.as_str())
            .filter(|path| !listed.contains(path) && !named.contains(path))
            .collect();
        let Some(first) = stray.first() else { continue };
        let others = match stray.len() - 1 {
            0 => String::new(),
            n => format!(" (and neither does it name {n} more below this folder)"),
        };
        let message = format!(
            "{} does not name this file{others}: delete it, or keep it outside the module folders",
            module.name()
        );
        Finding::in_file(*first, message).count(stray.len()).report(findings);
    }
    Some(())
}

/// Whether the module names a missing file, or one file for two things. Stray files follow from that, and rules of its
/// family report it.
fn misnames_files(context: &Context, module: &Module) -> bool {
    let mut seen = HashSet::new();
    paths::of_module(module).iter().any(|path| {
        let there = match path.place(context) {
            paths::Place::Here(path) => entries::look(context, path).is_ok(),
            _ => false,
        };
        !there || (!path.is_reference && !seen.insert(path.path))
    })
}

fn file_list_incomplete(context: &Context, findings: &mut Findings) -> Option<()> {
    for entry in listed_modules(context)? {
        // Another rule reports a listed file that has a fault of its own.
        if entry.module.is_none() || entry.has_faulty_file(context) {
            continue;
        }
        let mut files = entry.entry.files.iter().enumerate();
        if let Some((place, file)) = files.find(|(_, file)| !entry.holds(&file.path)) {
            let message = "the file is not in the module's folder: list it with the module that it belongs to";
            finding_in(&entry, format!("files/{place}/path"), message)
                .values(format!("a path in {}/", entry.entry.path), &file.path)
                .report(findings);
            continue;
        }
        let unlisted = unlisted(context, &entry);
        let Some(first) = unlisted.first() else { continue };
        let message = match unlisted.len() - 1 {
            0 => format!("{first} is not listed: add it, with size and SHA-256"),
            n => format!("{first} and {n} more are not listed: add them, with sizes and SHA-256"),
        };
        finding_in(&entry, "files", message)
            .expected(format!("an entry for {first}"))
            .count(unlisted.len())
            .report(findings);
    }
    Some(())
}

/// The files of a module that are missing from its list.
fn unlisted(context: &Context, entry: &Entry<'_>) -> Vec<String> {
    let Some(module) = entry.module else { return Vec::new() };
    let files = entry.entry.files.iter();
    let listed: HashSet<&str> = files.map(|file| file.path.as_str()).collect();
    let schema = is_extension(&module.folder).then_some("schema.json");
    let own = entries::MODULE_FILES.into_iter().chain(schema).map(|name| module.file(name));
    let named = paths::of_module(module).into_iter().filter_map(|path| match path.place(context) {
        paths::Place::Here(path) if entry.holds(path) => Some(path.to_owned()),
        _ => None,
    });
    let mut unlisted: Vec<String> = own
        .chain(named)
        .filter(|path| !listed.contains(path.as_str()) && context.listing().has_file(path))
        .collect();
    unlisted.sort();
    unlisted.dedup();
    unlisted
}

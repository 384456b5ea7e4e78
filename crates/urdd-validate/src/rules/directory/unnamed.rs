use crate::rules::prelude::*;
use urdd_document::entries::MODULE_FILES;
use urdd_document::module::is_extension;
use urdd_document::paths::Place;

declare_rule! {
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
        let own = MODULE_FILES.map(|name| module.file(name));
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
            Place::Here(path) => entries::look(context, path).is_ok(),
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
    let own = MODULE_FILES.into_iter().chain(schema).map(|name| module.file(name));
    let named = paths::of_module(module).into_iter().filter_map(|path| match path.place(context) {
        Place::Here(path) if entry.holds(path) => Some(path.to_owned()),
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

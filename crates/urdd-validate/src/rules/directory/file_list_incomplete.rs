use crate::rules::prelude::*;
use urdd_document::entries::MODULE_FILES;
use urdd_document::module::is_extension;
use urdd_document::paths::Place;

declare_rule! {
    /// `urdd.json` does not list the files of a module as they are.
    ///
    /// The list is what a program copies, packs or downloads when it wants a module, and what says
    /// that a file is unchanged. A file that is not on it gets lost; one of another folder does not
    /// belong there.
    ///
    /// List `VERSION`, `module.json`, `module.yaml`, every mesh or other file in the module's folder
    /// that the module's document names (for an extension `schema.json`), and nothing outside of it.
    DIR012 "file-list-incomplete", Error, clause "2.7", since "0.1.0",
    phase Files, needs [Version1, RootMetadata, NotFailed(DIR021)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
        let Some(first) = unlisted.first() else {
            continue;
        };
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
    let Some(module) = entry.module else {
        return Vec::new();
    };
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

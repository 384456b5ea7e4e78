//! `urdd.json`, and this program's extensions of it.

use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::error::{GenerateError, Result};
use urdd_directory::writer::sha256;
use urdd_format::registry::{FIRST_SPEC_VERSION, ModuleKind, PROGRAM_VERSION};
use urdd_format::root_metadata::{
    ConformanceClass, FileEntry, Generator, ModuleEntry, RootMetadata, Source, Version,
};

/// The generator name in the URDDs of this program.
pub(super) const GENERATOR: &str = "urdd";
/// Key in a module's entry: the hash of all its inputs.
pub(super) const INPUTS_KEY: &str = "x_urdd_inputs";
/// Key in the source: the file as found, if the stored text differs.
pub(super) const FOUND_KEY: &str = "x_urdd_found";

/// Key in the source: the description that it was imported from.
const IMPORTED_KEY: &str = "x_urdd_imported";

pub(super) struct Entry {
    pub module: ModuleEntry,
    pub inputs: Option<String>,
}

/// The version of every module that this program generates.
pub(super) const MODULE_VERSION: &str = "1.0.0";

fn version(text: &str) -> Version {
    Version::new(text).unwrap_or_else(|| unreachable!("a constant of this program"))
}

/// The entry of a module. `files` may be in any order.
pub(super) fn entry(kind: ModuleKind, mut files: Vec<FileEntry>, inputs: Option<String>) -> Entry {
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Entry {
        module: ModuleEntry {
            name: kind.name().to_owned(),
            version: version(MODULE_VERSION),
            path: kind.folder().to_owned(),
            depends_on: kind.depends_on().iter().map(|kind| kind.name().to_owned()).collect(),
            files,
        },
        inputs,
    }
}

/// The hash of all inputs of a module: the program version, the module and its settings, and the files of the modules
/// that it depends on.
pub(super) fn inputs<'a>(
    kind: ModuleKind,
    settings: &str,
    modules: impl Iterator<Item = &'a ModuleEntry> + Clone,
) -> String {
    let mut text =
        format!("{GENERATOR} {}\n{} {MODULE_VERSION}\n{settings}\n", PROGRAM_VERSION, kind.name());
    let needed = kind.depends_on().iter().map(|kind| kind.name());
    for name in needed {
        let named = modules.clone().filter(|module| module.name == name);
        for file in named.flat_map(|module| &module.files) {
            text += &format!("{} {} {}\n", file.path, file.size, file.sha256);
        }
    }
    sha256(&Sha256::digest(text)).as_str().to_owned()
}

/// The highest conformance class whose modules are all present.
pub(super) fn class(made: &[Entry]) -> ConformanceClass {
    let has = |kind: ModuleKind| made.iter().any(|entry| entry.module.name == kind.name());
    let whole = |class: ConformanceClass| {
        let mut kinds = ModuleKind::ALL.iter().filter(|kind| kind.class() == Some(class));
        kinds.all(|kind| has(*kind))
    };
    match (whole(ConformanceClass::Geometry), whole(ConformanceClass::Shapes)) {
        (true, true) => ConformanceClass::Shapes,
        (true, false) => ConformanceClass::Geometry,
        _ => ConformanceClass::Core,
    }
}

/// Builds the document. `extensions` are the entries of modules unknown to this program.
pub(super) fn document(
    robot_name: &str,
    source: &FileEntry,
    found: Option<&FileEntry>,
    origin: Option<&Value>,
    made: &[Entry],
    extensions: Vec<Value>,
) -> Result<Value> {
    let is_made = |kind: &&ModuleKind| made.iter().any(|entry| entry.module.name == kind.name());
    // The lowest version of the specification that has all modules (SPEC 4.1).
    let since = ModuleKind::ALL.iter().filter(is_made).map(|kind| kind.since()).max();
    let metadata = RootMetadata {
        urdd_version: version(since.unwrap_or(FIRST_SPEC_VERSION)),
        robot_name: robot_name.to_owned(),
        conformance_class: class(made),
        generator: Some(Generator {
            name: GENERATOR.to_owned(),
            version: PROGRAM_VERSION.to_owned(),
        }),
        source: Some(Source::Urdf(source.clone())),
        modules: made.iter().map(|entry| entry.module.clone()).collect(),
    };
    let to_value = |value| {
        serde_json::to_value(value).map_err(|error| GenerateError::internal(robot_name, error))
    };
    let mut document = to_value(metadata)?;
    if let Some(found) = found {
        document["source"][FOUND_KEY] = json!({
            "path": found.path, "size": found.size, "sha256": found.sha256,
        });
    }
    if let Some(origin) = origin {
        document["source"][IMPORTED_KEY] = origin.clone();
    }
    if let Some(modules) = document["modules"].as_array_mut() {
        for (module, entry) in modules.iter_mut().zip(made) {
            if let Some(inputs) = &entry.inputs {
                module[INPUTS_KEY] = json!(inputs);
            }
        }
        modules.extend(extensions);
    }
    Ok(document)
}

//! The published JSON Schemas as the text of files, generated from the types. No I/O:
//! `urdd_directory::schema_files` reads and writes them.

use schemars::Schema;
use schemars::transform::transform_subschemas;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};

use super::annotations::KEYWORDS;
use super::conformance::{
    PRODUCER_RESULT_VERSION, ProducerResult, VALIDATOR_RESULT_VERSION, ValidatorResult,
};
use super::diff_report::{DIFF_REPORT_VERSION, DiffReport};
use super::hexadecimal::hexadecimal;
use super::nearest::nearest;
use super::registry::{ModuleSpec, Profile, modules};
use super::report::{REPORT_VERSION, Report};
use super::root_metadata::RootMetadata;

/// Each with the keys and types that the one after it has more.
type EarlierVersions<const N: usize> =
    [(&'static str, &'static [&'static str], &'static [&'static str]); N];

/// The earlier versions of the report.
const EARLIER_REPORTS: EarlierVersions<2> = [
    (
        "1.0.0",
        &["programs", "imported", "xacro_arguments"],
        &["ProgramResult", "ProgramEffect", "Does", "Deed", "ImportedFrom", "ImportedPart"],
    ),
    (
        "1.1.0",
        &["not_examined", "passed", "failed", "used_at", "calls", "is_supposed"],
        &["NotExamined", "Cause", "MacroPlace"],
    ),
];

/// The earlier versions of the report of differences, each with the lists that the one after it has more.
pub const EARLIER_DIFF_REPORTS: [(&str, &[&str]); 3] =
    [("1.0.0", &["configurations"]), ("1.1.0", &["srdf", "setup", "lost"]), ("1.2.0", &["loops"])];

/// The earlier versions of the result of a validator.
const EARLIER_VALIDATOR_RESULTS: EarlierVersions<2> = [
    (
        "1.0.0",
        &["profile", "unreadable"],
        &["ValidatorProfile", "UnreadableScore", "UnreadableCase", "UnreadableFault"],
    ),
    ("1.1.0", &["unverified", "crashed_unreadable", "class"], &["ConformanceClass"]),
];

/// A document that has a published schema.
#[derive(Clone, Copy)]
pub enum Subject {
    /// `urdd.json`.
    RootMetadata,
    /// The document of a module.
    Module(&'static ModuleSpec),
    /// Output of `urdd validate --format json`.
    Report,
    /// The same in an earlier version, by its place in the list of earlier ones.
    EarlierReport(usize),
    /// Output of `urdd diff --format json`.
    DiffReport,
    /// The same in an earlier version, by its place in [`EARLIER_DIFF_REPORTS`].
    EarlierDiffReport(usize),
    /// Output of `urdd conformance producer --format json`.
    ProducerResult,
    /// Output of `urdd conformance validator --format json`.
    ValidatorResult,
    /// The same in an earlier version, by its place in the list of earlier ones.
    EarlierValidatorResult(usize),
}

/// Intended use of a schema.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Variant {
    /// For producers and validators: rejects unknown keys.
    Strict,
    /// For code generators: accepts unknown keys, to read documents of later minor versions.
    Open,
}

/// A file in the folder of published schemas.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SchemaFile {
    /// Path relative to that folder, with forward slashes.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// Errors in the schemas themselves.
#[derive(Debug, thiserror::Error)]
pub enum SchemaError {
    /// No schema has this id.
    #[error("there is no schema `{id}`{}", hint(near))]
    UnknownId {
        /// The requested id.
        id: String,
        /// Similar ids, nearest first.
        near: Vec<String>,
    },
    /// The list of released schemas cannot be read.
    #[error("{RELEASED_PATH}: {0}")]
    Released(#[from] serde_json::Error),
}

fn hint(near: &[String]) -> String {
    let words: Vec<String> = near.iter().map(|id| format!("`{id}`")).collect();
    match words.as_slice() {
        [] => String::new(),
        words => format!("; did you mean {}?", words.join(" or ")),
    }
}

/// A frozen schema.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Release {
    /// Its id: `dof_module@0.0.2`.
    pub id: String,
    /// Its [`validating_hash`].
    pub sha256: String,
}

/// Path of the list of released schemas in the folder of published schemas.
pub const RELEASED_PATH: &str = "released.json";

/// The list itself. It is maintained by hand: a program that updated it would not freeze anything.
const RELEASED: &str = include_str!("released.json");

/// The released schemas, in the order of the list.
///
/// # Errors
/// If the list is not a valid list of releases.
pub fn released() -> Result<Vec<Release>, SchemaError> {
    Ok(serde_json::from_str(RELEASED)?)
}

impl Subject {
    /// Every document with a published schema: the root metadata, the registry in its order, the
    /// reports, and the results of the conformance commands.
    pub fn all() -> impl Iterator<Item = Subject> {
        let modules = modules().iter().map(Subject::Module);
        let earlier = (0..EARLIER_DIFF_REPORTS.len()).map(Subject::EarlierDiffReport);
        let reports = (0..EARLIER_REPORTS.len()).map(Subject::EarlierReport);
        let reports = reports.chain([Subject::Report]).chain(earlier);
        std::iter::once(Subject::RootMetadata)
            .chain(modules)
            .chain(reports)
            .chain([Subject::DiffReport, Subject::ProducerResult])
            .chain((0..EARLIER_VALIDATOR_RESULTS.len()).map(Subject::EarlierValidatorResult))
            .chain([Subject::ValidatorResult])
    }

    /// The subject with an id such as `dof_module@1.0.0`.
    ///
    /// # Errors
    /// If no subject has this id. The error suggests similar ids.
    pub fn find(id: &str) -> Result<Subject, SchemaError> {
        Subject::all()
            .find(|subject| subject.id() == id)
            .ok_or_else(|| SchemaError::UnknownId { id: id.to_owned(), near: near_ids(id) })
    }

    /// Name and version as one word: `dof_module@1.0.0`.
    pub fn id(self) -> String {
        format!("{}@{}", self.name(), self.version())
    }

    /// Name of the document.
    pub fn name(self) -> &'static str {
        match self {
            Subject::RootMetadata => "root_metadata",
            Subject::Report | Subject::EarlierReport(_) => "report",
            Subject::DiffReport | Subject::EarlierDiffReport(_) => "diff_report",
            Subject::ProducerResult => "producer_result",
            Subject::ValidatorResult | Subject::EarlierValidatorResult(_) => "validator_result",
            Subject::Module(spec) => spec.kind.name(),
        }
    }

    /// Version of its format; `unversioned` for a legacy module without one.
    pub fn version(self) -> &'static str {
        match self {
            Subject::RootMetadata => "1.0.0",
            Subject::EarlierReport(place) => EARLIER_REPORTS[place].0,
            Subject::EarlierValidatorResult(place) => EARLIER_VALIDATOR_RESULTS[place].0,
            Subject::EarlierDiffReport(place) => EARLIER_DIFF_REPORTS[place].0,
            Subject::Report => REPORT_VERSION,
            Subject::DiffReport => DIFF_REPORT_VERSION,
            Subject::ProducerResult => PRODUCER_RESULT_VERSION,
            Subject::ValidatorResult => VALIDATOR_RESULT_VERSION,
            Subject::Module(spec) if spec.version.is_empty() => "unversioned",
            Subject::Module(spec) => spec.version,
        }
    }

    /// Path of its schema in the folder of published schemas.
    pub fn path(self) -> String {
        format!("{}/{}.json", self.name(), self.version())
    }

    /// Its schema, as published.
    pub fn schema(self, variant: Variant) -> Value {
        let schema = match self {
            Subject::RootMetadata => schemars::schema_for!(RootMetadata),
            Subject::Report => schemars::schema_for!(Report),
            Subject::DiffReport => schemars::schema_for!(DiffReport),
            Subject::EarlierReport(place) => {
                before(schemars::schema_for!(Report), &EARLIER_REPORTS[place..])
            }
            Subject::EarlierDiffReport(place) => {
                let later = EARLIER_DIFF_REPORTS[place..].iter().flat_map(|(_, lists)| *lists);
                let later: Vec<&str> = later.copied().collect();
                without(schemars::schema_for!(DiffReport), &later, &[])
            }
            Subject::ProducerResult => schemars::schema_for!(ProducerResult),
            Subject::ValidatorResult => schemars::schema_for!(ValidatorResult),
            Subject::EarlierValidatorResult(place) => {
                before(schemars::schema_for!(ValidatorResult), &EARLIER_VALIDATOR_RESULTS[place..])
            }
            Subject::Module(spec) => spec.schema(),
        };
        let suffix = match variant {
            Variant::Strict => "",
            Variant::Open => ":open",
        };
        let id = format!("urn:urdd:schema:{}:{}{suffix}", self.name(), self.version());
        published(schema, id, variant, self.is_version_1())
    }

    /// Whether it is a document of a URDD of version 1. Only the schemas of these say units, frames, indices and lengths
    /// (SPEC 11.3).
    pub fn is_version_1(self) -> bool {
        match self {
            Subject::RootMetadata => true,
            Subject::Module(spec) => spec.profile == Profile::V1,
            _ => false,
        }
    }

    /// The text of its schema file.
    pub fn text(self, variant: Variant) -> String {
        // `{:#}` writes indented JSON; unlike `to_string_pretty`, it cannot fail.
        format!("{:#}\n", self.schema(variant))
    }
}

/// The schema before what these versions and later ones have more.
fn before(schema: Schema, later: &[(&str, &[&str], &[&str])]) -> Schema {
    let keys: Vec<&str> = later.iter().flat_map(|(_, keys, _)| *keys).copied().collect();
    let types: Vec<&str> = later.iter().flat_map(|(_, _, types)| *types).copied().collect();
    without(schema, &keys, &types)
}

/// The schema before these keys and types were added.
fn without(mut schema: Schema, keys: &[&str], types: &[&str]) -> Schema {
    let mut definitions = schema.get_mut("$defs");
    let definitions = definitions.as_mut().and_then(|all| all.as_object_mut());
    if let Some(all) = definitions {
        all.retain(|name, _| !types.contains(&name.as_str()));
        all.values_mut().filter_map(Value::as_object_mut).for_each(|object| forget(object, keys));
    }
    forget(schema.ensure_object(), keys);
    schema
}

/// Removes keys from the schema of an object.
fn forget(object: &mut Map<String, Value>, keys: &[&str]) {
    if let Some(Value::Object(properties)) = object.get_mut("properties") {
        properties.retain(|key, _| !keys.contains(&key.as_str()));
    }
    if let Some(Value::Array(required)) = object.get_mut("required") {
        required.retain(|one| !keys.iter().any(|key| one == key));
    }
}

/// Every file in the folder of published schemas, sorted by path. Open schemas are not frozen, so
/// the list of releases comes with the strict ones only.
pub fn files(variant: Variant) -> Vec<SchemaFile> {
    let mut files: Vec<SchemaFile> = Subject::all()
        .map(|subject| SchemaFile { path: subject.path(), text: subject.text(variant) })
        .collect();
    if variant == Variant::Strict {
        files.push(SchemaFile { path: RELEASED_PATH.to_owned(), text: RELEASED.to_owned() });
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    files
}

/// The part of a schema that decides validity: without texts for people, and with unordered lists
/// sorted. Schemas with equal validating parts accept the same documents. The annotations of SPEC 11.3
/// are part of it: a released field keeps its unit, frame, index space and length.
pub fn validating_part(schema: &Value) -> Value {
    let mut part = Schema::try_from(schema.clone()).unwrap_or_default();
    each_schema(&mut part, &|object| {
        for annotation in ["title", "description", "$id", "$comment", "examples"] {
            object.shift_remove(annotation);
        }
        for set in ["required", "enum", "type"] {
            if let Some(Value::Array(items)) = object.get_mut(set) {
                items.sort_by_key(Value::to_string);
            }
        }
    });
    let mut part = part.to_value();
    part.sort_all_objects();
    part
}

/// SHA-256 of a schema's validating part as JSON without white space and with sorted keys: 64
/// lower-case hexadecimal digits.
pub fn validating_hash(schema: &Value) -> String {
    let digest = Sha256::digest(validating_part(schema).to_string());
    hexadecimal(&digest)
}

fn published(mut schema: Schema, id: String, variant: Variant, annotated: bool) -> Value {
    schema.insert("$id".to_owned(), json!(id));
    name_definitions(&mut schema);
    each_schema(&mut schema, &|object| {
        // The bit width is an implementation detail, and validators warn about unknown formats.
        object.shift_remove("format");
        if !annotated {
            object.retain(|keyword, _| !KEYWORDS.contains(&keyword.as_str()));
        }
        if let Some(Value::String(text)) = object.get_mut("description") {
            *text = flowing(text);
        }
        // Some code generators turn a `$ref` with a description beside it into a second type.
        if object.len() > 1
            && let Some(reference) = object.shift_remove("$ref")
        {
            object.insert("allOf".to_owned(), json!([{ "$ref": reference }]));
        }
        if variant == Variant::Open {
            object.shift_remove("additionalProperties");
            object.shift_remove("patternProperties");
            plain_integers(object);
        }
        // Put first what a reader looks for first.
        let mut rest = std::mem::take(object);
        for keyword in ["$schema", "$id", "title", "description"].into_iter().chain(KEYWORDS) {
            if let Some(value) = rest.shift_remove(keyword) {
                object.insert(keyword.to_owned(), value);
            }
        }
        object.extend(rest);
    });
    schema.to_value()
}

/// Some code generators declare an extra type for integer list elements that have bounds or a
/// description. The description of the list says what they count.
fn plain_integers(list: &mut Map<String, Value>) {
    let items = list.get_mut("items").and_then(Value::as_object_mut);
    if let Some(items) = items.filter(|items| items.get("type") == Some(&json!("integer"))) {
        items.retain(|keyword, _| keyword == "type" || KEYWORDS.contains(&keyword.as_str()));
    }
}

/// Some code generators name a type after the title, else after the property that refers to it.
fn name_definitions(schema: &mut Schema) {
    let Some(Value::Object(definitions)) = schema.get_mut("$defs") else {
        return;
    };
    for (name, definition) in definitions {
        if let Value::Object(definition) = definition {
            definition.insert("title".to_owned(), json!(name));
        }
    }
}

/// Joins the wrapped lines of a doc comment; lists and paragraphs keep their line breaks.
fn flowing(text: &str) -> String {
    let mut flowing = String::with_capacity(text.len());
    for line in text.lines() {
        if line.is_empty() || line.starts_with("- ") {
            flowing.push('\n');
        } else if !flowing.is_empty() && !flowing.ends_with('\n') {
            flowing.push(' ');
        }
        flowing.push_str(line);
    }
    flowing
}

/// Applies `change` to every schema within a schema, and to itself. Property names and enumeration
/// values are not schemas, even if they look like keywords.
pub(super) fn each_schema(schema: &mut Schema, change: &dyn Fn(&mut Map<String, Value>)) {
    transform_subschemas(&mut |inner: &mut Schema| each_schema(inner, change), schema);
    if let Some(object) = schema.as_object_mut() {
        change(object);
    }
}

/// All versions of the module with this name, else of the one with the most similar name.
fn near_ids(id: &str) -> Vec<String> {
    let name = id.split('@').next().unwrap_or_default();
    let near = nearest(Subject::all().map(Subject::name), name);
    let of_name = Subject::all().filter(|subject| near.as_deref() == Some(subject.name()));
    of_name.map(Subject::id).collect()
}

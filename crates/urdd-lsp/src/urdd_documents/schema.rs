//! The schema of a document.

use serde::Deserialize;
use serde_json::Value;

use crate::kind::Schema;
use urdd_document::schema_check::{self, SchemaViolation};
use urdd_format::registry::{self, modules};
use urdd_format::root_metadata::RootMetadata;
use urdd_format::schema::{Subject, Variant};

impl Schema {
    /// The document that it is of.
    pub(super) fn subject(self) -> Subject {
        match self {
            Schema::Root => Subject::RootMetadata,
            Schema::Module(index, _) => {
                modules().get(index).map_or(Subject::RootMetadata, Subject::Module)
            }
        }
    }

    /// The schema as it is published.
    pub(super) fn published(self) -> Value {
        self.subject().schema(Variant::Strict)
    }

    /// How a document breaks it.
    pub(super) fn violations(self, value: &Value) -> Vec<SchemaViolation> {
        match self.subject() {
            Subject::Module(spec) => {
                let newer = matches!(self, Schema::Module(_, true));
                schema_check::read(spec, value, newer).1
            }
            _ => {
                let Err(error) = RootMetadata::deserialize(value) else {
                    return Vec::new();
                };
                let schema = schemars::schema_for!(RootMetadata);
                let newer = is_newer(value);
                let read = |known: &Value| RootMetadata::deserialize(known).ok();
                schema_check::read_newer(&schema, value, newer, &error, read).1
            }
        }
    }
}

/// Whether root metadata is of a later minor version of the specification.
fn is_newer(metadata: &Value) -> bool {
    let version = metadata.get("urdd_version").and_then(Value::as_str);
    let version = version.and_then(|version| semver::Version::parse(version).ok());
    let known = semver::Version::parse(registry::SPEC_VERSION).ok();
    version
        .zip(known)
        .is_some_and(|(version, known)| version.major == known.major && version > known)
}

//! The schema of an extension: used without opening other files, and only if it takes little work. It is as untrusted
//! as the rest of the URDD.

use std::borrow::Cow;
use std::collections::HashSet;
use std::sync::Arc;

use jsonschema::error::ValidationErrorKind;
use jsonschema::{ValidationError, ValidationOptions, Validator};
use serde_json::{Number, Value};

use super::annotated::{self, Counts, Judged};
use super::pattern;
use super::schema_work::{affordable_work, anchors, definitions, escaped, schemas_in, targets};
use urdd_directory::json;
use urdd_directory::root::ReadError;
use urdd_document::module::Module;
use urdd_document::urdd::Urdd;
use urdd_format::annotations;

/// Maximum size of a `schema.json`, bytes.
pub const MAX_SCHEMA_BYTES: u64 = 1 << 20;

/// Maximum size of a pattern's automaton, bytes. Patterns are matched in time linear in the text; those that would need
/// backtracking (lookaround, backreferences) are refused.
const PATTERN_BYTES: usize = 1 << 18;

/// Above this work, only the first violation is searched, because a list of them takes memory proportional to the
/// document.
const WORK_FOR_ALL_VIOLATIONS: u64 = 100_000;

/// Compiling and evaluating follow references by recursion.
#[cfg(not(target_family = "wasm"))]
const STACK_BYTES: usize = 256 << 20;

/// Reads the schema of an extension.
///
/// # Errors
/// In words, why it is not JSON that can be read.
pub fn read(urdd: &Urdd, module: &Module) -> Result<Value, String> {
    let file = module.file("schema.json");
    let bytes = urdd.root().read(&file, MAX_SCHEMA_BYTES).map_err(|error| match error {
        ReadError::Missing => {
            "the extension has no schema.json: put its JSON Schema there".to_owned()
        }
        // DIR016 or DIR023 would report it for other files.
        error => error.to_string(),
    })?;
    let document = json::read(&bytes).map_err(|error| format!("not JSON: {error}"))?;
    Ok(document.value)
}

/// Why a value cannot be used as a schema for a document.
pub fn faults(schema: &Value, document: Option<&Value>) -> Vec<SchemaFault> {
    let mut faults = faults_of_parts(schema);
    if faults.is_empty()
        && let Err(fault) = on_a_large_stack(|| compile(options(), schema).map(|_| ()))
    {
        faults.push(fault);
    }
    if let (true, Some(document)) = (faults.is_empty(), document)
        && on_a_large_stack(|| affordable_work(schema, document)).is_none()
    {
        faults.push(SchemaFault {
            pointer: String::new(),
            message: "checking module.json against this schema takes too much work: its choices multiply; let one key decide each choice, or remove some".to_owned(),
        });
    }
    faults
}

/// The violations of a schema by a document.
#[derive(Debug, Default)]
pub struct Violations {
    /// Pointers and messages.
    pub found: Vec<(String, String)>,
    /// Whether only the first was searched.
    pub is_first_only: bool,
}

impl Violations {
    /// What a message adds where only the first was searched.
    pub fn more(&self) -> &'static str {
        if self.is_first_only { " (the document is large: there may be more)" } else { "" }
    }
}

/// The violations by a document of a schema without [`faults`]: at most `limit` places. In a large document, only the
/// first is searched.
///
/// `asserted`: an annotation that counts as an assertion. Without it, the document has no violations.
pub fn violations(
    schema: &Value,
    document: &Value,
    asserted: Option<(Judged, &Arc<Counts>)>,
    limit: usize,
) -> Violations {
    let judged = asserted.map(|(judged, _)| judged);
    on_a_large_stack(|| {
        let options = match asserted {
            Some((judged, counts)) => annotated::judging(options(), judged, Arc::clone(counts)),
            None => options(),
        };
        let Ok(validator) = compile(options, schema) else { return Violations::default() };
        let document = &*in_binary64(document);
        let Err(first) = validator.validate(document) else { return Violations::default() };
        let is_first_only =
            affordable_work(schema, document).is_none_or(|work| work > WORK_FOR_ALL_VIOLATIONS);
        let found = match is_first_only {
            true => places(&first, schema, judged).into_iter().take(1).collect(),
            false => (validator.iter_errors(document))
                .flat_map(|error| places(&error, schema, judged))
                .take(limit)
                .collect(),
        };
        Violations { found, is_first_only }
    })
}

/// Pointers and messages of a violation. Where no alternative of a choice fits, and all that is wrong in one of them
/// are annotations, they are those.
fn places(
    error: &ValidationError<'_>,
    schema: &Value,
    judged: Option<Judged>,
) -> Vec<(String, String)> {
    if let ValidationErrorKind::AnyOf { context } | ValidationErrorKind::OneOfNotValid { context } =
        error.kind()
        && let Some(nearest) = context.iter().find(|errors| are_annotations(errors))
    {
        let nearest = nearest.iter();
        return nearest.flat_map(|error| places(error, schema, judged)).collect();
    }
    let is_pattern = matches!(error.kind(), ValidationErrorKind::Pattern { .. });
    let written = schema.pointer(error.schema_path().as_str()).filter(|_| is_pattern);
    let message = match written {
        Some(pattern) => format!("value does not match {pattern}"),
        None => error.masked().to_string(),
    };
    let mut message: String = message.chars().take(200).collect();
    if let Some(judged) = judged.filter(|_| !is_annotation(error)) {
        // Of a keyword around it, such as `contains`.
        message = format!("`{}` of schema.json is not met: {message}", judged.keyword());
    }
    vec![(error.instance_path().to_string(), message)]
}

fn are_annotations(errors: &[ValidationError<'_>]) -> bool {
    !errors.is_empty() && errors.iter().all(is_annotation)
}

fn is_annotation(error: &ValidationError<'_>) -> bool {
    match error.kind() {
        ValidationErrorKind::Custom { .. } => true,
        ValidationErrorKind::AnyOf { context } | ValidationErrorKind::OneOfNotValid { context } => {
            context.iter().any(|errors| are_annotations(errors))
        }
        _ => false,
    }
}

/// Whether a key occurs anywhere.
pub fn mentions(value: &Value, key: &str) -> bool {
    match value {
        Value::Object(map) => {
            map.contains_key(key) || map.values().any(|value| mentions(value, key))
        }
        Value::Array(list) => list.iter().any(|value| mentions(value, key)),
        _ => false,
    }
}

fn options<'i>() -> ValidationOptions<'i> {
    // Without a retriever, so that a reference to another file fails without opening anything.
    jsonschema::draft202012::options().with_pattern_options(
        jsonschema::PatternOptions::regex().size_limit(PATTERN_BYTES).dfa_size_limit(PATTERN_BYTES),
    )
}

fn compile(options: ValidationOptions<'_>, schema: &Value) -> Result<Validator, SchemaFault> {
    let fault = |error: &ValidationError<'_>| SchemaFault {
        pointer: error.instance_path().to_string(),
        message: error.to_string().chars().take(300).collect(),
    };
    jsonschema::draft202012::meta::validate(schema).map_err(|error| fault(&error))?;
    options.build(&for_the_library(schema)).map_err(|error| fault(&error))
}

/// A value whose numbers are those of binary64 (SPEC 11.1). The library compares integers exactly.
fn in_binary64(value: &Value) -> Cow<'_, Value> {
    fn is_large(number: &Number) -> bool {
        const EXACT: u64 = 1 << f64::MANTISSA_DIGITS;
        number.as_i64().map(i64::unsigned_abs).or(number.as_u64()).is_some_and(|n| n >= EXACT)
    }
    fn has_large(value: &Value) -> bool {
        match value {
            Value::Number(number) => is_large(number),
            Value::Array(items) => items.iter().any(has_large),
            Value::Object(map) => map.values().any(has_large),
            _ => false,
        }
    }
    fn rounded(value: &mut Value) {
        match value {
            Value::Number(number) if is_large(number) => *value = number.as_f64().into(),
            Value::Array(items) => items.iter_mut().for_each(rounded),
            Value::Object(map) => map.values_mut().for_each(rounded),
            _ => {}
        }
    }
    let mut value = Cow::Borrowed(value);
    if has_large(&value) {
        rounded(value.to_mut());
    }
    value
}

/// A browser has no spare thread; its stack size is set at link time (`.cargo/config.toml`).
#[cfg(target_family = "wasm")]
fn on_a_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    work()
}

#[cfg(not(target_family = "wasm"))]
fn on_a_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    std::thread::scope(|scope| {
        let spawned = std::thread::Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, work);
        match spawned.map(|thread| thread.join()) {
            Ok(Ok(result)) => result,
            // The engine reports a rule that panics as crashed.
            Ok(Err(panic)) => std::panic::resume_unwind(panic),
            Err(error) => std::panic::resume_unwind(Box::new(error.to_string())),
        }
    })
}

pub struct SchemaFault {
    /// JSON Pointer into the schema.
    pub pointer: String,
    pub message: String,
}

/// All schemas in a schema, itself first, with their pointers. Each comes before those inside it.
fn parts(schema: &Value) -> Vec<(String, &Value)> {
    let mut parts = vec![(String::new(), schema)];
    let mut next = 0;
    while let Some((pointer, schema)) = parts.get(next).cloned() {
        next += 1;
        parts.extend(
            schemas_in(schema).map(|(inner, schema, _)| (pointer.clone() + &inner, schema)),
        );
        let definitions = definitions(schema);
        parts.extend(definitions.map(|(inner, schema)| (pointer.clone() + &inner, schema)));
    }
    parts
}

/// The patterns of a schema, not those in it, with their pointers behind its own.
fn patterns(schema: &Value) -> impl Iterator<Item = (String, &str)> {
    let one = schema.get("pattern").and_then(Value::as_str);
    let keys = schema.get("patternProperties").and_then(Value::as_object);
    let keys = keys.into_iter().flat_map(|keys| keys.keys());
    let keys = keys.map(|key| (format!("/patternProperties/{}", escaped(key)), key.as_str()));
    one.into_iter().map(|one| ("/pattern".to_owned(), one)).chain(keys)
}

/// The schema as the library has to have it: with patterns that it reads as JavaScript reads those that are there, and
/// without what it takes for more than SPEC 11.1 does: names of the schema that it wants to be URIs, and a keyword of draft 7.
fn for_the_library(schema: &Value) -> Cow<'_, Value> {
    let mut all = in_binary64(schema);
    for key in ["$schema", "$id"] {
        if schema.get(key).is_some() {
            all.to_mut().as_object_mut().map(|schema| schema.remove(key));
        }
    }
    let read = pattern::in_words_of_the_library;
    let in_words = |text: &str| read(text).map_or_else(|_| text.to_owned(), Cow::into_owned);
    // Those inside first: the pointers to them have the patterns as they were.
    for (pointer, part) in parts(schema).iter().rev() {
        let is_old = part.get("dependencies").is_some();
        if !is_old && !patterns(part).any(|(_, text)| matches!(read(text), Ok(Cow::Owned(_)))) {
            continue;
        }
        let Some(Value::Object(part)) = all.to_mut().pointer_mut(pointer) else { continue };
        part.remove("dependencies");
        if let Some(Value::String(text)) = part.get_mut("pattern") {
            *text = in_words(text);
        }
        if let Some(Value::Object(keys)) = part.get_mut("patternProperties") {
            for (key, value) in std::mem::take(keys) {
                let mut key = in_words(&key);
                // `\x41` and `\u0041` are two keys.
                while keys.contains_key(&key) {
                    key = format!("(?:{key})");
                }
                keys.insert(key, value);
            }
        }
    }
    all
}

/// References that leave the schema's own file, constructs that would make references ambiguous, annotations that are not
/// defined, and texts that are no patterns.
pub fn faults_of_parts(root: &Value) -> Vec<SchemaFault> {
    let mut faults = Vec::new();
    let (anchors, parts) = (anchors(root), parts(root));
    let schemas: HashSet<*const Value> =
        parts.iter().map(|(_, part)| std::ptr::from_ref(*part)).collect();
    for (of_part, schema) in parts {
        let mut fault = |at: &str, message: String| {
            faults.push(SchemaFault { pointer: of_part.clone() + at, message });
        };
        for key in ["$ref", "$dynamicRef"] {
            let Some(target) = schema.get(key).and_then(Value::as_str) else { continue };
            let shown: String = target.chars().take(80).collect();
            let what = match &*targets(root, &anchors, target) {
                _ if !target.starts_with('#') => {
                    "leads out of this file, and nothing else is opened: put what it names into `$defs`, and refer to it by `#/$defs/...`"
                }
                [_, _, ..] => "names an anchor that several schemas have: give each another name",
                [one] if !schemas.contains(&std::ptr::from_ref(*one)) => {
                    "leads to what is no schema, or is inside a keyword that says nothing: put it into `$defs`"
                }
                _ => continue,
            };
            fault(&format!("/{key}"), format!("`{shown}` {what}"));
        }
        for annotation in schema.as_object().map(annotations::faults).unwrap_or_default() {
            fault(&format!("/{}", annotation.keyword), annotation.to_string());
        }
        if !of_part.is_empty() && schema.get("$id").is_some() {
            fault("/$id", "only the schema itself may have an `$id`: take this one out, and refer to the part by `#/$defs/...`".to_owned());
        }
        for (inner, text) in patterns(schema) {
            if let Err(why) = pattern::in_words_of_the_library(text) {
                let shown: String = text.chars().take(80).collect();
                let message =
                    format!("`{shown}` is no pattern of JavaScript in Unicode mode: {why}");
                fault(&inner, message);
            }
        }
    }
    faults.sort_by(|a, b| a.pointer.cmp(&b.pointer));
    faults
}

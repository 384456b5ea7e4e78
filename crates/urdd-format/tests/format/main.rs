//! For every published schema: serde reads a document exactly if JSON Schema accepts it, and the result serialises back
//! unchanged.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod annotations;
mod cpp_types;
mod escape;
mod mutate;
mod published_schemas;
mod rate;
mod readable;
mod schema_comment;
mod short;
mod skips;
mod typescript;

use std::cell::Cell;

use jsonschema::Validator;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseError, TestRunner};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use testkit::documents::{Choices, arbitrary_json, instance};
use testkit::trials::trials;
use urdd_format::conformance::{ProducerResult, ValidatorResult};
use urdd_format::diff_report::DiffReport;
use urdd_format::registry::ModuleDocument;
use urdd_format::report::Report;
use urdd_format::root_metadata::RootMetadata;
use urdd_format::schema::{Subject, Variant};

/// Generated documents for each schema; each is mutated [`MUTATIONS`] times.
const CASES: u32 = 60;
const MUTATIONS: usize = 25;
/// Minimum number of times that each verdict must occur for each schema; below it, the comparison is meaningless.
const ENOUGH: usize = 100;

#[derive(Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum Document {
    Root(Box<RootMetadata>),
    Module(ModuleDocument),
    Report(Box<Report>),
    DiffReport(Box<DiffReport>),
    ProducerResult(Box<ProducerResult>),
    ValidatorResult(Box<ValidatorResult>),
}

fn read(subject: Subject, value: &Value) -> Result<Document, serde_json::Error> {
    match subject {
        Subject::RootMetadata => {
            RootMetadata::deserialize(value).map(|m| Document::Root(Box::new(m)))
        }
        Subject::Module(spec) => spec.read(value).map(Document::Module),
        Subject::Report | Subject::EarlierReport(_) => {
            Report::deserialize(value).map(|r| Document::Report(Box::new(r)))
        }
        Subject::DiffReport | Subject::EarlierDiffReport(_) => {
            DiffReport::deserialize(value).map(|r| Document::DiffReport(Box::new(r)))
        }
        Subject::ProducerResult => {
            ProducerResult::deserialize(value).map(|r| Document::ProducerResult(Box::new(r)))
        }
        Subject::ValidatorResult | Subject::EarlierValidatorResult(_) => {
            ValidatorResult::deserialize(value).map(|r| Document::ValidatorResult(Box::new(r)))
        }
    }
}

/// A file of the repository is what a test of this name writes with `URDD_UPDATE=1`.
fn is_written(file: &str, test: &str, expected: &str) {
    let path = testkit::repository().join(file);
    if std::env::var_os("URDD_UPDATE").is_some() {
        std::fs::write(&path, expected).expect("written");
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        found.replace("\r\n", "\n") == expected,
        "{file} is not what the schemas say: run URDD_UPDATE=1 cargo test --workspace --test format {test}"
    );
}

/// Every document that has a type: all but earlier versions of a report.
fn subjects() -> impl Iterator<Item = Subject> {
    Subject::all().filter(|subject| {
        use Subject::{EarlierDiffReport, EarlierReport, EarlierValidatorResult};
        !matches!(subject, EarlierReport(_) | EarlierDiffReport(_) | EarlierValidatorResult(_))
    })
}

fn validator(schema: &Value) -> Validator {
    jsonschema::draft202012::new(schema).unwrap()
}

/// Raw choices that determine a document: few and small ones give a small document, so that proptest shrinks documents
/// by shrinking this.
fn choices(most: usize) -> impl Strategy<Value = Vec<u16>> {
    proptest::collection::vec(any::<u16>(), 0..most)
}

/// Runs a property that generates a document from the first choices, and changes it by the second.
fn run(cases: u32, property: impl Fn(&mut Choices, &mut Choices) -> Result<(), TestCaseError>) {
    let mut runner = TestRunner::new(Config {
        cases: trials(cases),
        failure_persistence: None,
        ..Config::default()
    });
    let outcome = runner.run(&(choices(500), choices(600)), |(document, changes)| {
        property(&mut Choices::new(&document), &mut Choices::new(&changes))
    });
    if let Err(error) = outcome {
        panic!("{error}");
    }
}

/// The common verdict, or a failure where the two differ.
fn verdict(subject: Subject, validator: &Validator, value: &Value) -> Result<bool, TestCaseError> {
    let valid = validator.is_valid(value);
    let serde = read(subject, value);
    if valid != serde.is_ok() {
        let schema = validator.validate(value).err().map(|e| e.to_string());
        return Err(TestCaseError::fail(format!(
            "{}: schema says {schema:?}, serde says {:?} of\n{value:#}",
            subject.id(),
            serde.err().map(|e| e.to_string()),
        )));
    }
    Ok(valid)
}

#[test]
fn serde_accepts_exactly_what_the_schema_accepts() {
    for subject in subjects() {
        let schema = subject.schema(Variant::Strict);
        let validator = validator(&schema);
        let seen = [Cell::new(0), Cell::new(0)];
        run(CASES, |choices, changes| {
            let document = instance(&schema, choices);
            prop_assert!(
                verdict(subject, &validator, &document)?,
                "{}: the generator is wrong: {document:#}",
                subject.id()
            );
            for _ in 0..MUTATIONS {
                let mut mutant = document.clone();
                for _ in 0..=changes.pick(2) {
                    mutate::mutate(&mut mutant, changes);
                }
                let count = &seen[usize::from(verdict(subject, &validator, &mutant)?)];
                count.set(count.get() + 1);
            }
            verdict(subject, &validator, &arbitrary_json(changes, 3))?;
            Ok(())
        });
        let [rejected, accepted] = seen.map(Cell::into_inner);
        assert!(
            rejected > ENOUGH && accepted > ENOUGH,
            "{}: {rejected} rejected, {accepted} accepted",
            subject.id()
        );
    }
}

#[test]
fn what_is_read_comes_back_unchanged() {
    for subject in subjects() {
        let schema = subject.schema(Variant::Strict);
        let validator = validator(&schema);
        run(CASES, |choices, _| {
            let value = instance(&schema, choices);
            let document = read(subject, &value).unwrap();
            let text = serde_json::to_string(&document).unwrap();
            let written: Value = serde_json::from_str(&text).unwrap();
            prop_assert!(validator.is_valid(&written), "{text}");
            prop_assert_eq!(read(subject, &written).unwrap(), document);
            Ok(())
        });
    }
}

#[test]
fn the_open_schema_accepts_what_the_strict_one_does_and_new_keys() {
    for subject in subjects() {
        let schema = subject.schema(Variant::Strict);
        let open = validator(&subject.schema(Variant::Open));
        run(CASES / 4, |choices, _| {
            let mut value = instance(&schema, choices);
            prop_assert!(open.is_valid(&value), "{value:#}");
            mutate::add_key_everywhere(&mut value, "key_of_a_later_version");
            prop_assert!(open.is_valid(&value), "{value:#}");
            Ok(())
        });
    }
}

proptest! {
    #[test]
    fn finite_numbers_survive_their_text(bits in any::<u64>()) {
        let number = f64::from_bits(bits);
        if number.is_finite() {
            let text = serde_json::to_string(&[number]).unwrap();
            let [read] = serde_json::from_str::<[f64; 1]>(&text).unwrap();
            prop_assert_eq!(read.to_bits(), bits, "{}", text);
            let value: Value = serde_json::from_str(&text).unwrap();
            let [read] = <[f64; 1]>::deserialize(&value).unwrap();
            prop_assert_eq!(read.to_bits(), bits, "{}", text);
        }
    }
}

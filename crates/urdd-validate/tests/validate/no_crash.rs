//! No document that matches its schema crashes a rule, whatever its content. Rules may rely on the schema, and on
//! nothing else.

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde_json::{Value, json};
use testkit::documents::{Choices, instance};
use urdd_format::registry::{self, ModuleKind, ModuleSpec};
use urdd_format::report::{Status, Verdict};
use urdd_format::root_metadata::RootMetadata;
use urdd_format::schema::{Subject, Variant};
use urdd_validate::settings::Settings;

use testkit::dice::Dice;
use testkit::fixture::{Fixture, ROOT};
use testkit::trials::trials;

/// How many URDDs of each kind are tried.
const TRIALS: u32 = 24;

/// How many of those with a self-collision model: each is evaluated.
const TRIALS_OF_MODELS: u32 = 8;

/// In the toy a few values are replaced by others of the schema, among them absurd ones.
#[test]
fn absurd_values_crash_no_rule() {
    try_all(TRIALS, Fixture::toy, |urdd, dice| {
        for _ in 0..=dice.below(3) {
            put_nonsense(urdd, dice);
        }
    });
}

/// The same for a robot with a self-collision model, which the toy does not have.
#[test]
fn absurd_values_in_a_model_crash_no_rule() {
    let model = testkit::model::fixture();
    try_all(
        TRIALS_OF_MODELS,
        || model.clone(),
        |urdd, dice| {
            for _ in 0..=dice.below(3) {
                put_nonsense(urdd, dice);
            }
        },
    );
}

/// In the toy a whole document is replaced by an arbitrary one of the schema.
#[test]
fn arbitrary_documents_crash_no_rule() {
    let schemas: Vec<(&str, Value)> = ModuleKind::ALL
        .iter()
        .filter_map(|kind| Some((kind.name(), spec(kind.name())?)))
        .map(|(name, spec)| (name, Subject::Module(spec).schema(Variant::Strict)))
        .collect();
    try_all(TRIALS, Fixture::toy, |urdd, dice| {
        for _ in 0..=dice.below(2) {
            let (name, schema) = &schemas[dice.below(schemas.len())];
            let choices: Vec<u16> = (0..dice.below(400)).map(|_| dice.word()).collect();
            let document = instance(schema, &mut Choices::new(&choices));
            let is_there = urdd.documents.keys().any(|folder| folder.ends_with(name));
            match is_there {
                true => *urdd.doc_mut(name) = document,
                // The toy is not composed of others.
                false => urdd.add_module(name, document),
            }
        }
    });
}

/// Changes a URDD a number of times, each time differently, and validates it. Most of these URDDs have findings.
fn try_all(
    few: u32,
    base: impl Fn() -> Fixture + Sync,
    change: impl Fn(&mut Fixture, &mut Dice) + Sync,
) {
    let trials = u64::from(trials(few));
    let broken = (0..trials).into_par_iter().map(|trial| {
        let mut urdd = base();
        change(&mut urdd, &mut Dice(trial << 32));
        urdd.seal();
        examine(&urdd, trial)
    });
    let broken = broken.filter(|broken| *broken).count() as u64;
    assert!(broken > trials * 3 / 4, "only {broken} of {trials} were judged wrong");
}

/// Whether the URDD has findings.
fn examine(urdd: &Fixture, trial: u64) -> bool {
    let run =
        urdd_validate::validate_source(urdd.in_memory(), "robot", &Settings::default()).unwrap();
    let [urdd_report] = &run.report.urdds[..] else { panic!("one URDD") };
    assert_ne!(urdd_report.verdict, Verdict::Unreadable);
    for check in &urdd_report.checks {
        let changed = || {
            let toy = Fixture::toy();
            let documents = urdd.documents.iter();
            let changed = documents
                .filter(|(folder, document)| toy.documents.get(*folder) != Some(*document));
            let text: BTreeMap<_, _> = changed.collect();
            serde_json::to_string(&text).unwrap()
        };
        assert!(
            check.status != Status::Crashed,
            "trial {trial}: {} crashed: {:?} on {}",
            check.code,
            check.reason,
            changed()
        );
    }
    !urdd_report.findings.is_empty()
}

/// Replaces a value of a document so that it still matches its schema.
fn put_nonsense(urdd: &mut Fixture, dice: &mut Dice) {
    let names: Vec<String> = urdd.documents.keys().cloned().collect();
    let name = &names[dice.below(names.len())];
    let valid = urdd.doc(name).clone();
    // A document that has lost nearly everything may have nothing left to replace.
    for _ in 0..200 {
        let place = descend(urdd.doc_mut(name), dice);
        let before = place.clone();
        nonsense(place, &valid, dice);
        if *place != before && fits_schema(name, urdd.doc(name)) {
            return;
        }
        *urdd.doc_mut(name) = valid.clone();
    }
}

/// Any place: each kind is equally likely, however large its table.
fn descend<'a>(document: &'a mut Value, dice: &mut Dice) -> &'a mut Value {
    let mut place = document;
    loop {
        let count = match &*place {
            Value::Object(map) => map.len(),
            Value::Array(list) if dice.below(4) > 0 => list.len(),
            _ => 0,
        };
        if count == 0 {
            return place;
        }
        let at = dice.below(count);
        place = match place {
            Value::Object(map) => map.values_mut().nth(at).expect("counted"),
            Value::Array(list) => &mut list[at],
            _ => unreachable!(),
        };
    }
}

fn nonsense(place: &mut Value, document: &Value, dice: &mut Dice) {
    // A value from elsewhere in the document, or nothing.
    if dice.below(8) == 0 {
        *place = descend(&mut document.clone(), dice).take();
        return;
    }
    let numbers =
        [0.0, -0.0, 1.0, -1.0, 0.5, 1e308, -1e308, f64::MAX, 5e-324, 1e-300, 1e155, -1e154, 1e16];
    let indices = [0, 1, 2, 14, 15, 1000, 1 << 31, u32::MAX - 1, u32::MAX];
    let words = ["", "/", "base", "..", "a/../../b", "\u{feff}", "1:30", "tip", "\u{1f916}\n"];
    match place {
        Value::Null | Value::Bool(_) => {
            *place = [json!(true), json!(false), Value::Null, json!([]), json!(0), json!(1e308)]
                [dice.below(6)]
            .clone();
        }
        Value::Number(number) if number.is_f64() => {
            *place = json!(numbers[dice.below(numbers.len())])
        }
        Value::Number(_) => *place = json!(indices[dice.below(indices.len())]),
        Value::String(text) => match dice.below(3) {
            0 => *text = text.repeat(1 << dice.below(12)),
            _ => *text = words[dice.below(words.len())].to_owned(),
        },
        Value::Array(list) => match dice.below(5) {
            0 => list.clear(),
            1 => list.truncate(dice.below(list.len() + 1)),
            2 => list.extend(list.clone()),
            3 => list.reverse(),
            _ => {
                for element in list {
                    nonsense(element, document, dice);
                }
            }
        },
        Value::Object(_) => *place = Value::Null,
    }
}

fn spec(module: &str) -> Option<&'static ModuleSpec> {
    let kind = ModuleKind::ALL.iter().find(|kind| kind.name() == module)?;
    registry::find(*kind, registry::FIRST_SPEC_VERSION)
}

fn fits_schema(folder: &str, document: &Value) -> bool {
    if folder == ROOT {
        return serde_json::from_value::<RootMetadata>(document.clone()).is_ok();
    }
    let name = folder.rsplit('/').next().unwrap_or_default();
    spec(name).is_some_and(|spec| spec.read(document).is_ok())
}

//! What is computed here and stored in `conformance/`: `bases/`, and the cases in `computed/`. The stored files are
//! compared with what the closures make; `URDD_UPDATE=1 cargo test --test rules computed` writes them, and then writes
//! into `expected` of each invalid case, also of those that people wrote, what the validator finds in it.

mod bases;
mod difference;
mod expected;
mod files;

use std::collections::BTreeMap;

use serde_json::{Value, json};
use testkit::fixture::Fixture;
use testkit::trials::trials;
use urdd_conformance::data::COMPUTED;
use urdd_conformance::tree::Tree;
use urdd_findings::description::Severity;
use urdd_validate::rules;

use self::bases::Bases;
use crate::Case;
use crate::one_case::{asked_for, begins};

fn update() -> bool {
    std::env::var_os("URDD_UPDATE").is_some()
}

fn tree_of(fixture: Fixture) -> Tree {
    let mut tree = Tree::default();
    for (path, bytes) in fixture.files {
        tree.put(path.as_str().into(), bytes);
    }
    tree
}

/// The list that a case is in.
fn list(case: &Case) -> &'static str {
    match case.caught {
        true => "invalid",
        false => "near_misses",
    }
}

/// A case as its file has it.
fn stored<'a>(files: &'a BTreeMap<String, Value>, case: &Case) -> Option<&'a Value> {
    let cases = files.get(case.code.as_str())?.get(list(case))?.as_array()?;
    cases.iter().find(|stored| stored["name"] == case.name)
}

/// The file of a rule's cases, without cases.
fn empty_file(case: &Case) -> Value {
    let rules = rules::all();
    let rule = rules.iter().find(|rule| rule.code == case.code).expect("a rule of that code");
    let verdict = if rule.severity == Severity::Error { "reject" } else { "accept" };
    json!({ "rule": rule.name, "verdict": verdict })
}

/// Every fourth case; all cases and their bases where `URDD_TRIALS` is at least 4.
#[test]
fn the_suite_has_what_is_computed() {
    let asked = asked_for();
    if asked.is_some() && !update() {
        println!("left out: URDD_CASE asks for others");
        return;
    }
    let is_asked = begins(asked.as_deref().unwrap_or_default());
    let cases = crate::cases();
    let before = files::read(COMPUTED);
    let step = if update() || trials(1) >= 4 { 1 } else { 4 };
    let all = asked.is_none() && step == 1;
    let mut bases = if all { Bases::made(&cases) } else { Bases::stored() };
    let mut after: BTreeMap<String, Value> = BTreeMap::new();
    for (at, case) in cases.iter().enumerate() {
        let old = stored(&before, case);
        let stored = match is_asked(&case.id()) && at % step == 0 {
            true => Some(bases.case(case, old)),
            false => old.cloned(),
        };
        let file = after.entry(case.code.to_string()).or_insert_with(|| empty_file(case));
        if let Some(stored) = stored {
            let file = file.as_object_mut().expect("an object");
            let cases = file.entry(list(case)).or_insert_with(|| json!([]));
            cases.as_array_mut().expect("a list").push(stored);
        }
    }
    let mut stale = files::differences(&before, &after);
    if all {
        bases.keep_used(&after);
    }
    let (files, stray) = bases.differences(all);
    stale.extend(files.keys().chain(&stray).cloned());
    if update() {
        files::write(COMPUTED, &before, &after);
        bases::write(&files, &stray);
        expected::update(is_asked);
        return;
    }
    assert!(
        stale.is_empty(),
        "conformance/ is not what tests/rules compute; run URDD_UPDATE=1 cargo test --test rules computed and read what \
         changed (URDD_CASE=CODE: of one rule): {stale:#?}"
    );
}

//! What the validator finds in the cases, written into `expected`. A person reads it, and says whether it is right.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;
use serde_json::{Value, json};
use urdd_conformance::data::{CASES, COMPUTED};
use urdd_conformance::suite::{Case, CaseKind, Suite};
use urdd_validate::settings::Settings;
use urdd_validate::validate;

use super::files;
use crate::judge;

/// The places that the validator finds in a case. Panics if it finds something by another rule, or by the wrong one.
fn found(suite: &Suite, case: &Case) -> Value {
    let folder = testkit::temporary::folder();
    let root = folder.path().join(case.urdd());
    let urdd = suite.tree(case).unwrap_or_else(|error| panic!("{error}"));
    case.write(&urdd, &root).expect("the URDD is written");
    let run = validate(&[&root], &Settings::default()).expect("something to examine");
    let found = judge::found(&case.code, &run.report);
    let codes: BTreeSet<&str> = found.iter().map(|finding| finding.code.as_str()).collect();
    let right = (case.kind == CaseKind::Invalid).then_some(case.code.as_str());
    assert_eq!(codes, right.into_iter().collect(), "{}: {found:#?}", case.id());
    found
        .into_iter()
        .map(|finding| {
            let mut place = json!({ "file": finding.file, "pointer": finding.pointer });
            place.as_object_mut().expect("an object").retain(|_, value| !value.is_null());
            place
        })
        .collect()
}

/// Writes the places of the cases that are asked for.
pub fn update(is_asked: impl Fn(&str) -> bool) {
    let mut suite = urdd::suite::carried().unwrap_or_else(|error| panic!("{error}"));
    let mut asked = std::mem::take(&mut suite.cases);
    asked.retain(|case| is_asked(&case.id()));
    let found: BTreeMap<String, Value> =
        asked.par_iter().map(|case| (case.id(), found(&suite, case))).collect();
    for folder in [CASES, COMPUTED] {
        let before = files::read(folder);
        let mut after = before.clone();
        for (code, file) in &mut after {
            let cases = file.get_mut("invalid").and_then(Value::as_array_mut);
            for case in cases.into_iter().flatten() {
                let id = format!("{code}/{}", case["name"].as_str().unwrap_or_default());
                if let Some(found) = found.get(&id) {
                    case["expected"] = found.clone();
                }
            }
        }
        files::write(folder, &before, &after);
    }
}

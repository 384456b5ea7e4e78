//! The rules on meshes and link shapes, on arbitrary robots: no finding on valid URDDs, and consistent results for any
//! document.

use proptest::prelude::*;
use proptest::sample::Index;
use serde_json::{Value, json};
use urdd_format::report::Report;
use urdd_format::report::Status;
use urdd_validate::settings::Settings;
use urdd_validate::validate_source;

use testkit::fixture::Fixture;
use testkit::robot::arbitrary_box_robot;
use testkit::trials::trials;

fn report(fixture: &Fixture) -> Report {
    let run = validate_source(fixture.in_memory(), "robot", &Settings::default());
    run.expect("not cancelled").report
}

/// Whether a rule is in the tested families.
fn ours(code: &str) -> bool {
    code.starts_with("MSH") || code.starts_with("SHP")
}

proptest! {
    #![proptest_config(ProptestConfig { cases: trials(6), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_is_found_in_valid_urdds(robot in arbitrary_box_robot()) {
        let report = report(&Fixture::full(&robot));
        let found: Vec<_> = report.urdds.iter().flat_map(|urdd| &urdd.findings).filter(|f| ours(&f.code)).collect();
        prop_assert!(found.is_empty(), "{found:#?}");
        let skipped: Vec<_> = report.urdds.iter().flat_map(|urdd| &urdd.checks)
            .filter(|check| ours(&check.code) && check.status != Status::Passed)
            .collect();
        prop_assert!(skipped.is_empty(), "{skipped:#?}");
    }

    #[test]
    fn no_rule_crashes_on_nonsense(
        changes in prop::collection::vec((any::<Index>(), any::<Index>(), nonsense()), 1..6),
    ) {
        let mut fixture = Fixture::toy();
        let modules: Vec<String> = fixture.documents.keys().filter(|key| key.contains('/')).cloned().collect();
        for (module, place, new) in changes {
            let module = &modules[module.index(modules.len())];
            let mut places = Vec::new();
            pointers(fixture.doc(module), String::new(), &mut places);
            let place = &places[place.index(places.len())];
            match new {
                Some(new) => fixture.set(module, place, new),
                None => { fixture.remove(module, place); }
            }
        }
        fixture.seal();
        let report = report(&fixture);
        let crashed: Vec<_> = report.urdds.iter().flat_map(|urdd| &urdd.checks)
            .filter(|check| check.status == Status::Crashed)
            .collect();
        prop_assert!(crashed.is_empty(), "{crashed:#?}");
    }
}

/// The new value, or `None` to remove the old one.
fn nonsense() -> impl Strategy<Value = Option<Value>> {
    prop_oneof![
        2 => Just(None),
        1 => Just(Some(Value::Null)),
        1 => Just(Some(json!([]))),
        1 => any::<u32>().prop_map(|n| Some(json!(n))),
        1 => prop_oneof![Just(1e308), Just(-1e308), Just(-0.5), Just(0.0)].prop_map(|x| Some(json!(x))),
        1 => any::<bool>().prop_map(|b| Some(json!(b))),
        1 => prop_oneof![Just(""), Just("../x.stl"), Just("/etc/passwd"), Just("Collision"), Just("Always")]
            .prop_map(|text| Some(json!(text))),
    ]
}

fn pointers(value: &Value, at: String, into: &mut Vec<String>) {
    match value {
        Value::Array(items) => {
            for (i, item) in items.iter().enumerate() {
                pointers(item, format!("{at}/{i}"), into);
            }
        }
        Value::Object(map) => {
            for (key, item) in map {
                pointers(item, format!("{at}/{key}"), into);
            }
        }
        _ => {}
    }
    if !at.is_empty() {
        into.push(at);
    }
}

//! Tests of the kill rate measurement: it finds a blind spot, gives the same result for any number of threads, and
//! leaves its inputs unchanged.

#![allow(clippy::disallowed_methods)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};
use tempfile::TempDir;
use testkit::fixture::{Fixture, toy_robot};
use testkit::trials::trials;
use urdd_findings::description::Severity;
use urdd_kill_rate::{
    FIELD_TOLERANCES, FREE_FIELDS, Judge, MeasureError, Measured, Outcome, PERMITTED, Plan, Target,
    Tolerance, Trial, measure, present,
};
use urdd_validate::code::Code;
use urdd_validate::rule::Rule;
use urdd_validate::rules;
use urdd_validate::settings::Settings;

fn core() -> TempDir {
    let folder = testkit::temporary::folder();
    Fixture::core(&toy_robot()).write_to(folder.path());
    folder
}

fn plan(modules: &[&str]) -> Plan {
    Plan {
        seed: 3,
        per_field: Some(trials(4) as usize),
        limit: None,
        modules: modules.iter().map(|name| (*name).to_owned()).collect(),
        threads: None,
    }
}

fn measured(path: &Path, rules: &[&'static Rule], plan: &Plan) -> Result<Measured, MeasureError> {
    let judge = Judge { rules, plain: Settings::default(), deep: None };
    measure(&[path], &judge, plan, &|_, _, _| {}).map(|mut urdds| urdds.remove(0))
}

/// Every file below a folder.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            let name = path.display().to_string();
            found.insert(name, fs::read(&path).expect("a file"));
        }
    }
    found
}

#[test]
fn a_rule_that_is_missing_is_a_blind_spot() {
    let folder = core();
    let before = files(folder.path());
    let plan = plan(&["bounds_module"]);
    let all = measured(folder.path(), &rules::all(), &plan).expect("a measure");
    assert!(all.trials.len() > 40, "{}", all.trials.len());
    assert_eq!(all.survivors().count(), 0, "{}", present::table(&[all]));

    let without: Vec<&'static Rule> =
        rules::all().into_iter().filter(|rule| rule.code != Code::BND005).collect();
    let blind = measured(folder.path(), &without, &plan).expect("a measure");
    let survived: BTreeSet<&str> =
        blind.survivors().map(|trial| trial.change.field.as_str()).collect();
    let speeds = ["/dof_effort_limits/*", "/dof_velocity_limits/*"];
    assert!(speeds.iter().all(|field| survived.contains(field)), "{survived:?}");
    let by_that_rule = |field: &&str| speeds.iter().any(|speed| speed.starts_with(field));
    assert!(survived.iter().all(by_that_rule), "{survived:?}");
    for trial in blind.survivors() {
        assert_eq!(trial.plain, Outcome::Missed);
        assert_ne!(trial.change.from, trial.change.to);
        assert_eq!(trial.change.target, Target::Document);
    }
    assert_eq!(files(folder.path()), before);
}

#[test]
fn the_result_is_the_same_for_any_number_of_threads() {
    let folder = core();
    let with = |threads| {
        let plan = Plan { threads: Some(threads), limit: Some(60), ..plan(&[]) };
        measured(folder.path(), &rules::all(), &plan).expect("a measure")
    };
    let one = with(1);
    assert!((50..=60).contains(&one.trials.len()), "{}", one.trials.len());
    let modules = one.modules();
    assert!(modules.iter().all(|module| module.plain.changes > 0));
    // All core modules, the samples, urdd.json and the carried URDF.
    assert_eq!(modules.len(), 8);
    assert_eq!(one, with(3));
}

#[test]
fn only_what_is_right_is_measured_with() {
    let folder = testkit::temporary::folder();
    let mut fixture = Fixture::core(&toy_robot());
    fixture.set("dof_module", "/num_dofs", json!(3));
    fixture.seal();
    fixture.write_to(folder.path());
    let refused = measured(folder.path(), &rules::all(), &plan(&[]));
    let Err(MeasureError::HasFindings { codes, .. }) = refused else {
        panic!("a URDD with findings was measured with");
    };
    assert_eq!(codes, [Code::DOF001]);
}

#[test]
fn hashes_follow_the_change() {
    let folder = core();
    let rules: Vec<&'static Rule> =
        rules::all().into_iter().filter(|rule| rule.code == Code::DIR014).collect();
    let of_modules = Plan { limit: Some(trials(60) as usize), ..plan(&["dof_module", "source"]) };
    let modules = measured(folder.path(), &rules, &of_modules).expect("a measure");
    assert!(modules.trials.len() > 40);
    assert!(modules.trials.iter().all(|trial| trial.plain == Outcome::Missed));
    let root = measured(folder.path(), &rules, &plan(&["urdd.json"])).expect("a measure");
    let sizes = root.trials.iter().filter(|trial| {
        trial.change.field == "/modules/*/files/*/size" && trial.change.kind.starts_with("one ")
    });
    let sizes: Vec<&Outcome> = sizes.map(|trial| &trial.plain).collect();
    assert!(sizes.len() > 1);
    let noticed = Outcome::Noticed(vec![Code::DIR014]);
    assert!(sizes.iter().all(|outcome| **outcome == noticed), "{sizes:?}");
}

/// A warning is a finding: only a mutation without any finding has survived.
#[test]
fn a_warning_counts() {
    let folder = core();
    let rules: Vec<&'static Rule> =
        rules::all().into_iter().filter(|rule| rule.severity != Severity::Error).collect();
    let measured = measured(folder.path(), &rules, &plan(&["source"])).expect("a measure");
    let warned = |trial: &&Trial| matches!(trial.plain, Outcome::Warned(_));
    assert!(measured.trials.iter().any(|trial| warned(&trial)));
    assert!(!measured.survivors().any(|trial| warned(&trial)));
    let module = &measured.modules()[0].plain;
    assert_eq!(module.noticed, 0);
    assert!((module.rate() - module.warned as f64 / module.changes as f64).abs() < 1e-12);
}

#[test]
fn what_lies_beside_the_triangles_of_a_mesh_is_changed_too() {
    let folder = testkit::temporary::folder();
    Fixture::toy().write_to(folder.path());
    // Changes of nodes are rare among those of a mesh.
    let plan = Plan { per_field: Some(12), ..plan(&["convex_hull_meshes_module"]) };
    let measured = measured(folder.path(), &rules::all(), &plan).expect("a measure");
    let of = |start: &str| -> Vec<&Trial> {
        let trials = measured.trials.iter();
        trials.filter(|trial| trial.change.kind.starts_with(start)).collect()
    };
    let stray = of("a vertex without faces");
    assert!(!stray.is_empty());
    assert!(
        stray.iter().all(|trial| !trial.change.file.ends_with(".stl")
            || trial.change.field == "meshes, all formats")
    );
    let nodes = of("its node");
    assert!(nodes.len() > 2, "{}", nodes.len());
    // Poses of nodes are read: a hull in another place is another hull.
    assert!(nodes.iter().all(|trial| trial.plain.is_noticed()), "{nodes:#?}");
}

#[test]
fn what_is_free_is_left_alone() {
    let folder = core();
    let root = measured(folder.path(), &rules::all(), &plan(&["urdd.json"])).expect("a measure");
    let generator = |field: &str| field.starts_with("/generator");
    assert!(root.trials.iter().all(|trial| !generator(&trial.change.field)));
    assert_eq!(root.survivors().count(), 0, "{}", present::table(&[root]));
}

#[test]
fn the_command_tells_by_its_status() {
    let folder = core();
    let run = |path: &Path, more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd-kill-rate"));
        command.arg(path);
        command.args(["--format", "json", "--modules", "bounds_module", "--limit", "40"]);
        command.args(more).output().expect("urdd runs")
    };
    let output = run(folder.path(), &[]);
    let said: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(output.status.code(), Some(0));
    let module = &said["urdds"][0]["modules"][0];
    assert_eq!(module["module"], "bounds_module");
    assert_eq!(module["plain"]["rate"], json!(1.0));
    assert_eq!(said["urdds"][0]["survivors"], json!([]));
    assert_eq!(run(folder.path(), &["--min-rate", "1.1"]).status.code(), Some(1));
    let empty = testkit::temporary::folder();
    assert_eq!(run(empty.path(), &[]).status.code(), Some(2));
    fs::remove_file(folder.path().join("bounds_module/VERSION")).expect("a file");
    assert_eq!(run(folder.path(), &[]).status.code(), Some(1));
}

#[test]
fn the_page_lists_what_does_not_count() {
    let page = include_str!("../../conformance/kill_rate.md");
    let mut rows = Vec::new();
    for free in FREE_FIELDS {
        let (module, field, clause) = (free.module, free.field, free.clause);
        rows.push(format!("| `{module}` | `{field}` | free | {clause} |"));
    }
    for permitted in PERMITTED {
        let (module, field) = (permitted.module, permitted.field);
        let (change, clause) = (permitted.change, permitted.clause);
        rows.push(format!("| `{module}` | `{field}` | {change} | {clause} |"));
    }
    for listed in FIELD_TOLERANCES {
        let tolerance = match listed.tolerance {
            Tolerance::Copied => "as copies".to_owned(),
            Tolerance::OfReach(part) => format!("{part:e} of the reach"),
            Tolerance::OfShapes(part) => format!("{part:e} of the largest shape"),
            Tolerance::OfSpan(part) => format!("{part:e} of what two points may be apart"),
            Tolerance::Absolute(tolerance) => format!("{tolerance:e}"),
        };
        let (module, field, clause) = (listed.module, listed.field, listed.clause);
        let field = if field.is_empty() { "every one" } else { &format!("`{field}`") };
        rows.push(format!("| `{module}` | {field} | {tolerance} | {clause} |"));
    }
    for row in rows {
        assert!(page.contains(&row), "conformance/kill_rate.md lacks the line\n{row}");
    }
}

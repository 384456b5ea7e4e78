//! The rules and their cases in `conformance/`: one case alone ([`one_case`]), and the cases and bases that are computed
//! here ([`computed`]). `crates/urdd-conformance/tests` judges the whole suite.
//!
//! A case that a person can write is data: `conformance/cases`. The cases here have meshes, other robots, or numbers that
//! follow from a number of SPEC.md. Each is a valid URDD with one change. The valid URDD comes from `testkit`, a producer
//! that shares no code with the validator.

// A test may stop anywhere.
#![allow(clippy::restriction, clippy::disallowed_methods)]

mod bases;
mod bounds;
mod chain;
mod clauses;
mod computed;
mod connections;
mod dof;
mod extensions;
#[path = "../../crates/urdd-conformance/tests/conformance/judge.rs"]
mod judge;
mod kinematics;
mod learned;
mod loops;
mod mesh_files;
mod meshes;
mod messages;
mod numbers;
mod one_case;
mod schemas;
mod shapes;
mod source;
mod spheres;
mod two_faults;
mod urdf;
mod usable;

use std::collections::BTreeMap;
use std::path::Path;

use testkit::fixture::Fixture;
use testkit::robot::Robot;
use urdd_format::report;
use urdd_validate::code::Code;
use urdd_validate::settings::Settings;
use urdd_validate::{Run, validate, validate_source};

/// How a URDD is built.
type Make = Box<dyn Fn() -> Fixture>;

/// A computed URDD with one change.
pub struct Case {
    code: Code,
    name: &'static str,
    make: Make,
    /// The URDD before the change.
    base: Make,
    caught: bool,
}

impl Case {
    /// Its id: code, slash, name.
    fn id(&self) -> String {
        format!("{}/{}", self.code, self.name)
    }
}

/// The same fixture, in the canonical emission, in which the suite seals.
pub fn canonical(mut fixture: Fixture) -> Fixture {
    fixture.canonical = true;
    fixture.seal();
    fixture
}

/// A change of the toy that exactly this rule catches. Mirrors and hashes follow it.
pub fn invalid(code: Code, name: &'static str, change: impl Fn(&mut Fixture) + 'static) -> Case {
    changed(code, name, true, Fixture::toy, change)
}

/// A change that is close to what the rule catches, but valid: nothing is found.
pub fn near_miss(code: Code, name: &'static str, change: impl Fn(&mut Fixture) + 'static) -> Case {
    changed(code, name, false, Fixture::toy, change)
}

/// A change of a valid URDD other than the toy; `caught`: whether it is an invalid case.
pub fn changed(
    code: Code,
    name: &'static str,
    caught: bool,
    base: impl Fn() -> Fixture + 'static,
    change: impl Fn(&mut Fixture) + 'static,
) -> Case {
    let base = std::rc::Rc::new(move || canonical(base()));
    let unchanged = base.clone();
    Case {
        code,
        name,
        make: Box::new(move || {
            let mut fixture = base();
            change(&mut fixture);
            canonical(fixture)
        }),
        base: Box::new(move || unchanged()),
        caught,
    }
}

/// A valid URDD of class Core of this robot.
pub fn valid(code: Code, name: &'static str, robot: fn() -> Robot) -> Case {
    changed(code, name, false, move || Fixture::core(&robot()), |_| {})
}

fn cases() -> Vec<Case> {
    [
        urdf::cases(),
        source::cases(),
        dof::cases(),
        extensions::cases(),
        chain::cases(),
        connections::cases(),
        bounds::cases(),
        meshes::cases(),
        mesh_files::cases(),
        usable::cases(),
        shapes::cases(),
        kinematics::cases(),
        learned::cases(),
        spheres::cases(),
        schemas::cases(),
        numbers::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Codes that were found, except infos, with a message for each.
fn findings(write: &dyn Fn(&Path)) -> BTreeMap<String, String> {
    let folder = testkit::temporary::folder();
    let root = folder.path().join("robot");
    std::fs::create_dir(&root).expect("the URDD's folder");
    write(&root);
    told(&validate(&[&root], &Settings::default()).expect("something to examine"))
}

/// As [`findings`], in a fixture whose paths are all allowed.
fn findings_in(fixture: &Fixture) -> BTreeMap<String, String> {
    let run = validate_source(fixture.in_memory(), "robot", &Settings::default());
    told(&run.expect("not cancelled"))
}

fn told(run: &Run) -> BTreeMap<String, String> {
    let findings = run.report.urdds.iter().flat_map(|urdd| &urdd.findings);
    findings
        .filter(|f| f.severity != report::Severity::Info)
        .map(|f| (f.code.clone(), format!("{:?} {:?}: {}", f.file, f.pointer, f.message)))
        .collect()
}

#[test]
fn the_base_is_valid() {
    let toy = |root: &Path| {
        let mut toy = Fixture::toy();
        toy.seal();
        toy.write_to(root);
    };
    assert_eq!(findings(&toy), BTreeMap::new());
}

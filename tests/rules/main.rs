//! Every rule has an invalid case that only it catches, and a near miss that it accepts.
//!
//! A case is a valid URDD with one change. The valid URDD comes from `tests/support`, a producer that shares no code
//! with the validator.

// A test may stop anywhere.
#![allow(clippy::restriction)]

#[cfg(unix)]
mod as_data;
mod bounds;
mod chain;
mod composition;
mod connections;
mod directory;
mod dof;
mod extension_annotations;
mod extensions;
mod json;
mod kinematics;
mod learned;
mod legacy;
mod legacy_core;
mod legacy_robot;
mod mesh_files;
mod meshes;
mod messages;
mod named_configurations;
mod numbers;
mod one_case;
mod packed;
mod schema;
mod shapes;
mod source;
mod two_faults;
mod urdf;
mod usable;
mod yaml;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use testkit::fixture::Fixture;
use urdd_conformance::archive::{self, Packed};
use urdd_conformance::data::{PACKED, URDD};
use urdd_conformance::tree::Tree;
use urdd_format::report;
use urdd_validate::code::Code;
use urdd_validate::settings::Settings;
use urdd_validate::{Run, rules, validate, validate_source};

/// How a URDD is built.
pub enum Make {
    /// In memory.
    Fixture(Box<dyn Fn() -> Fixture>),
    /// Written into a folder.
    Folder(Box<dyn Fn(&Path)>),
}

impl Make {
    /// Writes it into a folder.
    pub fn write(&self, folder: &Path) {
        match self {
            Make::Fixture(make) => make().write_to(folder),
            Make::Folder(write) => write(folder),
        }
    }
}

/// A URDD with one change, and the validator's expected findings. Cases are written here as code, and become the data
/// in `conformance/` (see [`as_data`]), on which they are judged.
pub struct Case {
    code: Code,
    name: &'static str,
    make: Make,
    /// The URDD before the change, if known.
    base: Option<Make>,
    caught: bool,
    /// Where the URDD is in a zip archive; `None` for a folder.
    packed: Option<Packed>,
}

impl Case {
    /// Writes its URDD below a folder, and returns the URDD's path.
    fn write(&self, folder: &Path) -> PathBuf {
        let root = folder.join(URDD);
        std::fs::create_dir(&root).expect("the URDD's folder");
        self.make.write(&root);
        let Some(packed) = self.packed else {
            return root;
        };
        let tree = Tree::read(&root, &root).expect("what was just written");
        let path = folder.join(PACKED);
        archive::write(&tree, packed, &path).expect("an archive");
        path
    }
}

/// The URDD that most cases change, in the canonical emission.
pub fn toy() -> Fixture {
    canonical(Fixture::toy())
}

/// The same fixture, in the canonical emission, in which the suite seals.
pub fn canonical(mut fixture: Fixture) -> Fixture {
    fixture.canonical = true;
    fixture.seal();
    fixture
}

/// A change of [`toy`] that exactly this rule catches. Mirrors and hashes follow it.
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
        make: Make::Fixture(Box::new(move || {
            let mut fixture = base();
            change(&mut fixture);
            canonical(fixture)
        })),
        base: Some(Make::Fixture(Box::new(move || unchanged()))),
        caught,
        packed: None,
    }
}

/// A URDD (a legacy one, say) that `write` writes into a folder named `robot`, the only one in its parent folder. All
/// findings except infos are compared.
pub fn in_folder(
    code: Code,
    name: &'static str,
    caught: bool,
    write: impl Fn(&Path) + 'static,
) -> Case {
    Case { code, name, make: Make::Folder(Box::new(write)), base: None, caught, packed: None }
}

fn cases() -> Vec<Case> {
    [
        directory::cases(),
        packed::cases(),
        json::cases(),
        yaml::cases(),
        schema::cases(),
        extensions::cases(),
        extension_annotations::cases(),
        urdf::cases(),
        source::cases(),
        dof::cases(),
        chain::cases(),
        connections::cases(),
        bounds::cases(),
        composition::cases(),
        meshes::cases(),
        mesh_files::cases(),
        usable::cases(),
        shapes::cases(),
        kinematics::cases(),
        learned::cases(),
        named_configurations::cases(),
        legacy::cases(),
        legacy_core::cases(),
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

#[test]
fn every_rule_has_an_invalid_case_and_a_near_miss() {
    let mut untested: BTreeSet<String> = BTreeSet::new();
    let cases = cases();
    for rule in rules::all() {
        for (caught, kind) in [(true, "invalid case"), (false, "near miss")] {
            if !cases.iter().any(|case| case.code == rule.code && case.caught == caught) {
                untested.insert(format!("{}: no {kind}", rule.code));
            }
        }
    }
    assert_eq!(untested, BTreeSet::new());
}

#[test]
fn case_names_are_unique() {
    let mut names = BTreeSet::new();
    for case in cases() {
        assert!(names.insert((case.code, case.name)), "{} {}", case.code, case.name);
    }
}

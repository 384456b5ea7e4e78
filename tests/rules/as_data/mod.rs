//! The cases as data: `conformance/invalid` and `conformance/bases` are written from the closures in this test.
//! `URDD_UPDATE=1 cargo test --test rules as_data` writes them; without it, the stored files are compared.
//!
//! A case names the base that needs the shortest changes. A URDD that is far from every base becomes a base. Stored
//! changes that still produce the case are kept, so that a new case does not change the others.

mod bases;
mod changes;
mod patch;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde_json::Value;
use testkit::trials::{sample, trials};
use urdd_conformance::case::{self, Expected, Kind, Verdict};
use urdd_conformance::data::{BASES, INVALID};
use urdd_conformance::judge;
use urdd_conformance::tree::Tree;
use urdd_directory::canonical;
use urdd_findings::description::Severity;
use urdd_validate::rules;
use urdd_validate::settings::Settings;
use urdd_validate::validate;

use self::bases::Bases;
use self::changes::Difference;
use crate::{Case, Make};

/// The versions of the specification that the cases apply to.
const SPEC_VERSIONS: &str = ">=1.0.0, <2.0.0";

/// Number of cases to keep in memory.
const AT_ONCE: usize = 32;

fn update() -> bool {
    std::env::var_os("URDD_UPDATE").is_some()
}

fn suite() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance")
}

/// The file of a case, in the suite.
fn path(case: &Case) -> String {
    format!("{INVALID}/{}/{}.json", case.code, case.name)
}

/// In memory if possible: files on disk take ten times as long.
fn tree_of(make: &Make) -> Tree {
    match make {
        Make::Fixture(make) => {
            let mut tree = Tree::default();
            for (path, bytes) in make().files {
                tree.put(path.as_str().into(), bytes);
            }
            tree
        }
        Make::Folder(write) => tree_written(write),
    }
}

fn tree_written(write: &dyn Fn(&Path)) -> Tree {
    let folder = testkit::temporary::folder();
    let root = folder.path().join("robot");
    fs::create_dir(&root).expect("the URDD's folder");
    write(&root);
    Tree::read(folder.path(), &root).expect("what was just written")
}

/// The validator's findings in a case, which is this URDD.
fn found(case: &case::Case, urdd: &Tree) -> Vec<Expected> {
    let folder = testkit::temporary::folder();
    let root = folder.path().join(case.urdd());
    case.write(urdd, &root).expect("the URDD is written");
    let run = validate(&[&root], &Settings::default()).expect("something to examine");
    let report = run.report;
    let found = judge::found(&case.code, &report);
    let codes: BTreeSet<&str> = found.iter().map(|finding| finding.code.as_str()).collect();
    let right = (case.kind == Kind::Invalid).then_some(case.code.as_str());
    assert_eq!(codes, right.into_iter().collect(), "{} {}: {found:#?}", case.code, case.name);
    found
}

fn as_data(case: &Case, base: String, way: Difference, old: Option<&case::Case>) -> case::Case {
    let all = rules::all();
    let rule = all.iter().find(|rule| rule.code == case.code);
    let rule = rule.expect("a rule of that code");
    let near = if case.caught { "" } else { "near " };
    let title = format!("{near}{}: {}", rule.name, case.name.replace('-', " "));
    case::Case {
        code: case.code.to_string(),
        name: case.name.to_owned(),
        title,
        kind: match case.caught {
            true => Kind::Invalid,
            false => Kind::NearMiss,
        },
        spec_versions: SPEC_VERSIONS.parse().expect("a range of versions"),
        verdict: match case.caught && rule.severity == Severity::Error {
            true => Verdict::Reject,
            false => Verdict::Accept,
        },
        // The validator supplies the locations; a person reads them once, when they are written.
        expected: old.map(|old| old.expected.clone()).unwrap_or_default(),
        base,
        changes: way.0,
        hashes_kept: way.1,
        packed: case.packed,
    }
}

/// Every file that the closures produce, by its path in `conformance/`. If only some cases are selected: the files that
/// they add to the stored bases.
fn files(cases: &[Case], all: bool) -> BTreeMap<String, Vec<u8>> {
    let mut bases = match all {
        true => Bases::made_again(cases),
        false => Bases::stored(),
    };
    let mut files = BTreeMap::new();
    let mut used = BTreeSet::new();
    for cases in cases.chunks(AT_ONCE) {
        let mut data: Vec<(String, case::Case, Tree)> = Vec::new();
        for case in cases {
            let path = path(case);
            let old = fs::read(suite().join(&path)).ok();
            let old: Option<case::Case> = old.and_then(|text| serde_json::from_slice(&text).ok());
            let urdd = tree_of(&case.make);
            let (base, way) = bases.for_case(case, &urdd, old.as_ref());
            used.insert(base.clone());
            data.push((path, as_data(case, base, way, old.as_ref()), urdd));
        }
        if update() {
            data.par_iter_mut().for_each(|(_, case, urdd)| case.expected = found(case, urdd));
        }
        for (path, case, _) in data {
            let value: Value = serde_json::to_value(case).expect("a case is JSON");
            files.insert(path, canonical::json_string(&value).into_bytes());
        }
    }
    if all {
        bases.keep(&used);
    }
    files.extend(bases.files());
    files
}

/// Every file below two folders of the suite.
fn on_disk() -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut folders = vec![suite().join(BASES), suite().join(INVALID)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten() {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let path = path.strip_prefix(suite()).expect("below it");
                found.insert(path.to_str().expect("UTF-8").to_owned());
            }
        }
    }
    found
}

/// Every fourth case; all cases and their bases where `URDD_TRIALS` is at least 4. `URDD_UPDATE=1` writes what is missing
/// or stale; with `URDD_CASE`, only for these cases.
#[test]
fn the_suite_is_what_the_closures_say() {
    let asked = crate::one_case::asked_for();
    if asked.is_some() && !update() {
        println!("left out: URDD_CASE asks for others");
        return;
    }
    let mut cases = crate::one_case::beginning_with(asked.as_deref().unwrap_or_default());
    let paths: BTreeSet<String> = cases.iter().map(path).collect();
    let step = if update() || asked.is_some() { 1 } else { 4 };
    let all = asked.is_none() && trials(1) >= step;
    cases = sample(cases, step).collect();
    let files = files(&cases, all);
    let stray: Vec<String> = on_disk()
        .into_iter()
        .filter(|path| asked.is_none() && !files.contains_key(path) && !paths.contains(path))
        .collect();
    let differs = |(path, bytes): &(&String, &Vec<u8>)| {
        fs::read(suite().join(path)).ok().as_ref() != Some(*bytes)
    };
    let stale: Vec<(&String, &Vec<u8>)> = files.iter().filter(differs).collect();
    if update() {
        for path in stray {
            println!("removed conformance/{path}");
            let path = suite().join(path);
            fs::remove_file(&path).expect("removed");
            // Its folders, unless they contain anything else.
            let mut folders = path.ancestors().skip(1);
            while folders.next().is_some_and(|folder| fs::remove_dir(folder).is_ok()) {}
        }
        for (path, bytes) in stale {
            println!("wrote conformance/{path}");
            let path = suite().join(path);
            fs::create_dir_all(path.parent().expect("a folder")).expect("made");
            fs::write(path, bytes).expect("written");
        }
        return;
    }
    let stale: Vec<&String> = stale.into_iter().map(|(path, _)| path).collect();
    assert!(
        stale.is_empty() && stray.is_empty(),
        "conformance/ is not what the cases say; run URDD_UPDATE=1 cargo test --test rules as_data and read what \
         changed (URDD_CASE=CODE: of one rule).\nmissing or stale: {stale:#?}\nof no case: {stray:#?}"
    );
}

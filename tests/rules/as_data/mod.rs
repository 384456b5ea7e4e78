//! The cases as data: `conformance/invalid` and `conformance/bases` are made of the closures in this
//! test. `URDD_UPDATE=1 cargo test --test rules` writes them; without it, what is there is compared.
//!
//! A case names the base that needs the fewest words. A URDD that is far from every base becomes one.

mod changes;
mod patch;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use urdd::conformance::case::{self, Expected, Kind, Verdict};
use urdd::conformance::change::mirror_of;
use urdd::conformance::data::{BASES, INVALID, URDD};
use urdd::conformance::judge;
use urdd::conformance::seal::add_mirrors;
use urdd::conformance::tree::{Node, Tree};
use urdd_directory::canonical;
use urdd_validate::rule::Severity;
use urdd_validate::rules;
use urdd_validate::settings::Settings;
use urdd_validate::validate;

use self::changes::{Difference, difference};
use crate::{Case, Make, cases, legacy};
use testkit::fixture::{Fixture, toy_robot};

/// A case that takes more of a base's bytes than this part gets a base of its own.
const TOO_DIFFERENT: f64 = 0.25;
/// But not below so many bytes.
const SMALL: usize = 3000;
/// In which versions of the specification the cases hold.
const SPEC_VERSIONS: &str = ">=1.0.0, <2.0.0";

fn update() -> bool {
    std::env::var_os("URDD_UPDATE").is_some()
}

fn suite() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance")
}

/// In memory where that can be: files on disk take ten times as long.
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
    let folder = tempfile::tempdir().expect("a temporary folder");
    let root = folder.path().join("robot");
    fs::create_dir(&root).expect("the URDD's folder");
    write(&root);
    Tree::read(folder.path(), &root).expect("what was just written")
}

/// Bases by name, in the order in which they were made.
struct Bases(Vec<(String, Tree)>);

impl Bases {
    fn new() -> Bases {
        let fixture = |fixture: Fixture| {
            tree_of(&Make::Fixture(Box::new(move || {
                crate::canonical(fixture.clone())
            })))
        };
        Bases(vec![
            ("toy".to_owned(), fixture(Fixture::toy())),
            ("toy_core".to_owned(), fixture(Fixture::core(&toy_robot()))),
            ("legacy".to_owned(), tree_written(&legacy::write_legacy)),
        ])
    }

    /// The base from which it takes the fewest words to `tree`, and these. The few that share most
    /// bytes with it are tried.
    fn nearest(&self, tree: &Tree) -> (usize, Difference) {
        let foreign = |base: &Tree| -> usize {
            let nodes = tree.nodes.iter();
            let missing = nodes.filter(|(path, node)| base.nodes.get(path) != Some(node));
            missing.map(|(_, node)| size(node)).sum()
        };
        let mut order: Vec<usize> = (0..self.0.len()).collect();
        order.sort_by_cached_key(|at| foreign(&self.0[*at].1));
        let mut nearest: Option<(usize, Difference)> = None;
        for at in order.into_iter().take(4) {
            let way = difference(&self.0[at].1, tree);
            if nearest
                .as_ref()
                .is_none_or(|(_, best)| length(&way) < length(best))
            {
                nearest = Some((at, way));
            }
            if nearest.as_ref().is_some_and(|(_, way)| length(way) < SMALL) {
                break;
            }
        }
        nearest.expect("there are bases")
    }

    /// The same, from a new base where all are far away.
    fn for_case(&mut self, case: &Case) -> (usize, Difference) {
        let tree = tree_of(&case.make);
        let found = self.nearest(&tree);
        let own = stored(&tree).map(|(_, bytes)| bytes.len()).sum::<usize>();
        let limit = SMALL.max((own as f64 * TOO_DIFFERENT) as usize);
        if length(&found.1) <= limit.min(own) {
            return found;
        }
        let base = case.base.as_ref().map(tree_of);
        // One that is far larger than the case is of no use to it.
        let bytes = |tree: &Tree| stored(tree).map(|(_, bytes)| bytes.len()).sum::<usize>();
        let base = base.filter(|base| bytes(base) <= 2 * bytes(&tree));
        let mut base = base.unwrap_or_else(|| tree.clone());
        // A base has files only; what else there is comes by changes.
        base.nodes
            .retain(|path, node| path.as_str().is_some() && matches!(node, Node::File(_)));
        let name = format!("{}-{}", case.code.as_str().to_lowercase(), case.name);
        self.0.push((name, base));
        let found = self.nearest(&tree);
        if found.0 + 1 != self.0.len() {
            self.0.pop();
        }
        found
    }
}

fn size(node: &Node) -> usize {
    match node {
        Node::File(bytes) => bytes.len(),
        Node::Link(_) | Node::Folder => 0,
    }
}

fn length((changes, kept): &Difference) -> usize {
    let text = serde_json::to_string(&(changes, kept));
    text.expect("changes are JSON").len()
}

/// The files of a base that are stored: mirrors that sealing makes are not.
fn stored(tree: &Tree) -> impl Iterator<Item = (&str, &[u8])> {
    let mut made = tree.clone();
    made.nodes.retain(|path, _| mirror_of(path).is_some());
    add_mirrors(&mut made);
    tree.nodes.iter().filter_map(move |(path, node)| {
        let Node::File(bytes) = node else { return None };
        let path = path.as_str()?;
        let is_made = path.ends_with("module.yaml") && made.file(path) == Some(bytes);
        (!is_made).then_some((path, &**bytes))
    })
}

/// What the validator finds in a case.
fn found(case: &Case) -> Vec<Expected> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let root = folder.path().join("robot");
    fs::create_dir(&root).expect("the URDD's folder");
    case.make.write(&root);
    let run = validate(&[&root], &Settings::default()).expect("something to examine");
    let report = run.report;
    let found = judge::found(case.code.as_str(), &report);
    let codes: BTreeSet<&str> = found.iter().map(|finding| finding.code.as_str()).collect();
    let right = case.caught.then_some(case.code.as_str());
    assert_eq!(
        codes,
        right.into_iter().collect(),
        "{} {}: {found:#?}",
        case.code,
        case.name
    );
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
        // Places are the validator's; a person reads them once, when they are written.
        expected: match (update(), old) {
            (true, _) => found(case),
            (false, Some(old)) => old.expected.clone(),
            (false, None) => Vec::new(),
        },
        base,
        changes: way.0,
        hashes_kept: way.1,
    }
}

/// Every file that the closures make, by its path in `conformance/`.
fn files() -> BTreeMap<String, Vec<u8>> {
    let mut bases = Bases::new();
    let mut files = BTreeMap::new();
    for case in cases() {
        let (base, way) = bases.for_case(&case);
        let path = format!("{INVALID}/{}/{}.json", case.code, case.name);
        let old = fs::read(suite().join(&path)).ok();
        let old = old.and_then(|text| serde_json::from_slice(&text).ok());
        let data = as_data(&case, bases.0[base].0.clone(), way, old.as_ref());
        let value: Value = serde_json::to_value(data).expect("a case is JSON");
        files.insert(path, canonical::json_string(&value).into_bytes());
    }
    for (name, tree) in &bases.0 {
        for (path, bytes) in stored(tree) {
            let path = match path.strip_prefix("../") {
                Some(beside) => beside.to_owned(),
                None => format!("{URDD}/{path}"),
            };
            files.insert(format!("{BASES}/{name}/{path}"), bytes.to_vec());
        }
    }
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

#[test]
fn the_suite_is_what_the_closures_say() {
    if crate::one_case::one_is_asked_for() && !update() {
        println!("left out: URDD_CASE asks for others");
        return;
    }
    let files = files();
    let stray: Vec<String> = on_disk()
        .into_iter()
        .filter(|path| !files.contains_key(path))
        .collect();
    let differs = |(path, bytes): &(&String, &Vec<u8>)| {
        fs::read(suite().join(path)).ok().as_ref() != Some(*bytes)
    };
    let stale: Vec<(&String, &Vec<u8>)> = files.iter().filter(differs).collect();
    if update() {
        for path in stray {
            let path = suite().join(path);
            fs::remove_file(&path).expect("removed");
            // Its folders, as far as nothing else is in them.
            let mut folders = path.ancestors().skip(1);
            while folders
                .next()
                .is_some_and(|folder| fs::remove_dir(folder).is_ok())
            {}
        }
        for (path, bytes) in stale {
            let path = suite().join(path);
            fs::create_dir_all(path.parent().expect("a folder")).expect("made");
            fs::write(path, bytes).expect("written");
        }
        return;
    }
    let stale: Vec<&String> = stale.into_iter().map(|(path, _)| path).collect();
    assert!(
        stale.is_empty() && stray.is_empty(),
        "conformance/ is not what the cases say; run URDD_UPDATE=1 cargo test --test rules and read what \
         changed.\nmissing or stale: {stale:#?}\nof no case: {stray:#?}"
    );
}

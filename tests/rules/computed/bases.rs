//! The bases of cases: those that are made here, the one that a case changes, and how they are stored.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs;

use serde_json::{Value, json};
use urdd_conformance::change::{add_mirrors, mirror_of};
use urdd_conformance::data::{BASES, COPIES, URDD};
use urdd_conformance::tree::{Node, Tree};
use urdd_directory::canonical;

use super::difference::{difference, makes};
use super::files::suite;
use super::{tree_of, update};
use crate::Case;
use crate::bases::shared;
use testkit::fixture::ROOT;

/// A case whose changes take more than this fraction of its URDD's bytes gets a base of its own.
const TOO_DIFFERENT: f64 = 0.25;
/// Below this many bytes, a case never gets its own base.
const SMALL: usize = 8000;

/// Files by path in `bases/`.
type Files = BTreeMap<String, Vec<u8>>;

/// Bases by name.
pub struct Bases(BTreeMap<String, Tree>);

impl Bases {
    /// The bases of the stored suite, and those that are new.
    pub fn stored() -> Bases {
        let suite = urdd::suite::carried().unwrap_or_else(|error| panic!("{error}"));
        let mut bases = suite.bases;
        for (name, make) in shared() {
            bases.entry(name.to_owned()).or_insert_with(|| tree_of(make()));
        }
        Bases(bases)
    }

    /// The bases, made again. Those of before version 1 stay as they are stored.
    pub fn made(cases: &[Case]) -> Bases {
        let mut bases = Bases::stored().0;
        let stored: BTreeSet<String> = bases.keys().cloned().collect();
        bases.retain(|_, tree| tree.file(ROOT).is_none());
        let own = cases.iter().map(|case| (base_name(case), case));
        for (name, case) in own.filter(|(name, _)| stored.contains(name)) {
            bases.insert(name, base_of(case, &tree_of((case.make)())));
        }
        bases.extend(shared().into_iter().map(|(name, make)| (name.to_owned(), tree_of(make()))));
        Bases(bases)
    }

    /// A case as its file has it. What is stored is kept if it still makes the URDD.
    pub fn case(&mut self, case: &Case, stored: Option<&Value>) -> Value {
        let urdd = tree_of((case.make)());
        let makes = |stored: &&Value| {
            let base = stored["base"].as_str().and_then(|name| self.0.get(name));
            base.is_some_and(|base| makes(base, stored, &urdd))
        };
        if let Some(stored) = stored.filter(makes) {
            return stored.clone();
        }
        let (base, changes) = self.changes(case, &urdd);
        let mut made = json!({ "name": case.name, "base": base });
        let parts = changes.as_object().expect("an object");
        for (key, value) in parts.iter().filter(|(_, value)| **value != json!([])) {
            made[key] = value.clone();
        }
        if case.caught {
            made["expected"] = stored.map_or(json!([]), |stored| stored["expected"].clone());
        }
        made
    }

    /// The base that shares most bytes with a URDD, and the changes to it; or a base of its own.
    fn changes(&mut self, case: &Case, urdd: &Tree) -> (String, Value) {
        let foreign = |base: &Tree| -> usize {
            let nodes = urdd.nodes.iter();
            let missing = nodes.filter(|(path, node)| base.nodes.get(path) != Some(node));
            let gone = base.nodes.iter().filter(|(path, _)| !urdd.nodes.contains_key(path));
            missing.map(|(_, node)| size(node)).sum::<usize>() + gone.count()
        };
        let (name, base) = self.0.iter().min_by_key(|(_, base)| foreign(base)).expect("bases");
        let changes = difference(base, urdd);
        let own = stored(urdd).map(|(_, bytes)| bytes.len()).sum::<usize>();
        let limit = SMALL.max((own as f64 * TOO_DIFFERENT) as usize);
        if changes.to_string().len() <= limit.min(own) {
            return (name.clone(), changes);
        }
        let name = base_name(case);
        let base = base_of(case, urdd);
        let changes = difference(&base, urdd);
        self.0.insert(name.clone(), base);
        (name, changes)
    }

    /// Drops bases that no case names.
    pub fn keep_used(&mut self, computed: &BTreeMap<String, Value>) {
        let written = super::files::read(urdd_conformance::data::CASES);
        let files = written.values().chain(computed.values());
        let lists = files.flat_map(|file| [&file["invalid"], &file["near_misses"]]);
        let cases = lists.filter_map(Value::as_array).flatten();
        let used: BTreeSet<&str> = cases.filter_map(|case| case["base"].as_str()).collect();
        self.0.retain(|name, _| used.contains(name.as_str()));
    }

    /// The files in `bases/` that are missing or stale, and those that are of no base; `all`: these are all bases.
    pub fn differences(&self, all: bool) -> (Files, Vec<String>) {
        if !all && !update() {
            return (Files::new(), Vec::new());
        }
        let mut files = self.files();
        let mut stray = Vec::new();
        let mut folders = vec![suite().join(BASES)];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).into_iter().flatten() {
                let path = entry.expect("an entry").path();
                let name = path.strip_prefix(suite()).expect("below it");
                let name = name.to_str().expect("UTF-8").replace('\\', "/");
                if path.is_dir() {
                    folders.push(path);
                } else if !files.contains_key(&name) {
                    stray.push(name);
                } else if files.get(&name) == fs::read(&path).ok().as_ref() {
                    files.remove(&name);
                }
            }
        }
        (files, stray)
    }

    /// Their files. A file that several bases share is stored once: where it is stored already, otherwise in the first
    /// of them. The list of copies names the others.
    fn files(&self) -> Files {
        let main = ["toy", "toy_core", "legacy"];
        let mut all = Vec::new();
        for (name, tree) in &self.0 {
            let rank = main.iter().position(|main| main == name).unwrap_or(main.len());
            for (path, bytes) in stored(tree) {
                let path = match path.strip_prefix("../") {
                    Some(beside) => format!("{name}/{beside}"),
                    None => format!("{name}/{URDD}/{path}"),
                };
                let there = fs::read(suite().join(BASES).join(&path)).ok();
                all.push(((rank, there.as_deref() != Some(bytes), path), bytes));
            }
        }
        all.sort();
        let mut homes: HashMap<&[u8], String> = HashMap::new();
        let mut copies = BTreeMap::new();
        let mut files = Files::new();
        for ((_, _, path), bytes) in all {
            if let Some(home) = homes.get(bytes) {
                copies.insert(path, home.clone());
            } else {
                files.insert(format!("{BASES}/{path}"), bytes.to_vec());
                homes.insert(bytes, path);
            }
        }
        let copies = serde_json::to_value(copies).expect("paths are JSON");
        files.insert(COPIES.to_owned(), canonical::json_string(&copies).into_bytes());
        files
    }
}

/// Writes files of bases, and removes others.
pub fn write(files: &Files, stray: &[String]) {
    for (path, bytes) in files {
        println!("wrote conformance/{path}");
        let path = suite().join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, bytes).expect("written");
    }
    for path in stray {
        println!("removed conformance/{path}");
        let path = suite().join(path);
        fs::remove_file(&path).expect("removed");
        // Its folders, unless they contain anything else.
        let mut folders = path.ancestors().skip(1);
        while folders.next().is_some_and(|folder| fs::remove_dir(folder).is_ok()) {}
    }
}

/// The name of a base that belongs to a case.
fn base_name(case: &Case) -> String {
    format!("{}-{}", case.code.as_str().to_lowercase(), case.name)
}

/// The content of a case's own base: the URDD before the change, or the case itself where that is far larger.
fn base_of(case: &Case, urdd: &Tree) -> Tree {
    let base = tree_of((case.base)());
    let bytes = |tree: &Tree| stored(tree).map(|(_, bytes)| bytes.len()).sum::<usize>();
    match bytes(&base) <= 2 * bytes(urdd) {
        true => base,
        false => urdd.clone(),
    }
}

fn size(node: &Node) -> usize {
    match node {
        Node::File(bytes) => bytes.len(),
        Node::Link(_) | Node::Folder => 0,
    }
}

/// The files of a base that are stored, without the mirrors that sealing writes.
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

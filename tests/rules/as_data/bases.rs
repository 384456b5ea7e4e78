//! The bases of cases: the existing ones, the one that a case changes, and how they are stored.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs;

use urdd_conformance::case;
use urdd_conformance::change::mirror_of;
use urdd_conformance::data::{BASES, COPIES, URDD};
use urdd_conformance::seal::add_mirrors;
use urdd_conformance::tree::{Node, Tree};
use urdd_directory::canonical;

use super::changes::{Difference, difference, makes};
use super::{suite, tree_of, tree_written};
use crate::{Case, Make, legacy};
use testkit::fixture::{Fixture, toy_robot};

/// A case that adds more than this fraction of a base's bytes gets a base of its own.
const TOO_DIFFERENT: f64 = 0.25;
/// Below this many bytes, a case never gets its own base.
const SMALL: usize = 3000;

/// Bases that do not belong to a case. Files that several bases share are stored in these first.
const MAIN: [&str; 3] = ["toy", "toy_core", "legacy"];

/// Bases by name, [`MAIN`] first.
pub struct Bases(Vec<(String, Tree)>);

impl Bases {
    /// The bases of the stored suite.
    pub fn stored() -> Bases {
        let bases = urdd::suite::carried().expect("the suite reads").bases;
        let mut bases: Vec<(String, Tree)> = bases.into_iter().collect();
        let place = |name: &str| MAIN.iter().position(|main| *main == name);
        bases.sort_by_key(|(name, _)| place(name).unwrap_or(MAIN.len()));
        Bases(bases)
    }

    /// The bases of the stored suite, rebuilt. The bases of removed cases are dropped.
    pub fn made_again(cases: &[Case]) -> Bases {
        let fixture = |fixture: Fixture| {
            tree_of(&Make::Fixture(Box::new(move || crate::canonical(fixture.clone()))))
        };
        let trees = [
            fixture(Fixture::toy()),
            fixture(Fixture::core(&toy_robot())),
            tree_written(&legacy::write_legacy),
        ];
        let mut bases: Vec<(String, Tree)> =
            MAIN.map(str::to_owned).into_iter().zip(trees).collect();
        for (name, _) in Bases::stored().0 {
            if let Some(case) = cases.iter().find(|case| base_name(case) == name) {
                bases.push((name, base_of(case, &tree_of(&case.make))));
            }
        }
        Bases(bases)
    }

    /// The base with the shortest changes to `tree`, and these changes. Only the few bases that share most bytes with
    /// it are tried, those with fewest other files first.
    fn nearest(&self, tree: &Tree) -> (usize, Difference) {
        let foreign = |base: &Tree| -> (usize, usize) {
            let nodes = tree.nodes.iter();
            let missing = nodes.filter(|(path, node)| base.nodes.get(path) != Some(node));
            let gone = base.nodes.keys().filter(|path| !tree.nodes.contains_key(path));
            (missing.map(|(_, node)| size(node)).sum(), gone.count())
        };
        let mut order: Vec<usize> = (0..self.0.len()).collect();
        order.sort_by_cached_key(|at| foreign(&self.0[*at].1));
        let mut nearest: Option<(usize, Difference)> = None;
        for at in order.into_iter().take(4) {
            let way = difference(&self.0[at].1, tree);
            if nearest.as_ref().is_none_or(|(_, best)| length(&way) < length(best)) {
                nearest = Some((at, way));
            }
            if nearest.as_ref().is_some_and(|(_, way)| length(way) < SMALL) {
                break;
            }
        }
        nearest.expect("there are bases")
    }

    /// The base of a case, and its changes. The stored ones are kept if they still produce the case, so that other
    /// cases and bases change nothing here. Otherwise the nearest base is used, or a new one if all are too different.
    pub fn for_case(
        &mut self,
        case: &Case,
        tree: &Tree,
        old: Option<&case::Case>,
    ) -> (String, Difference) {
        if let Some(old) = old {
            let base = self.0.iter().find(|(name, _)| *name == old.base);
            if base.is_some_and(|(_, base)| makes(base, &old.changes, &old.hashes_kept, tree)) {
                let way = (old.changes.clone(), old.hashes_kept.clone());
                return (old.base.clone(), way);
            }
        }
        let (at, way) = self.nearest(tree);
        let own = stored(tree).map(|(_, bytes)| bytes.len()).sum::<usize>();
        let limit = SMALL.max((own as f64 * TOO_DIFFERENT) as usize);
        if length(&way) <= limit.min(own) {
            return (self.0[at].0.clone(), way);
        }
        let name = base_name(case);
        self.0.retain(|(other, _)| *other != name);
        self.0.push((name, base_of(case, tree)));
        let (at, way) = self.nearest(tree);
        if at + 1 != self.0.len() {
            self.0.pop();
        }
        (self.0[at].0.clone(), way)
    }

    /// Drops bases that no case names.
    pub fn keep(&mut self, used: &BTreeSet<String>) {
        self.0.retain(|(name, _)| used.contains(name));
    }

    /// Their files by path in `conformance/`. A file that several bases share is stored once: where it is stored
    /// already, otherwise in the first of them. The list of copies names the others.
    pub fn files(&self) -> BTreeMap<String, Vec<u8>> {
        let mut all = Vec::new();
        for (rank, (name, tree)) in self.0.iter().enumerate() {
            for (path, bytes) in stored(tree) {
                let path = match path.strip_prefix("../") {
                    Some(beside) => format!("{name}/{beside}"),
                    None => format!("{name}/{URDD}/{path}"),
                };
                let there = fs::read(suite().join(BASES).join(&path)).ok();
                let is_new = there.as_deref() != Some(bytes);
                all.push(((rank.min(MAIN.len()), is_new, path), bytes));
            }
        }
        all.sort();
        let mut homes: HashMap<&[u8], String> = HashMap::new();
        let mut copies = BTreeMap::new();
        let mut files = BTreeMap::new();
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

/// The name of a base that belongs to a case.
fn base_name(case: &Case) -> String {
    format!("{}-{}", case.code.as_str().to_lowercase(), case.name)
}

/// The content of a case's own base: the URDD before the change if known, otherwise the case itself.
fn base_of(case: &Case, tree: &Tree) -> Tree {
    let base = case.base.as_ref().map(tree_of);
    // A base that is far larger than the case does not help.
    let bytes = |tree: &Tree| stored(tree).map(|(_, bytes)| bytes.len()).sum::<usize>();
    let base = base.filter(|base| bytes(base) <= 2 * bytes(tree));
    let mut base = base.unwrap_or_else(|| tree.clone());
    // A base contains only files; changes add everything else.
    base.nodes.retain(|path, node| path.as_str().is_some() && matches!(node, Node::File(_)));
    base
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

//! SCH001: for each module, documents that break one keyword of its schema, in one place. They follow from the published
//! schemas, and change the smallest base that has the place.

mod bases;
mod faults;
mod walk;

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};
use testkit::fixture::{Fixture, ROOT};
use urdd_format::registry::{self, Profile};
use urdd_validate::code::Code::SCH001;

pub use self::bases::shared;
use self::faults::{Change, Fault};
use crate::{Case, changed};

/// Modules whose faults are cases, `urdd.json` first.
fn modules() -> impl Iterator<Item = &'static str> {
    let of_v1 = registry::modules().iter().filter(|spec| spec.profile == Profile::V1);
    std::iter::once("root_metadata").chain(of_v1.map(|spec| spec.kind.name()))
}

fn schema(module: &str) -> Value {
    let path = testkit::repository().join(format!("schema/{module}/1.0.0.json"));
    let text = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_slice(&text).expect("a schema")
}

/// The name of a module's document in a fixture.
fn document(module: &str) -> &str {
    if module == "root_metadata" { ROOT } else { module }
}

fn has(urdd: &Fixture, module: &str) -> bool {
    let name = document(module);
    urdd.documents.keys().any(|key| key.rsplit('/').next() == Some(name))
}

pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let (mut known, mut names) = (BTreeSet::new(), BTreeSet::new());
    for module in modules() {
        let schema = schema(module);
        let faults = bases::all()
            .iter()
            .filter(|(_, base)| has(base, module))
            .map(|(name, base)| (*name, walk::faults(&schema, base.doc(document(module)))));
        for (base, fault) in chosen(module, faults.collect(), &mut known) {
            let short = module.strip_suffix("_module").unwrap_or(module);
            let mut name = fault.name(short);
            if !names.insert(name.clone()) {
                // `name` of `Link`, and `LinkName`.
                name += "-2";
            }
            cases.push(case(module, base, name, fault));
        }
    }
    cases.extend(bases::all().iter().map(|(name, _)| keys_of_ones_own(name)));
    cases
}

/// One fault for each place and keyword, in the first base that has it. Where several places in that base lead to one
/// definition, its faults are spread over them, so that each reference is broken once.
///
/// Without `skipped_reasons`, the document of skips is one of a draft (DIR030).
fn chosen(
    module: &str,
    faults: Vec<(&'static str, Vec<Fault>)>,
    known: &mut BTreeSet<String>,
) -> Vec<(&'static str, Fault)> {
    let mut by_key: BTreeMap<String, (&'static str, Vec<Fault>)> = BTreeMap::new();
    for (base, faults) in faults {
        for fault in faults {
            let entry = by_key.entry(fault.key()).or_insert((base, Vec::new()));
            if entry.0 == base {
                entry.1.push(fault);
            }
        }
    }
    let mut used: BTreeMap<String, usize> = BTreeMap::new();
    let mut chosen = Vec::new();
    for (base, faults) in by_key.into_values() {
        let count = |fault: &Fault| used.get(&fault.reference).copied().unwrap_or(0);
        let least = faults.into_iter().min_by_key(|fault| (count(fault), fault.pointer.len()));
        let fault = least.expect("at least one");
        if module == "link_shapes_skips_module" && fault.key() == "/skipped_reasons missing" {
            continue;
        }
        if !known.insert(fault.kept_once(module)) {
            continue;
        }
        *used.entry(fault.reference.clone()).or_default() += 1;
        chosen.push((base, fault));
    }
    chosen
}

fn case(module: &'static str, base: &'static str, name: String, fault: Fault) -> Case {
    changed(
        SCH001,
        name.leak(),
        true,
        move || bases::named(base),
        move |urdd| {
            if module == "root_metadata" {
                urdd.keep_hashes();
                // What the metadata says changes no file.
                for (path, bytes) in urdd.files.clone() {
                    if path != ROOT {
                        urdd.put_file(&path, bytes);
                    }
                }
            }
            let (document, pointer) = (document(module), &fault.pointer);
            match &fault.change {
                Change::Set(value) => urdd.set(document, pointer, value.clone()),
                Change::Remove => {
                    urdd.remove(document, pointer);
                }
            }
        },
    )
}

/// A near miss: each object of each document has one more key, which is a producer's own (3.1.2). A learned model states
/// a hash of all documents that it follows from: there, its own document alone has them.
fn keys_of_ones_own(base: &'static str) -> Case {
    let name = format!("{}-with-keys-of-ones-own", base.replace('_', "-"));
    changed(
        SCH001,
        name.leak(),
        false,
        move || bases::named(base),
        |urdd| {
            let modules: Vec<&str> = modules().filter(|module| has(urdd, module)).collect();
            let modules = match modules.last() {
                Some(last @ &"self_collision_model_module") => vec![*last],
                _ => modules,
            };
            for module in modules {
                let pointers = walk::objects(&schema(module), urdd.doc(document(module)));
                for pointer in pointers {
                    urdd.set(document(module), &format!("{pointer}/x_acme"), json!(1));
                }
            }
        },
    )
}

/// Every keyword of the schemas is broken somewhere, but for those of places that no base has.
#[test]
fn every_place_of_a_schema_is_in_a_base() {
    let mut missing = Vec::new();
    for module in modules() {
        let schema = schema(module);
        let there = bases::all().iter().filter(|(_, base)| has(base, module));
        let places: BTreeSet<String> =
            there.flat_map(|(_, base)| walk::places(&schema, base.doc(document(module)))).collect();
        let all = walk::all_places(&schema);
        missing.extend(all.difference(&places).map(|place| format!("{module}{place}")));
    }
    assert_eq!(missing, Vec::<String>::new());
}

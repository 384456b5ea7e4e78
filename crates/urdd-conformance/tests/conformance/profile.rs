//! The profiles of validators: which cases one of Core modules by their JSON can decide, and which one of a class.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;
use urdd_conformance::export::{Item, items};
use urdd_conformance::profile::Profile;
use urdd_conformance::suite::{CaseKind, Verdict};
use urdd_conformance::tree::{Node, Tree};
use urdd_directory::file_entry::hashes;

use crate::suite;

fn split() -> (Vec<Item>, Vec<Item>) {
    let items = items(&suite()).expect("the suite reads");
    items.into_iter().partition(|item| item.profiles.contains(&Profile::CoreJson))
}

fn families(items: &[Item], profile: Profile) -> BTreeSet<String> {
    let inside = items.iter().filter(|item| item.profiles.contains(&profile));
    inside.filter_map(|item| Some(item.code.as_deref()?[..3].to_owned())).collect()
}

/// SPEC 12.2: each class judges what the one before it does, and more.
#[test]
fn classes_contain_each_other() {
    let items = items(&suite()).expect("the suite reads");
    let [json, core, geometry, shapes] = Profile::ALL;
    for (smaller, larger) in [(json, core), (core, geometry), (geometry, shapes)] {
        let is_of = |item: &&Item, profile| item.profiles.contains(&profile);
        let lost = items.iter().find(|item| is_of(item, smaller) && !is_of(item, larger));
        assert!(lost.is_none(), "{}", lost.expect("one").id);
        let more = families(&items, larger);
        let more: Vec<String> = more.difference(&families(&items, smaller)).cloned().collect();
        let expected: &[&str] = match larger {
            Profile::Core => &["EXT", "YML"],
            Profile::Geometry => &["MSH"],
            _ => &["SHP"],
        };
        assert_eq!(more, expected, "{larger:?}");
    }
    let is_in = |id: &str, profile| {
        let item = items.iter().find(|item| item.id == id).unwrap_or_else(|| panic!("no {id}"));
        item.profiles.contains(&profile)
    };
    for (id, first) in [
        ("DIR012/schema-of-extension-not-listed", core),
        ("DIR001/packed", core),
        ("unreadable/two-roots", core),
        ("DIR012/mesh-not-listed", geometry),
    ] {
        let mut before = Profile::ALL.iter().take_while(|profile| **profile != first);
        assert!(is_in(id, first) && before.all(|of| !is_in(id, *of)), "{id}");
    }
    // Documents of modules that a class passes over: LRN and SPH are of none.
    let of_none = |item: &&Item| item.profiles.is_empty() && item.profile == "1.0";
    let files = items.iter().filter(of_none).flat_map(|item| &item.findings);
    let files: BTreeSet<&str> = files.filter_map(|finding| finding.file.as_deref()).collect();
    assert!(files.iter().any(|file| file.contains("self_collision_model_module")), "{files:?}");
}

/// SPEC 8.8.9, 8.9.7: URDDs with a model or spheres may be left unverified, and cases of their rules.
#[test]
fn some_cases_may_be_left_unverified() {
    let items = items(&suite()).expect("the suite reads");
    let may = |id: &str| {
        let item = items.iter().find(|item| item.id == id).unwrap_or_else(|| panic!("no {id}"));
        item.may_be_unverified
    };
    for id in ["LRN010/misses-halved", "LRN010/misses-off-by-two", "LRN011/learned-by-heart"] {
        assert!(may(id), "{id}");
    }
    for id in ["valid/gripper", "DOF001/joint-missing", "SPH009/pair-twice"] {
        assert!(!may(id), "{id}");
    }
}

#[test]
fn the_profile_is_neither_empty_nor_everything() {
    let (inside, outside) = split();
    assert!(inside.len() > 400, "{} cases", inside.len());
    assert!(outside.len() > 400, "{} cases", outside.len());
    let families = |items: &[Item]| -> BTreeSet<String> {
        items.iter().filter_map(|item| Some(item.code.as_deref()?[..3].to_owned())).collect()
    };
    let core =
        ["BND", "CHN", "CMP", "CNF", "CON", "DIR", "DOF", "JSN", "KIN", "LOP", "SCH", "SRC", "URD"];
    assert_eq!(families(&inside), core.map(str::to_owned).into());
    for others in ["YML", "EXT", "MSH", "SHP", "LRN", "LEG"] {
        assert!(families(&outside).contains(others), "{others}");
    }
}

/// Where a URDD is rejected, the fault is where a validator of the profile looks.
#[test]
fn faults_are_in_what_the_profile_reads() {
    let (inside, outside) = split();
    for item in inside.iter().filter(|item| item.verdict == Verdict::Reject) {
        assert!(item.folder.ends_with("/robot") && item.profile == "1.0", "{}", item.id);
        for file in item.findings.iter().filter_map(|finding| finding.file.as_deref()) {
            let other =
                ["module.yaml", "schema.json", "mesh_modules/", "link_shapes_modules/", "x_"];
            assert!(!other.iter().any(|other| file.contains(other)), "{}: {file}", item.id);
        }
    }
    // Codes of the profile whose fault is elsewhere.
    let is_outside = |id: &str| outside.iter().any(|item| item.id == id);
    for id in ["DIR012/mesh-not-listed", "DIR012/schema-of-extension-not-listed", "DIR001/packed"] {
        assert!(is_outside(id), "{id}");
    }
    assert!(
        inside
            .iter()
            .any(|item| item.code.as_deref() == Some("DIR012") && item.kind == CaseKind::Invalid)
    );
}

/// A validator of the profile sees another URDD than the base, which it accepts. What it does not read may differ at will.
#[test]
fn what_the_profile_reads_decides_its_cases() {
    let suite = suite();
    let items = items(&suite).expect("the suite reads");
    let mut compared = 0;
    for (item, case) in items.iter().skip(suite.data.robots().len()).zip(suite.all_cases()) {
        assert_eq!(item.id, case.id());
        if !item.profiles.contains(&Profile::CoreJson)
            || item.verdict != Verdict::Reject
            || case.changes.is_empty()
        {
            continue;
        }
        let urdd = suite.tree(case).expect("a case");
        assert_ne!(read(&urdd), read(&suite.bases[&case.base]), "{}: nothing it reads", item.id);
        compared += 1;
    }
    assert!(compared > 300, "{compared}");
}

/// What the profile reads of a URDD: `urdd.json`, with whether each listed file is as it says; documents and versions of
/// Core modules; the source; and the names of what is in modules, or may be one.
fn read(urdd: &Tree) -> BTreeMap<String, Vec<u8>> {
    let metadata = urdd.file("urdd.json").unwrap_or_default();
    let mut read = BTreeMap::from([("urdd.json".to_owned(), metadata.to_vec())]);
    if let Ok(mut value) = serde_json::from_slice::<Value>(metadata) {
        let list = |value: &'_ mut Value, key: &str| {
            let list = value.get_mut(key).and_then(Value::as_array_mut);
            list.map(std::mem::take).unwrap_or_default()
        };
        let mut modules = list(&mut value, "modules");
        let mut files: Vec<Value> = modules.iter_mut().flat_map(|one| list(one, "files")).collect();
        for file in files.iter_mut().filter_map(Value::as_object_mut) {
            let text = |key: &str| file.get(key).and_then(Value::as_str);
            let bytes = text("path").and_then(|path| urdd.file(path));
            let hash = bytes.map(|mut bytes| hashes(&mut bytes, false).expect("bytes").plain);
            let size = file.get("size").and_then(Value::as_u64);
            let is_right =
                hash.as_deref() == text("sha256") && bytes.map(|bytes| bytes.len() as u64) == size;
            file.insert("sha256".to_owned(), is_right.into());
            if is_right {
                file.insert("size".to_owned(), Value::Null);
            }
        }
        read.insert("modules".to_owned(), format!("{modules:?} {files:?}").into_bytes());
        read.insert("urdd.json".to_owned(), value.to_string().into_bytes());
    }
    for (path, node) in &urdd.nodes {
        let path = String::from_utf8_lossy(path.as_bytes()).into_owned();
        let last = path.rsplit('/').next().unwrap_or_default();
        let is_core = path.ends_with("_module/module.json") && path.matches('/').count() == 1;
        let content = match node {
            Node::File(bytes) if is_core || last == "VERSION" || last.ends_with(".urdf") => {
                bytes.to_vec()
            }
            Node::File(_) => Vec::new(),
            other => format!("{other:?}").into_bytes(),
        };
        let is_of_module = path.contains("_module") && last != "module.yaml";
        if is_of_module || !path.contains('/') {
            read.entry(path).or_insert(content);
        }
    }
    read
}

#[test]
fn what_cannot_be_read_is_of_it_as_a_folder() {
    let (inside, outside) = split();
    let named = |items: &[Item], id: &str| items.iter().any(|item| item.id == id);
    assert!(named(&inside, "unreadable/empty-folder"));
    assert!(named(&outside, "unreadable/two-roots"));
}

//! The profiles of validators: which cases one of Core modules by their JSON can decide, and which one of a class.

use std::collections::BTreeSet;

use urdd_conformance::export::{Item, items};
use urdd_conformance::profile::Profile;
use urdd_conformance::suite::{CaseKind, Verdict};

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

#[test]
fn what_cannot_be_read_is_of_it_as_a_folder() {
    let (inside, outside) = split();
    let named = |items: &[Item], id: &str| items.iter().any(|item| item.id == id);
    assert!(named(&inside, "unreadable/empty-folder"));
    assert!(named(&outside, "unreadable/two-roots"));
}

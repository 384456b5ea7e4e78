//! The profile `core-json`: which cases a validator of Core modules by their JSON can decide.

use std::collections::BTreeSet;

use urdd_conformance::export::{Item, items};
use urdd_conformance::suite::{CaseKind, Verdict};

use crate::suite;

fn split() -> (Vec<Item>, Vec<Item>) {
    let items = items(&suite()).expect("the suite reads");
    items.into_iter().partition(|item| !item.profiles.is_empty())
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

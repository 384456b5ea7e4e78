//! What every test relies on: `tests/support` produces documents that the format accepts, and text that reads back to
//! them.

use std::collections::BTreeSet;

use proptest::prelude::*;
use serde_json::{Value, json};
use urdd_format::registry::{FIRST_SPEC_VERSION, ModuleKind, find};
use urdd_format::root_metadata::RootMetadata;

use testkit::fixture::{Fixture, ROOT, URDF};
use testkit::meshes::{Point, dot, minus};
use testkit::robot::{arbitrary_box_robot, arbitrary_robot};
use testkit::shapes::box_distance;
use testkit::transform::{apply, norm, rotation_of_rpy, transform};

#[test]
fn toy_is_accepted() {
    check(&Fixture::toy());
}

#[test]
fn a_model_that_is_written_down_is_accepted() {
    check(&testkit::model::fixture());
}

#[test]
fn toy_holds_what_it_promises() {
    let toy = Fixture::toy();
    let kinds = ModuleKind::ALL
        .iter()
        // What a class requires, and what is recommended for all.
        .filter(|kind| kind.class().is_some() || **kind == ModuleKind::KinematicsSamples)
        .filter(|kind| find(**kind, FIRST_SPEC_VERSION).is_some());
    // And `urdd.json`.
    assert_eq!(toy.documents.len(), kinds.count() + 1);
    let reasons = toy.get("link_shapes_simple_skips_module", "/reasons/full_convex_hulls");
    let rows = reasons.as_array().into_iter().flatten();
    let words: BTreeSet<&str> = rows
        .flat_map(|row| row.as_array().into_iter().flatten())
        .filter_map(Value::as_str)
        .collect();
    assert_eq!(
        words.into_iter().collect::<Vec<_>>(),
        ["Adjacent", "Always", "Default", "Never", "None", "SameLink"]
    );
    let simple = toy.get("link_shapes_simple_skips_module", "/full_obbs_simple_skips");
    let edited = toy.get("link_shapes_skips_module", "/full_obbs_skips");
    assert_ne!(simple, edited);
    let types = toy.get("urdf_module", "/joints").as_array().into_iter().flatten();
    let types: BTreeSet<_> = types.map(|joint| joint["joint_type"].to_string()).collect();
    assert_eq!(types.len(), 7);
}

#[test]
fn sealing_follows_edits_and_spares_what_is_kept() {
    let mut urdd = Fixture::toy();
    let before = urdd.clone();
    urdd.seal();
    assert_eq!(urdd.files, before.files);

    urdd.set("dof_module", "/dofs/0/name", json!("x"));
    urdd.keep_mirror("bounds_module");
    urdd.set("bounds_module", "/dof_limited/0", json!(false));
    urdd.remove("chain_module", "/links_in_chain/0/name");
    urdd.urdf_replace("toy robot", "toy");
    urdd.keep_hash(URDF);
    urdd.remove_file("connections_module/module.yaml");
    urdd.seal();
    let changed = urdd.files.iter().filter(|(path, bytes)| before.files.get(*path) != Some(*bytes));
    let changed: Vec<&str> = changed.map(|(path, _)| path.as_str()).collect();
    assert_eq!(
        changed,
        [
            "bounds_module/module.json",
            "chain_module/module.json",
            "chain_module/module.yaml",
            "dof_module/module.json",
            "dof_module/module.yaml",
            "robot.urdf",
            "urdd.json",
        ]
    );
    assert_eq!(urdd.get(ROOT, "/source"), before.get(ROOT, "/source"));
    assert!(!urdd.files.contains_key("connections_module/module.yaml"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_robots_are_accepted(robot in arbitrary_robot()) {
        check(&Fixture::core(&robot));
    }

    #[test]
    fn arbitrary_box_robots_are_accepted(robot in arbitrary_box_robot()) {
        check(&Fixture::full(&robot));
    }

    #[test]
    fn box_distances_lie_between_bounds(a in any_box(), b in any_box()) {
        let distance = box_distance(&a, &b);
        let (least, most) = distance_bounds(&a, &b);
        prop_assert!(least - 1e-9 <= distance && distance <= most + 1e-9, "{least} {distance} {most}");
        prop_assert!(most - least < 0.1 || distance == 0.0, "the bounds say something");
    }
}

fn any_box() -> impl Strategy<Value = [Point; 8]> {
    let turn = prop_oneof![Just([0.0; 3]), prop::array::uniform3(-3.0..3.0)];
    let place = prop_oneof![
        prop::array::uniform3(-1.0..1.0),
        prop::array::uniform3(prop::sample::select(vec![-1.0, 0.0, 1.0])),
    ];
    (prop::array::uniform3(0.05..1.0f64), turn, place).prop_map(|(sides, turn, place)| {
        let place = transform(rotation_of_rpy(turn), place);
        std::array::from_fn(|number| {
            let side = |bit: usize| {
                if number >> bit & 1 == 0 { -sides[bit] } else { sides[bit] }
            };
            apply(&place, [side(0), side(1), side(2)].map(|s| s / 2.0))
        })
    })
}

/// Bounds of the distance of two convex hulls, by another method: the Frank-Wolfe descent to the point of their
/// difference that is nearest to 0, and the plane behind that point.
fn distance_bounds(a: &[Point; 8], b: &[Point; 8]) -> (f64, f64) {
    let corners: Vec<Point> = a.iter().flat_map(|p| b.iter().map(|q| minus(*p, *q))).collect();
    let mut at = corners[0];
    let (mut least, mut most) = (0.0f64, norm(at));
    for _ in 0..2000 {
        let nearer = |x: &&Point, y: &&Point| dot(at, **x).total_cmp(&dot(at, **y));
        let corner = *corners.iter().min_by(nearer).expect("64");
        if norm(at) > 0.0 {
            least = least.max(dot(at, corner) / norm(at));
        }
        let step = minus(corner, at);
        if dot(step, step) == 0.0 {
            break;
        }
        let length = (-dot(at, step) / dot(step, step)).clamp(0.0, 1.0);
        at = [0, 1, 2].map(|i| at[i] + length * step[i]);
        most = most.min(norm(at));
    }
    (least, most)
}

/// Every document is read by its type and written back the same; both texts read back to it; every
/// listed file is there.
fn check(urdd: &Fixture) {
    for (folder, document) in &urdd.documents {
        let text = if folder == ROOT {
            serde_json::from_value::<RootMetadata>(document.clone()).expect("root metadata");
            urdd.file(ROOT)
        } else {
            let name = folder.rsplit('/').next().unwrap_or_default();
            let kind = ModuleKind::ALL.iter().find(|kind| kind.name() == name);
            let module = find(*kind.expect("a module"), "1.0.0").expect("a version");
            module.read(document).unwrap_or_else(|e| panic!("{folder}: {e}"));
            let yaml = urdd.file(&format!("{folder}/module.yaml"));
            let read: Value =
                serde_yaml::from_slice(yaml).unwrap_or_else(|e| panic!("{folder}: {e}"));
            assert_eq!(&read, document, "{folder}/module.yaml");
            urdd.file(&format!("{folder}/module.json"))
        };
        let read: Value = serde_json::from_slice(text).expect("JSON");
        assert_eq!(&read, document, "{folder}");
    }
    let modules = urdd.get(ROOT, "/modules").as_array().expect("a list");
    let files = modules.iter().flat_map(|m| m["files"].as_array().into_iter().flatten());
    let listed: BTreeSet<&str> = files.filter_map(|file| file["path"].as_str()).collect();
    let there: BTreeSet<&str> = urdd.files.keys().map(String::as_str).collect();
    let unlisted: Vec<_> = there.difference(&listed).copied().collect();
    assert_eq!(unlisted, [URDF, ROOT]);
    assert!(listed.is_subset(&there));
}

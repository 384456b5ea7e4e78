//! One fault gives one message, and a second fault does not hide behind it. The URDD describes its robot twice, in
//! `urdf_module` and in the carried URDF. Where these differ, other modules are wrong only where they follow from
//! neither.

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::json;

use crate::findings;
use testkit::fixture::Fixture;

/// A name, a change, and every code that should be found.
type Case = (&'static str, fn(&mut Fixture), &'static [&'static str]);

/// The URDF was changed, and the URDD was not generated again.
fn stale_limit(urdd: &mut Fixture) {
    urdd.urdf_replace("upper=\"0.2\"", "upper=\"0.21\"");
}

/// A user changed `urdf_module`.
fn damaged_limit(urdd: &mut Fixture) {
    urdd.set("urdf_module", &limit_of("slide"), json!(0.21));
}

fn limit_of(joint: &str) -> String {
    format!("/joints/{}/limit/upper", JOINTS.iter().position(|name| *name == joint).unwrap())
}

/// The toy's first joints, in order.
const JOINTS: [&str; 5] = ["tip", "turn", "shoulder", "flange", "slide"];

fn upper_bound(urdd: &mut Fixture, dof: usize, upper: f64) {
    urdd.set("bounds_module", &format!("/bounds/{dof}/1"), json!(upper));
    urdd.set("bounds_module", &format!("/dof_upper_bounds/{dof}"), json!(upper));
}

fn moved_origin(urdd: &mut Fixture) {
    urdd.set("chain_module", "/joints_in_chain/1/origin/position/0", json!(7.0));
}

const CASES: &[Case] = &[
    ("stale limit", stale_limit, &["URD001"]),
    ("damaged limit", damaged_limit, &["URD001"]),
    (
        "stale limit, and a chain that follows from neither",
        |urdd| {
            stale_limit(urdd);
            moved_origin(urdd);
        },
        &["CHN008", "URD001"],
    ),
    (
        "damaged limit, and a chain that follows from neither",
        |urdd| {
            damaged_limit(urdd);
            moved_origin(urdd);
        },
        &["CHN008", "URD001"],
    ),
    (
        "stale limit, and bounds of another joint",
        |urdd| {
            stale_limit(urdd);
            upper_bound(urdd, 0, 0.75);
        },
        &["BND003", "URD001"],
    ),
    (
        "damaged limit, and bounds that are a third thing",
        |urdd| {
            damaged_limit(urdd);
            upper_bound(urdd, 2, 0.75);
        },
        &["BND003", "URD001"],
    ),
    (
        "columns that differ, and bounds of other DOFs that are wrong",
        |urdd| {
            urdd.set("bounds_module", "/bounds/1/0", json!(-1.1));
            upper_bound(urdd, 0, 0.75);
            upper_bound(urdd, 15, 7.0);
        },
        &["BND002", "BND003", "BND006"],
    ),
    (
        "stale limit, and columns that differ about it",
        |urdd| {
            stale_limit(urdd);
            urdd.set("bounds_module", "/bounds/2/1", json!(0.21));
        },
        &["BND002", "URD001"],
    ),
    (
        "stale limit, and bounds that are up to date",
        |urdd| {
            stale_limit(urdd);
            upper_bound(urdd, 2, 0.21);
        },
        // The samples and the statistics use the old bounds.
        &["KIN002", "SHP024", "URD001"],
    ),
    (
        "link added to the URDF, and a wrong hierarchy",
        |urdd| {
            urdd.urdf_replace(
                "</robot>",
                "<link name=\"new\"/><joint name=\"new\" type=\"fixed\"><parent link=\"base\"/>\
                 <child link=\"new\"/></joint></robot>",
            );
            moved_origin(urdd);
        },
        &["CHN008", "URD001"],
    ),
    (
        "a sample that is wrong beside a damaged limit",
        |urdd| {
            damaged_limit(urdd);
            urdd.set("kinematics_samples_module", "/samples/0/link_poses/3/position/0", json!(9.0));
        },
        &["KIN003", "URD001"],
    ),
    (
        "urdf_module is no robot, and the connections are wrong",
        |urdd| {
            urdd.set("urdf_module", "/joints/1/child/link", json!("nowhere"));
            urdd.set("connections_module", "/root_paths/1/links/0", json!(5));
        },
        &["CON002", "URD007"],
    ),
    (
        "urdf_module breaks its schema, and a DOF is misdescribed",
        |urdd| {
            urdd.set("urdf_module", "/joints/1/axis", json!(1.0));
            urdd.set("dof_module", "/dofs/0/name", json!("other"));
        },
        &["DOF006", "SCH001"],
    ),
    (
        "the URDF's mass was made negative",
        |urdd| urdd.urdf_replace("<mass value=\"", "<mass value=\"-"),
        &["SRC003", "URD013"],
    ),
    (
        "crossed in urdf_module alone",
        |urdd| urdd.set("urdf_module", &limit_of("slide"), json!(-9.0)),
        &["URD001"],
    ),
];

#[test]
fn every_fault_is_told_and_none_twice() {
    let mut wrong = Vec::new();
    for (name, change, expected) in CASES {
        let write = |folder: &Path| {
            let mut urdd = Fixture::toy();
            change(&mut urdd);
            urdd.seal();
            urdd.write_to(folder);
        };
        let found = findings(&write);
        let codes: BTreeSet<&str> = found.keys().map(String::as_str).collect();
        if codes != expected.iter().copied().collect() {
            wrong.push(format!("{name}: expected {expected:?}, found {found:#?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

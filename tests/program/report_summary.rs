//! Reports on many URDDs, and on geometry that could not be verified.

use std::path::Path;

use serde_json::{Value, json};
use testkit::fixture::Fixture;
use testkit::robot::*;
use urdd_format::urdf::{Joint, JointType, Link};

const PLAIN: &str = "plain_meshes_module";
const SKIPS: &str = "link_shapes_skips_module";

/// Four links, side by side, each a box; that of link 2 is 47 mm off its origin.
fn robot() -> Robot {
    let mut robot = Robot::new("four links");
    for at in 0..4 {
        let place = (at == 2).then(|| origin([0.046875, 0.0, 0.0], [0.0; 3]));
        robot.urdf.links.push(Link {
            visual: vec![visual(place.flatten(), cuboid([0.125, 0.25, 0.5]))],
            ..link(&format!("link {at}"))
        });
    }
    for at in 1..4 {
        let child = format!("link {at}");
        robot.urdf.joints.push(Joint {
            origin: origin([at as f64, 0.0, 0.0], [0.0; 3]),
            ..joint(&format!("joint {at}"), JointType::Fixed, "link 0", &child)
        });
    }
    robot
}

fn urdd(folder: &Path, arguments: &[&str]) -> String {
    let output = crate::program::output(arguments, folder);
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[test]
fn faults_that_mean_the_same_are_one_cause() {
    let folder = testkit::temporary::folder();
    for number in 0..4 {
        let mut urdd = Fixture::full(&robot());
        for pointer in [
            "/full_convex_hulls_skips/0/1",
            "/full_obbs_skips/3/2",
            "/decomposition_obbs_skips/0/3",
        ] {
            let old = urdd.get(SKIPS, pointer).as_bool().expect("a skip");
            urdd.set(SKIPS, pointer, json!(!old));
        }
        urdd.seal();
        urdd.write_to(&folder.path().join(format!("robot{number}")));
    }
    let text = urdd(folder.path(), &["validate", "."]);
    let causes: Vec<&str> = text.lines().filter(|line| line.contains("error SHP006")).collect();
    assert_eq!(causes.len(), 1, "{text}");
    assert!(causes[0].contains("12 times in 4 URDDs"), "{text}");
}

#[test]
fn the_color_of_a_link_is_not_motion() {
    let explained = urdd(Path::new("."), &["explain", "URD014", "--format", "json"]);
    assert!(explained.contains("\"consequence\": \"appearance\""), "{explained}");
}

#[test]
fn geometry_that_is_not_verified_is_named_in_every_format() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    let mut shared = Fixture::full(&robot());
    let files = shared.get(PLAIN, "/link_meshes/1/files").clone();
    shared.set(PLAIN, "/link_meshes/2/files", files);
    shared.seal();
    shared.write_to(&root.join("shared"));
    let mut sound = Fixture::full(&robot());
    sound.seal();
    sound.write_to(&root.join("sound"));

    let report: Value =
        serde_json::from_str(&urdd(root, &["validate", "--format", "json", "."])).expect("JSON");
    let links = |urdd: usize| -> Vec<u64> {
        let links = report["urdds"][urdd]["geometry_not_verified"].as_array();
        let links = links.expect("a list").iter();
        links.map(|link| link["link"].as_u64().expect("an index")).collect()
    };
    assert_eq!(links(0), [1, 2]);
    assert_eq!(links(1), [0_u64; 0]);
    let second = &report["urdds"][0]["geometry_not_verified"][1];
    let reasons = second["reasons"].as_array().expect("a list");
    assert!(reasons.contains(&json!("MSH015 found a fault")), "{second}");
    let codes = second["codes"].as_array().expect("a list");
    assert!(codes.contains(&json!("MSH018")), "{second}");

    const WORDS: &str = "the geometry of 2 links was not verified";
    assert!(urdd(root, &["validate", "shared"]).contains(WORDS));
    assert!(!urdd(root, &["validate", "sound"]).contains("was not verified"));
    let sarif: Value =
        serde_json::from_str(&urdd(root, &["validate", "--format", "sarif", "shared"]))
            .expect("JSON");
    let invocation = &sarif["runs"][0]["invocations"][0];
    assert!(invocation.to_string().contains(WORDS), "{invocation}");
    assert_eq!(invocation["executionSuccessful"], json!(true));
}

#[test]
fn a_model_that_is_not_verified_is_named_in_every_format() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    let mut stale = testkit::model::fixture();
    stale.set(testkit::model::MODEL, "/trained_on", json!("0".repeat(64)));
    stale.seal();
    stale.write_to(&root.join("stale"));
    testkit::model::fixture().write_to(&root.join("true"));
    let mut without = Fixture::full(&robot());
    without.seal();
    without.write_to(&root.join("without"));

    let report = urdd(root, &["validate", "--format", "json", "."]);
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let open = |urdd: usize| report["urdds"][urdd]["model_not_verified"].clone();
    assert_eq!(
        open(0),
        json!({ "codes": ["LRN010", "LRN011"], "reasons": ["LRN006 found a fault"] })
    );
    assert_eq!([open(1), open(2)], [json!(null), json!(null)]);

    const WORDS: &str = "the rates of the self-collision model were not verified";
    assert!(urdd(root, &["validate", "stale"]).contains(WORDS));
    assert!(!urdd(root, &["validate", "true"]).contains("verified"));
    let sarif = urdd(root, &["validate", "--format", "sarif", "stale"]);
    let sarif: Value = serde_json::from_str(&sarif).expect("JSON");
    let invocation = &sarif["runs"][0]["invocations"][0];
    assert!(invocation.to_string().contains(WORDS), "{invocation}");
    for copy in ["b", "c", "d"] {
        stale.write_to(&root.join(copy));
    }
    let summary = urdd(root, &["validate", "."]);
    assert!(summary.contains(&format!("{WORDS}, in 4 URDDs")), "{summary}");

    // `urdd info` says it too, with the rates.
    let info = |name: &str| urdd(root, &["info", name]);
    assert!(info("true").contains("rates verified"), "{}", info("true"));
    assert!(info("stale").contains("rates NOT TRUE: LRN006 found a fault"), "{}", info("stale"));
    assert!(info("true").contains(" % of ") || info("true").contains(" %) of "));
    assert!(!info("without").contains("rates"));
}

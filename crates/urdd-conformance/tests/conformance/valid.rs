//! The valid URDDs: what `urdd generate` produces from our robots, and the validator's findings.

use std::collections::BTreeSet;
use std::fs;

use urdd_conformance::data::kept;
use urdd_conformance::export::write_valid;
use urdd_conformance::tree::{Node, Tree};
use urdd_validate::settings::Settings;
use urdd_validate::validate;

use crate::suite;

/// `URDD_UPDATE=1 cargo test --workspace --test conformance` writes them. Elsewhere the last digits of numbers
/// may differ (SPEC 9.4 and 13.3).
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[test]
fn generating_gives_what_is_kept_and_nothing_is_found_in_it() {
    let suite = suite();
    let folder = testkit::temporary::folder();
    let robots = folder.path().join("robots");
    suite.data.write_robots(&robots).expect("the robots");
    let urdds = folder.path().join("valid");
    write_valid(&suite.data, &suite.data.robots(), &robots, &urdds, &Default::default())
        .expect("URDDs");
    let update = std::env::var_os("URDD_UPDATE").is_some();
    let mut stale = BTreeSet::new();
    for robot in suite.data.robots() {
        let made = urdds.join(&robot);
        let made = kept(&Tree::read(&made, &made).expect("a URDD"));
        let place = testkit::repository().join("conformance/valid").join(&robot);
        let kept = match place.is_dir() {
            true => Tree::read(&place, &place).expect("a folder of the suite"),
            false => Tree::default(),
        };
        if update && kept != made {
            let _ = fs::remove_dir_all(&place);
            made.write(&place).expect("written");
            continue;
        }
        let paths = kept.nodes.keys().chain(made.nodes.keys());
        let differs = paths.filter(|path| kept.nodes.get(path) != made.nodes.get(path));
        stale.extend(differs.map(|path| format!("{robot}/{path}")));
    }
    assert!(
        stale.is_empty(),
        "urdd generate does not make these of our robots any more; if that is meant, run URDD_UPDATE=1 cargo test \
         --workspace --test conformance and read what changed: {stale:#?}"
    );

    let run = validate(&[&urdds], &Settings::default()).expect("URDDs");
    let report = run.report;
    assert_eq!(report.urdds.len(), 9);
    for urdd in report.urdds {
        assert!(urdd.findings.is_empty(), "{}: {:#?}", urdd.path, urdd.findings);
    }
}

#[test]
fn what_is_not_kept_is_in_the_hashes() {
    let suite = suite();
    for robot in suite.data.robots() {
        let kept = suite.data.carried(&robot);
        let root = kept.file("urdd.json").expect("urdd.json");
        let root: serde_json::Value = serde_json::from_slice(root).expect("JSON");
        let modules = root["modules"].as_array().expect("a list");
        let listed = modules.iter().flat_map(|module| module["files"].as_array());
        let listed: BTreeSet<&str> =
            listed.flatten().filter_map(|file| file["path"].as_str()).collect();
        assert!(listed.len() > 30, "{robot}");
        for (path, node) in &kept.nodes {
            let path = path.as_str().expect("UTF-8");
            assert!(path == "urdd.json" || listed.contains(path), "{robot}/{path}");
            assert!(matches!(node, Node::File(_)));
        }
    }
}

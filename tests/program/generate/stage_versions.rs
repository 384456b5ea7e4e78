//! A stage whose result changes for the same inputs must change its version; otherwise URDDs keep the earlier result.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use urdd_generate::{Settings, generate};

use crate::generate::{our_robots, read_json};

const RECORD: &str = "tests/program/generate/stage_versions.json";
const ROBOTS: &[&str] = &["gripper", "scaled_parts", "toy_all_joints"];

/// For each module that may be kept: the hash of all its inputs, and that of the result.
fn made() -> BTreeMap<String, Value> {
    let mut record = BTreeMap::new();
    for (name, source) in our_robots() {
        if !ROBOTS.contains(&name.as_str()) {
            continue;
        }
        let folder = testkit::temporary::folder();
        let target = folder.path().join("out");
        let settings = Settings { num_samples: 10, ..Settings::default() };
        generate(&source, &target, &settings, &()).unwrap();
        let metadata = read_json(&target.join("urdd.json"));
        for module in metadata["modules"].as_array().unwrap() {
            let Some(inputs) = module["x_urdd_inputs"].as_str() else {
                continue;
            };
            let made = Sha256::digest(module["files"].to_string());
            let made: String = made.iter().map(|byte| format!("{byte:02x}")).collect();
            let key = format!("{name}/{}", module["name"].as_str().unwrap());
            record.insert(key, json!({"inputs": inputs, "made": made}));
        }
    }
    record
}

/// Recorded on one platform: others may differ in last digits.
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[test]
fn a_stage_that_makes_something_else_has_another_version() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(RECORD);
    let made = made();
    assert!(made.len() >= 9 * ROBOTS.len(), "{} modules", made.len());
    let text = fs::read_to_string(&path).unwrap_or_else(|_| "{}".to_owned());
    let recorded: BTreeMap<String, Value> = serde_json::from_str(&text).unwrap();
    for (key, now) in &made {
        let Some(before) = recorded.get(key) else {
            continue;
        };
        assert!(
            now["inputs"] != before["inputs"] || now["made"] == before["made"],
            "{key}: the stage makes something else of the same inputs. Change its text in \
             crates/urdd-generate/src/inputs.rs, so that nobody keeps what it made before; \
             then URDD_UPDATE=1 cargo test --test program stage_versions"
        );
    }
    if std::env::var_os("URDD_UPDATE").is_some() {
        let text = serde_json::to_string_pretty(&made).unwrap();
        fs::write(&path, text + "\n").unwrap();
        return;
    }
    assert!(
        made == recorded,
        "what stages are made of has changed; record it: URDD_UPDATE=1 cargo test --test program stage_versions"
    );
}

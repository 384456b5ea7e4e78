//! Two producers, written independently from SPEC.md alone, must produce the same for a robot: the Python example and
//! `tests/support`. Needs `python3`.

use std::fs;
use std::path::Path;
use std::process::Command;

use proptest::test_runner::{Config, TestCaseError, TestRunner};
use serde_json::{Value, json};

use testkit::difference::difference;
use testkit::fixture::{Fixture, ROOT, URDF, toy_robot};
use testkit::robot::{Robot, arbitrary_robot};

#[test]
#[ignore = "needs python3; .ci/run runs it"]
fn on_the_toy() {
    compare(&toy_robot()).unwrap_or_else(|difference| panic!("{difference}"));
}

#[test]
#[ignore = "needs python3; .ci/run runs it"]
fn on_arbitrary_robots() {
    let config =
        Config { cases: 50, failure_persistence: None, max_shrink_iters: 60, ..Config::default() };
    let mut runner = TestRunner::new(config);
    let outcome =
        runner.run(&arbitrary_robot(), |robot| compare(&robot).map_err(TestCaseError::fail));
    outcome.unwrap_or_else(|failure| panic!("{failure}"));
}

fn compare(robot: &Robot) -> Result<(), String> {
    let ours = Fixture::core(robot);
    let folder = testkit::temporary::folder();
    let (urdf, out) = (folder.path().join(URDF), folder.path().join("out"));
    std::fs::write(&urdf, robot.to_urdf_xml()).expect("the URDF");
    run_python(&urdf, &out)?;
    let mut root = read_json(&out.join(ROOT));
    check_hashes(&out, &root)?;
    for (name, document) in &ours.documents {
        if name == ROOT {
            continue;
        }
        let theirs = read_json(&out.join(name).join("module.json"));
        difference(document, &theirs, "").map_or(Ok(()), |d| Err(format!("{name}{d}")))?;
        let yaml = std::fs::read(out.join(name).join("module.yaml")).expect("module.yaml");
        let mirror: Value = serde_yaml::from_slice(&yaml).map_err(|e| format!("{name}: {e}"))?;
        if mirror != theirs {
            return Err(format!("{name}: module.yaml and module.json differ"));
        }
    }
    let mut own_root = ours.doc(ROOT).clone();
    for root in [&mut root, &mut own_root] {
        root["generator"] = Value::Null;
        let modules = root["modules"].as_array_mut().expect("modules");
        for file in modules.iter_mut().flat_map(|m| m["files"].as_array_mut()) {
            for entry in file {
                *entry = entry["path"].clone(); // The text, and therefore the hashes, may differ between producers.
            }
        }
    }
    difference(&own_root, &root, "").map_or(Ok(()), |d| Err(format!("{ROOT}{d}")))
}

fn run_python(urdf: &Path, out: &Path) -> Result<(), String> {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/minimal_producer.py");
    let output = Command::new("python3")
        .arg(script)
        .args([urdf, out])
        .output()
        .unwrap_or_else(|e| panic!("this test runs python3, which must be on the PATH: {e}"));
    if output.status.success() {
        Ok(())
    } else {
        Err(String::from_utf8_lossy(&output.stderr).into_owned())
    }
}

fn read_json(path: &Path) -> Value {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_slice(&bytes).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Sizes and hashes that the other producer states, compared with those that our fixture would write.
fn check_hashes(out: &Path, root: &Value) -> Result<(), String> {
    let modules = root["modules"].as_array().into_iter().flatten();
    let listed = modules.flat_map(|m| m["files"].as_array().into_iter().flatten());
    for entry in listed.chain([&root["source"]["Urdf"]]) {
        let path = entry["path"].as_str().expect("a path");
        let bytes = std::fs::read(out.join(path)).map_err(|e| format!("{path}: {e}"))?;
        let (size, sha256) = testkit::fixture::size_and_hash(&bytes);
        if entry["size"] != json!(size) || entry["sha256"] != json!(sha256) {
            return Err(format!("{path}: size or hash"));
        }
    }
    Ok(())
}

/// The robots and meshes in `conformance/robots` are what `make/make_robots.py` writes.
#[test]
#[ignore = "needs python3; .ci/run runs it"]
fn our_robots_are_what_their_script_writes() {
    let robots = Path::new(env!("CARGO_MANIFEST_DIR")).join("conformance/robots");
    let folder = testkit::temporary::folder();
    let output = Command::new("python3")
        .arg(robots.join("make/make_robots.py"))
        .arg(folder.path())
        .output()
        .unwrap_or_else(|e| panic!("this test runs python3, which must be on the PATH: {e}"));
    assert!(output.status.success(), "{output:?}");
    let written = testkit::files::below(folder.path());
    for (name, bytes) in &written {
        let ours = fs::read(robots.join(name)).unwrap_or_default();
        assert!(ours == *bytes, "{name} is not what the script writes: run it");
    }
    assert!(written.len() >= 20, "{} files", written.len());
}

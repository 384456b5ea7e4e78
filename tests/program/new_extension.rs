//! `urdd schema new-extension` as its user sees it.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use testkit::files;
use testkit::fixture::Fixture;
use urdd_validate::settings::Settings;
use urdd_validate::validate;

fn new_extension(name: &str, folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(["schema", "new-extension", name])
        .arg(folder)
        .output()
        .unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn toy() -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = testkit::temporary::folder();
    let root = folder.path().join("robot");
    let mut toy = Fixture::toy();
    toy.canonical = true;
    toy.seal();
    toy.write_to(&root);
    (folder, root)
}

fn codes(root: &Path) -> Vec<String> {
    let run = validate(&[root], &Settings::default()).unwrap();
    let findings = run.report.urdds.into_iter().flat_map(|urdd| urdd.findings);
    findings.map(|finding| finding.code).collect()
}

#[test]
fn an_extension_that_is_added_passes() {
    let (_guard, root) = toy();
    // The second stands before the first: modules of one's own are sorted by name.
    for name in ["acme_gripper", "acme_camera", "bolt_acme_2"] {
        let output = new_extension(name, &root);
        assert!(output.status.success(), "{}", stderr(&output));
    }
    assert_eq!(codes(&root), Vec::<String>::new());
    let read = |path: &str| -> Value {
        serde_json::from_str(&fs::read_to_string(root.join(path)).unwrap()).unwrap()
    };
    let stiffness = read("x_acme_gripper_module/module.json")["joint_stiffness"].clone();
    let joints = read("urdf_module/module.json")["joints"].clone();
    assert_eq!(stiffness.as_array().unwrap().len(), joints.as_array().unwrap().len());

    // It is checked: its index and its length by the annotations.
    let file = root.join("x_acme_gripper_module/module.json");
    let mut document = read("x_acme_gripper_module/module.json");
    document["link_idx"] = 4000.into();
    document["joint_stiffness"].as_array_mut().unwrap().pop();
    fs::write(&file, document.to_string()).unwrap();
    fs::remove_file(root.join("x_acme_gripper_module/module.yaml")).unwrap();
    let found = codes(&root);
    for code in ["EXT003", "EXT004"] {
        assert!(found.iter().any(|found| found == code), "{found:?}");
    }
}

#[test]
fn an_extension_in_a_folder_passes_when_it_is_listed() {
    let folder = testkit::temporary::folder();
    let output = new_extension("acme_gripper", folder.path());
    assert!(output.status.success(), "{}", stderr(&output));
    let written = files::below(&folder.path().join("x_acme_gripper_module"));
    let names: Vec<&String> = written.keys().collect();
    assert_eq!(names, ["VERSION", "module.json", "module.yaml", "schema.json"]);

    let mut toy = Fixture::toy();
    let document = serde_json::from_slice(&written["module.json"]).unwrap();
    toy.put_file("x_acme_gripper_module/schema.json", written["schema.json"].clone());
    toy.add_module("x_acme_gripper_module", document);
    toy.canonical = true;
    toy.seal();
    let root = folder.path().join("robot");
    toy.write_to(&root);
    assert_eq!(codes(&root), Vec::<String>::new());
}

#[test]
fn nothing_is_overwritten() {
    let (_guard, root) = toy();
    assert!(new_extension("acme_gripper", &root).status.success());
    let before = files::below(&root);
    let output = new_extension("acme_gripper", &root);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("lists `x_acme_gripper_module` already"),
        "{}",
        stderr(&output)
    );
    assert!(files::below(&root) == before);

    // A folder that is not listed.
    fs::create_dir(root.join("x_acme_camera_module")).unwrap();
    let output = new_extension("acme_camera", &root);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("exists, and is left as it is"), "{}", stderr(&output));
    assert!(files::below(&root) == before);

    // A URDD that cannot be changed.
    for broken in ["{", "{}", "{\"modules\": 7}"] {
        fs::write(root.join("urdd.json"), broken).unwrap();
        assert_eq!(new_extension("acme_arm", &root).status.code(), Some(2), "{broken}");
        assert!(!root.join("x_acme_arm_module").exists());
        assert_eq!(fs::read_to_string(root.join("urdd.json")).unwrap(), broken);
    }
}

#[test]
fn names_that_no_extension_may_have_are_refused() {
    let folder = testkit::temporary::folder();
    for name in [
        "",
        "gripper",
        "_gripper",
        "acme_",
        "Acme_gripper",
        "acme-gripper",
        "../a_b",
        "a_b/c",
        "x_acme_gripper",
        "acme_gripper_module",
        "x_acme_gripper_module",
        "a_\u{1b}[2J",
    ] {
        let output = new_extension(name, folder.path());
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(stderr(&output).contains("such as acme_gripper"), "{}", stderr(&output));
        assert!(!stderr(&output).contains('\u{1b}'));
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    let output = new_extension("acme_gripper", &folder.path().join("nowhere"));
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("is not a folder"), "{}", stderr(&output));
}

//! `urdd schema` as its user sees it.

use std::fs;
use std::process::{Command, Output, Stdio};

fn urdd(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_urdd")).arg("schema").args(arguments).output().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn lists_every_schema_in_aligned_columns() {
    let text = stdout(&urdd(&["list"]));
    let heading = text.lines().next().unwrap();
    let column = heading.find("folder").unwrap();
    for line in text.lines() {
        assert_eq!(&line[column - 2..column], "  ", "{line}");
        assert_ne!(&line[column..=column], " ", "{line}");
    }
    assert!(text.contains("creator_module@unversioned"));
    assert!(text.contains("bevy_modules/first_look_vis_module"));
}

#[test]
fn shows_a_schema_strict_or_open() {
    let strict = urdd(&["show", "dof_module@1.0.0"]);
    assert!(strict.status.success());
    assert!(stdout(&strict).contains("\"additionalProperties\": false"));
    let open = stdout(&urdd(&["show", "dof_module@1.0.0", "--open"]));
    assert!(!open.contains("additionalProperties"));
    assert!(open.contains("\"urn:urdd:schema:dof_module:1.0.0:open\""));
}

#[test]
fn an_unknown_id_is_a_usage_error_with_a_hint() {
    let output = urdd(&["show", "dof_module"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("did you mean `dof_module@1.0.0`"));
    assert!(stderr(&output).contains("urdd schema list"));
}

#[test]
fn checks_what_it_exports_and_says_how_to_mend_it() {
    let temporary = testkit::temporary::folder();
    let folder = temporary.path().join("deep").join("schemas");
    let path = folder.to_str().unwrap();
    let check = || urdd(&["check", path]);

    assert_eq!(check().status.code(), Some(2), "a folder that does not exist");
    assert!(urdd(&["export", path]).status.success());
    assert_eq!(check().status.code(), Some(0), "{}", stdout(&check()));

    let chain = folder.join("chain_module/1.0.0.json");
    let text = fs::read_to_string(&chain).unwrap();
    fs::write(&chain, text.replace('\n', "\r\n")).unwrap();
    assert_eq!(check().status.code(), Some(0), "line ends of another system");

    fs::write(&chain, "{}").unwrap();
    fs::remove_file(folder.join("dof_module/1.0.0.json")).unwrap();
    fs::write(folder.join("dof_module/2.0.0.json"), [0xff]).unwrap();
    let output = check();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        stdout(&output),
        format!(
            "chain_module/1.0.0.json: not what the types write\n\
             dof_module/1.0.0.json: missing\n\
             dof_module/2.0.0.json: not a published schema; remove it\n\
             repair: urdd schema export {path}\n"
        )
    );

    fs::remove_file(folder.join("dof_module/2.0.0.json")).unwrap();
    assert!(stdout(&urdd(&["export", path])).contains("2 written"));
    assert_eq!(check().status.code(), Some(0));
}

#[test]
fn a_reader_that_stops_early_is_no_fault() {
    // A pipe whose reading end is closed before the program writes.
    let mut child = Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(["schema", "show", "urdf_module@1.0.0"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(stderr(&output), "");
    assert!(output.status.success());
}

/// One schema for all: valid itself, and it accepts what the schemas of the modules accept.
#[test]
fn the_bundle_holds_every_module_of_version_1() {
    let examples = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/urdds/arm");
    for arguments in [&["bundle"] as &[&str], &["bundle", "--open"]] {
        let bundle: serde_json::Value =
            serde_json::from_str(&stdout(&urdd(arguments))).expect("JSON");
        assert!(jsonschema::draft202012::meta::is_valid(&bundle));
        let validator = jsonschema::draft202012::new(&bundle).expect("a schema");
        let mut urdd = serde_json::Map::new();
        for entry in fs::read_dir(&examples).expect("a URDD") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            let file = if path.is_dir() { path.join("module.json") } else { path.clone() };
            if name.ends_with("_module") || name == "urdd.json" {
                let text = fs::read_to_string(file).expect("a document");
                urdd.insert(name, serde_json::from_str(&text).expect("JSON"));
            }
        }
        assert!(urdd.len() >= 7, "{}", urdd.len());
        let mut urdd = serde_json::Value::Object(urdd);
        let errors: Vec<String> = validator.iter_errors(&urdd).map(|e| e.to_string()).collect();
        assert_eq!(errors, [""; 0]);
        let properties = bundle["properties"].as_object().expect("properties");
        assert!(properties.len() >= 16, "{}", properties.len());
        // It also rejects what they reject.
        urdd["dof_module"]["num_dofs"] = serde_json::json!("six");
        assert!(!validator.is_valid(&urdd));
    }
}

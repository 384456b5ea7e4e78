//! The reports for other programs: the properties that these programs rely on. (`.ci/run` checks SARIF against its
//! schema and third-party Rust types in `checks/`, and JUnit against the schema of Jenkins.)

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::{Value, json};
use testkit::fixture::{Fixture, ROOT};

fn validate(folder: &Path, arguments: &[&str]) -> Output {
    crate::program::output(&[&["validate"], arguments].concat(), folder)
}

fn text(folder: &Path, format: &str, arguments: &[&str]) -> String {
    let output = validate(folder, &[&["--format", format], arguments].concat());
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn sarif(folder: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str(&text(folder, "sarif", arguments)).expect("JSON")
}

fn results(log: &Value) -> &Vec<Value> {
    log["runs"][0]["results"].as_array().expect("a list")
}

fn uri(result: &Value) -> &str {
    result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].as_str().expect("a URI")
}

/// A repository with robots in it: a valid one; an invalid one, whose name every format must escape; and one with a
/// warning.
fn repository() -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    let write = |path: &str, change: &dyn Fn(&mut Fixture)| {
        let mut toy = Fixture::toy();
        change(&mut toy);
        toy.seal();
        toy.write_to(&folder.path().join(path));
    };
    write("robots/good", &|_| {});
    write("robots/né #1\u{1} <\"&'>", &|f| {
        f.set(ROOT, "/robot_name", json!("a\u{1}<b>&\"]]>\u{fffe}[x](y)"));
    });
    write("robots/arms/odd", &|f| {
        f.remove_file("dof_module/module.yaml");
        f.unlist("dof_module/module.yaml");
    });
    folder
}

#[test]
fn sarif_finds_the_files_in_the_repository() {
    let repository = repository();
    let root = repository.path();
    let absolute = root.join("robots");
    let absolute = absolute.to_str().expect("UTF-8");
    let expected = sarif(root, &["robots"]);
    assert_eq!(results(&expected).len(), 2);
    for path in ["./robots/", absolute, "robots/../robots"] {
        assert_eq!(sarif(root, &[path]), expected, "{path}");
    }
    assert_eq!(results(&sarif(root, &["."])), results(&expected));
    for result in results(&expected) {
        let path = percent_encoding::percent_decode_str(uri(result));
        let path = path.decode_utf8().expect("UTF-8").into_owned();
        // The folder of a missing mirror exists; the file of a value exists.
        let region = &result["locations"][0]["physicalLocation"]["region"];
        let on_disk = root.join(&path);
        assert!(on_disk.exists() || region.is_null(), "{path}");
        assert!(!uri(result).contains([' ', '#', '<', '"']), "{path}");
        assert_eq!(
            result["locations"][0]["physicalLocation"]["artifactLocation"]["uriBaseId"],
            "%SRCROOT%"
        );
    }
    // From inside a URDD, and from beside the repository.
    let within = root.join("robots/arms/odd");
    assert!(uri(&results(&sarif(&within, &["."]))[0]).starts_with("dof_module"));
    let beside = root.join("robots/good");
    let log = sarif(&beside, &[within.to_str().expect("UTF-8")]);
    assert!(uri(&results(&log)[0]).starts_with("odd/"), "no absolute path");
}

#[test]
fn sarif_says_what_the_report_says() {
    let repository = repository();
    let log = sarif(repository.path(), &["robots", "--with-crashing-rule"]);
    let run = &log["runs"][0];
    let report: Value =
        serde_json::from_str(&text(repository.path(), "json", &["robots"])).expect("JSON");
    let findings: Vec<&Value> = report["urdds"]
        .as_array()
        .expect("a list")
        .iter()
        .flat_map(|urdd| urdd["findings"].as_array().expect("a list"))
        .collect();
    assert_eq!(findings.len(), results(&log).len());
    for (finding, result) in findings.iter().zip(results(&log)) {
        assert_eq!(finding["code"], result["ruleId"]);
        let rule = &run["tool"]["driver"]["rules"]
            [result["ruleIndex"].as_u64().expect("an index") as usize];
        assert_eq!(rule["id"], result["ruleId"]);
        assert_eq!(finding["severity"], result["level"]);
        assert_eq!(finding["count"], result["occurrenceCount"]);
        let place = &result["locations"][0];
        assert_eq!(finding["line"], place["physicalLocation"]["region"]["startLine"]);
        assert_eq!(finding["column"], place["physicalLocation"]["region"]["startColumn"]);
        let pointer = &place["logicalLocations"][0]["fullyQualifiedName"];
        assert_eq!(&finding["pointer"], pointer);
        let message = result["message"]["text"].as_str().expect("a text");
        assert!(!message.contains("]("), "a link made of a name: {message}");
    }
    let invocation = &run["invocations"][0];
    assert_eq!(invocation["exitCode"], 101);
    assert_eq!(invocation["executionSuccessful"], false);
    let crashes = invocation["toolExecutionNotifications"].as_array().expect("a list");
    assert_eq!(crashes.len(), 3);
    assert_eq!(crashes[0]["associatedRule"]["id"], "TST001");
    let invocation = &sarif(repository.path(), &["robots"])["runs"][0]["invocations"][0];
    assert_eq!(
        (&invocation["exitCode"], &invocation["executionSuccessful"]),
        (&json!(1), &json!(true))
    );
}

#[test]
fn fingerprints_outlive_shifted_lines() {
    let fingerprints = |folder: &Path| -> BTreeSet<String> {
        let log = sarif(folder, &["robots"]);
        let of = |result: &Value| result["partialFingerprints"].to_string() + uri(result);
        results(&log).iter().filter(|result| result["ruleId"] == "DIR020").map(of).collect()
    };
    let repository = repository();
    let before = fingerprints(repository.path());
    assert_eq!(before.len(), 1);
    for entry in fs::read_dir(repository.path().join("robots")).expect("a folder") {
        let file = entry.expect("an entry").path().join(ROOT);
        if let Ok(text) = fs::read_to_string(&file) {
            fs::write(&file, format!("\n\n{text}")).expect("written");
        }
    }
    assert_eq!(fingerprints(repository.path()), before);
}

#[test]
fn junit_counts_what_it_holds() {
    let repository = repository();
    for (arguments, failures, errors) in [
        (&["robots"] as &[&str], 1, 0),
        (&["robots", "--fail-on", "info"], 2, 0),
        (&["robots", "--with-crashing-rule"], 1, 3),
        (&["robots/good"], 0, 0),
    ] {
        let xml = text(repository.path(), "junit", arguments);
        let document = urdd_xml::parse(&xml, urdd_xml::Kind::Other).expect("XML");
        let root = document.root_element();
        let of = |node: urdd_xml::Node, name: &str| {
            node.descendants().filter(|n| n.has_tag_name(name)).count()
        };
        let said = |node: urdd_xml::Node, name: &str| -> usize {
            node.attribute(name).expect("a total").parse().expect("a number")
        };
        for node in document.descendants().filter(|n| n.has_tag_name("testsuite") || *n == root) {
            assert_eq!(said(node, "tests"), of(node, "testcase"));
            assert_eq!(said(node, "failures"), of(node, "failure"));
            assert_eq!(said(node, "errors"), of(node, "error"));
            if node != root {
                assert_eq!(said(node, "skipped"), of(node, "skipped"));
            }
        }
        assert_eq!((of(root, "failure"), of(root, "error")), (failures, errors), "{arguments:?}");
        // The suite fails exactly when the run does.
        let status = validate(repository.path(), arguments).status.code();
        assert_eq!(status != Some(0), failures + errors > 0);
    }
}

#[test]
fn junit_says_hostile_names_as_far_as_xml_can() {
    let repository = repository();
    let xml = text(repository.path(), "junit", &["robots"]);
    let document = urdd_xml::parse(&xml, urdd_xml::Kind::Other).expect("XML");
    let names: BTreeSet<&str> = document
        .descendants()
        .filter(|n| n.has_tag_name("testsuite"))
        .filter_map(|n| n.attribute("name"))
        .collect();
    assert_eq!(
        names,
        BTreeSet::from(["robots/arms/odd", "robots/good", "robots/né #1\\u{1} <\"&'>"])
    );
    let failure = document.descendants().find(|n| n.has_tag_name("failure")).expect("a failure");
    let text = failure.text().expect("a text");
    assert!(text.contains("a\\u{1}<b>&\\\"]]>\\u{fffe}[x](y)"), "{text}");
    // A case has the same name whether it passes or not, so that it can be followed through runs.
    let cases = |suite: &str| -> Vec<String> {
        document
            .descendants()
            .filter(|n| n.has_tag_name("testcase") && n.attribute("classname") == Some(suite))
            .filter_map(|n| n.attribute("name").map(str::to_owned))
            .collect()
    };
    assert_eq!(cases("robots/good"), cases("robots/né #1\\u{1} <\"&'>"));
    assert!(cases("robots/good").contains(&"DOF003 dof-mappings-disagree".to_owned()));
}

#[test]
fn files_get_the_format_of_their_ending() {
    let repository = repository();
    let root = repository.path();
    let files = ["a.sarif", "b.sarif.json", "c.xml", "d.json", "e"];
    let mut arguments = vec!["robots"];
    for file in files {
        arguments.extend(["--output", file]);
    }
    let output = validate(root, &arguments);
    assert!(String::from_utf8_lossy(&output.stdout).contains("3 URDDs: 2 passed, 1 failed."));
    let formats = ["sarif", "sarif", "junit", "json", "json"];
    for (file, format) in files.into_iter().zip(formats) {
        let written = fs::read_to_string(root.join(file)).expect("a report");
        assert_eq!(written, text(root, format, &["robots"]), "{file}");
    }
}

/// A URDF with two axes in a joint.
const TWO_AXES: &str = r#"<robot name="r">
  <link name="base"/>
  <link name="tip"/>
  <joint name="j" type="continuous">
    <parent link="base"/>
    <child link="tip"/>
    <axis xyz="1 0 0"/><axis
      xyz="0 1 0"/>
  </joint>
</robot>
"#;

#[test]
fn a_finding_says_what_to_see_besides_and_what_mends_it() {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("r.urdf"), TWO_AXES).expect("written");
    let report = text(folder.path(), "json", &["r.urdf"]);
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let finding = &report["urdds"][0]["findings"][0];
    assert_eq!(finding["code"], "SRC008");
    let place = &finding["places"][0];
    assert_eq!((&place["line"], &place["column"]), (&json!(7), &json!(24)));
    assert_eq!(place["written_at"], Value::Null);
    let first = &place["related"][0];
    assert_eq!((&first["line"], &first["column"]), (&json!(7), &json!(5)));

    // The fix, made by hand: of line 7 what is before column 24, of line 8 what is from column 20 on.
    let fix = &place["fixes"][0];
    let edit = json!({
        "file": "r.urdf", "line": 7, "column": 24, "end_line": 8, "end_column": 20, "text": "",
    });
    assert_eq!(fix["is_safe"], false, "others take the last");
    assert_eq!(fix["edits"], json!([edit]));
    let mended = TWO_AXES.replace("<axis\n      xyz=\"0 1 0\"/>", "");
    fs::write(folder.path().join("mended.urdf"), mended).expect("written");
    let mended = text(folder.path(), "json", &["mended.urdf"]);
    let mended: Value = serde_json::from_str(&mended).expect("JSON");
    assert_eq!(mended["urdds"][0]["findings"], json!([]));

    let log = sarif(folder.path(), &["r.urdf"]);
    let result = &results(&log)[0];
    let related = &result["relatedLocations"][0];
    assert_eq!(related["physicalLocation"]["region"]["startColumn"], 5);
    assert_eq!(related["message"]["text"], first["message"]);
    let change = &result["fixes"][0]["artifactChanges"][0];
    assert_eq!(change["artifactLocation"]["uri"], "r.urdf");
    let deleted = json!({"startLine": 7, "startColumn": 24, "endLine": 8, "endColumn": 20});
    assert_eq!(change["replacements"][0]["deletedRegion"], deleted);

    let human = text(folder.path(), "human", &["r.urdf"]);
    assert!(human.contains("see 7:5: the first, which counts"), "{human}");
}

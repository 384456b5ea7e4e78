//! `urdd validate` as people and scripts use it: exit status, reports, settings, and the same bytes for the same input.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::{Value, json};
use testkit::fixture::{Fixture, ROOT};

/// Runs `urdd validate` in a folder.
fn validate(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().expect("the program")
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
    command.arg("validate").args(arguments).current_dir(folder);
    command
}

fn status(folder: &Path, arguments: &[&str]) -> i32 {
    let output = validate(folder, arguments);
    output.status.code().expect("an exit status")
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

fn report(folder: &Path, arguments: &[&str]) -> Value {
    let output = validate(folder, &[&["--format", "json"], arguments].concat());
    serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", stderr(&output)))
}

/// A folder with URDDs: `good`, `bad` (an error), and `odd` (a warning).
fn collection() -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    let write = |name: &str, change: &dyn Fn(&mut Fixture)| {
        let mut toy = Fixture::toy();
        change(&mut toy);
        toy.seal();
        toy.write_to(&folder.path().join(name));
    };
    write("good", &|_| {});
    write("bad", &|f| f.set(ROOT, "/robot_name", json!("other")));
    write("odd", &|f| {
        f.remove_file("dof_module/module.yaml");
        f.unlist("dof_module/module.yaml");
    });
    folder
}

#[test]
fn exit_statuses() {
    let folder = collection();
    let status = |arguments: &[&str]| status(folder.path(), arguments);
    assert_eq!(status(&["good"]), 0);
    assert_eq!(status(&["odd"]), 0);
    assert_eq!(status(&["bad"]), 1);
    assert_eq!(status(&["."]), 1);
    assert_eq!(status(&["good", "bad"]), 1);
    assert_eq!(status(&["nowhere"]), 2);
    assert_eq!(status(&["good", "nowhere"]), 2);
    assert_eq!(status(&["good/urdd.json"]), 2);
    assert_eq!(status(&[]), 2);
    assert_eq!(status(&["good", "--no-such-flag"]), 2);
    assert_eq!(status(&["good", "--with-crashing-rule"]), 101);
    assert_eq!(status(&["bad", "--with-crashing-rule"]), 101);
}

#[test]
fn fail_on() {
    let folder = collection();
    let status = |name, severity| status(folder.path(), &[name, "--fail-on", severity]);
    assert_eq!(status("odd", "warning"), 1);
    assert_eq!(status("odd", "info"), 1);
    assert_eq!(status("odd", "error"), 0);
    assert_eq!(status("good", "info"), 0);
    assert_eq!(status("good", "fatal"), 2);
}

#[test]
fn class() {
    let folder = collection();
    let mut core = Fixture::toy();
    for (module, class) in
        [("original_meshes_module", "Geometry"), ("link_shapes_skips_module", "Core")]
    {
        core.remove_module(module);
        core.set(ROOT, "/conformance_class", json!(class));
    }
    for kind in [
        "link_shapes_simple_skips_module",
        "link_shapes_distance_statistics_module",
        "link_shapes_max_distance_from_origin_module",
        "link_shapes_approximations_module",
        "convex_decomposition_meshes_module",
        "convex_hull_meshes_module",
        "plain_meshes_module",
    ] {
        core.remove_module(kind);
    }
    core.seal();
    core.write_to(&folder.path().join("core"));
    let status = |arguments: &[&str]| status(folder.path(), arguments);
    assert_eq!(status(&["core"]), 0);
    assert_eq!(status(&["core", "--class", "core"]), 0);
    assert_eq!(status(&["core", "--class", "Shapes"]), 1);
    assert_eq!(status(&["core", "--class", "huge"]), 2);
    let report = report(folder.path(), &["core", "--class", "geometry"]);
    let finding = &report["urdds"][0]["findings"][0];
    assert_eq!((&finding["code"], &finding["count"]), (&json!("DIR019"), &json!(4)));
}

#[test]
fn crashes_are_told() {
    let folder = collection();
    let output = validate(folder.path(), &["good", "--with-crashing-rule"]);
    assert!(stdout(&output).contains("INCOMPLETE"), "{}", stdout(&output));
    assert!(stdout(&output).contains("TST001"));
    assert_eq!(stderr(&output), "");
    let report = report(folder.path(), &["good", "--with-crashing-rule"]);
    assert_eq!(report["urdds"][0]["verdict"], "incomplete");
}

#[test]
fn json_reports_fit_their_schema() {
    let folder = collection();
    let schema =
        serde_json::to_value(schemars::schema_for!(urdd_format::report::Report)).expect("a value");
    let schema = jsonschema::draft202012::new(&schema).expect("a schema");
    for arguments in [&["."] as &[&str], &["good"], &["bad", "--with-crashing-rule"]] {
        let report = report(folder.path(), arguments);
        let errors: Vec<String> = schema.iter_errors(&report).map(|e| e.to_string()).collect();
        assert_eq!(errors, [""; 0]);
    }
    let report = report(folder.path(), &["."]);
    let verdicts: Vec<(&Value, &Value)> = report["urdds"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|urdd| (&urdd["path"], &urdd["verdict"]))
        .collect();
    let expected = [("bad", "fail"), ("good", "pass"), ("odd", "pass")];
    let expected = expected.map(|(path, verdict)| (json!(path), json!(verdict)));
    assert!(verdicts.iter().map(|(p, v)| (*p, *v)).eq(expected.iter().map(|(p, v)| (p, v))));
    let totals = json!({
        "urdds": 3, "passed": 2, "failed": 1, "not_examined": 0, "error": 1, "warning": 1, "info": 0
    });
    assert_eq!(report["totals"], totals);
}

#[test]
fn a_report_file_beside_the_text() {
    let folder = collection();
    let output = validate(folder.path(), &["bad", "--output", "report.json"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stdout(&output).contains("DIR020"));
    let file = fs::read_to_string(folder.path().join("report.json")).expect("a report");
    let written: Value = serde_json::from_str(&file).expect("JSON");
    assert_eq!(written, report(folder.path(), &["bad"]));
    assert_eq!(status(folder.path(), &["good", "--output", "no/such/folder.json"]), 2);
}

#[test]
fn settings_are_read_up_to_a_limit() {
    let folder = collection();
    let comment = "# a comment\n".repeat(100_000);
    fs::write(folder.path().join("urdd.toml"), comment).expect("written");
    let output = validate(folder.path(), &["good"]);
    assert_eq!(output.status.code(), Some(2));
    let words = stderr(&output);
    assert!(words.contains("urdd.toml: it is longer than 1 MiB"), "{words}");
}

#[cfg(target_os = "linux")]
#[test]
fn devices_are_no_settings_and_no_urdds() {
    let folder = collection();
    for arguments in [
        ["good", "--config", "/dev/zero"].as_slice(),
        // Reading the kernel's log blocks until its next line.
        &["/proc/kmsg"],
    ] {
        let output = validate(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
}

#[test]
fn settings() {
    let folder = collection();
    let with = |text: &str, arguments: &[&str]| {
        fs::write(folder.path().join("urdd.toml"), text).expect("written");
        validate(folder.path(), arguments)
    };
    for (wrong, part) in [
        ("colour = true", "colour"),
        ("[severity]\nDIR999 = \"info\"", "DIR999"),
        ("[severity]\nDIR020 = \"fatal\"", "fatal"),
        ("class = \"huge\"", "huge"),
        ("[[ignore]]\ncode = \"DIR020\"\npath = \"**\"", "reason"),
        ("[[ignore]]\ncode = \"DIR020\"\npath = \"**\"\nreason = \" \"", "reason"),
        ("[[ignore]]\ncode = \"DIR020\"\npath = \"[\"\nreason = \"x\"", "pattern"),
        ("fail-on = ", "urdd.toml"),
    ] {
        let output = with(wrong, &["good"]);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
        assert!(stderr(&output).contains(part), "{wrong}: {}", stderr(&output));
        assert!(stderr(&output).contains("urdd.toml"), "{wrong}: {}", stderr(&output));
    }
    let status = |text: &str, arguments: &[&str]| with(text, arguments).status.code();
    assert_eq!(status("[severity]\nDIR020 = \"warning\"", &["bad"]), Some(0));
    assert_eq!(status("[severity]\nDIR010 = \"error\"", &["odd"]), Some(1));
    assert_eq!(status("fail-on = \"warning\"", &["odd"]), Some(1));
    assert_eq!(status("fail-on = \"warning\"", &["odd", "--fail-on", "error"]), Some(0));

    let ignore = "[[ignore]]\ncode = \"DIR020\"\npath = \"bad/*\"\nreason = \"renamed soon\"\n";
    let output = with(ignore, &["."]);
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
    let checks = report(folder.path(), &["."]);
    let checks = checks["urdds"][0]["checks"].as_array().expect("a list").clone();
    let check = checks.iter().find(|check| check["code"] == "DIR020").expect("a check");
    assert_eq!(check["reason"], "ignored: renamed soon");
    // For another URDD: it matches nothing, and a message says so.
    let output = with(&ignore.replace("bad/", "ba/"), &["."]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stdout(&output).contains("`ba/*`"), "{}", stdout(&output));
    assert_eq!(report(folder.path(), &["."])["stale_ignores"][0]["code"], "DIR020");

    fs::remove_file(folder.path().join("urdd.toml")).expect("removed");
    fs::write(folder.path().join("ours.toml"), ignore).expect("written");
    let arguments = ["bad", "--config", "ours.toml"];
    assert_eq!(validate(folder.path(), &arguments).status.code(), Some(0));
    let arguments = ["bad", "--config", "nowhere.toml"];
    assert_eq!(validate(folder.path(), &arguments).status.code(), Some(2));
}

#[test]
fn same_input_same_bytes() {
    let (folder, other) = (collection(), testkit::temporary::folder());
    let copy = other.path().join("deeper/down");
    copy_folder(folder.path(), &copy);
    for format in ["json", "human"] {
        let run = |folder: &Path, threads: &str| {
            let mut command = command(folder, &[".", "--format", format]);
            command.env("RAYON_NUM_THREADS", threads).output().expect("the program").stdout
        };
        let first = run(folder.path(), "1");
        assert!(!first.is_empty());
        assert!(first == run(folder.path(), "2"), "{format}: with two threads");
        assert!(first == run(&copy, "2"), "{format}: in another folder");
    }
    let by_path = |path: &Path| {
        let path = path.join("bad");
        validate(folder.path(), &["--format", "json", path.to_str().expect("UTF-8")]).stdout
    };
    assert!(by_path(folder.path()) == by_path(&copy), "by absolute path");
}

fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder") {
        let entry = entry.expect("an entry");
        let target = to.join(entry.file_name());
        match entry.path().is_dir() {
            true => copy_folder(&entry.path(), &target),
            false => {
                fs::copy(entry.path(), target).expect("copied");
            }
        }
    }
}

#[test]
fn rehash_brings_sizes_and_hashes_up_to_date_and_nothing_else() {
    let folder = testkit::temporary::folder();
    let root = folder.path().join("robot");
    let mut toy = Fixture::toy();
    toy.seal();
    toy.write_to(&root);
    let rehash = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        command.args(["rehash", "robot"]).current_dir(folder.path()).output().expect("the program")
    };
    let metadata = || fs::read(root.join(ROOT)).expect("urdd.json");
    let before = metadata();
    assert_eq!(stdout(&rehash()), "robot: up to date\n");
    assert_eq!(metadata(), before);

    // White space does not change documents, but it changes every size and hash.
    let module = root.join("dof_module/module.json");
    let text = fs::read_to_string(&module).expect("module.json");
    fs::write(&module, text + "\n").expect("written");
    assert_eq!(status(folder.path(), &["robot"]), 1);
    assert_eq!(stdout(&rehash()), "robot: updated\n  dof_module/module.json\n");
    assert_eq!(status(folder.path(), &["robot"]), 0);

    fs::remove_file(root.join("dof_module/VERSION")).expect("removed");
    let now = metadata();
    let output = rehash();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("dof_module/VERSION: there is no such file"),
        "{}",
        stderr(&output)
    );
    assert_eq!(metadata(), now);
}

/// The findings of one URDD.
fn findings(folder: &Path, arguments: &[&str]) -> Vec<Value> {
    let report = report(folder, arguments);
    report["urdds"][0]["findings"].as_array().expect("a list").clone()
}

#[test]
fn machines_get_every_place_and_people_the_worst() {
    let folder = testkit::temporary::folder();
    let mut toy = Fixture::toy();
    // Each DOF's bounds are off by a different amount, the third by most.
    let dofs = toy.get("bounds_module", "/bounds").as_array().expect("a list").len();
    assert!(dofs > 5, "{dofs}");
    for dof in 0..dofs {
        let by = if dof == 2 { 100.0 } else { dof as f64 + 1.0 };
        for (list, index) in [("dof_lower_bounds", dof), ("dof_upper_bounds", dof)] {
            let pointer = format!("/{list}/{index}");
            let old = toy.get("bounds_module", &pointer).as_f64().expect("a number");
            toy.set("bounds_module", &pointer, json!(old - by));
        }
    }
    toy.seal();
    toy.write_to(&folder.path().join("robot"));
    let found = findings(folder.path(), &["robot", "--select", "BND"]);
    let lower = found
        .iter()
        .find(|f| f["pointer"].as_str().is_some_and(|p| p.starts_with("/dof_lower")))
        .expect("a finding");
    let places = lower["places"].as_array().expect("a list");
    assert_eq!((places.len(), &lower["count"]), (dofs, &json!(dofs)));
    assert_eq!(lower["places_cut"], 0);
    assert_eq!(places[0]["pointer"], "/dof_lower_bounds/2");
    assert_eq!(lower["pointer"], places[0]["pointer"]);
    let off: Vec<f64> = places
        .iter()
        .map(|place| place["magnitude"]["value"].as_f64().expect("a number"))
        .collect();
    assert!(off.is_sorted_by(|a, b| a >= b), "{off:?}");
    assert!((off[0] - 100.0).abs() < 1e-9);
    for place in places {
        let dof = place["pointer"].as_str().expect("a pointer").rsplit('/').next();
        let subject = place["subject"].as_str().expect("a name");
        assert!(subject.starts_with(&format!("DOF {} of joint `", dof.expect("an index"))));
        assert!(place["line"].as_u64().is_some());
    }
    let lines = |arguments: &[&str]| {
        let text = stdout(&validate(folder.path(), arguments));
        text.lines().filter(|line| line.contains(" also ")).count()
    };
    let three = lines(&["robot", "--select", "BND"]);
    assert_eq!(lines(&["robot", "--select", "BND", "--max-places", "1"]), 0);
    assert_eq!(lines(&["robot", "--select", "BND", "--max-places", "4"]), three / 2 * 3);
    let log = validate(folder.path(), &["robot", "--select", "BND", "--format", "sarif"]);
    let log: Value = serde_json::from_slice(&log.stdout).expect("JSON");
    let related = log["runs"][0]["results"][0]["relatedLocations"].as_array();
    assert_eq!(related.expect("a list").len(), dofs - 1);
}

#[test]
fn an_unknown_key_is_reported_at_its_own_line() {
    let folder = testkit::temporary::folder();
    let mut toy = Fixture::toy();
    toy.doc_mut("dof_module")["no/key"] = json!(1);
    toy.seal();
    toy.write_to(&folder.path().join("robot"));
    let found = findings(folder.path(), &["robot", "--select", "SCH001"]);
    assert_eq!(found[0]["pointer"], "/no~1key");
    let file = folder.path().join("robot/dof_module/module.json");
    let text = fs::read_to_string(file).expect("a module");
    let line = 1 + text.lines().position(|line| line.contains("no/key")).expect("the key");
    assert_eq!(found[0]["line"], json!(line));
}

#[test]
fn many_urdds_are_summed_up() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    for number in 0..12 {
        let mut toy = Fixture::toy();
        if number % 2 == 0 {
            toy.set("bounds_module", "/dof_lower_bounds/0", json!(-77.0 - f64::from(number)));
        }
        if number % 3 == 0 {
            toy.remove_file("dof_module/module.yaml");
            toy.unlist("dof_module/module.yaml");
        }
        if number == 5 {
            toy.put_file("chain_module/module.json", "{");
        }
        toy.seal();
        toy.write_to(&root.join(format!("robot{number:02}")));
    }
    let output = validate(root, &["."]);
    assert_eq!(output.status.code(), Some(1));
    let text = stdout(&output);
    assert!(text.lines().count() < 45, "{} lines:\n{text}", text.lines().count());
    assert!(text.lines().all(|line| line.chars().count() <= 130), "{text}");
    let row = |name: &str| text.lines().find(|line| line.starts_with(name));
    // What could not be checked is not shown as valid.
    let broken = row("robot05").expect("a row");
    assert!(broken.contains('?') && broken.contains(" ok"), "{broken}");
    let warned = row("robot03").expect("a row");
    assert!(warned.contains("1w"), "{warned}");
    assert_eq!(row("robot01"), None);
    let sound = [1, 7, 11].len();
    assert!(text.contains(&format!("{sound} URDDs more without findings")), "{text}");
    // One cause for all URDDs, and motion before format.
    let cause = text.lines().filter(|line| line.contains("6 times in 6 URDDs")).count();
    assert_eq!(cause, 1, "{text}");
    let motion = text.find("  wrong motion").expect("motion");
    let format = text.find("  format").expect("format");
    assert!(motion < format);
    assert!(text.contains("12 URDDs: "), "the totals");
    let full = stdout(&validate(root, &[".", "--full"]));
    assert!(full.contains("robot01 pass"), "{full}");
}

#[test]
fn a_urdf_by_itself_is_judged_as_a_source() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    let urdf = |links: &str| format!("<robot name=\"r\">{links}</robot>");
    let mass = |mass: f64| {
        format!(
            "<link name=\"a\"><inertial><mass value=\"{mass}\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link>"
        )
    };
    fs::write(root.join("good.urdf"), urdf(&mass(1.0))).expect("written");
    fs::write(root.join("odd.URDF"), urdf(&mass(-1.0))).expect("written");
    fs::write(root.join("two.urdf"), urdf(&(mass(1.0) + "<link name=\"b\"/>"))).expect("written");
    fs::write(root.join("broken.urdf"), "<robot name=\"r\"><link").expect("written");
    let codes = |name: &str| -> Vec<String> {
        let report = report(root, &[name]);
        assert_eq!(report["urdds"][0]["kind"], "urdf");
        let found = report["urdds"][0]["findings"].as_array().expect("a list");
        found.iter().map(|f| f["code"].as_str().expect("a code").to_owned()).collect()
    };
    assert_eq!(codes("good.urdf"), [""; 0]);
    assert_eq!(codes("odd.URDF"), ["SRC003"]);
    assert_eq!(codes("broken.urdf"), ["URD011"]);
    assert_eq!(codes("two.urdf"), ["URD004"]);
    assert!(!codes("two.urdf").is_empty());
    assert_eq!(status(root, &["good.urdf"]), 0);
    assert_eq!(status(root, &["two.urdf"]), 1);
    let text = stdout(&validate(root, &["good.urdf"]));
    assert!(text.contains("urdd generate"), "{text}");
    // Other reports give the file itself as its location.
    let log = validate(root, &["two.urdf", "--format", "github"]);
    assert!(stdout(&log).contains("::error file=two.urdf,line=1"), "{}", stdout(&log));
}

#[test]
fn files_of_other_formats_are_named() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    for (name, text, says) in [
        ("a.sdf", "<", "SDF"),
        ("a.xml", "<mujoco model=\"a\"/>", "MJCF"),
        ("b.xml", "<sdf/>", "SDF"),
        ("a.srdf", "<robot name=\"a\"/>", "SRDF"),
        ("a.usd", "x", "USD"),
        ("a.xacro", "<", "xacro"),
        ("a.txt", "x", "this is a file"),
    ] {
        fs::write(root.join(name), text).expect("written");
        let output = validate(root, &[name]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        let said = stderr(&output);
        assert!(said.contains(says), "{name}: {said}");
    }
}

#[test]
fn folders_are_excluded() {
    let folder = collection();
    let root = folder.path();
    let paths = |arguments: &[&str]| -> Vec<String> {
        let report = report(root, arguments);
        let urdds = report["urdds"].as_array().expect("a list");
        urdds.iter().map(|urdd| urdd["path"].as_str().expect("a path").to_owned()).collect()
    };
    assert_eq!(paths(&[".", "--exclude", "bad"]), ["good", "odd"]);
    assert_eq!(paths(&[".", "--exclude", "b*/", "--exclude", "odd"]), ["good"]);
    fs::create_dir(root.join("old")).expect("a folder");
    copy_folder(&root.join("bad"), &root.join("old/deeper/bad"));
    assert_eq!(paths(&[".", "--exclude", "old"]), ["bad", "good", "odd"]);
    assert_eq!(paths(&[".", "--exclude", "**/bad"]), ["good", "odd"]);
    fs::write(root.join("urdd.toml"), "exclude = [\"old\", \"bad\"]\n").expect("written");
    assert_eq!(paths(&["."]), ["good", "odd"]);
    let output = validate(root, &[".", "--exclude", "*"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("excluded"), "{}", stderr(&output));
    assert_eq!(status(root, &[".", "--exclude", "["]), 2);
}

#[test]
fn an_ignore_without_a_code_is_for_all_rules() {
    let folder = collection();
    let root = folder.path();
    let write = |text: &str| fs::write(root.join("urdd.toml"), text).expect("written");
    write("[[ignore]]\npath = \"bad/**\"\nreason = \"not ours\"\n");
    assert_eq!(status(root, &["bad"]), 0);
    assert_eq!(status(root, &["bad", "odd", "--fail-on", "warning"]), 1);
    write("[[ignore]]\npath = \"bad/**\"\n");
    assert_eq!(status(root, &["bad"]), 2);
    write("[[ignore]]\npath = \"nobody/**\"\nreason = \"x\"\n");
    let text = stdout(&validate(root, &["bad"]));
    assert!(text.contains("ignore of all rules at `nobody/**`"), "{text}");
}

#[test]
fn some_rules_only() {
    let folder = collection();
    let root = folder.path();
    assert_eq!(status(root, &["bad", "--select", "DIR"]), 1);
    assert_eq!(status(root, &["bad", "--select", "DIR020,MSH"]), 1);
    assert_eq!(status(root, &["bad", "--select", "MSH"]), 0);
    assert_eq!(status(root, &["bad", "--ignore", "dir020"]), 0);
    assert_eq!(status(root, &["bad", "--select", "NOPE"]), 2);
    let checks = report(root, &["bad", "--select", "DIR020"]);
    assert_eq!(checks["urdds"][0]["checks"].as_array().expect("a list").len(), 1);
}

#[test]
fn colours_on_request() {
    let folder = collection();
    let run = |arguments: &[&str], variables: &[(&str, &str)]| {
        let mut command = command(folder.path(), arguments);
        for name in ["NO_COLOR", "CLICOLOR_FORCE", "TERM"] {
            command.env_remove(name);
        }
        let output = command.envs(variables.iter().copied()).output();
        stdout(&output.expect("the program")).contains('\u{1b}')
    };
    assert!(!run(&["bad"], &[]));
    assert!(run(&["bad", "--color", "always"], &[("NO_COLOR", "1")]));
    assert!(run(&["bad"], &[("CLICOLOR_FORCE", "1")]));
    assert!(!run(&["bad"], &[("CLICOLOR_FORCE", "0")]));
    assert!(!run(&["bad"], &[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]));
    assert!(!run(&["bad", "--color", "never"], &[("CLICOLOR_FORCE", "1")]));
    assert!(!run(&["bad", "--color", "always", "--format", "json"], &[]));
}

#[test]
fn workflow_commands_hold_no_others() {
    let folder = testkit::temporary::folder();
    let mut toy = Fixture::toy();
    toy.set(ROOT, "/robot_name", json!("a%0A::error::b\n::error::c,d:e"));
    toy.put_file("dof_module/::stop-commands::x", "y");
    toy.seal();
    toy.write_to(&folder.path().join("::add-mask::robot,1"));
    let output = validate(folder.path(), &[".", "--format", "github"]);
    let text = stdout(&output);
    let commands: Vec<&str> =
        text.lines().filter(|line| line.trim_start().starts_with("::")).collect();
    assert!(commands.len() >= 2, "{text}");
    for command in &commands {
        let known = ["::error file=", "::warning file=", "::notice file="];
        assert!(known.iter().any(|start| command.starts_with(start)), "{command}");
        let properties = command.split("::").nth(1).expect("properties");
        assert!(properties.contains("%3A%3Aadd-mask%3A%3Arobot%2C1"), "{command}");
    }
    let unescaped = |command: &&str| command.contains("a%0A");
    assert!(!commands.iter().any(unescaped), "a percent sign is escaped");
    // Nor does the human-readable report, which is printed in workflows too.
    let text = stdout(&validate(folder.path(), &["."]));
    assert!(!text.lines().any(|line| line.trim_start().starts_with("::")), "{text}");
}

#[test]
fn explanations_as_json_and_completions() {
    let folder = testkit::temporary::folder();
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        let output = command.args(arguments).current_dir(folder.path()).output();
        output.expect("the program")
    };
    let explained = |arguments: &[&str]| -> Value {
        let output = run(&[&["explain", "--format", "json"], arguments].concat());
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    assert_eq!(explained(&["DOF003"])["name"], "dof-mappings-disagree");
    let family = explained(&["DOF"]);
    let family = family.as_array().expect("a list");
    assert!(family.len() > 5 && family.iter().all(|rule| rule["consequence"] == "wrong-motion"));
    let all = explained(&[]);
    let all = all.as_array().expect("a list");
    assert!(all.len() > 100);
    for rule in all {
        let (code, of) = (&rule["code"], &rule["family"]);
        let letters = of["code"].as_str().expect("a family");
        assert!(code.as_str().is_some_and(|code| code.starts_with(letters)), "{code}: {of}");
        for key in ["name", "about"] {
            assert!(of[key].as_str().is_some_and(|text| !text.is_empty()), "{code}: {of}");
        }
    }
    for shell in ["bash", "zsh", "fish"] {
        let script = stdout(&run(&["completions", shell]));
        assert!(script.contains("max-places"), "{shell}");
    }
}

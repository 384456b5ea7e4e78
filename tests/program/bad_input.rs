//! Whatever a folder contains, the program reports what is wrong with it: a finding or one clear error, the right exit
//! status, no panic, and soon.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use testkit::fixture::{Fixture, ROOT, URDF};

const SOON: Duration = Duration::from_secs(60);

struct Outcome {
    status: i32,
    stdout: String,
    stderr: String,
}

impl Outcome {
    /// Codes of all findings.
    fn codes(&self) -> Vec<String> {
        let report: Value = serde_json::from_str(&self.stdout).expect("a JSON report");
        let findings = report["urdds"][0]["findings"].as_array();
        let code = |finding: &Value| finding["code"].as_str().unwrap_or_default().to_owned();
        findings.into_iter().flatten().map(code).collect()
    }
}

/// Runs `urdd validate --format json PATH`.
fn validate(path: &Path) -> Outcome {
    let started = Instant::now();
    // Into files: a pipe that nobody reads would block the program.
    let folder = testkit::temporary::folder();
    let (out, err) = (folder.path().join("out"), folder.path().join("err"));
    let mut child = Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(["validate", "--format", "json"])
        .arg(path)
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .stdout(fs::File::create(&out).expect("a file"))
        .stderr(fs::File::create(&err).expect("a file"))
        .spawn()
        .expect("the program");
    let status = loop {
        if let Some(status) = child.try_wait().expect("a status") {
            break status;
        }
        if started.elapsed() > SOON {
            child.kill().expect("killed");
            panic!("{}: still running after {SOON:?}", path.display());
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    let stderr = fs::read_to_string(&err).expect("text");
    assert!(!stderr.contains("panicked"), "{stderr}");
    Outcome {
        status: status.code().expect("an exit status, not a signal"),
        stdout: fs::read_to_string(&out).expect("text"),
        stderr,
    }
}

/// The outcome of a folder `robot` that `write` fills.
fn examine(write: impl FnOnce(&Path)) -> Outcome {
    let folder = testkit::temporary::folder();
    let root = folder.path().join("robot");
    fs::create_dir(&root).expect("a folder");
    write(&root);
    validate(&root)
}

/// The outcome of the toy, changed on disk.
fn examine_toy(change: impl FnOnce(&Path)) -> Outcome {
    examine(|root| {
        let mut toy = Fixture::toy();
        toy.seal();
        toy.write_to(root);
        change(root);
    })
}

/// The findings have these codes, all of them and no others.
fn assert_findings(outcome: &Outcome, codes: &[&str]) {
    assert_eq!(outcome.codes(), codes, "{}", outcome.stderr);
    assert_eq!(outcome.status, 1);
    assert_eq!(outcome.stderr, "");
}

/// There is nothing to examine, and one line says so.
fn assert_refused(outcome: &Outcome, part: &str) {
    assert_eq!(outcome.status, 2, "{}", outcome.stdout);
    assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    assert!(outcome.stderr.contains(part), "{}", outcome.stderr);
    // Where JSON is asked for, that line is JSON too.
    let json: serde_json::Value = serde_json::from_str(&outcome.stdout).expect("JSON");
    let message = json["error"]["message"].as_str().expect("a message");
    assert_eq!(outcome.stderr, format!("urdd: {message}\n"));
}

fn module(root: &Path, name: &str) -> PathBuf {
    let folder = root.join(name);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
fn nothing_to_examine() {
    assert_refused(&examine(|_| {}), "no URDD here");
    assert_refused(
        &examine(|root| fs::create_dir_all(root.join("a/b/c")).expect("folders")),
        "no URDD here",
    );
    let folder = testkit::temporary::folder();
    let file = folder.path().join("urdd.json");
    fs::write(&file, "{}").expect("written");
    assert_refused(&validate(&file), "not a single file");
    assert_refused(&validate(&folder.path().join("nowhere")), "no such");
}

#[cfg(unix)]
#[test]
fn a_folder_that_may_not_be_read() {
    use std::os::unix::fs::PermissionsExt;
    let folder = testkit::temporary::folder();
    let closed = folder.path().join("closed");
    fs::create_dir(&closed).expect("a folder");
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o000)).expect("closed");
    // Root can read the folder, and finds nothing in it.
    let part = match fs::read_dir(&closed) {
        Ok(_) => "no URDD here",
        Err(_) => "cannot be listed",
    };
    assert_refused(&validate(&closed), part);

    let outcome = examine_toy(|root| {
        let file = root.join("dof_module/module.json");
        fs::set_permissions(&file, fs::Permissions::from_mode(0o000)).expect("closed");
        if fs::read(&file).is_ok() {
            // For root, reading fails in another way.
            fs::remove_file(&file).expect("removed");
            fs::create_dir(&file).expect("a folder");
        }
    });
    assert_findings(&outcome, &["DIR023"]);
}

/// Runs the program as a user who may not read everything: if this is root, with another user id.
#[cfg(unix)]
fn as_plain_user(command: &mut Command) -> &mut Command {
    use std::os::unix::process::CommandExt;
    let closed = testkit::temporary::folder();
    let may_read_all = {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(closed.path(), fs::Permissions::from_mode(0o000)).expect("closed");
        fs::read_dir(closed.path()).is_ok()
    };
    if may_read_all { command.uid(65534).gid(65534) } else { command }
}

/// A folder among URDDs that cannot be listed may contain URDDs: skipping it would make a pass meaningless.
#[cfg(unix)]
#[test]
fn a_closed_folder_among_urdds() {
    use std::os::unix::fs::PermissionsExt;
    let folder = testkit::temporary::folder();
    let program = folder.path().join("urdd");
    fs::copy(env!("CARGO_BIN_EXE_urdd"), &program).expect("a copy that anyone can run");
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755)).expect("open");
    let robots = folder.path().join("robots");
    let mut toy = Fixture::toy();
    toy.seal();
    toy.write_to(&robots.join("toy"));
    let closed = robots.join("vendor/closed");
    fs::create_dir_all(&closed).expect("a folder");
    let run = || {
        as_plain_user(Command::new(&program).arg("validate").arg(&robots))
            .output()
            .expect("the program")
    };
    let before = run();
    assert_eq!(before.status.code(), Some(0), "{}", String::from_utf8_lossy(&before.stderr));
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o000)).expect("closed");
    let output = run();
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o755)).expect("open");
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        text.contains("vendor/closed NOT EXAMINED") && text.contains("permission denied"),
        "{text}"
    );
}

#[test]
fn a_folder_too_deep_to_search() {
    let outcome = examine(|root| {
        fs::create_dir_all(root.join("a/".repeat(40))).expect("folders");
    });
    assert_eq!(outcome.status, 2);
    assert!(outcome.stdout.contains("deeper than 32"), "{}", outcome.stdout);
}

#[test]
fn a_version_alone() {
    let outcome = examine(|root| {
        fs::write(module(root, "dof_module").join("VERSION"), "0.0.2").expect("written");
    });
    assert!(outcome.codes().contains(&"DIR004".to_owned()));
    assert_eq!(outcome.status, 1);
}

#[test]
fn truncated_json() {
    let outcome = examine_toy(|root| {
        let file = root.join("kinematics_samples_module/module.json");
        let bytes = fs::read(&file).expect("read");
        fs::write(&file, &bytes[..bytes.len() / 3]).expect("written");
    });
    assert_findings(&outcome, &["DIR014", "JSN001"]);
}

#[test]
fn nesting_ten_thousand_deep() {
    let deep = "[".repeat(10_000) + &"]".repeat(10_000);
    for (file, code) in [("module.json", "JSN006"), ("module.yaml", "YML008")] {
        let deep = deep.clone();
        let outcome = examine_toy(move |root| {
            let file = root.join("kinematics_samples_module").join(file);
            fs::write(file, format!("{{\"samples\": {deep}}}")).expect("written");
        });
        assert_findings(&outcome, &["DIR014", code]);
    }
}

#[test]
fn a_bomb_of_aliases() {
    let mut bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n".to_owned();
    for i in 1..40 {
        let alias = format!("*a{}, ", i - 1).repeat(10);
        bomb += &format!("a{i}: &a{i} [{}]\n", alias.trim_end_matches(", "));
    }
    let outcome = examine_toy(|root| {
        fs::write(root.join("dof_module/module.yaml"), bomb).expect("written");
    });
    let codes = outcome.codes();
    assert!(codes.contains(&"YML003".to_owned()), "{codes:?}");
    assert_eq!(outcome.status, 1);
}

#[test]
fn a_file_that_claims_four_gibibytes() {
    let claim = |size: u64| {
        examine(move |root| {
            let mut toy = Fixture::toy();
            toy.seal();
            toy.set(ROOT, "/modules/0/files/1/size", json!(size));
            toy.keep_hashes();
            toy.seal();
            toy.write_to(root);
        })
    };
    assert_findings(&claim(u64::from(u32::MAX)), &["DIR014"]);
    assert_findings(&claim(1 << 32), &["SCH001"]);
}

#[test]
fn files_of_a_tebibyte_are_not_read() {
    for file in ["module.json", "module.yaml"] {
        let outcome = examine_toy(|root| {
            let file = root.join("kinematics_samples_module").join(file);
            let file = fs::OpenOptions::new().write(true).open(file).expect("open");
            // If the file system does not allow files of that size, one just beyond the limit is used.
            file.set_len(1 << 40).or_else(|_| file.set_len(1 << 33)).expect("a sparse file");
        });
        assert_findings(&outcome, &["DIR014", "DIR023"]);
    }
    let outcome = examine_toy(|root| {
        let file = fs::OpenOptions::new().write(true).open(root.join(URDF));
        file.expect("open").set_len(1 << 33).expect("a sparse file");
    });
    assert_eq!(outcome.codes()[0], "DIR014");
}

#[test]
fn a_folder_in_place_of_a_document() {
    let outcome = examine(|root| {
        fs::create_dir(module(root, "dof_module").join("module.json")).expect("a folder");
    });
    assert!(outcome.codes().contains(&"DIR023".to_owned()));
    assert_eq!(outcome.status, 1);
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::ffi::OsStrExt;
    use std::os::unix::fs::symlink;

    #[test]
    fn links_in_a_circle() {
        let outcome = examine_toy(|root| {
            let file = root.join("kinematics_samples_module/module.json");
            fs::remove_file(&file).expect("removed");
            symlink("module.json", &file).expect("a link");
            symlink("..", root.join("dof_module/up")).expect("a link");
        });
        let codes = outcome.codes();
        assert!(codes.iter().any(|code| code == "DIR004" || code == "DIR023"), "{codes:?}");
        assert_eq!(outcome.status, 1);

        // A collection whose folders link back to it.
        let outcome = examine(|root| {
            fs::create_dir(root.join("a")).expect("a folder");
            symlink("..", root.join("a/back")).expect("a link");
        });
        assert_refused(&outcome, "no URDD here");
        // The path itself.
        let folder = testkit::temporary::folder();
        let link = folder.path().join("loop");
        symlink("loop", &link).expect("a link");
        let outcome = validate(&link);
        assert_eq!(outcome.status, 2);
    }

    #[test]
    fn a_link_out_of_the_root_is_not_followed() {
        let secret = "sesame-7431";
        let outcome = examine_toy(|root| {
            let outside = root.parent().expect("a parent").join("secret.json");
            fs::write(&outside, format!("{{\"{secret}\": \"{secret}\"}}")).expect("written");
            let file = root.join("kinematics_samples_module/module.json");
            fs::remove_file(&file).expect("removed");
            symlink(&outside, &file).expect("a link");
        });
        assert_findings(&outcome, &["DIR016"]);
        assert!(!outcome.stdout.contains(secret));
    }

    #[test]
    fn a_pipe_does_not_hang() {
        for file in [
            "kinematics_samples_module/module.json",
            "dof_module/module.yaml",
            "dof_module/VERSION",
            URDF,
            ROOT,
        ] {
            let outcome = examine_toy(|root| {
                let path = root.join(file);
                fs::remove_file(&path).expect("removed");
                let made = Command::new("mkfifo").arg(&path).status().expect("mkfifo");
                assert!(made.success());
            });
            let codes = outcome.codes();
            assert!(codes.contains(&"DIR023".to_owned()), "{file}: {codes:?}");
            assert_eq!(outcome.status, 1);
        }
    }

    #[test]
    fn names_that_are_not_utf8() {
        let odd = std::ffi::OsStr::from_bytes(b"ger\xE4t");
        let outcome = examine_toy(|root| {
            fs::write(root.join(odd), "hello").expect("written");
        });
        assert_eq!((outcome.status, outcome.codes().len()), (0, 0));
        let outcome = examine_toy(|root| {
            fs::write(root.join("dof_module").join(odd), "hello").expect("written");
        });
        assert_findings(&outcome, &["DIR024"]);
        // The root itself.
        let folder = testkit::temporary::folder();
        let root = folder.path().join(odd);
        Fixture::toy().write_to(&root);
        assert_eq!(validate(&root).status, 0);
    }
}

#[test]
fn odd_robot_names() {
    for name in ["a/b", "../../etc/passwd", ".", "a b\u{1F916}ü", "C:\\robot", "-rf"] {
        let outcome = examine(|root| {
            let mut toy = Fixture::toy();
            toy.set(ROOT, "/robot_name", json!(name));
            toy.set("urdf_module", "/name", json!(name));
            toy.urdf_replace("name=\"toy robot\"", &format!("name=\"{name}\""));
            toy.seal();
            toy.write_to(root);
        });
        assert_eq!(outcome.codes(), [""; 0], "{name:?}");
        assert_eq!(outcome.status, 0, "{name:?}");
    }
}

#[test]
fn hostile_schemas_of_extensions() {
    let mut definitions = serde_json::Map::new();
    for i in 0..60 {
        let next = json!({"$ref": format!("#/$defs/a{}", i + 1)});
        definitions.insert(format!("a{i}"), json!({"anyOf": [next, next]}));
    }
    definitions.insert("a60".to_owned(), json!(false));
    let mut chain = serde_json::Map::new();
    for i in 0..15_000 {
        let next = json!({"$ref": format!("#/$defs/a{}", i + 1)});
        chain.insert(format!("a{i}"), next);
    }
    chain.insert("a15000".to_owned(), json!(true));
    for schema in [
        json!({"$defs": definitions, "$ref": "#/$defs/a0"}),
        json!({"$defs": chain, "$ref": "#/$defs/a0"}),
        json!({"pattern": "((((a{100}){100}){100}){100})"}),
        json!({"$ref": "file:///etc/passwd"}),
    ] {
        let outcome = examine(|root| {
            let mut toy = Fixture::toy();
            let folder = "x_acme_gripper_module";
            toy.put_file(&format!("{folder}/schema.json"), schema.to_string());
            toy.add_module(folder, json!("a"));
            toy.seal();
            toy.write_to(root);
        });
        assert_findings(&outcome, &["EXT001"]);
    }
}

/// Annotations of extensions that would take time, memory or the stack of a validator.
#[test]
fn hostile_annotations_of_extensions() {
    let is_link = json!({"x-index": "link"});
    let mut deep = json!([]);
    for _ in 0..90 {
        deep = json!([deep]);
    }
    let words = vec!["link"; 100_000].join(" or ");
    let many = json!(
        (0..2000).map(|i| (format!("a{i}"), is_link.clone())).collect::<serde_json::Map<_, _>>()
    );
    let cases = [
        // Very many wrong indices: one is named.
        (json!({"items": is_link}), json!(vec![4_000_000_000_u32; 200_000]), "EXT003"),
        (json!({"x-length": "links"}), json!(vec![0; 200_000]), "EXT004"),
        // Every level of lists has the wrong length.
        (json!({"x-length": "links", "items": {"$ref": "#"}}), deep.clone(), "EXT004"),
        (json!({"$ref": "#", "x-index": "link"}), json!(1e300), "EXT003"),
        (json!({"x-index": words}), json!(-1), "EXT003"),
        (
            json!({"$dynamicAnchor": "a", "items": {"$dynamicRef": "#a"}, "x-index": "link"}),
            json!([[[-1]]]),
            "EXT003",
        ),
        (json!({"unevaluatedProperties": is_link}), json!({"a": -1}), "EXT003"),
        (json!({"contains": is_link}), json!([-1]), "EXT003"),
        (
            json!({"dependentSchemas": {"a": {"properties": {"b": is_link}}}}),
            json!({"a": 0, "b": -1}),
            "EXT003",
        ),
        (json!({"properties": many}), json!({"a7": -1, "a1999": 0}), "EXT003"),
        (json!({"x-unit": "m*".repeat(400_000)}), json!(1), "EXT001"),
        (json!({"x-frame": {"deep": deep}}), json!(1), "EXT001"),
    ];
    for (schema, document, code) in cases {
        let outcome = examine(|root| {
            let mut toy = Fixture::toy();
            let folder = "x_acme_gripper_module";
            toy.put_file(&format!("{folder}/schema.json"), schema.to_string());
            toy.add_module(folder, document.clone());
            toy.seal();
            toy.write_to(root);
        });
        let mut codes = outcome.codes();
        codes.dedup();
        assert_eq!(codes, [code], "{}", outcome.stderr);
        assert_eq!((outcome.status, outcome.stderr.as_str()), (1, ""));
    }
}

/// `rehash` does not vouch for documents: one that it updates may still be broken.
#[test]
fn rehash_says_which_document_is_broken() {
    let folder = testkit::temporary::folder();
    let root = folder.path().join("toy");
    let mut toy = Fixture::toy();
    toy.seal();
    toy.write_to(&root);
    let rehash = || {
        let program = env!("CARGO_BIN_EXE_urdd");
        let output = Command::new(program).arg("rehash").arg(&root).output();
        let output = output.unwrap();
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), words)
    };
    assert_eq!(rehash(), (Some(0), String::new()));
    let file = root.join("link_shapes_modules/link_shapes_skips_module/module.json");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replacen("\"edits\":", "\"edit\":", 1)).unwrap();
    for _ in 0..2 {
        let (status, words) = rehash();
        assert_eq!(status, Some(1));
        let place = "toy/link_shapes_modules/link_shapes_skips_module/module.json:";
        assert!(words.contains(place), "{words}");
    }
    fs::write(&file, text.replacen('{', "{,", 1)).unwrap();
    let (status, words) = rehash();
    assert_eq!(status, Some(1));
    assert!(words.contains("module.json:1:2: not JSON"), "{words}");
}

/// A folder for a URDD that is still being written is not a URDD, under a name of this version or of 0.1.0.
#[test]
fn staging_folders_are_not_examined() {
    let folder = testkit::temporary::folder();
    let mut toy = Fixture::toy();
    toy.seal();
    for name in ["toy", ".urdd-0123456789abcdef/new", ".toy.urdd-4711-0/new"] {
        toy.write_to(&folder.path().join(name));
    }
    let outcome = validate(folder.path());
    let report: Value = serde_json::from_str(&outcome.stdout).unwrap();
    let names: Vec<&str> = report["urdds"]
        .as_array()
        .unwrap()
        .iter()
        .map(|urdd| urdd["path"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["toy"]);
}

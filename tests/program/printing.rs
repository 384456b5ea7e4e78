//! What reaches standard output and standard error: nothing that a terminal would act upon, whatever a file contains or
//! is named. A report that cannot be written is an error.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};
use testkit::fixture::{Fixture, ROOT, URDF};
use testkit::trials::trials;
use urdd_format::escape;

/// The content of a hostile name: it clears the screen, colours, reverses and hides text, and adds a line.
const HOSTILE: &str = "a\u{1b}[2J\u{1b}[32m\u{9b}2J\u{202e}\u{2066}\u{200b}\u{feff}\u{2028}\u{85}\u{7f}\u{8}\u{e0041}\r\nFORGED pass";
/// The same without what file names and arguments cannot contain, and without what XML cannot.
const HOSTILE_IN_XML: &str = "a\u{9b}2J\u{202e}\u{2066}\u{200b}\u{2028}\u{85}&#10;FORGED pass";

fn urdd(folder: &Path, arguments: &[&str]) -> Output {
    crate::program::output(arguments, folder)
}

/// Whether a terminal would act upon a character, or show nothing: by Unicode's own lists, not by the code under test.
pub(crate) fn acts(c: char) -> bool {
    matches!(c,
        '\0'..='\u{9}' | '\u{b}'..='\u{1f}' | '\u{7f}'..='\u{9f}' | '\u{ad}' | '\u{61c}'
        | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}'
        | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

/// Runs the program, and checks its output against the rule.
fn clean(folder: &Path, arguments: &[&str]) -> String {
    let output = urdd(folder, arguments);
    let mut all = String::new();
    for stream in [&output.stdout, &output.stderr] {
        let text = String::from_utf8(stream.clone()).expect("UTF-8");
        let found: Vec<char> = text.chars().filter(|c| acts(*c)).collect();
        assert!(found.is_empty(), "{arguments:?} printed {found:?}: {text:?}");
        let forged = text.lines().find(|line| line.starts_with("FORGED"));
        assert_eq!(forged, None, "{arguments:?} printed a line of a name's own");
        all += &text;
    }
    all
}

/// The JSON Pointers of the strings of a document.
fn strings(value: &Value, at: String, out: &mut Vec<String>) {
    match value {
        Value::String(_) => out.push(at),
        Value::Array(list) => {
            // The first two: the others are read in the same way.
            for (index, value) in list.iter().enumerate().take(2) {
                strings(value, format!("{at}/{index}"), out);
            }
        }
        Value::Object(map) => {
            for (key, value) in map {
                let key = key.replace('~', "~0").replace('/', "~1");
                strings(value, format!("{at}/{key}"), out);
            }
        }
        _ => {}
    }
}

/// URDDs with hostile words in every field, key and file.
fn hostile_urdds(folder: &Path) -> usize {
    let toy = Fixture::toy();
    let mut number = 0;
    let mut write = |change: &dyn Fn(&mut Fixture), seal: bool| {
        let mut urdd = toy.clone();
        change(&mut urdd);
        if seal {
            urdd.seal();
        }
        urdd.write_to(&folder.join(format!("{number}")));
        number += 1;
    };
    let names: Vec<String> = toy.documents.keys().cloned().collect();
    for name in &names {
        let mut pointers = Vec::new();
        strings(&toy.documents[name], String::new(), &mut pointers);
        // All at once, and each kind of field alone: a document that does not match its schema is not read further.
        let mut kinds = std::collections::BTreeSet::new();
        for pointer in &pointers {
            let kind: String =
                pointer.split('/').filter(|part| part.parse::<usize>().is_err()).collect();
            if kinds.insert(kind) && (kinds.len() % 3 == 1 || trials(1) > 1) {
                write(&|f| f.set(name, pointer, json!(HOSTILE)), name != ROOT);
            }
        }
        write(&|f| f.doc_mut(name)[HOSTILE] = json!(HOSTILE), true);
    }
    write(&|f| f.put_file("dof_module/module.json", format!("{{\"{HOSTILE}\"")), false);
    write(&|f| f.put_file("dof_module/module.yaml", format!("{HOSTILE}: [&x !y")), false);
    write(&|f| f.put_file("dof_module/VERSION", HOSTILE), false);
    write(&|f| f.put_file(URDF, format!("<{HOSTILE}")), false);
    write(
        &|f| {
            f.urdf_mut(|text| *text = text.replace("name=\"", &format!("name=\"{HOSTILE_IN_XML}")))
        },
        true,
    );
    // glTF: a version that is text.
    let glb = toy.files.keys().find(|path| path.ends_with(".glb")).expect("a .glb").clone();
    let mut json = format!("{{\"asset\":{{\"version\":{}}}}}", json!(HOSTILE)).into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((20 + json.len() as u32).to_le_bytes());
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    write(&|f| f.put_file(&glb, bytes.clone()), true);
    // Names of files and folders, and targets of links.
    let odd = folder.join("0");
    fs::write(odd.join(HOSTILE), "x").expect("written");
    fs::create_dir(odd.join(format!("x_{}_module", HOSTILE))).expect("a folder");
    symlink(format!("/{HOSTILE}"), odd.join("link")).expect("a link");
    let mut last = toy.clone();
    last.put_file("stray", "x");
    last.write_to(&folder.join(HOSTILE).join(HOSTILE));
    number + 1
}

#[test]
fn nothing_that_a_terminal_would_act_upon() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    let urdds = hostile_urdds(root);
    assert!(urdds > 40, "{urdds}");
    clean(root, &["info", "."]);
    clean(root, &["info", ".", "--format", "json"]);
    clean(root, &["rehash", "."]);
    // Every format, in one run.
    let files = ["--output", "a.sarif", "--output", "a.xml", "--output", "a"];
    let text = clean(root, &[&["validate", ".", "--full"] as &[&str], &files].concat());
    assert!(text.contains("FORGED"), "the names are shown");
    for file in ["a.sarif", "a.xml", "a"] {
        let text = fs::read_to_string(root.join(file)).expect("a report");
        assert!(!text.contains(|c| c != '\n' && acts(c)), "{file}");
        assert!(text.contains("FORGED"), "{file}: the names are there");
        assert!(!text.lines().any(|line| line.starts_with("FORGED")), "{file}");
    }
    // JSON contains the names unchanged.
    let report = fs::read_to_string(root.join("a")).expect("a report");
    let report: Value = serde_json::from_str(&report).expect("JSON");
    let paths = report["urdds"].as_array().expect("a list").iter();
    let hostile = format!("{HOSTILE}/{HOSTILE}");
    assert!(paths.map(|urdd| &urdd["path"]).any(|path| *path == json!(hostile)));
}

#[test]
fn nothing_from_the_command_line_or_the_settings() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    let mut toy = Fixture::toy();
    toy.seal();
    toy.write_to(&root.join("good"));
    let pattern = HOSTILE.escape_unicode().to_string().replace("\\u{", "\\U");
    assert!(pattern.contains('\\'));
    for command in ["validate", "info", "rehash", "explain", "schema"] {
        clean(root, &[command, HOSTILE]);
        clean(root, &[command, &format!("--{HOSTILE}")]);
    }
    clean(root, &[HOSTILE]);
    clean(root, &["validate", "good", "--class", HOSTILE]);
    clean(root, &["validate", "good", "--config", HOSTILE]);
    let nowhere = format!("{HOSTILE}/x.json");
    clean(root, &["validate", "good", "--output", &nowhere]);
    clean(root, &["generate", HOSTILE, "-o", "out"]);
    clean(root, &["generate", "good", "-o", "out", "--modules", HOSTILE]);
    clean(root, &["generate", "good", "-o", "out", "--package", HOSTILE]);
    let quoted = json!(HOSTILE).to_string().replace("\\b", "\\u0008");
    for settings in [
        format!("class = {quoted}"),
        format!("fail-on = {quoted}"),
        format!("{quoted} = 1"),
        format!("[severity]\n{quoted} = \"info\""),
        format!("[[ignore]]\ncode = {quoted}\npath = \"**\"\nreason = \"x\""),
        format!("[[ignore]]\ncode = \"DIR020\"\npath = {quoted}\nreason = \"x\""),
        HOSTILE.to_owned(),
    ] {
        fs::write(root.join("urdd.toml"), &settings).expect("written");
        clean(root, &["validate", "good"]);
    }
}

#[test]
fn nothing_from_a_urdf() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    let name = HOSTILE_IN_XML;
    let link = format!(
        "<link name=\"{name}\"><visual><geometry><mesh filename=\"{name}.stl\"/></geometry></visual></link>"
    );
    let joint = format!(
        "<joint name=\"{name}\" type=\"{name}\"><parent link=\"{name}\"/><child link=\"b\"/></joint>"
    );
    for (file, text) in [
        ("a.urdf", format!("<robot name=\"{name}\">{link}</robot>")),
        ("b.urdf", format!("<robot name=\"{name}\">{link}<link name=\"b\"/>{joint}</robot>")),
        ("c.urdf", format!("<robot name=\"{name}\">{link}{link}</robot>")),
        ("d.urdf", format!("<{HOSTILE}")),
        (
            "e.urdf",
            format!(
                "<robot name=\"e\"><link name=\"e\"><inertial><mass value=\"{name}\"/></inertial></link></robot>"
            ),
        ),
    ] {
        fs::write(root.join(file), text).expect("written");
        for format in ["human", "json"] {
            clean(root, &["generate", file, "-o", "out", "--format", format]);
        }
    }
    fs::create_dir(root.join("many")).expect("a folder");
    fs::copy(root.join("a.urdf"), root.join("many").join(HOSTILE)).expect("a copy");
    let path = format!("{HOSTILE}.urdf");
    fs::copy(root.join("a.urdf"), root.join("many").join(&path)).expect("a copy");
    fs::copy(root.join("b.urdf"), root.join("many/b.urdf")).expect("a copy");
    for format in ["human", "json"] {
        clean(root, &["generate", "many", "-o", "made", "--format", format]);
    }
    clean(root, &["validate", "made"]);
    clean(root, &["generate", "a.urdf", "-o", HOSTILE]);
}

/// A folder with a valid URDD.
fn good() -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    let mut toy = Fixture::toy();
    toy.seal();
    toy.write_to(&folder.path().join("good"));
    folder
}

const PRINTING: &[&[&str]] = &[
    &["validate", "good"],
    &["validate", "good", "--format", "json"],
    &["validate", "good", "--format", "sarif"],
    &["validate", "good", "--format", "junit"],
    &["info", "good"],
    &["info", "good", "--format", "json"],
    &["diff", "good", "good"],
    &["diff", "robot.urdf", "robot.urdf", "--format", "markdown"],
    &["rehash", "good"],
    &["explain"],
    &["explain", "DOF003"],
    &["schema", "list"],
    &["schema", "show", "dof_module@1.0.0"],
    &["generate", "robot.urdf", "-o", "out"],
    &["generate", "robot.urdf", "-o", "out", "--format", "json"],
    &["--help"],
    &["--version"],
];

/// A folder with work for each of these.
fn with_robot() -> tempfile::TempDir {
    let folder = good();
    let robot = "<robot name=\"r\"><link name=\"a\"/></robot>";
    fs::write(folder.path().join("robot.urdf"), robot).expect("written");
    folder
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_an_error() {
    let folder = with_robot();
    for arguments in PRINTING {
        let full = fs::File::create("/dev/full").expect("/dev/full");
        let output = Command::new(env!("CARGO_BIN_EXE_urdd"))
            .args(*arguments)
            .current_dir(folder.path())
            .stdout(full)
            .output()
            .expect("the program");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(
            said.contains("standard output cannot be written: no space left"),
            "{arguments:?}: {said}"
        );
    }
}

#[test]
fn a_closed_standard_output_is_an_error() {
    let folder = with_robot();
    for arguments in PRINTING {
        let output = Command::new("sh")
            .args(["-c", "exec \"$0\" \"$@\" >&-", env!("CARGO_BIN_EXE_urdd")])
            .args(*arguments)
            .current_dir(folder.path())
            .output()
            .expect("the program");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains("it is closed"), "{arguments:?}: {said}");
    }
    // Dropped on purpose, without closing.
    for arguments in [&["validate", "good"] as &[&str], &["explain"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        command.args(arguments).current_dir(folder.path());
        let status = command.stdout(Stdio::null()).status();
        assert_eq!(status.expect("the program").code(), Some(0));
    }
}

#[test]
fn a_pipe_that_is_closed_is_none() {
    let folder = with_robot();
    for arguments in PRINTING {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let output = Command::new(env!("CARGO_BIN_EXE_urdd"))
            .args(*arguments)
            .current_dir(folder.path())
            .stdout(writer)
            .output()
            .expect("the program");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
        assert_eq!(said, "", "{arguments:?}");
    }
}

#[test]
fn a_report_file_is_whole_or_what_it_was() {
    use std::os::unix::fs::PermissionsExt;
    let folder = good();
    let root = folder.path();
    fs::write(root.join("kept.json"), "what was there").expect("written");
    // Files may grow to 512 bytes at most.
    let limited = "trap '' XFSZ; ulimit -f 1; exec \"$0\" validate good --output kept.json";
    let output = Command::new("sh")
        .args(["-c", limited, env!("CARGO_BIN_EXE_urdd")])
        .current_dir(root)
        .output()
        .expect("the program");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("kept.json: cannot be written"), "{said}");
    // The human-readable report is still there.
    assert!(String::from_utf8_lossy(&output.stdout).contains("good pass"));
    let names = || {
        let entries = fs::read_dir(root).expect("a folder");
        let mut names: Vec<String> = entries
            .map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8"))
            .collect();
        names.sort();
        names
    };
    assert_eq!(names(), ["good", "kept.json"]);
    let text = fs::read_to_string(root.join("kept.json")).expect("a file");
    assert_eq!(text, "what was there");
    // If there is room, it is replaced; its permissions are kept, and a link remains a link.
    fs::set_permissions(root.join("kept.json"), fs::Permissions::from_mode(0o640)).expect("set");
    symlink("kept.json", root.join("link.json")).expect("a link");
    assert_eq!(urdd(root, &["validate", "good", "--output", "link.json"]).status.code(), Some(0));
    assert!(fs::symlink_metadata(root.join("link.json")).expect("a link").is_symlink());
    let metadata = fs::metadata(root.join("kept.json")).expect("a file");
    assert_eq!(metadata.permissions().mode() & 0o777, 0o640);
    let report = fs::read(root.join("kept.json")).expect("a file");
    serde_json::from_slice::<Value>(&report).expect("JSON");
    // A device is written to, not replaced.
    let output = urdd(root, &["validate", "good", "--quiet", "--output", "/dev/stderr"]);
    serde_json::from_slice::<Value>(&output.stderr).expect("JSON");
}

#[test]
fn no_report_makes_a_folder_a_urdd() {
    let folder = good();
    let root = folder.path();
    fs::create_dir(root.join("reports")).expect("a folder");
    for name in ["urdd.json", "reports/urdd.json", "reports/URDD.Json", "./urdd.json"] {
        let output = urdd(root, &["validate", "good", "--output", name]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{name}: {said}");
        assert!(said.contains("urdd-report.json"), "{name}: {said}");
        assert!(!root.join(name).exists());
    }
    assert_eq!(urdd(root, &["validate", "."]).status.code(), Some(0));
}

/// A command that a message suggests is one that a shell takes for what it says, whatever a file or a package is called.
#[test]
fn suggested_commands_are_quoted_for_a_shell() {
    // What a terminal would act upon is printed as its escape, so that no shell gets it.
    let texts = crate::export::texts::texts().into_iter();
    let texts: Vec<String> = texts.filter(|text| escape::line(text) == text.as_str()).collect();
    assert!(texts.len() > 40);
    let words = texts.iter().map(|text| format!("printf '%s\\0' {}\n", escape::shell(text)));
    let output = Command::new("sh").args(["-c", &words.collect::<String>()]).output();
    let output = output.expect("a shell").stdout;
    let found: Vec<&[u8]> = output.split(|byte| *byte == 0).collect();
    assert_eq!(found.len(), texts.len() + 1);
    for (found, text) in found.iter().zip(&texts) {
        assert_eq!(String::from_utf8_lossy(found), *text);
    }
    for text in ["a", "é.urdf", "../a_b-c/d.e", "C:/x"] {
        assert_eq!(escape::shell(text), text);
    }
    let folder = testkit::temporary::folder();
    let file = "a `id` $(id) b's.urdf";
    let robot = "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"package://$(id)/x.stl\"/></geometry></visual></link></robot>";
    fs::write(folder.path().join(file), robot).expect("written");
    let said = clean(folder.path(), &["export", "srdf", file, "-o", "-"]);
    assert!(said.contains("urdd generate 'a `id` $(id) b'\\''s.urdf' -o DIR"), "{said}");
    let said = clean(folder.path(), &["generate", file, "-o", "out"]);
    assert!(said.contains("--package '$(id)'=FOLDER"), "{said}");
}

/// A runner of GitHub Actions takes `::` at the beginning of a line for a command, and `##[` anywhere.
#[test]
fn nothing_printed_is_a_workflow_command() {
    let folder = testkit::temporary::folder();
    let link = "<link name=\"##[error]x\"/>";
    let robot = format!("<robot name=\"x ##[error]\">{link}{link}</robot>");
    for file in ["::error::x.urdf", "##[group]x.urdf", "a ##[error]x.urdf"] {
        fs::write(folder.path().join(file), &robot).expect("written");
        for arguments in [
            &["validate", file][..],
            &["validate", file, "--format", "json"],
            &["lint", file],
            &["lint", file, "--format", "github"],
            &["generate", file, "-o", "out"],
            &["info", file],
            &["diff", file, file, "--format", "markdown"],
        ] {
            let said = clean(folder.path(), arguments);
            // A line that begins with a command of ours holds no other.
            let ours = ["::error file=", "::warning file=", "::notice file="];
            let mut lines = said.lines().filter(|line| !ours.iter().any(|of| line.starts_with(of)));
            assert_eq!(lines.find(|line| line.contains("##[")), None, "{arguments:?}: {said}");
            let forged = said.lines().find(|line| line.trim_start().starts_with("::error::x"));
            assert_eq!(forged, None, "{arguments:?}");
            if arguments.ends_with(&["json"]) {
                serde_json::from_str::<Value>(&said).expect("JSON");
            }
        }
    }
}

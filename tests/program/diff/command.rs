//! The command: formats, exit statuses, the page about it.

use std::path::Path;
use std::process::Command;

use testkit::repository;
use testkit::workshop::Workshop;
use urdd_format::schema::{Subject, Variant};

/// Exit status, standard output, standard error of `urdd diff` in a folder.
pub fn diff(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    run(folder, arguments, None)
}

/// The same, with programs in a folder.
pub fn run(folder: &Path, arguments: &[&str], programs: Option<&Path>) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
    command.arg("diff").args(arguments).current_dir(folder);
    let output = command.envs(programs.map(|path| ("PATH", path))).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// Two versions of a robot in which one change of each kind was made.
fn two_versions() -> Workshop {
    let shop = Workshop::new();
    let text = shop.text("welding_arm");
    let from = |text: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    let text = from(&text, "<mass value=\"8\"/>", "<mass value=\"8.5\"/>");
    let text = from(&text, "<box size=\"0.2 0.16 0.24\"/>", "<box size=\"0.2 0.16 0.3\"/>");
    let text = from(&text, "rgba=\"0.95 0.45 0.1 1\"", "rgba=\"0.9 0.2 0.1 1\"");
    let text = from(&text, "<mass value=\"14\"/>", "");
    let joint = text.find("<joint").unwrap();
    let (head, tail) = text.split_at(joint);
    let tail = from(tail, "lower=\"-2.9\"", "lower=\"-2.8\"");
    let end = tail.rfind("</robot>").unwrap();
    let added = "<link name=\"lamp\"/><joint name=\"lamp mount\" type=\"revolute\"><parent link=\"forearm\"/>\
        <child link=\"lamp\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>";
    shop.write("after.urdf", &format!("{head}{}{added}</robot>\n", &tail[..end]));
    shop
}

#[test]
fn a_tolerance_that_is_none_is_refused() {
    let folder = testkit::repository();
    let robot = "conformance/robots/single_link.urdf";
    for word in ["-1", "nan", "inf", "1e999", "x"] {
        let (status, _, said) = diff(folder, &[robot, robot, &format!("--tolerance={word}")]);
        assert_eq!(status, 2, "{word}");
        let reason = if word == "x" { "--tolerance" } else { "it must be at least 0" };
        assert!(said.contains(reason), "{said}");
    }
    assert_eq!(diff(folder, &[robot, robot, "--tolerance", "1e-9"]).0, 0);
}

#[test]
fn each_format_says_the_same() {
    let shop = two_versions();
    let run = |format: &str| {
        let folder = shop.folder();
        diff(folder, &["welding_arm.urdf", "after.urdf", "--format", format])
    };
    for (format, end) in [("text", "txt"), ("markdown", "md"), ("json", "json")] {
        let (status, out, err) = run(format);
        assert_eq!((status, err.as_str()), (1, ""), "{out}");
        let version = concat!("\"version\": \"", env!("CARGO_PKG_VERSION"), "\"");
        let out = out.replace(version, "\"version\": \"V\"");
        insta::assert_snapshot!(format!("diff_{end}"), out);
    }
    let json: serde_json::Value = serde_json::from_str(&run("json").1).unwrap();
    let schema = Subject::DiffReport.schema(Variant::Strict);
    let validator = jsonschema::draft202012::new(&schema).unwrap();
    assert!(validator.is_valid(&json));
}

#[test]
fn the_exit_status_says_whether_there_is_a_difference() {
    let shop = two_versions();
    let folder = shop.folder();
    let (status, out, err) = diff(folder, &["after.urdf", "after.urdf"]);
    assert_eq!((status, err.as_str()), (0, ""));
    assert!(out.ends_with("\nno difference in meaning\n"), "{out}");
    assert_eq!(diff(folder, &["after.urdf", "welding_arm.urdf"]).0, 1);
    assert_eq!(diff(folder, &["after.urdf", "none.urdf"]).0, 2);
    assert_eq!(diff(folder, &["after.urdf"]).0, 2);
}

/// The robots that docs/diff.md shows are in the repository, and it shows what the commands print.
#[test]
fn the_page_shows_what_the_command_prints() {
    let page = std::fs::read_to_string(repository().join("docs/diff.md")).unwrap();
    let mut shown = 0;
    for block in page.split("```console\n").skip(1) {
        let block = block.split("```").next().unwrap();
        let (command, expected) = block.split_once('\n').unwrap();
        let words = command.strip_prefix("$ urdd diff ").expect("a command");
        let words: Vec<&str> = words.split_whitespace().collect();
        let (_, out, err) = diff(repository(), &words);
        assert_eq!(format!("{out}{err}"), expected, "{command}");
        shown += 1;
    }
    assert!(shown >= 2, "{shown}");
}

//! Messages about missing meshes, and `--strict`; URDFs through a pipe, and files that are not URDFs.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Output, Stdio};

use serde_json::Value;

use crate::generate::{ascii_stl, findings_of, read_json, urdd};

const ROBOT: &str = r#"<robot name="r"><link name="a">
<visual><geometry><mesh filename="here.stl"/></geometry></visual>
<visual><geometry><mesh filename="gone.stl"/></geometry></visual>
<visual><geometry><mesh filename="gone.stl"/></geometry></visual>
<visual><geometry><mesh filename="text.stl"/></geometry></visual>
<visual><geometry><mesh filename="flat.stl"/></geometry></visual>
</link></robot>
"#;

fn workshop(robot: &str) -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("r.urdf"), robot).unwrap();
    fs::write(folder.path().join("here.stl"), ascii_stl("here", "0 1 0")).unwrap();
    fs::write(folder.path().join("flat.stl"), ascii_stl("flat", "0 0 0")).unwrap();
    fs::write(folder.path().join("text.stl"), "a shopping list\n").unwrap();
    folder
}

fn generate(folder: &Path, more: &[&str]) -> Output {
    urdd(&["generate", "-o", "out"]).args(more).current_dir(folder).output().unwrap()
}

fn run(folder: &Path, more: &[&str]) -> (Option<i32>, String, String) {
    let output = generate(folder, &[&["--modules", "plain_meshes"], more].concat());
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn a_summary_counts_meshes_that_were_not_found() {
    let folder = workshop(ROBOT);
    let (status, summary, _) = run(folder.path(), &["r.urdf"]);
    assert_eq!(status, Some(0));
    let end = "; 1 of 4 meshes was not found; 1 of 4 meshes is empty or not a mesh; 1 of 4 meshes cannot be used\n";
    assert!(summary.ends_with(end), "{summary}");
    let (_, lines, _) = run(folder.path(), &["r.urdf", "--format", "json"]);
    let line: Value = serde_json::from_str(&lines).unwrap();
    let count = serde_json::json!({"named": 4, "not_found": 2, "not_usable": 1});
    assert_eq!(line["meshes"], count);
    fs::create_dir(folder.path().join("all")).unwrap();
    fs::rename(folder.path().join("r.urdf"), folder.path().join("all/r.urdf")).unwrap();
    let (_, summary, _) = run(folder.path(), &["--force", "all"]);
    let last = summary.lines().last().unwrap();
    assert_eq!(last, "1 robot: 1 generated, 0 unchanged, 0 failed; 4 of 4 meshes were not found");
}

#[test]
fn strict_makes_nothing_of_what_has_to_be_assumed() {
    let folder = workshop(ROBOT);
    let (status, _, said) = run(folder.path(), &["--strict", "r.urdf"]);
    assert_eq!(status, Some(1), "{said}");
    for words in [
        "`gone.stl` was not found",
        "`text.stl` is not a mesh",
        "`flat.stl` is not usable",
        "--strict",
    ] {
        assert!(said.contains(words), "{said}");
    }
    assert!(!folder.path().join("out").exists());
    // A robot that needs none of these.
    let robot = "<robot name=\"r\"><link name=\"a\"><collision><geometry><mesh filename=\"here.stl\"/></geometry></collision></link></robot>";
    fs::write(folder.path().join("r.urdf"), robot).unwrap();
    let (status, _, said) = run(folder.path(), &["--strict", "r.urdf"]);
    assert_eq!((status, said.as_str()), (Some(0), ""));
    // An invalid number.
    let folder = workshop(
        "<robot name=\"r\"><link name=\"a\"><visual><origin xyz=\"0 nan 0\"/><geometry><sphere radius=\"1\"/></geometry></visual></link></robot>",
    );
    let (status, _, said) = run(folder.path(), &["--strict", "r.urdf"]);
    assert_eq!(status, Some(1), "{said}");
}

fn piped(folder: &Path, text: &[u8], more: &[&str]) -> Output {
    let mut child = urdd(&["generate", "--modules", "original_meshes", "-o", "out"])
        .args(more)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that exits before it has read all input is not a fault here.
    let _ = child.stdin.take().unwrap().write_all(text);
    child.wait_with_output().unwrap()
}

#[test]
fn a_urdf_may_come_through_a_pipe() {
    let folder = workshop(ROBOT);
    let output = piped(folder.path(), ROBOT.as_bytes(), &["-"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let out = folder.path().join("out");
    assert_eq!(fs::read_to_string(out.join("robot.urdf")).unwrap(), ROBOT);
    let module = read_json(&out.join("mesh_modules/original_meshes_module/module.json"));
    // Names are relative to the current folder.
    assert!(module["references"][0]["path"].is_string(), "{module}");
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("standard input:3:"), "{said}");

    let refused = piped(folder.path(), b"<robot", &["-"]);
    assert_eq!(refused.status.code(), Some(1));
    let batch = piped(folder.path(), ROBOT.as_bytes(), &["-", "r.urdf"]);
    assert_eq!(batch.status.code(), Some(2), "{batch:?}");
}

/// Inputs that are not URDFs: a message, the status, and no waiting.
#[cfg(unix)]
#[test]
fn what_is_no_file_is_said() {
    let folder = workshop(ROBOT);
    let path = folder.path();
    let status = std::process::Command::new("mkfifo").arg(path.join("pipe.urdf")).status();
    assert!(status.unwrap().success());
    std::os::unix::fs::symlink("loop.urdf", path.join("loop.urdf")).unwrap();
    fs::create_dir(path.join("empty.urdf")).unwrap();
    let huge = fs::File::create(path.join("huge.urdf")).unwrap();
    huge.set_len(600 << 20).unwrap();
    let cases = [
        ("pipe.urdf", 1, "pipe.urdf: cannot be read: it is not a regular file"),
        ("/dev/zero", 1, "it is not a regular file"),
        ("huge.urdf", 1, "it is longer than 64 MiB"),
        ("loop.urdf", 1, "loop.urdf: cannot be read: "),
        ("gone.urdf", 1, "gone.urdf: cannot be read: "),
        ("empty.urdf", 2, "there is no .urdf"),
        ("name:=value", 2, "no robot given"),
    ];
    for (source, expected, words) in cases {
        let (status, _, said) = run(path, &[source]);
        assert_eq!(status, Some(expected), "{source}: {said}");
        assert!(said.contains(words), "{source}: {said}");
        assert!(!path.join("out").exists(), "{source}");
    }
    // In a batch each has its line, and the good one is generated.
    let (status, lines, _) = run(path, &["--format", "json", "pipe.urdf", "huge.urdf", "r.urdf"]);
    assert_eq!(status, Some(1), "{lines}");
    assert_eq!(lines.lines().count(), 4, "{lines}");
    assert!(path.join("out/r/urdd.json").exists());
}

/// A URDD grows with the square of the links: one that is too large is refused, with a message that states the limit.
#[test]
fn a_robot_beyond_the_limits_is_refused() {
    let star = |links: usize| {
        let names = (0..links).map(|idx| format!("<link name=\"l{idx}\"/>"));
        let joints = (1..links).map(|idx| {
            format!("<joint name=\"j{idx}\" type=\"fixed\"><parent link=\"l0\"/><child link=\"l{idx}\"/></joint>")
        });
        let all: String = names.chain(joints).collect();
        format!("<robot name=\"r\">{all}</robot>")
    };
    let unknown = format!("<robot name=\"r\"><link name=\"a\"/>{}</robot>", "<x/>".repeat(400_000));
    for (text, words) in [
        (star(2_001), "the robot has 2001 links, but a URDD has at most 2000"),
        (unknown, "at most 100000"),
    ] {
        let folder = workshop(&text);
        let (status, _, said) = run(folder.path(), &["r.urdf"]);
        assert_eq!(status, Some(1));
        assert!(said.contains(words), "{said}");
        assert!(!folder.path().join("out").exists());
    }
    let folder = workshop(&star(2_000));
    let output = urdd(&["generate", "--modules", "core", "-o", "out", "r.urdf"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
}

#[test]
fn more_triangles_than_files_hold_are_refused() {
    // A sphere has 1280 triangles: 3,000,000 are those of 2,343 spheres, and 10,000,000 of 7,812.
    let spheres = |number: usize| {
        "<visual><geometry><sphere radius=\"1\"/></geometry></visual>".repeat(number)
    };
    let link =
        |name: &str, number: usize| format!("<link name=\"{name}\">{}</link>", spheres(number));
    let robot = |links: &[usize]| {
        let mut text: String = (links.iter().enumerate())
            .map(|(idx, number)| link(&format!("l{idx}"), *number))
            .collect();
        for idx in 1..links.len() {
            text += &format!(
                "<joint name=\"j{idx}\" type=\"fixed\"><parent link=\"l0\"/><child link=\"l{idx}\"/></joint>"
            );
        }
        format!("<robot name=\"r\">{text}</robot>")
    };
    for (links, words) in [
        (
            vec![1, 2_344],
            "the shapes of link `l1` have 3000320 triangles, but a link of a URDD has at most 3000000",
        ),
        (
            vec![1_954, 1_954, 1_954, 1_954],
            "the shapes of all links have more than 10000000 triangles",
        ),
    ] {
        let folder = workshop(&robot(&links));
        let (status, _, said) = run(folder.path(), &["r.urdf"]);
        assert_eq!(status, Some(1), "{said}");
        assert!(said.contains(words), "{said}");
        assert!(!folder.path().join("out").exists());
        let output = generate(folder.path(), &["--modules", "core", "r.urdf"]);
        assert!(output.status.success(), "{output:?}");
    }
}

#[test]
fn shapes_that_files_do_not_tell_from_points_or_lines_are_refused() {
    let robot = |at: &str, size: &str| {
        format!(
            "<robot name=\"r\"><link name=\"a\"><visual><origin xyz=\"{at} 0 0\"/><geometry><box size=\"{size}\"/></geometry></visual></link></robot>"
        )
    };
    for (at, size, made) in [
        ("1e9", "1 1 1", false),
        ("100", "1e-6 1e-6 1e-6", false),
        ("1e300", "1 1 1", false),
        ("0", "1 1e-7 1e-7", false),
        ("0", "1e-50 1e-50 1e-50", false),
        ("1e5", "1 1 1", true),
        ("0", "1 1e-5 1e-5", true),
        ("0", "1 1 1e-9", true),
        ("0", "1e-20 1e-20 1e-20", true),
        ("0", "1e8 1e8 1e8", true),
    ] {
        let folder = workshop(&robot(at, size));
        let output = generate(folder.path(), &["r.urdf"]);
        let (status, said) = (output.status.code(), String::from_utf8(output.stderr).unwrap());
        let out = folder.path().join("out");
        if made {
            assert_eq!(status, Some(0), "{at}, {size}: {said}");
            assert_eq!(findings_of(&out), [], "{at}, {size}");
        } else {
            assert_eq!(status, Some(1), "{at}, {size}: {said}");
            assert!(said.contains("link `a`: its shape is too thin"), "{said}");
            assert!(!out.exists());
        }
    }
}

#[test]
fn meshes_of_which_files_keep_nothing_are_refused() {
    for (scale, made) in [
        ("1 1 1", true),
        // The triangle is in the xy plane: it becomes a line.
        ("1 0 1", false),
        ("1e-50 1e-50 1e-50", false),
        ("1e39 1e39 1e39", false),
        // Not usable (SPEC 7.2), so there is no mesh to keep.
        ("0 0 1", true),
    ] {
        let folder = workshop(&format!(
            "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"here.stl\" scale=\"{scale}\"/></geometry></visual></link></robot>"
        ));
        let output = generate(folder.path(), &["r.urdf"]);
        let said = String::from_utf8(output.stderr).unwrap();
        let out = folder.path().join("out");
        if made {
            assert_eq!(output.status.code(), Some(0), "{scale}: {said}");
            assert_eq!(findings_of(&out), [], "{scale}");
        } else {
            assert_eq!(output.status.code(), Some(1), "{scale}: {said}");
            assert!(said.contains("link `a`: its shape is too thin"), "{said}");
            assert!(!out.exists());
        }
    }
}

#[test]
fn paths_that_are_left_out_are_said_and_strict_allows_it() {
    let line = |links: usize| {
        let names = (0..links).map(|i| format!("<link name=\"l{i}\"/>"));
        let joints = (1..links).map(|i| {
            let above = i - 1;
            format!(
                "<joint name=\"j{i}\" type=\"fixed\"><parent link=\"l{above}\"/><child link=\"l{i}\"/></joint>"
            )
        });
        let all: String = names.chain(joints).collect();
        format!("<robot name=\"r\">{all}</robot>")
    };
    for (links, kinds) in [(180, vec![]), (181, vec!["too-large"])] {
        let folder = workshop(&line(links));
        let more = ["--modules", "core", "--strict", "--format", "json"];
        let output = generate(folder.path(), &[&more[..], &["r.urdf"]].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let said: Value = serde_json::from_slice(&output.stdout).unwrap();
        let notes = said["notes"].as_array().unwrap();
        let found: Vec<&str> = notes.iter().filter_map(|n| n["kind"].as_str()).collect();
        assert_eq!(found, kinds, "{said}");
        let made = read_json(&folder.path().join("out/connections_module/module.json"));
        assert_eq!(made["link_to_link_paths"].is_null(), links == 181);
        let validated = urdd(&["validate", "out"]).current_dir(folder.path()).output().unwrap();
        assert_eq!(validated.status.code(), Some(0), "{validated:?}");
    }
}

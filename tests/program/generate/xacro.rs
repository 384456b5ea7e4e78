//! Xacro files, expanded by a program of that name on the PATH.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

use crate::generate::{findings_of, read_json, urdd};

const EXPANDED: &str =
    "<?xml version=\"1.0\"?>\n<robot name=\"expanded\"><link name=\"a\"/></robot>\n";

fn run(folder: &Path, source: &str, program: Option<&str>) -> (Option<i32>, String) {
    run_with(folder, source, program, &[])
}

fn run_with(
    folder: &Path,
    source: &str,
    program: Option<&str>,
    more: &[&str],
) -> (Option<i32>, String) {
    let programs = folder.join("bin");
    fs::create_dir_all(&programs).unwrap();
    if let Some(script) = program {
        let path = programs.join("xacro");
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }
    let output = urdd(&["generate", "-o"])
        .arg(folder.join("out"))
        .arg(folder.join(source))
        .args(more)
        .env("PATH", programs)
        .output()
        .unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn is_expanded_by_the_program() {
    let folder = testkit::temporary::folder();
    let source = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><xacro:arm/></robot>";
    fs::write(folder.path().join("arm.urdf.xacro"), source).unwrap();
    fs::write(folder.path().join("expanded"), EXPANDED).unwrap();
    // It receives the file, and writes the URDF.
    let script = "case \"$1\" in *arm.urdf.xacro) while read -r line; do echo \"$line\"; done < \"${1%/*}/expanded\";; *) exit 3;; esac";
    let (status, said) = run(folder.path(), "arm.urdf.xacro", Some(script));
    assert_eq!(status, Some(0), "{said}");
    let out = folder.path().join("out");
    assert_eq!(fs::read_to_string(out.join("arm.urdf")).unwrap(), EXPANDED);
    assert_eq!(fs::read_to_string(out.join("arm.urdf.as-found")).unwrap(), source);
    assert_eq!(read_json(&out.join("urdd.json"))["robot_name"], "expanded");
    assert_eq!(findings_of(&out), []);
}

#[test]
fn without_the_program_the_message_says_what_to_do() {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("arm.xacro"), EXPANDED).unwrap();
    let (status, said) = run(folder.path(), "arm.xacro", None);
    assert_eq!(status, Some(1));
    assert!(said.contains("pip install xacro"), "{said}");
    assert!(!folder.path().join("out").exists());
}

#[test]
fn what_the_program_says_is_passed_on() {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("arm.xacro"), EXPANDED).unwrap();
    let (status, said) =
        run(folder.path(), "arm.xacro", Some("echo 'no such package: arm' >&2; exit 2"));
    assert_eq!(status, Some(1));
    assert!(said.contains("no such package: arm"), "{said}");
    // Of a file that is not well-formed, it has advice below that.
    let not_xml = "echo 'XML parsing error: mismatched tag: line 4, column 2' >&2; echo 'when processing file: p/arm.xacro' >&2
echo >&2; echo 'Check that:' >&2; echo ' - Your XML is well-formed' >&2; exit 2";
    let (_, said) = run(folder.path(), "arm.xacro", Some(not_xml));
    let stated = "could not expand it: XML parsing error: mismatched tag: line 4, column 2; when processing file: p/arm.xacro";
    assert!(said.contains(stated) && !said.contains("Check that"), "{said}");
}

/// A URDF that contains the word runs nothing, unless the user asks for it.
#[test]
fn a_urdf_is_expanded_only_where_the_user_asks_for_it() {
    let folder = testkit::temporary::folder();
    let text = "<robot name=\"r\"><!-- <xacro:arm/> --><link name=\"a\"/></robot>\n";
    fs::write(folder.path().join("arm.urdf"), text).unwrap();
    fs::write(folder.path().join("expanded"), EXPANDED).unwrap();
    let ran = folder.path().join("ran");
    let script = format!(
        "echo > {}; while read -r line; do echo \"$line\"; done < {}",
        ran.display(),
        folder.path().join("expanded").display()
    );
    let (status, said) = run(folder.path(), "arm.urdf", Some(&script));
    assert_eq!((status, said.as_str()), (Some(0), ""));
    assert!(!ran.exists(), "xacro ran on a .urdf");
    let carried = folder.path().join("out/arm.urdf");
    assert_eq!(fs::read_to_string(&carried).unwrap(), text);
    let (status, said) = run_with(folder.path(), "arm.urdf", Some(&script), &["--xacro"]);
    assert_eq!(status, Some(0), "{said}");
    assert!(ran.exists());
    assert_eq!(fs::read_to_string(&carried).unwrap(), EXPANDED);
}

#[test]
fn it_gets_arguments_and_packages() {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("arm.xacro"), EXPANDED).unwrap();
    let package = folder.path().join("my_arm");
    fs::create_dir(&package).unwrap();
    fs::write(package.join("package.xml"), "<package><name>my_arm</name></package>").unwrap();
    let script = "shift; p=${AMENT_PREFIX_PATH%%:*}; r=${ROS_PACKAGE_PATH%%:*}
[ -f $p/share/my_arm/package.xml ] && [ -f $p/share/ament_index/resource_index/packages/my_arm ] && [ -f $r/my_arm/package.xml ] || exit 4
echo \"<robot name='$*'><link name='a'/></robot>\"";
    let package = format!("my_arm={}", package.display());
    let more = ["prefix:=left ", "--package", &package, "n:=2"];
    let (status, said) = run_with(folder.path(), "arm.xacro", Some(script), &more);
    assert_eq!(status, Some(0), "{said}");
    let metadata = read_json(&folder.path().join("out/urdd.json"));
    assert_eq!(metadata["robot_name"], "prefix:=left  n:=2");
}

/// `$(find NAME)`, with ROS and without: ament looks into the folders of AMENT_PREFIX_PATH for a file of the package's name in
/// `share/ament_index/resource_index/packages`, and says `share/NAME`.
#[test]
fn it_finds_the_packages_around_the_file() {
    let folder = testkit::temporary::folder();
    for (name, text) in [
        ("ws/arm/package.xml", "<package><name>my_arm</name></package>"),
        ("ws/arm/urdf/v1/arm.xacro", EXPANDED),
        ("ws/hand-ros/package.xml", "<package><name>hand</name></package>"),
        ("ws/plain/meshes/a.stl", ""),
        ("ws/bad/package.xml", "<package><name>../../x</name></package>"),
    ] {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    let find = "find() {
  IFS=:; for p in $AMENT_PREFIX_PATH; do [ -f $p/share/ament_index/resource_index/packages/$1 ] && echo $p/share/$1 && return; done
  echo \"error: package '$1' not found, searching: [$AMENT_PREFIX_PATH]\" >&2; echo \"when processing file: x\" >&2; exit 2
}";
    // ROS 1 would search folders without a package.xml to their ends.
    let script = format!(
        "{find}
arm=$(find my_arm) && hand=$(find hand) && above=$(find ws) || exit 4
[ -f ${{PYTHONPATH##*:}}/ament_index_python/packages.py ] && [ -f $arm/package.xml ] || exit 5
case \"$ROS_PACKAGE_PATH\" in *named*) exit 6;; esac
(find plain) 2> /dev/null && exit 7
echo \"<robot name='$arm/a $above/b file://$hand/c'><link name='a'/></robot>\""
    );
    let (status, said) = run(folder.path(), "ws/arm/urdf/v1/arm.xacro", Some(&script));
    assert_eq!(status, Some(0), "{said}");
    let metadata = read_json(&folder.path().join("out/urdd.json"));
    let ws = folder.path().canonicalize().unwrap().join("ws").display().to_string();
    assert_eq!(metadata["robot_name"], format!("{ws}/arm/a {ws}/b package://hand/c"));

    let script = format!("{find}\nfind nobody");
    let (status, said) = run(folder.path(), "ws/arm/urdf/v1/arm.xacro", Some(&script));
    assert_eq!(status, Some(1));
    let advice = "the package `nobody` is not around the file, nor on AMENT_PREFIX_PATH; say where it is: --package \
        nobody=FOLDER; when processing file: x";
    assert!(said.contains(advice), "{said}");
}

#[test]
fn it_may_not_take_for_ever_nor_write_without_end() {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("arm.xacro"), EXPANDED).unwrap();
    let late = folder.path().join("late");
    let script = format!("(/bin/sleep 4; echo > {}) & /bin/sleep 60", late.display());
    let start = std::time::Instant::now();
    let more = ["--xacro-timeout", "1"];
    let (status, said) = run_with(folder.path(), "arm.xacro", Some(&script), &more);
    assert_eq!(status, Some(1));
    assert!(said.contains("it took more than 1 s"), "{said}");
    assert!(start.elapsed() < std::time::Duration::from_secs(30));
    let endless = "while :; do echo 0123456789012345678901234567890123456789012345678901234567890123456789; done";
    let script = format!("exec /usr/bin/yes '{}'", &endless[..60]);
    let (status, said) = run(folder.path(), "arm.xacro", Some(&script));
    assert_eq!(status, Some(1));
    assert!(said.contains("longer than 64 MiB"), "{said}");
    assert!(!folder.path().join("out").exists());
    let late_enough = std::time::Duration::from_millis(4500);
    std::thread::sleep(late_enough.saturating_sub(start.elapsed()));
    assert!(!late.exists(), "what xacro started outlived it");
}

#[test]
fn arguments_that_no_file_takes_are_wrong_usage() {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("r.urdf"), EXPANDED).unwrap();
    let (status, said) = run_with(folder.path(), "r.urdf", None, &["prefix:=left_"]);
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("`prefix:=left_` is an argument for xacro"), "{said}");
    assert!(!folder.path().join("out").exists());
    // With `--xacro`, a file without macros is accepted too.
    let (status, said) = run_with(folder.path(), "r.urdf", None, &["prefix:=left_", "--xacro"]);
    assert_eq!(status, Some(0), "{said}");
}

/// A child that created its own session ends at the time limit, and on a signal.
#[test]
#[cfg(target_os = "linux")]
fn what_left_its_session_ends_too() {
    use std::time::{Duration, Instant};
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("arm.xacro"), EXPANDED).unwrap();
    let number = folder.path().join("number");
    let script = format!(
        "(/usr/bin/setsid /bin/sh -c 'echo $$ > {}; exec /bin/sleep 600' &) & /bin/sleep 600",
        number.display()
    );
    let is_alive = || {
        let pid = fs::read_to_string(&number).unwrap_or_default();
        let stat = fs::read_to_string(format!("/proc/{}/stat", pid.trim())).unwrap_or_default();
        stat.rsplit_once(')').is_some_and(|(_, rest)| !rest.starts_with(" Z"))
    };
    let more = ["--xacro-timeout", "2"];
    let (status, said) = run_with(folder.path(), "arm.xacro", Some(&script), &more);
    assert_eq!(status, Some(1));
    assert!(said.contains("it took more than 2 s"), "{said}");
    assert!(number.exists() && !is_alive());

    fs::remove_file(&number).unwrap();
    let mut run = urdd(&["generate", "-o"])
        .arg(folder.path().join("out"))
        .arg(folder.path().join("arm.xacro"))
        .env("PATH", folder.path().join("bin"))
        .spawn()
        .unwrap();
    let start = Instant::now();
    while !is_alive() && start.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    let (pid, asked) = (run.id().to_string(), Instant::now());
    let kill = std::process::Command::new("kill").args(["-TERM", &pid]).status();
    assert!(kill.unwrap().success());
    assert_eq!(run.wait().unwrap().code(), Some(143));
    assert!(asked.elapsed() < Duration::from_secs(4));
    assert!(!is_alive());
}

#[test]
fn faults_and_notes_name_the_place_in_the_xacro_file() {
    let folder = crate::lint::xacro::hand("hand");
    let file = folder.path().join("hand/parts/finger.xacro");
    let text = fs::read_to_string(&file).unwrap();
    let said = |text: &str| {
        fs::write(&file, text).unwrap();
        let output = urdd(&["generate", "hand/hand.urdf.xacro", "-o", "out", "--force"])
            .current_dir(folder.path())
            .env("PATH", folder.path().join("bin"))
            .output()
            .unwrap();
        String::from_utf8(output.stderr).unwrap()
    };
    // A joint without limits is a note.
    let without = text.replace("<limit lower=", "<limits lower=");
    let noted = said(&without);
    assert!(noted.contains("hand/parts/finger.xacro:4:1: "), "{noted}");
    let refused = said(&text.replace("\"prismatic\"", "\"wheel\""));
    assert!(refused.contains("hand/parts/finger.xacro:4:"), "{refused}");
    // Two links of one name, on one line of the macro: no line of the expansion is named.
    let main = folder.path().join("hand/hand.urdf.xacro");
    let twice = "<xacro:finger prefix=\"left\"/>";
    let twice = fs::read_to_string(&main).unwrap().replace(twice, &twice.repeat(2));
    fs::write(&main, twice).unwrap();
    let refused = said(&text);
    assert!(refused.contains("finger.xacro:3:1: two links are named `left_tip`\n"), "{refused}");
}

//! `urdd view` as a process: what it prints, reads and starts.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use testkit::requests::{PATIENCE, Requests, is_whole, next, status};
use testkit::robots::made_named;
use testkit::urdfs::arm;

const STATES: &str = "/robots/gripper/states";

fn view(words: &[&Path]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
    command.arg("view").args(words);
    command
}

/// The address that a process says in its first line.
fn address_of(child: &mut Child) -> String {
    let mut line = String::new();
    let output = child.stdout.take().expect("a pipe");
    BufReader::new(output).read_line(&mut line).expect("a line");
    line.trim().rsplit(' ').next().expect("an address").to_owned()
}

#[test]
fn a_package_shows_its_urdfs_and_runs_xacro_only_if_it_may() {
    let folder = testkit::temporary::folder();
    let package = folder.path().join("arms");
    fs::create_dir_all(package.join("urdf")).expect("a folder");
    fs::write(package.join("package.xml"), "<package><name>arms</name></package>").expect("it");
    let text = arm(1.0, r#"<sphere radius="0.3"/>"#);
    for name in ["one.urdf", "two.urdf", "three.urdf.xacro"] {
        fs::write(package.join("urdf").join(name), &text).expect("written");
    }
    let site = folder.path().join("site");
    let done = view(&[&package]).arg("--export").arg(&site).output().expect("it runs");
    let (said, errors) =
        (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert!(done.status.success(), "{errors}");
    assert!(said.contains("a site of 2 robots"), "{said}");
    assert!(errors.contains("left out 1 .xacro file; --xacro runs them"), "{errors}");
    fs::remove_file(package.join("urdf/one.urdf")).expect("removed");
    fs::remove_file(package.join("urdf/two.urdf")).expect("removed");
    let done = view(&[&package]).arg("--no-open").output().expect("it runs");
    assert_eq!(done.status.code(), Some(2));
}

#[cfg(unix)]
#[test]
fn what_xacro_includes_is_followed() {
    use std::os::unix::fs::PermissionsExt;
    let folder = testkit::temporary::folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("bin")).expect("a folder");
    // Not beside the robot: in a package that the command line names.
    fs::create_dir(at("parts")).expect("a folder");
    let elsewhere = testkit::temporary::folder();
    let xacro = elsewhere.path().join("arm.xacro");
    let part = at("parts/part.xacro");
    // As the program of that name does: the expanded file, or the list of what it includes.
    let script = "#!/bin/sh\npart=${ROS_PACKAGE_PATH%%:*}/parts/part.xacro\n\
        if [ \"$1\" = --deps ]; then echo \"$part\"; else cat \"$part\"; fi\n";
    fs::write(at("bin/xacro"), script).expect("written");
    fs::set_permissions(at("bin/xacro"), fs::Permissions::from_mode(0o755)).expect("set");
    fs::write(&xacro, "<robot/>").expect("written");
    let sphere = r#"<sphere radius="0.3"/>"#;
    fs::write(&part, arm(1.0, sphere)).expect("written");
    let package = format!("parts={}", at("parts").display());
    let mut child = view(&[&xacro, &PathBuf::from("--no-open")])
        .args(["--package", &package])
        .env("PATH", format!("{}:/usr/bin:/bin", at("bin").display()))
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("it runs");
    let server = Requests::to(&address_of(&mut child));
    let _ends = Interrupts(child);
    let first = server.until("arm", is_whole);
    fs::write(&part, arm(2.0, sphere)).expect("written");
    let changed = |answer: &Value| answer["revision"] != first["revision"];
    server.until("arm", |answer| changed(answer) && is_whole(answer));
    let _ = server.json("/robots/arm/files.json");
    let urdf = server.json("/robots/arm/files/urdf_module/module.json");
    assert_eq!(urdf["joints"][0]["limit"]["upper"], 2.0);
}

/// Everybody on the machine can read the arguments of a program: a browser gets the path of a file that leads on.
#[cfg(target_os = "linux")]
#[test]
fn the_token_is_in_no_argument() {
    use std::os::unix::fs::PermissionsExt;
    let folder = testkit::temporary::folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("bin")).expect("a folder");
    let script = "#!/bin/sh\necho \"$@\" > \"$SEEN.part\"; tr '\\0' '\\n' < /proc/$$/environ >> \"$SEEN.part\"\n\
        mv \"$SEEN.part\" \"$SEEN\"\n";
    fs::write(at("bin/xdg-open"), script).expect("written");
    fs::set_permissions(at("bin/xdg-open"), fs::Permissions::from_mode(0o755)).expect("set");
    let urdf = at("arm.urdf");
    fs::write(&urdf, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
    let mut child = view(&[&urdf])
        .env("PATH", format!("{}:/usr/bin:/bin", at("bin").display()))
        .env("SEEN", at("seen"))
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("it runs");
    let address = address_of(&mut child);
    let token = Requests::to(&address).token.clone();
    let ends = Interrupts(child);
    let begun = Instant::now();
    while !at("seen").exists() {
        assert!(begun.elapsed() < PATIENCE, "no browser was opened");
        std::thread::sleep(Duration::from_millis(20));
    }
    let seen = fs::read_to_string(at("seen")).expect("a file");
    assert!(!seen.contains(&token), "{seen}");
    let page = PathBuf::from(seen.lines().next().expect("an argument"));
    let mode = |path: &Path| fs::metadata(path).expect("it").permissions().mode() & 0o777;
    assert_eq!(mode(&page), 0o600);
    assert_eq!(mode(page.parent().expect("a folder")), 0o700);
    let text = fs::read_to_string(&page).expect("a page");
    assert!(text.contains(&format!("content=\"0; url={address}\"")), "{text}");
    drop(ends);
    assert!(!page.exists());
}

/// Ends a program as Ctrl-C does, so that it removes its temporary folder.
#[cfg(unix)]
struct Interrupts(std::process::Child);

#[cfg(unix)]
impl Drop for Interrupts {
    fn drop(&mut self) {
        let id = self.0.id().to_string();
        let _ = Command::new("kill").args(["-INT", &id]).status();
        let _ = self.0.wait();
    }
}

#[test]
fn the_command_shows_what_it_reads() {
    let (_folder, path) = made_named("gripper");
    let mut child = Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(["view", "--no-open", "--follow"])
        .arg(&path)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("started");
    let mut input = child.stdin.take().expect("standard input");
    let mut output = BufReader::new(child.stdout.take().expect("standard output"));
    let mut line = String::new();
    output.read_line(&mut line).expect("a line");
    let server = Requests::to(line.split_whitespace().last().expect("an address"));
    let dofs = server.json("/robots/gripper/summary.json")["dofs"].clone();
    assert!(dofs.is_number(), "{dofs}");
    let names = urdd_robot::Robot::open(&path).expect("a robot");
    let names = names.dof_names().expect("DOFs");
    let head = names.iter().rev().cloned().collect::<Vec<_>>().join(",");
    let row = |value: f64| vec![value.to_string(); names.len()].join(",");
    write!(input, "{head}\n{}\n", row(0.01)).expect("written");
    let mut page = server.listen(STATES, &server.token);
    assert!(status(&mut page).contains("200"));
    assert_eq!(next(&mut page)["q"], json!(vec![0.01; names.len()]));
    // A wrong line is said, and the next one is shown.
    write!(input, "1,x\n{}\n", row(0.02)).expect("written");
    assert_eq!(next(&mut page)["q"], json!(vec![0.02; names.len()]));
    // A line without an end takes no more memory than that.
    input.write_all(&[b'1'; 1 << 20]).expect("written");
    let mut errors = BufReader::new(child.stderr.take().expect("errors"));
    let mut said = String::new();
    while !said.contains("longer than 1 MiB") {
        assert!(errors.read_line(&mut said).expect("text") > 0, "{said}");
    }
    assert!(said.contains("standard input:3: ") && said.contains("standard input:5: "), "{said}");
    drop(input);
    child.kill().expect("ended");
    child.wait().expect("ended");
}

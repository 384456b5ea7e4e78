//! `urdd view --compare` as a process.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use testkit::robots::made_named;
use testkit::urdfs::arm;

fn compare(words: &[&Path]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
    command.args(["view", "--compare"]).args(words);
    command
}

/// What the program says when it refuses.
fn refused(mut command: Command) -> String {
    let done = command.output().expect("it runs");
    assert_eq!(done.status.code(), Some(2));
    String::from_utf8(done.stderr).expect("text")
}

#[test]
fn the_address_opens_the_second_beside_the_first() {
    let (_folder, urdd) = made_named("gripper");
    let folder = testkit::temporary::folder();
    let versions = ["old", "new"].map(|version| folder.path().join(version).join("arm.urdf"));
    for file in &versions {
        fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
        fs::write(file, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
    }
    let [old, new] = &versions;
    let tries = [([old, new], "&r=new-arm&v=old-arm"), ([&urdd, new], "&r=arm&v=gripper")];
    for (robots, view) in tries {
        let mut child = compare(&robots.map(|path| path.as_path()))
            .arg("--no-open")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("it runs");
        let mut line = String::new();
        let output = child.stdout.take().expect("a pipe");
        BufReader::new(output).read_line(&mut line).expect("a line");
        child.kill().expect("ended");
        child.wait().expect("ended");
        assert!(line.starts_with("2 robots: ") && line.contains("/#token="), "{line}");
        assert!(line.trim().ends_with(view), "{line}");
    }
}

#[test]
fn it_takes_two_robots() {
    let (_folder, urdd) = made_named("gripper");
    let folder = testkit::temporary::folder();
    let many = folder.path().join("many");
    fs::create_dir(&many).expect("a folder");
    for name in ["one.urdf", "two.urdf"] {
        let text = arm(1.0, r#"<sphere radius="0.3"/>"#);
        fs::write(many.join(name), text).expect("written");
    }
    for robots in [&[&*urdd] as &[&Path], &[&*urdd; 3]] {
        let said = refused(compare(robots));
        let count = robots.len();
        assert!(said.contains("--compare BEFORE AFTER"), "{said}");
        assert!(said.contains(&format!("found {count} path")), "{said}");
    }
    let said = refused(compare(&[&urdd, &many]));
    assert!(said.contains("many: found 2 robots") && said.contains("name one of them"), "{said}");
    let mut command = compare(&[&urdd, &many.join("one.urdf")]);
    command.arg("--export").arg(folder.path().join("page.html"));
    let said = refused(command);
    assert!(said.contains("give --export a folder"), "{said}");
    assert!(!folder.path().join("page.html").exists());
}

#[test]
fn an_exported_page_says_what_it_opens() {
    let (_folder, urdd) = made_named("gripper");
    let folder = testkit::temporary::folder();
    let (urdf, site) = (folder.path().join("arm.urdf"), folder.path().join("site"));
    fs::write(&urdf, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
    let page = |command: &mut Command| {
        let done = command.arg("--export").arg(&site).output().expect("it runs");
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        fs::read_to_string(site.join("index.html")).expect("a page")
    };
    let opens = r#"<meta name="urdd-opens" content="r=arm&amp;v=gripper" />"#;
    assert!(page(&mut compare(&[&urdd, &urdf])).contains(opens));
    let mut plain = Command::new(env!("CARGO_BIN_EXE_urdd"));
    assert!(!page(plain.arg("view").arg(&urdd).arg(&urdf)).contains("urdd-opens"));
}

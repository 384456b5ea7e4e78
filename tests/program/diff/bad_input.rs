//! Broken, unrelated and hostile files: a message that says what to do, or a readable difference.

use std::fs;
use std::time::Instant;

use super::command::diff;
use testkit::workshop::Workshop;

#[test]
fn what_is_no_robot_is_refused_with_advice() {
    let shop = Workshop::new();
    let folder = shop.folder();
    shop.write("broken.urdf", "<robot name='a'><link name='b'>");
    shop.write("empty.urdf", "");
    shop.write("two.urdf", "<robot name='a'><link name='b'/><link name='b'/></robot>");
    shop.write("robot.sdf", "<sdf version='1.6'/>");
    shop.write("robot.xacro", "<robot name='a'/>");
    let bomb = "<!DOCTYPE robot [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;'>]><robot name='&b;'/>";
    shop.write("bomb.urdf", bomb);
    shop.write("deep.urdf", &"<robot>".repeat(100_000));
    fs::write(shop.path("junk.urdf"), b"\x7fELF\x02\0\xff").unwrap();
    shop.write("robot.txt", "a robot");
    fs::create_dir(shop.path("folder")).unwrap();
    fs::create_dir(shop.path("folder.urdf")).unwrap();
    fs::create_dir_all(shop.path("urdd/urdf_module")).unwrap();
    fs::write(shop.path("urdd/urdf_module/module.json"), "{").unwrap();
    fs::write(shop.path("urdd/urdf_module/VERSION"), "1.0.0").unwrap();
    for (path, words) in [
        ("none.urdf", "no such file"),
        ("none", "no such file"),
        ("broken.urdf", "broken.urdf:1:"),
        ("empty.urdf", "empty.urdf:1:"),
        ("two.urdf", "two.urdf:1:"),
        ("robot.sdf", "robot.sdf:1:"),
        ("robot.xacro", "xacro"),
        ("none.xacro", "no such file"),
        ("bomb.urdf", "bomb.urdf:1:"),
        ("deep.urdf", "deep.urdf:1:"),
        ("junk.urdf", "this is a program: give the file that is meant"),
        ("robot.txt", "neither a URDF"),
        ("folder", "no URDD here"),
        ("folder.urdf", "no URDD here"),
        ("urdd", "module.json"),
    ] {
        let begun = Instant::now();
        for arguments in [[path, "welding_arm.urdf"], ["welding_arm.urdf", path], [path, path]] {
            let (status, out, err) = diff(folder, &arguments);
            assert_eq!((status, out.as_str()), (2, ""), "{path}: {err}");
            assert!(err.contains(words), "{path}: {err}");
            assert!(!err.contains("panicked"), "{path}: {err}");
        }
        assert!(begun.elapsed().as_secs() < 60, "{path}");
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_is_refused_without_waiting() {
    let shop = Workshop::new();
    let made = std::process::Command::new("mkfifo").arg(shop.path("pipe.urdf")).status();
    assert!(made.unwrap().success());
    let (status, _, err) = diff(shop.folder(), &["pipe.urdf", "welding_arm.urdf"]);
    assert_eq!(status, 2);
    assert!(err.contains("not a regular file"), "{err}");
}

#[test]
fn hostile_names_stay_text_in_what_is_printed() {
    let shop = Workshop::new();
    let robot = |name: &str| {
        format!(
            "<robot name='r'><link name='a'/><link name='{name}'/><joint name='{name}' type='fixed'>\
             <parent link='a'/><child link='{name}'/></joint></robot>"
        )
    };
    shop.write("before.urdf", &robot("b"));
    let bad = "x&#x9b;&#x202e;`&lt;img src=x&gt;&#10;::error::@user [a](http://b) | #1";
    shop.write("after.urdf", &robot(bad));
    let folder = shop.folder();
    for format in ["text", "markdown", "json"] {
        let (status, out, err) = diff(folder, &["before.urdf", "after.urdf", "--format", format]);
        assert_eq!((status, err.as_str()), (1, ""));
        assert!(!out.contains(['\u{1b}', '\u{9b}', '\u{202e}']), "{out}");
        let is_command = |line: &str| line.trim_start().starts_with("::");
        assert!(!out.lines().any(is_command), "{out}");
    }
}

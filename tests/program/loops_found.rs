//! Which file says the loops of a robot, and what is said where none is read.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{urdd, urdd_with_input};

const FOUR_BAR: &str = r#"<robot name="fb"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
<joint name="a" type="continuous"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
<joint name="b" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="0.1 0 0"/><axis xyz="0 0 1"/></joint>
<joint name="c" type="continuous"><parent link="ground"/><child link="rocker"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/></joint></robot>"#;
const PLUS: &str = r#"<loop name="plus" type="revolute"><predecessor link="coupler"><origin xyz="0.3 0 0"/></predecessor>
<successor link="rocker"><origin xyz="0.1 0 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#;
const TOML: &str = "[[loop]]\nname = \"toml\"\nkind = \"Spherical\"\nlink_a = \"coupler\"\nframe_a = { xyz = [0.3, 0.0, 0.0] }\nlink_b = \"rocker\"\nframe_b = { xyz = [0.1, 0.0, 0.0] }\n";
/// The coupler is not on the rocker, but the crank may be.
const YAML: &str = "closed_loop: [[coupler, rocker]]\ntype: [3d]\n";
const CORE: [&str; 2] = ["--modules", "core"];

/// The names of the loops of a URDD.
fn loops(urdd: &Path) -> Vec<String> {
    let Ok(bytes) = fs::read(urdd.join("loops_module/module.json")) else { return Vec::new() };
    let module: Value = serde_json::from_slice(&bytes).expect("JSON");
    let loops = module["loops"].as_array().expect("loops");
    loops.iter().map(|of| of["name"].as_str().expect("a name").to_owned()).collect()
}

/// Generates a URDD of the core class. Returns the status, what was said, and the names of its loops.
fn generated(folder: &Path, source: &str, more: &[&str]) -> (i32, String, Vec<String>) {
    let target = folder.join("out");
    let _ = fs::remove_dir_all(&target);
    let arguments = [&["generate", source, "-o", "out"], &CORE[..], more].concat();
    let (status, out, said) = urdd(&arguments, folder);
    (status, out + &said, loops(&target))
}

#[test]
fn a_file_of_loops_is_read_for_a_urdf_from_standard_input() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("ok.toml"), TOML).expect("written");
    let arguments = ["generate", "-", "-o", "out", "--modules", "core", "--loops", "ok.toml"];
    let (status, out, said) = urdd_with_input(&arguments, folder.path(), FOUR_BAR.as_bytes());
    assert_eq!(status, 0, "{out}{said}");
    assert_eq!(loops(&folder.path().join("out")), ["toml"]);
}

#[test]
fn a_part_that_is_a_urdf_says_that_its_loops_are_lost() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("fb.urdf"), FOUR_BAR).expect("written");
    fs::write(at("fb.loops.toml"), TOML).expect("written");
    fs::write(at("leg.urdf"), r#"<robot name="leg"><link name="foot"/></robot>"#).expect("written");
    let combine = ["combine", "fb.urdf", "leg.urdf", "--at", "ground", "-o", "c"];
    let (status, out, said) = urdd(&[&combine[..], &CORE].concat(), folder.path());
    assert_eq!(status, 0, "{out}{said}");
    assert!((out + &said).contains("its loops are not in its URDF"));
    assert_eq!(loops(&at("c")), [""; 0]);
    // The file that it asks for is about the combined robot.
    let (status, out, said) =
        urdd(&[&combine[..], &CORE, &["--loops", "fb.loops.toml"]].concat(), folder.path());
    assert_eq!(status, 0, "{out}{said}");
    assert_eq!(loops(&at("c")), ["toml"]);
}

#[test]
fn a_file_of_loops_is_refused_for_a_format_that_says_them_itself() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(
        at("m.xml"),
        r#"<mujoco><worldbody><body name="a"><geom size="0.1"/></body></worldbody></mujoco>"#,
    )
    .expect("written");
    fs::write(at("m.sdf"), r#"<sdf version="1.9"><model name="m"><link name="a"/></model></sdf>"#)
        .expect("written");
    for (source, format) in [("m.xml", "mjcf"), ("m.sdf", "sdf")] {
        let (status, said, _) = generated(folder.path(), source, &["--loops", "nope"]);
        assert_eq!(status, 1, "{said}");
        assert!(said.contains(&format!("format {format} says its loops itself")), "{said}");
        assert_eq!(generated(folder.path(), source, &[]).0, 0);
        let (status, out, said) =
            urdd(&["import", source, "-o", "i", "--loops", "n"], folder.path());
        assert!(status == 2 && said.contains("unexpected argument '--loops'"), "{out}{said}");
    }
    let (_, help, _) = urdd(&["import", "--help"], folder.path());
    assert!(help.contains("NAME.loops.toml"), "{help}");
}

#[test]
fn of_several_that_say_loops_a_note_names_those_that_are_passed_over() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let plus = FOUR_BAR.replace("</robot>", PLUS);
    fs::write(at("fb.urdf"), &plus).expect("written");
    assert_eq!(generated(folder.path(), "fb.urdf", &[]).2, ["plus"]);
    fs::write(at("fb.loops.toml"), TOML).expect("written");
    fs::write(at("fb.yaml"), YAML).expect("written");
    let (status, said, names) = generated(folder.path(), "fb.urdf", &[]);
    assert_eq!((status, &*names), (0, &["toml".to_owned()][..]), "{said}");
    for other in ["fb.urdf", "fb.yaml"] {
        let note = format!(
            "{other}: this file says loops, and so does `fb.loops.toml`: the loops of this file are passed over, those of `fb.loops.toml` are used"
        );
        assert!(said.contains(&note), "{said}");
    }
    // Who names a file has chosen.
    let (_, said, names) = generated(folder.path(), "fb.urdf", &["--loops", "fb.loops.toml"]);
    assert_eq!(names, ["toml"]);
    assert!(!said.contains("passed over"), "{said}");
    // A YAML about something else says none.
    fs::write(at("fb.yaml"), "gains: 1\n").expect("written");
    let (_, said, _) = generated(folder.path(), "fb.urdf", &[]);
    assert!(said.contains("fb.urdf: this file says loops") && !said.contains("fb.yaml"), "{said}");
}

#[test]
fn a_file_of_loops_that_is_none_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("fb.urdf"), FOUR_BAR).expect("written");
    let refused = |why: &str| {
        let (status, said, _) = generated(folder.path(), "fb.urdf", &[]);
        assert!(status == 1 && said.contains("fb.loops.toml") && said.contains(why), "{said}");
    };
    fs::create_dir(at("fb.loops.toml")).expect("a folder");
    refused("cannot be read");
    fs::remove_dir(at("fb.loops.toml")).expect("removed");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("nowhere", at("fb.loops.toml")).expect("a link");
        refused("it is a link that leads nowhere");
        fs::remove_file(at("fb.loops.toml")).expect("removed");
        let pipe = std::process::Command::new("mkfifo").arg(at("fb.loops.toml")).status();
        assert!(pipe.expect("mkfifo").success());
        refused("cannot be read");
    }
}

#[test]
fn a_byte_order_mark_is_no_part_of_a_file_of_loops() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let urdf = FOUR_BAR.replace("</robot>", r#"<link name="end"/><joint name="e" type="fixed"><parent link="coupler"/><child link="end"/><origin xyz="0.2 0 0"/></joint></robot>"#);
    fs::write(at("fb.urdf"), urdf).expect("written");
    fs::write(at("fb.yaml"), "\u{feff}closed_loop: [[end, rocker]]\ntype: [3d]\n")
        .expect("written");
    assert_eq!(generated(folder.path(), "fb.urdf", &[]).2, ["end"]);
    fs::write(at("fb.loops.toml"), format!("\u{feff}{TOML}")).expect("written");
    assert_eq!(generated(folder.path(), "fb.urdf", &[]).2, ["toml"]);
}

#[test]
fn loops_are_no_module_to_select() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("fb.urdf"), FOUR_BAR).expect("written");
    for word in ["loops", "loops_module"] {
        let arguments = ["generate", "fb.urdf", "-o", "out", "--modules", word];
        let (status, _, said) = urdd(&arguments, folder.path());
        let what =
            format!("`{word}` is not selected: it is made of every robot whose source says loops");
        assert!(status == 2 && said.contains(&what), "{status}: {said}");
    }
}

#[test]
fn strict_refuses_loops_that_do_not_close() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("fb.urdf"), FOUR_BAR).expect("written");
    fs::write(at("fb.loops.toml"), TOML.replace("[0.3, 0.0, 0.0]", "[9.0, 0.0, 0.0]"))
        .expect("written");
    assert_eq!(generated(folder.path(), "fb.urdf", &[]).0, 0);
    let (status, said, _) = generated(folder.path(), "fb.urdf", &["--strict"]);
    assert!(status == 1 && said.contains("no configuration was found"), "{said}");
    assert!(!at("out").exists());
}

//! `urdd picture`: a PNG of a robot.

use std::fs;
use std::path::Path;

use testkit::robots::BARS;

use crate::program::urdd;

/// The width and height in the header of a PNG, and all bytes.
fn png(file: &Path) -> ([u32; 2], Vec<u8>) {
    let bytes = fs::read(file).expect("a file");
    assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
    let side = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().expect("four bytes"));
    ([side(16), side(20)], bytes)
}

#[test]
fn a_picture_is_of_the_robot_its_configuration_and_the_viewer() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(folder.join("bars.urdf"), BARS).expect("written");
    let drawn = |arguments: &[&str]| {
        let all = [&["picture", "-o", "new.png", "--force"][..], arguments].concat();
        let (status, out, said) = urdd(&all, folder);
        assert_eq!((status, &*out, &*said), (0, "new.png\n", ""), "{arguments:?}");
        png(&folder.join("new.png"))
    };
    let (size, robot) = drawn(&["bars.urdf"]);
    assert_eq!(size, [800, 600]);
    let (status, _, said) =
        urdd(&["generate", "bars.urdf", "-o", "bars", "--modules", "plain_meshes"], folder);
    assert_eq!(status, 0, "{said}");
    assert_eq!(drawn(&["bars"]).1, robot, "of the URDD as of the URDF");
    let set = ["configurations", "set", "bars", "bent", "ab=0.7"];
    let (status, _, said) = urdd(&set, folder);
    assert_eq!(status, 0, "{said}");
    let bent = drawn(&["bars", "--configuration", "bent"]).1;
    assert_ne!(bent, robot);
    let (size, above) = drawn(&["bars.urdf", "--from", "0,0,1", "--size", "30x2048"]);
    assert_eq!(size, [30, 2048]);
    assert_ne!(above, robot);
}

#[test]
fn meshes_that_are_not_drawn_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let gone = r#"<visual><geometry><mesh filename="gone.stl"/></geometry></visual><visual>"#;
    let text = BARS.replacen(
        "<collision>",
        &format!("{gone}<geometry><box size=\"1 1 1\"/></geometry></visual><collision>"),
        1,
    );
    fs::write(folder.join("bars.urdf"), text).expect("written");
    let (status, out, said) = urdd(&["picture", "bars.urdf", "-o", "new.png"], folder);
    assert_eq!((status, &*out), (0, "new.png\n"), "{said}");
    assert!(said.starts_with("urdd: note: ") && said.contains("gone.stl"), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
}

#[test]
fn what_cannot_be_drawn_is_said_and_nothing_is_lost() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    fs::write(folder.join("bars.urdf"), BARS).expect("written");
    fs::write(folder.join("mine.png"), "mine").expect("written");
    fs::write(folder.join("bare.urdf"), r#"<robot name="bare"><link name="a"/></robot>"#)
        .expect("written");
    for (arguments, told) in [
        (&["bars.urdf", "-o", "mine.png"][..], "mine.png already exists: --force overwrites it"),
        (&["bare.urdf", "-o", "new.png"], "bare.urdf: it has no shape to draw"),
        (&["bars.urdf", "-o", "new.png", "-c", "home"], "there is no configuration `home`"),
        (&["bars.urdf", "-o", "new.png", "-c", "1,2,3,4,5,6,7"], "7 values, but the robot has"),
        (&["bars.urdf", "-o", "new.png", "-c", ""], "expected a name, or a value for each DOF"),
        (&["bars.urdf", "-o", "new.png", "--size", "0x600"], "each 1 to 2048, such as 800x600"),
        (&["bars.urdf", "-o", "new.png", "--from", "0,0,0"], "three numbers that are not all 0"),
        (&["bars.urdf", "bare.urdf", "-o", "new.png"], "a picture is of one robot; found 2 paths"),
        (&["gone", "-o", "new.png"], "gone: "),
        (&["bars.urdf", "-o", "bare.urdf/new.png"], "cannot be written"),
    ] {
        let (status, out, said) = urdd(&[&["picture"], arguments].concat(), folder);
        assert_eq!((status, &*out), (2, ""), "{arguments:?}: {said}");
        assert!(said.contains(told), "{arguments:?}: {said}");
    }
    assert_eq!(fs::read_to_string(folder.join("mine.png")).expect("a file"), "mine");
    assert!(!folder.join("new.png").exists());
}

#[test]
fn a_picture_is_written_to_standard_output() {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("bars.urdf"), BARS).expect("written");
    let to = |output: &str| {
        let arguments = ["picture", "bars.urdf", "-o", output];
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_urdd"));
        command.args(arguments).current_dir(folder.path()).output().expect("an output")
    };
    let printed = to("-");
    assert_eq!(printed.status.code(), Some(0), "{printed:?}");
    assert!(!folder.path().join("-").exists());
    assert_eq!(to("file.png").status.code(), Some(0));
    assert_eq!(printed.stdout, fs::read(folder.path().join("file.png")).expect("a file"));
}

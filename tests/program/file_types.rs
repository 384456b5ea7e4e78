//! What a file is: by its name in any letter case, or by its outermost element, in every command alike.

use std::fs;

use testkit::repository;

use crate::program::urdd;

const MJCF: &str =
    "<mujoco><worldbody><body name=\"b\"><geom size=\"1\"/></body></worldbody></mujoco>";

/// A URDF, MJCFs and SDFs of unusual names and beginnings.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let urdf = fs::read(repository().join("conformance/robots/single_link.urdf")).expect("a URDF");
    let far = format!("<!-- {} -->\n{MJCF}", "long ".repeat(2000));
    let quoted = "<robot name=\"r\"><link name=\"l\"/><!-- as <mujoco> has it --></robot>";
    for (name, bytes) in [
        ("arm.URDF", urdf.as_slice()),
        ("box.mjcf", MJCF.as_bytes()),
        ("far.xml", far.as_bytes()),
        (
            "old.xml",
            b"<gazebo version=\"1.2\"><model name=\"a\"><link name=\"l\"/></model></gazebo>",
        ),
        ("quoted.xml", quoted.as_bytes()),
    ] {
        fs::write(folder.path().join(name), bytes).expect("written");
    }
    folder
}

#[test]
fn endings_in_capitals_and_of_mujoco_are_no_part_of_the_name() {
    let folder = folder();
    for (source, carried) in [("arm.URDF", "arm.urdf"), ("box.mjcf", "box.urdf")] {
        let words = ["generate", source, "-o", "made", "--modules", "urdf", "--force"];
        let (status, _, said) = urdd(&words, folder.path());
        assert_eq!(status, 0, "{source}: {said}");
        assert!(folder.path().join("made").join(carried).is_file(), "{source}");
    }
    let (status, _, said) = urdd(&["import", "box.mjcf", "-o", "imported"], folder.path());
    assert_eq!(status, 0, "{said}");
    assert!(folder.path().join("imported/box.urdf").is_file());
}

#[test]
fn the_outermost_element_says_what_it_is_behind_any_comment() {
    let folder = folder();
    for (file, words) in [
        ("far.xml", "this is MJCF"),
        ("old.xml", "this is SDF"),
        ("quoted.xml", "this looks like a URDF"),
    ] {
        let (status, _, said) = urdd(&["validate", file], folder.path());
        assert!(status == 2 && said.contains(words), "{file}: {said}");
    }
    for file in ["far.xml", "old.xml"] {
        let (status, _, said) = urdd(&["import", file, "-o", "out", "--force"], folder.path());
        assert_eq!(status, 0, "{file}: {said}");
    }
}

/// The page chooses from a drop before it asks the program: its list is that of the program.
#[test]
fn the_page_takes_the_same_endings_for_descriptions() {
    let text = |file: &str| fs::read_to_string(repository().join(file)).expect("a source");
    let (program, page) =
        (text("crates/urdd-directory/src/file_type.rs"), text("page/src/drop.ts"));
    let pairs = program.lines().filter_map(|line| {
        let (ending, kind) = line.trim().strip_prefix("(\"")?.split_once("\", ")?;
        Some((ending, kind.strip_suffix("),")?))
    });
    let describes =
        pairs.filter(|(_, kind)| ["Xacro", "Xml", "Urdf", "Sdf", "Mjcf", "Usd"].contains(kind));
    let mut of_program: Vec<&str> = describes.map(|(ending, _)| ending).collect();
    let (_, list) = page.split_once("MAY_DESCRIBE = /\\.(?:").expect("the list of the page");
    let (list, _) = list.split_once(')').expect("an end");
    let list = list.replace("usd[acz]?", "usd|usda|usdc|usdz");
    let mut of_page: Vec<&str> = list.split('|').collect();
    of_program.sort_unstable();
    of_page.sort_unstable();
    assert!(of_program.len() > 8);
    assert_eq!(of_program, of_page);
}

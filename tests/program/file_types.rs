//! What a file is: by its name in any letter case, or by its outermost element, in every command alike.

use std::collections::BTreeSet;
use std::fs;

use testkit::repository;
use urdd_directory::limits;

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
    for (file, words) in [("far.xml", "this is MJCF"), ("old.xml", "this is SDF")] {
        let (status, _, said) = urdd(&["validate", file], folder.path());
        assert!(status == 2 && said.contains(words), "{file}: {said}");
    }
    let (status, said, _) = urdd(&["validate", "quoted.xml"], folder.path());
    assert!(status == 0 && said.contains("this is a URDF"), "{said}");
    for file in ["far.xml", "old.xml"] {
        let (status, _, said) = urdd(&["import", file, "-o", "out", "--force"], folder.path());
        assert_eq!(status, 0, "{file}: {said}");
    }
}

#[test]
fn a_urdf_is_one_by_any_name() {
    let folder = folder();
    let here = folder.path();
    for name in ["a.xml", "b.txt", "c.sdf", "d.mjcf", "e.usda", "f.zip", "g"] {
        fs::copy(here.join("arm.URDF"), here.join(name)).expect("copied");
        let (status, said, wrong) = urdd(&["validate", name], here);
        assert!(status == 0 && said.contains("this is a URDF"), "{name}: {said}{wrong}");
        let (status, said, wrong) = urdd(&["diff", name, "arm.URDF"], here);
        assert!(status == 0 && said.contains(": URDF, robot"), "{name}: {said}{wrong}");
        let site = format!("site-{name}");
        let (status, said, wrong) = urdd(&["view", name, "--export", &site], here);
        assert_eq!(status, 0, "{name}: {said}{wrong}");
        let (status, _, wrong) = urdd(&["info", name], here);
        assert!(status == 2 && wrong.contains("this is a URDF"), "{name}: {wrong}");
        let (status, _, wrong) = urdd(&["import", name, "-o", "out"], here);
        assert!(status == 2 && wrong.contains("is a URDF"), "{name}: {wrong}");
        let (status, ..) =
            urdd(&["generate", name, "-o", "made", "--modules", "urdf", "--force"], here);
        assert_eq!(status, 0, "{name}");
        let lint = urdd(&["lint", name], here);
        assert_eq!(lint.0, 0, "{name}: {lint:?}");
    }
    // In a folder, if there is none whose name says it.
    let alone = here.join("alone");
    fs::create_dir(&alone).expect("a folder");
    fs::copy(here.join("arm.URDF"), alone.join("a.xml")).expect("copied");
    let made = urdd(&["generate", "alone", "-o", "many", "--modules", "urdf"], here);
    assert_eq!(made.0, 0, "{made:?}");
    // What is no zip archive and no description stays a broken archive.
    fs::write(here.join("broken.zip"), "nothing").expect("written");
    let (status, said, wrong) = urdd(&["validate", "broken.zip"], here);
    assert!(status == 2 && (said + &wrong).contains("archive"), "{wrong}");
}

#[test]
fn what_is_imported_is_so_by_the_name_of_a_urdf_too() {
    let folder = folder();
    let here = folder.path();
    for (source, name, words) in
        [("box.mjcf", "m.urdf", "this is MJCF"), ("old.xml", "s.urdf", "this is SDF")]
    {
        fs::copy(here.join(source), here.join(name)).expect("copied");
        let (status, _, said) = urdd(&["validate", name], here);
        assert!(status == 2 && said.contains(words), "{name}: {said}");
        let (status, said, wrong) = urdd(&["diff", name, source], here);
        assert!(status < 2, "{name}: {said}{wrong}");
        let (status, _, said) = urdd(&["info", name], here);
        assert!(status == 2 && said.contains(words), "{name}: {said}");
    }
}

fn source(file: &str) -> String {
    fs::read_to_string(repository().join(file)).expect("a source")
}

/// The endings of files that the program knows by these types, or by any.
fn endings(types: &[&str]) -> BTreeSet<String> {
    let program = source("crates/urdd-directory/src/file_type.rs");
    let pairs = program.lines().filter_map(|line| {
        let (ending, kind) = line.trim().strip_prefix("(\"")?.split_once("\", ")?;
        Some((ending, kind.strip_suffix("),")?))
    });
    let found = pairs.filter(|(_, kind)| types.is_empty() || types.contains(kind));
    let found: BTreeSet<String> = found.map(|(ending, _)| ending.to_owned()).collect();
    assert!(found.len() >= types.len(), "{types:?}");
    found
}

/// What stands between quotes in a list of a source, behind these words.
fn quoted(file: &str, begin: &str) -> BTreeSet<String> {
    let text = source(file);
    let (_, list) = text.split_once(begin).unwrap_or_else(|| panic!("{file}: {begin}"));
    let (list, _) = list.split_once("];").expect("an end");
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The page chooses from a drop before it asks the program: its lists are those of the program.
#[test]
fn the_page_takes_the_same_endings() {
    let page = |list: &str| quoted("page/src/drop.ts", &format!("const {list} = ["));
    // All but what belongs to a robot, so that a new kind is not left out.
    let mut describing = endings(&[]);
    endings(&["Srdf", "Archive", "Document"]).iter().for_each(|other| {
        describing.remove(other);
    });
    assert_eq!(page("DESCRIBING"), describing);
    let of_meshes = [("MESHES"), ("SIDE_FILES")].into_iter().flat_map(|list| {
        quoted("crates/urdd-source/src/inspect.rs", &format!("const {list}: &[&str] = &["))
    });
    assert_eq!(page("OF_MESHES"), of_meshes.collect());
    // Beside those, what says what their folder is or what exports need.
    let beside: BTreeSet<String> = page("BESIDE");
    let documents = endings(&["Srdf", "Document"]).into_iter().filter(|ending| ending != "json");
    let others = ["config", "toml"].map(str::to_owned);
    assert_eq!(beside, documents.chain(others).collect());
    // Their places are known.
    let manifests = quoted("crates/urdd-source/src/files.rs", "const MANIFESTS: [&str; 2] = [");
    assert_eq!(page("MANIFESTS"), manifests);
}

/// An editor that starts the server for these files, by their names.
#[test]
fn visual_studio_code_has_the_endings_of_urdf_and_xacro() {
    let manifest: serde_json::Value =
        serde_json::from_str(&source("editors/vscode/package.json")).expect("JSON");
    let known = &manifest["contributes"]["languages"][0]["extensions"];
    let known = known.as_array().expect("a list").iter();
    let known = known.map(|ending| ending.as_str().expect("a text").trim_start_matches('.'));
    let known: BTreeSet<String> = known.map(str::to_owned).collect();
    assert_eq!(known, endings(&["Urdf", "Xacro"]));
}

/// A browser may take less than the program, and not more.
#[test]
fn the_page_takes_no_more_than_the_program() {
    let page = source("page/src/drop.ts");
    let of = |name: &str| -> u64 {
        let (_, rest) = page.split_once(&format!("const {name} = ")).expect("a limit");
        let (number, _) = rest.split_once(';').expect("an end");
        number.replace('_', "").parse().expect("a number")
    };
    assert!(of("MAX_FILES") <= limits::MAX_FILES as u64);
    assert_eq!(of("MAX_DESCRIBED"), limits::MAX_SET_FILES as u64);
    assert!(of("MAX_BYTES") <= limits::MAX_SET_BYTES.min(limits::MAX_ARCHIVE_BYTES));
}

//! Descriptions in memory are read as those on the disk.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::{Files, FolderFacts, MemoryFault, Settings, SourceError, SourceMeshes};
use urdd_directory::limits::{MAX_SET_BYTES, MAX_SET_FILES};
use urdd_directory::listing::ReadError;
use urdd_directory::source::Memory;
use urdd_xml::tally;

/// A triangle of area 1/2.
const STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
const PACKAGE: &str = "<package><name>arm_description</name></package>";

fn urdf(meshes: &[&str]) -> String {
    let visual =
        |name: &&str| format!("<visual><geometry><mesh filename=\"{name}\"/></geometry></visual>");
    let visuals: String = meshes.iter().map(visual).collect();
    format!("<robot name=\"arm\"><link name=\"base\">{visuals}</link></robot>")
}

fn memory(files: &[(&str, &str)]) -> Result<Files, MemoryFault> {
    let file = |(path, text): &(&str, &str)| ((*path).to_owned(), Arc::from(text.as_bytes()));
    Files::in_memory(files.iter().map(file))
}

fn open(files: &[(&str, &str)], path: &str) -> SourceMeshes {
    let settings = Settings { files: memory(files).expect("files"), ..Settings::default() };
    SourceMeshes::open(Path::new(path), &settings).expect("a robot")
}

#[test]
fn names_lead_where_they_lead_on_a_disk() {
    let names = [
        "../meshes/a.stl",
        "package://arm_description/meshes/a.stl",
        "file:///arm/meshes/a.stl",
        "../Meshes/a.stl",
        "../meshes/b.stl",
        "../../../etc/passwd",
    ];
    let text = urdf(&names);
    let files = [
        ("arm/package.xml", PACKAGE),
        ("arm/urdf/arm.urdf", text.as_str()),
        ("arm/meshes/a.stl", STL),
    ];
    let source = open(&files, "arm/urdf/arm.urdf");
    let found: Vec<_> = source.meshes.iter().map(|mesh| mesh.file.as_ref().ok()).collect();
    let mesh = Path::new("/arm/meshes/a.stl").to_owned();
    assert_eq!(found, [Some(&mesh), Some(&mesh), Some(&mesh), None, None, None]);
    assert_eq!(source.read(&mesh).expect("a mesh").triangle_count(), 1);
    let other = source.meshes[3].file.as_ref().expect_err("another case");
    assert_eq!(other.other_case.as_ref().expect("a file").written, "../meshes/a.stl");
    let facts = FolderFacts::new(&memory(&files).unwrap());
    assert_eq!(facts.package_name(Path::new("/arm")).as_deref(), Some("arm_description"));
}

#[test]
fn the_same_files_on_a_disk_give_the_same() {
    let text = urdf(&["../meshes/a.stl", "package://arm_description/meshes/a.stl", "c.stl"]);
    let files = [
        ("arm/package.xml", PACKAGE),
        ("arm/urdf/arm.urdf", text.as_str()),
        ("arm/meshes/a.stl", STL),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (path, text) in files {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    let of = |source: &SourceMeshes, root: &Path| {
        let file = |mesh: &crate::SourceMesh| {
            let file = mesh.file.as_ref().ok();
            file.map(|file| file.strip_prefix(root).expect("inside").to_owned())
        };
        source.meshes.iter().map(file).collect::<Vec<_>>()
    };
    let path = folder.path().join("arm/urdf/arm.urdf");
    let on_disk = SourceMeshes::open(&path, &Settings::default());
    let on_disk = on_disk.expect("a robot");
    let in_memory = open(&files, "arm/urdf/arm.urdf");
    let root = folder.path().canonicalize().unwrap();
    assert_eq!(of(&on_disk, &root), of(&in_memory, Path::new("/")));
    assert_eq!(on_disk.robot, in_memory.robot);
}

/// The file of each name, or the reason why there is none.
fn places(names: &[&str], files: &[(&str, &str)], path: &str) -> Vec<Result<String, String>> {
    let text = urdf(names);
    let all: Vec<(&str, &str)> =
        [(path, text.as_str())].into_iter().chain(files.to_vec()).collect();
    let meshes = open(&all, path).meshes.into_iter();
    let place = |mesh: crate::SourceMesh| match mesh.file {
        Ok(file) => Ok(file.display().to_string()),
        Err(why) => Err(why.reason),
    };
    meshes.map(place).collect()
}

#[test]
fn a_package_without_a_name_is_the_folder_of_the_urdf() {
    let names = [
        "package://a.stl",
        "package:///a.stl",
        "package:////a.stl",
        "model://a.stl",
        "PACKAGE://a.stl",
        "package://./a.stl",
        "package://../b.stl",
        "package:///meshes/c.stl",
        "package://meshes/c.stl",
        "package://./meshes/c.stl",
        "package:///b.stl",
        "package:///../b.stl",
        "package://a%2Estl",
        r"package:\\\a.stl",
    ];
    let files = [("bot/urdf/a.stl", STL), ("bot/b.stl", STL), ("bot/meshes/c.stl", STL)];
    let found = places(&names, &files, "bot/urdf/r.urdf");
    let [a, b, c] = ["/bot/urdf/a.stl", "/bot/b.stl", "/bot/meshes/c.stl"];
    let wanted = [a, a, a, a, a, a, b, c, c, c, b, b, a, a];
    let wanted: Vec<_> = wanted.map(|path| Ok(path.to_owned())).into();
    assert_eq!(found, wanted);
}

#[test]
fn a_package_is_first_looked_for_by_its_name() {
    // Both the package `arm` beside the robot's, and a folder `arm` that is not above.
    let files = [("arm/package.xml", PACKAGE), ("arm/a.stl", STL), ("bot/urdf/arm/a.stl", STL)];
    let names = ["package:///arm_description/a.stl", "package:///arm/a.stl"];
    let found = places(&names, &files, "bot/urdf/r.urdf");
    assert_eq!(found, [Ok("/arm/a.stl".to_owned()), Ok("/bot/urdf/arm/a.stl".to_owned())]);
}

#[test]
fn a_package_may_be_the_folder_that_the_urdf_is_in() {
    let files = [("top/bot/meshes/a.stl", STL), ("top/bot/urdf/b.stl", STL)];
    let names =
        ["package://bot/meshes/a.stl", "package://top/bot/meshes/a.stl", "package://urdf/b.stl"];
    let found = places(&names, &files, "top/bot/urdf/r.urdf");
    let [a, b] = ["/top/bot/meshes/a.stl", "/top/bot/urdf/b.stl"].map(|path| Ok(path.to_owned()));
    assert_eq!(found, [a.clone(), a, b]);
}

#[test]
fn a_package_without_a_name_is_said() {
    let found = places(&["package://a.stl", "package://"], &[], "bot/urdf/r.urdf");
    for (found, tried) in found.iter().zip(["tried /bot/urdf/a.stl, /bot/a.stl", "tried /bot/urdf"])
    {
        let said = found.as_ref().expect_err("nothing there");
        assert!(said.contains(tried), "{said}");
        assert!(said.contains("the name has no package; write `package://NAME/PATH`"), "{said}");
    }
    let found = places(&["package:///meshes/a.stl"], &[], "bot/urdf/r.urdf");
    let said = found[0].as_ref().expect_err("nothing there");
    assert!(said.contains("/bot/meshes/a.stl") && said.contains("has no package"), "{said}");
}

#[test]
fn a_package_without_a_name_leads_to_no_file_outside() {
    let folder = tempfile::tempdir().unwrap();
    let put = |path: &str, text: &str| {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    put("secret.stl", STL);
    put("bot/r.urdf", &urdf(&["package://secret.stl", "package://../secret.stl"]));
    let path = folder.path().join("bot/r.urdf");
    let source = SourceMeshes::open(&path, &Settings::default());
    let source = source.expect("a robot");
    let [above, named] = &source.meshes[..] else { panic!("two meshes") };
    // Nothing above the robot's folder is looked at, unless a name leads there.
    assert!(above.file.as_ref().expect_err("outside").outside.is_none());
    assert!(named.file.as_ref().expect_err("outside").outside.is_some());
}

#[test]
fn a_set_has_bounds_and_no_path_out_of_it() {
    for path in ["", "..", "../a", "a/../../b", "."] {
        assert_eq!(memory(&[(path, "")]).unwrap_err(), MemoryFault::Path(path.to_owned()));
    }
    let files = memory(&[("a/./b/../c.stl", "1234")]).unwrap();
    let at = |path: &str| files.read(Path::new(path), 4).map_err(|error| error.to_string());
    assert_eq!(at("/a/c.stl").unwrap(), b"1234");
    assert_eq!(at("a/c.stl").unwrap(), b"1234");
    assert_eq!(at("a").unwrap_err(), ReadError::NotAFile.to_string());
    assert_eq!(at("b").unwrap_err(), ReadError::Missing.to_string());
    assert_eq!(files.read(Path::new("a/c.stl"), 3), Err(ReadError::TooLong { limit: 3 }));
    assert!(files.is_dir(Path::new("/a")) && !files.is_dir(Path::new("/a/c.stl")));
    assert_eq!(files.names(Path::new("/")), ["a"]);
    let of = |all: &mut dyn Iterator<Item = (String, u64)>| Files::of(Memory::default(), "", all);
    let mut many = (0..=MAX_SET_FILES).map(|k| (k.to_string(), 0));
    assert_eq!(of(&mut many).unwrap_err(), MemoryFault::TooMany);
    let mut large = [MAX_SET_BYTES, 1].map(|size| (size.to_string(), size)).into_iter();
    assert_eq!(of(&mut large).unwrap_err(), MemoryFault::TooLarge);
}

#[test]
fn xacro_does_not_run_on_a_set() {
    let settings =
        Settings { files: memory(&[("a.xacro", "<robot/>")]).unwrap(), ..Settings::default() };
    let error = SourceMeshes::open(Path::new("a.xacro"), &settings).unwrap_err();
    assert!(matches!(error, SourceError::NoXacro { .. }), "{error}");
}

/// Of files that were dropped singly: where each name leads.
fn searched(files: &[(&str, &str)], lost: &[&str], path: &str) -> Vec<Option<String>> {
    let files = memory(files).expect("files");
    let lost = |file: &Path| lost.iter().any(|lost| Path::new("/").join(lost) == file);
    let settings = Settings { files: files.searched(lost), ..Settings::default() };
    let source = SourceMeshes::open(Path::new(path), &settings).expect("a robot");
    let file = |mesh: &crate::SourceMesh| Some(mesh.file.as_ref().ok()?.display().to_string());
    source.meshes.iter().map(file).collect()
}

#[test]
fn lost_files_are_found_by_their_last_names_and_others_by_names_that_lead_out() {
    let names = [
        "meshes/lost.stl",
        "../meshes/lost.stl",
        "file:///home/me/arm/meshes/known.stl",
        "meshes/known.stl",
        "../../../../twice.stl",
        "/somewhere/b/twice.stl",
        "meshes/none.stl",
    ];
    let text = urdf(&names);
    let files = [
        ("arm/urdf/arm.urdf", text.as_str()),
        ("lost.stl", STL),
        ("arm/meshes/known.stl", STL),
        ("a/twice.stl", STL),
        ("b/twice.stl", STL),
    ];
    let found = searched(&files, &["lost.stl"], "arm/urdf/arm.urdf");
    let known = Some("/arm/meshes/known.stl".to_owned());
    let lost = Some("/lost.stl".to_owned());
    let twice = Some("/b/twice.stl".to_owned());
    assert_eq!(found, [lost.clone(), lost, known, None, None, twice, None]);
    // Where nothing is searched, all is as on a disk.
    let source = open(&files, "arm/urdf/arm.urdf");
    assert!(source.meshes.iter().all(|mesh| mesh.file.is_err()));
}

#[test]
fn manifests_are_never_searched() {
    let files = [("arm.urdf", "<robot name='r'/>"), ("package.xml", PACKAGE), ("b/x.stl", STL)];
    let files = memory(&files).expect("files").searched(|_| true);
    let facts = FolderFacts::new(&files);
    assert_eq!(facts.package_name(Path::new("/b")), None);
    assert_eq!(facts.package_name(Path::new("/")).as_deref(), Some("arm_description"));
}

#[test]
fn what_is_elsewhere_is_asked_for_when_it_is_needed() {
    static ASKED: AtomicUsize = AtomicUsize::new(0);
    let asked = || ASKED.load(Ordering::Relaxed);
    let memory = Memory::empty("", |path| {
        ASKED.fetch_add(1, Ordering::Relaxed);
        Ok((path == "a.stl").then(|| Arc::from(STL.as_bytes())))
    });
    let (text, size) = (urdf(&["a.stl"]), STL.len() as u64);
    memory.give("arm.urdf", text.as_bytes());
    memory.name("a.stl", size);
    memory.name("none.stl", size);
    let all = [("arm.urdf", text.len() as u64), ("a.stl", size), ("none.stl", size)];
    let all = all.map(|(path, size)| (path.to_owned(), size));
    let files = Files::of(memory, "bot", all).unwrap();
    let settings = Settings { files, ..Settings::default() };
    let source = SourceMeshes::open(Path::new("bot/arm.urdf"), &settings).unwrap();
    let mesh = source.meshes[0].file.as_ref().expect("a file");
    assert_eq!((mesh.as_path(), asked()), (Path::new("/bot/a.stl"), 0));
    assert_eq!(source.read(mesh).expect("a mesh").triangle_count(), 1);
    assert_eq!(asked(), 1);
    assert_eq!(settings.files.read(mesh, 10), Err(ReadError::TooLong { limit: 10 }));
    assert_eq!(asked(), 1);
    let none = settings.files.read(Path::new("bot/none.stl"), size).unwrap_err();
    assert_eq!(none.to_string(), "it cannot be read: its bytes are not there yet");
}

#[test]
fn a_clean_urdf_is_parsed_once() {
    tally::take();
    open(&[("arm.urdf", &urdf(&[]))], "arm.urdf");
    assert_eq!(tally::take(), [("roxmltree", 1)].into());
}

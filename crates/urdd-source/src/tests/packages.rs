//! Packages as they are installed, and what the files of a folder are.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use urdd_directory::cancellation::Cancellation;
use urdd_xml::Xml;

use crate::described::{Description, FileKind, Reason, describe};
use crate::macros::has_no_link;
use crate::package_index::PackageIndex;
use crate::robots::{BatchError, find, jobs};
use crate::{Files, Packages, Settings};

const XACRO: &str = "xmlns:xacro=\"http://www.ros.org/wiki/xacro\"";

pub fn memory(files: &[(&str, &str)]) -> Files {
    let file = |(path, text): &(&str, &str)| ((*path).to_owned(), Arc::from(text.as_bytes()));
    Files::in_memory(files.iter().map(file)).expect("files")
}

fn index(packages: &Packages, file: &Path) -> PackageIndex {
    PackageIndex::new(packages, file, &Cancellation::default()).expect("an index")
}

fn described(files: &[(&str, &str)]) -> Description {
    let paths: Vec<PathBuf> = files.iter().map(|(path, _)| Path::new("/").join(path)).collect();
    let settings = Settings { files: memory(files), ..Settings::default() };
    describe(&paths, &BTreeMap::from([("p".to_owned(), PathBuf::from("/p"))]), &settings)
}

fn robot(content: &str) -> String {
    format!("<robot name=\"r\" {XACRO}>{content}</robot>")
}

#[test]
fn the_text_tells_robots_from_parts() {
    let link = "<link name=\"a\"/>";
    let files = [
        (
            "p/arm_macro.xacro",
            robot(&format!(
                "<xacro:macro name=\"arm\" params=\"p\">{link}</xacro:macro><xacro:macro name=\"wrap\"><xacro:arm/></xacro:macro>"
            )),
        ),
        (
            "p/arm.urdf.xacro",
            robot(
                "<xacro:arg name=\"p\"/><xacro:include filename=\"$(find p)/arm_macro.xacro\"/><xacro:wrap/>",
            ),
        ),
        ("p/whole.xacro", robot(&format!("<xacro:if value=\"$(arg p)\">{link}</xacro:if>"))),
        ("p/again.xacro", robot("<xacro:include filename=\"whole.xacro\"/>")),
        ("p/gazebo.xacro", robot("<gazebo/><material name=\"m\"/>")),
        ("p/control.xacro", robot("<xacro:macro name=\"control\"><ros2_control/></xacro:macro>")),
        (
            "p/calls_control.xacro",
            robot("<xacro:include filename=\"control.xacro\"/><xacro:control/>"),
        ),
        ("p/part.xacro", robot("<xacro:of_the_file_that_includes_this/>")),
        (
            "p/elsewhere.xacro",
            robot("<xacro:include filename=\"$(find other)/a.xacro\"/><xacro:made_there/>"),
        ),
        (
            "p/library.xacro",
            robot("<xacro:include filename=\"$(find other)/a.xacro\"/><xacro:macro name=\"m\"/>"),
        ),
        ("p/arm.srdf.xacro", robot("<group name=\"g\"><link name=\"a\"/></group>")),
        (
            "p/unknown.srdf.xacro",
            robot("<xacro:include filename=\"$(find other)/a.xacro\"/><xacro:made_there/>"),
        ),
        (
            "p/circle_a.xacro",
            robot(
                "<xacro:include filename=\"circle_b.xacro\"/><xacro:macro name=\"ca\"><xacro:cb/></xacro:macro>",
            ),
        ),
        (
            "p/circle_b.xacro",
            robot(
                "<xacro:include filename=\"circle_a.xacro\"/><xacro:macro name=\"cb\"><xacro:ca/></xacro:macro>",
            ),
        ),
        ("p/empty.urdf", "<robot name=\"r\"/>".to_owned()),
        ("p/no_link.urdf", "<robot name=\"r\"><material name=\"m\"/></robot>".to_owned()),
        ("p/launch.xacro", "<launch/>".to_owned()),
        ("p/broken.xacro", robot("<link>")),
    ];
    let files: Vec<(&str, &str)> = files.iter().map(|(path, text)| (*path, &**text)).collect();
    let found = described(&files);
    let kind = |name: &str| {
        let path = Path::new("/p").join(name);
        found.files.iter().find(|file| file.path == path).expect("it is listed").kind.clone()
    };
    let names = |wanted: FileKind| -> Vec<&str> {
        let names = files.iter().map(|(path, _)| &path[2..]);
        names.filter(|name| kind(name) == wanted).collect()
    };
    let robots = [
        "arm.urdf.xacro",
        "whole.xacro",
        "again.xacro",
        "elsewhere.xacro",
        "empty.urdf",
        "no_link.urdf",
    ];
    assert_eq!(names(FileKind::Robot), robots);
    let parts = [
        "arm_macro.xacro",
        "gazebo.xacro",
        "control.xacro",
        "calls_control.xacro",
        "part.xacro",
        "library.xacro",
        "circle_a.xacro",
        "circle_b.xacro",
    ];
    assert_eq!(names(FileKind::Fragment), parts);
    assert_eq!(kind("arm.srdf.xacro"), FileKind::Neither(Reason::Srdf));
    assert_eq!(kind("unknown.srdf.xacro"), FileKind::Neither(Reason::Srdf));
    assert_eq!(kind("launch.xacro"), FileKind::Neither(Reason::Root("launch".into())));
    assert!(matches!(kind("broken.xacro"), FileKind::Neither(Reason::Unreadable(_))));
    // The circle calls itself, and nothing calls it.
    let uncalled: Vec<&str> = found.uncalled.iter().map(|(_, one)| one.name.as_str()).collect();
    assert_eq!(uncalled, ["m", "ca", "cb"]);
    let elsewhere = robot("<xacro:macro name=\"for_others\"/>");
    let robot_of_p = robot("<link name=\"a\"/>");
    let files = [("p/robot.xacro", &*robot_of_p), ("q/library.xacro", &*elsewhere)];
    assert_eq!(described(&files).uncalled, []);
    // `again.xacro` includes `whole.xacro`; `arm_macro.xacro` is a part by its text.
    let parts = found.files.iter().map(|file| file.path.as_path());
    let parts: Vec<&Path> = parts.filter(|path| found.may_be_part(path)).collect();
    assert_eq!(parts, [Path::new("/p/whole.xacro")]);
}

/// A file that another one names is read in its package alone: not beside it, and not through a link that leads out of it.
#[cfg(unix)]
#[test]
fn files_outside_of_the_package_are_not_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |path: &str, text: &str| {
        let path = folder.path().join(path);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(&path, text).expect("written");
        path
    };
    let links = robot("<link name=\"a\"/>");
    write("p/package.xml", "<package><name>p</name></package>");
    write("p/parts/links.xacro", &links);
    let secret = write("secret/links.xacro", &links);
    std::os::unix::fs::symlink(&secret, folder.path().join("p/parts/out.xacro")).expect("a link");
    // A file with macros of its own is a part, unless it is known to make a link.
    let including = |name: &str| {
        let text = format!("<xacro:include filename=\"{name}\"/><xacro:macro name=\"m\"/>");
        let path = write("p/urdf/it.xacro", &robot(&text));
        describe(&[path], &BTreeMap::new(), &Settings::default()).files[0].kind.clone()
    };
    assert_eq!(including("../parts/links.xacro"), FileKind::Robot);
    assert_eq!(including("../../secret/links.xacro"), FileKind::Fragment);
    assert_eq!(including("../parts/out.xacro"), FileKind::Fragment);
    assert_eq!(including(&secret.display().to_string()), FileKind::Fragment);
}

#[test]
fn macros_of_computed_names_may_call_anything_and_a_library_calls_nothing() {
    let library = robot("<xacro:macro name=\"a\"><link name=\"a\"/></xacro:macro>");
    assert_eq!(described(&[("p/a.xacro", &library)]).uncalled, []);
    let computed = robot("<link name=\"b\"/><xacro:call macro=\"${x}\"/>");
    assert_eq!(described(&[("p/a.xacro", &library), ("p/b.xacro", &computed)]).uncalled, []);
    let plain = robot("<link name=\"b\"><xacro:ns.a/></link>");
    assert_eq!(described(&[("p/a.xacro", &library), ("p/b.xacro", &plain)]).uncalled, []);
}

#[test]
fn an_expansion_without_a_link_is_no_robot() {
    assert!(has_no_link(&Xml::new("<robot name=\"r\"><gazebo/></robot>")));
    assert!(!has_no_link(&Xml::new("<robot name=\"r\"><link name=\"a\"/></robot>")));
    assert!(!has_no_link(&Xml::new("<robot name=\"r\">")));
}

fn put(folder: &Path, files: &[(&str, &str)]) {
    for (path, text) in files {
        let path = folder.join(path);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, text).expect("written");
    }
}

fn manifest(name: &str) -> String {
    format!("<package><name>{name}</name></package>")
}

/// What `$(find NAME)` is: the first prefix that has it, as ament does.
fn share(index: &PackageIndex, name: &str) -> Option<PathBuf> {
    let mut command = Command::new("xacro");
    index.tell(&mut command, &[]);
    let variable = command.get_envs().find(|(name, _)| *name == "AMENT_PREFIX_PATH");
    let prefixes = variable.and_then(|(_, value)| value).expect("it is set").to_owned();
    let found = std::env::split_paths(&prefixes).find(|prefix| {
        prefix.join("share/ament_index/resource_index/packages").join(name).exists()
    });
    Some(found?.join("share").join(name))
}

#[test]
#[cfg(unix)]
fn find_leads_to_the_tree_as_it_is_installed() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path().canonicalize().expect("a path");
    let (demo, other) = (manifest("demo"), manifest("other"));
    put(
        &root,
        &[
            ("ws/src/repo/demo/package.xml", &demo),
            (
                "ws/src/repo/demo/CMakeLists.txt",
                "project(demo)\ninstall(DIRECTORY d/ros2_control d/urdf DESTINATION share/${PROJECT_NAME})\ninstall(FILES d/x.yaml DESTINATION share/${PROJECT_NAME}/urdf)",
            ),
            ("ws/src/repo/demo/d/ros2_control/a.xacro", "<robot/>"),
            ("ws/src/repo/demo/d/urdf/b.xacro", "<robot/>"),
            ("ws/src/repo/demo/d/x.yaml", "x"),
            ("ws/src/repo/demo/meshes/m.stl", "m"),
            ("ws/src/deep/er/other/package.xml", &other),
            ("ws/src/deep/er/other/c.xacro", "<robot/>"),
            ("ws/src/ignored/third/package.xml", &manifest("third")),
            ("ws/src/ignored/COLCON_IGNORE", ""),
        ],
    );
    let file = root.join("ws/src/repo/demo/d/urdf/b.xacro");
    let index = index(&Packages::none(), &file);
    let share = |name| share(&index, name);
    let at = share("demo").expect("demo");
    for path in ["ros2_control/a.xacro", "urdf/b.xacro", "urdf/x.yaml", "meshes/m.stl", "d/x.yaml"]
    {
        assert!(at.join(path).is_file(), "{path}");
    }
    assert!(share("other").expect("a package of another repository").join("c.xacro").is_file());
    assert_eq!(share("third"), None);
    // What xacro writes outlives the layout.
    let text = format!(
        "<m f=\"file://{0}/meshes/m.stl\"/> <m f=\"file:///{0}/meshes/m.stl\"/> {0}/ros2_control/a.xacro, {0}/none",
        at.display()
    );
    let demo = root.join("ws/src/repo/demo");
    let expected = format!(
        "<m f=\"package://demo/meshes/m.stl\"/> <m f=\"package://demo/meshes/m.stl\"/> {0}/d/ros2_control/a.xacro, {0}/none",
        demo.display()
    );
    assert_eq!(index.lasting(&text), expected);
}

#[test]
#[cfg(unix)]
fn paths_of_installed_packages_are_theirs_and_those_of_the_machine_stay() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path().canonicalize().expect("a path");
    put(
        &root,
        &[
            ("install/share/ament_index/resource_index/packages/arm", ""),
            ("install/share/arm/package.xml", &manifest("arm")),
            ("install/share/arm/meshes/m.stl", "m"),
            ("robot/r.xacro", "<robot/>"),
        ],
    );
    let packages = Packages::from_environment(|name| {
        (name == "AMENT_PREFIX_PATH").then(|| root.join("install").into())
    });
    let index = index(&packages, &root.join("robot/r.xacro"));
    let at = share(&index, "arm").expect("arm");
    let machine = format!("file://{}/install/share/arm/meshes/m.stl", root.display());
    let text = format!("file://{}/meshes/m.stl {machine}", at.display());
    assert_eq!(index.lasting(&text), format!("package://arm/meshes/m.stl {machine}"));
}

#[test]
fn folders_say_what_they_have() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path();
    let part = robot("<xacro:macro name=\"m\"><link name=\"a\"/></xacro:macro>");
    put(root, &[("a/macros.xacro", &part), ("a/more.urdf.xacro", &part)]);
    let settings = Settings::default();
    let error = jobs(&[root.to_owned()], &settings).expect_err("parts alone");
    assert!(matches!(error, BatchError::OnlyParts { files: 2, .. }), "{error}");
    assert_eq!(find(&[root.to_owned()], &settings).expect("found").jobs, []);
    put(
        root,
        &[
            ("a/package.xml", &manifest("p")),
            ("b/package.xml", &manifest("p")),
            ("a/robot.xacro", &robot("<link name=\"a\"/>")),
            ("a/robot.srdf.xacro", &robot("<group name=\"a\"/>")),
            ("a/passive.xacro", &robot("<passive_joint name=\"a\"/>")),
            ("install/COLCON_IGNORE", ""),
            ("install/robot.urdf", "<robot name=\"r\"><link name=\"a\"/></robot>"),
        ],
    );
    let batch = find(&[root.to_owned()], &settings).expect("found");
    let names: Vec<&str> = batch.jobs.iter().map(|job| job.name.as_str()).collect();
    assert_eq!(names, ["robot"]);
    let asides = batch.asides(1);
    let [parts, srdfs, macros, packages] = &asides[..] else { panic!("{asides:?}") };
    assert_eq!(parts, "3 files define macros or other parts, and no robot");
    assert_eq!(srdfs, "2 files make SRDFs");
    assert!(macros.contains("`m` (") && macros.contains("macros.xacro:1)"), "{macros}");
    assert!(packages.starts_with("2 packages are named `p`: "), "{packages}");
}

#[test]
fn what_is_included_by_default_is_a_part() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path();
    let main = |include: &str| {
        robot(&format!(
            "<xacro:arg name=\"file\" default=\"empty.urdf\"/><xacro:property name=\"other\" value=\"$(arg file)\"/><link name=\"a\"/><xacro:include filename=\"{include}\"/>"
        ))
    };
    for (include, is_part) in [
        ("empty.urdf", true),
        ("$(optenv EXTRAS empty.urdf)", true),
        ("$(arg file)", true),
        ("${other}", true),
        ("$(dirname)/empty.urdf", true),
        ("$(optenv EXTRAS)", false),
        ("$(arg unknown)", false),
        ("$(arg", false),
    ] {
        put(
            root,
            &[
                ("urdf/arm.urdf.xacro", &main(include)),
                ("urdf/empty.urdf", "<robot><!-- a place --></robot>"),
            ],
        );
        let batch = find(&[root.to_owned()], &Settings::default()).expect("found");
        let empty = root.join("urdf/empty.urdf");
        assert_eq!(batch.description.may_be_part(&empty), is_part, "{include}");
        let error = crate::load(&empty, &Settings::default()).expect_err("no robot");
        assert_eq!(batch.is_part(&empty, &error), is_part, "{include}: {error}");
    }
}

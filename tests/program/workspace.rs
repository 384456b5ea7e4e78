//! Packages and workspaces of ROS 2, as `lint`, `generate` and `view` take them.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use testkit::site::{json, named};

const ROBOT: &str = "<robot name='r'><link name='a'/></robot>";
const OPEN: &str = "<robot name='c'><link name='c'/><joint name='j' type='fixed'><parent link='a'/><child link='c'/></joint></robot>";
const XACRO: &str = "xmlns:xacro='http://www.ros.org/wiki/xacro'";

fn put(folder: &Path, path: &str, text: &str) {
    let path = folder.join(path);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, text).unwrap();
}

fn robot(content: &str) -> String {
    format!("<robot name='r' {XACRO}>{content}</robot>")
}

/// Runs the program with a xacro that makes a robot of `robot*.xacro`, a robot without links of `thin.xacro`, one without a
/// name of `add_on.xacro`, one with an open end of `camera.xacro`, one of `asks.xacro` where the package `far` is found, and fails for anything else.
fn urdd(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let script = format!(
        "#!/bin/sh\nfor it in \"$@\"; do case \"$it\" in */robot*.xacro) echo \"{ROBOT}\"; exit 0;; */thin.xacro) echo \"<robot name='t'><gazebo/></robot>\"; exit 0;; */add_on.xacro) echo \"<robot><link name='a'/></robot>\"; exit 0;; */camera.xacro) echo \"{OPEN}\"; exit 0;; */asks.xacro) IFS=:; for p in $AMENT_PREFIX_PATH; do [ ! -f \"$p/share/far/package.xml\" ] || {{ echo \"{ROBOT}\"; exit 0; }}; done;; esac; done\necho 'error: it failed' >&2; exit 3\n"
    );
    put(folder, "bin/xacro", &script);
    fs::set_permissions(folder.join("bin/xacro"), fs::Permissions::from_mode(0o755)).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
    command.args(arguments).current_dir(folder).env("PATH", folder.join("bin"));
    for variable in ["AMENT_PREFIX_PATH", "ROS_PACKAGE_PATH"] {
        command.env_remove(variable);
    }
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

/// A robot, its macros, an SRDF, and a file of which only the expansion says that it has no link.
fn package(folder: &Path) {
    put(folder, "ws/src/p/package.xml", "<package><name>p</name></package>");
    let arm = "<xacro:macro name='arm'><link name='a'/></xacro:macro><xacro:macro name='leg'/>";
    put(folder, "ws/src/p/urdf/arm.urdf.xacro", &robot(arm));
    let uses = "<xacro:include filename='$(find p)/urdf/arm.urdf.xacro'/><xacro:arm/>";
    put(folder, "ws/src/p/urdf/robot.xacro", &robot(uses));
    put(folder, "ws/src/p/urdf/materials.xacro", &robot("<material name='m'/>"));
    put(folder, "ws/src/p/urdf/r.srdf.xacro", &robot("<group name='g'/>"));
    put(
        folder,
        "ws/src/p/urdf/thin.xacro",
        &robot("<xacro:if value='$(arg no)'><link name='b'/></xacro:if>"),
    );
}

#[test]
fn parts_of_robots_are_counted_and_fail_nothing() {
    let folder = testkit::temporary::folder();
    package(folder.path());
    let (status, said, asides) =
        urdd(folder.path(), &["lint", "ws", "--xacro", "--format", "json"]);
    assert_eq!(status, Some(0), "{said}{asides}");
    let report: Value = serde_json::from_str(&said).unwrap();
    let paths: Vec<&str> = report["urdds"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one["path"].as_str().unwrap())
        .collect();
    assert_eq!(paths, ["src/p/urdf/robot.xacro"]);
    for line in
        ["3 files define macros", "1 file makes an SRDF", "`leg` (ws/src/p/urdf/arm.urdf.xacro:1)"]
    {
        assert!(asides.contains(line), "{line} in {asides}");
    }
    // A file that somebody names is to be a robot.
    let named = urdd(folder.path(), &["lint", "ws/src/p/urdf/thin.xacro", "--format", "json"]);
    assert_eq!(named.0, Some(1), "{}", named.1);
    let (status, said, asides) =
        urdd(folder.path(), &["generate", "ws/src/p", "-o", "out", "--modules", "core"]);
    assert_eq!(status, Some(0), "{said}{asides}");
    assert!(folder.path().join("out/robot/urdd.json").is_file(), "{said}{asides}");
    assert!(
        !folder.path().join("out/arm").exists() && asides.contains("3 files define macros"),
        "{asides}"
    );
}

#[test]
fn files_that_are_declared_or_named_are_no_parts() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    package(root);
    // Xacro fails for a file that another one includes.
    put(root, "ws/src/p/urdf/half.xacro", &robot("<link name='h'/>"));
    let uses = robot("<xacro:include filename='half.xacro'/><link name='c'/>");
    put(root, "ws/src/p/urdf/robot_two.xacro", &uses);
    let run = |words: &[&str]| {
        let _ = fs::remove_dir_all(root.join("out"));
        let (status, said, asides) = urdd(root, words);
        (status, said + &asides)
    };
    let lint = ["lint", "--xacro", "ws"];
    let generate = ["generate", "-o", "out", "--modules", "core", "ws"];
    for command in [&lint[..], &generate[..]] {
        let (status, said) = run(command);
        assert!(status == Some(0) && said.contains("4 files define macros"), "{said}");
        for name in ["thin", "half"] {
            let file = format!("ws/src/p/urdf/{name}.xacro");
            let other = format!("./{file}");
            put(root, "robots.toml", &format!("[[robot]]\npath = \"{file}\"\n"));
            for more in [&["--config", "robots.toml"][..], &[&*file][..], &[&*other][..]] {
                let (status, said) = run(&[command, more].concat());
                assert_eq!(status, Some(1), "{more:?}: {said}");
                assert!(said.contains("3 files define macros"), "{more:?}: {said}");
            }
        }
    }
}

#[test]
fn a_nameless_file_that_another_includes_is_a_part() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    package(root);
    put(root, "ws/src/p/urdf/add_on.xacro", &robot("<link name='h'/>"));
    let lint = ["lint", "--xacro", "ws"];
    // By itself, its name may have been forgotten.
    let (status, said, asides) = urdd(root, &lint);
    assert_eq!(status, Some(1), "{said}{asides}");
    let uses = robot("<xacro:include filename='add_on.xacro'/><link name='c'/>");
    put(root, "ws/src/p/urdf/robot_two.xacro", &uses);
    let (status, said, asides) = urdd(root, &lint);
    assert!(status == Some(0) && asides.contains("4 files define macros"), "{said}{asides}");
}

#[test]
fn a_file_with_open_ends_that_another_includes_is_a_part() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    package(root);
    put(root, "ws/src/p/urdf/camera.xacro", &robot("<link name='c'/>"));
    let lint = ["lint", "--xacro", "ws"];
    // By itself, a link may have been forgotten.
    let (status, said, asides) = urdd(root, &lint);
    assert!(status == Some(1) && said.contains("URD007"), "{said}{asides}");
    let uses = "<link name='a'/><xacro:include filename='camera.xacro'/>";
    put(root, "ws/src/p/urdf/robot_two.xacro", &robot(uses));
    let (status, said, asides) = urdd(root, &lint);
    assert!(status == Some(0) && asides.contains("4 files define macros"), "{said}{asides}");
    let make = ["generate", "ws", "-o", "out", "--modules", "core"];
    let (status, said, asides) = urdd(root, &make);
    assert!(status == Some(0) && asides.contains("4 files define macros"), "{said}{asides}");
    // A whole one is a robot, whoever includes it.
    let uses = "<xacro:include filename='robot.xacro'/>";
    put(root, "ws/src/p/urdf/robot_three.xacro", &robot(uses));
    let (_, said, asides) = urdd(root, &lint);
    assert!(said.contains("3 URDFs"), "{said}{asides}");
}

#[test]
fn a_package_of_macros_alone_has_no_finding_and_nothing_to_make() {
    let folder = testkit::temporary::folder();
    put(folder.path(), "p/a.xacro", &robot("<xacro:macro name='a'><link name='a'/></xacro:macro>"));
    let (status, said, asides) = urdd(folder.path(), &["lint", "p", "--xacro"]);
    assert_eq!(status, Some(0), "{said}{asides}");
    assert!(
        asides.contains("1 file defines macros") && !asides.contains("no robot here calls"),
        "{asides}"
    );
    let (status, _, said) = urdd(folder.path(), &["generate", "p", "-o", "out"]);
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("there is no robot"), "{said}");
}

#[test]
fn a_folder_that_colcon_passes_over_is_named_where_there_is_nothing_else() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    package(root);
    put(root, "ws/src/p/CATKIN_IGNORE", "");
    let (status, _, said) = urdd(root, &["lint", "--xacro", "ws"]);
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("`ws/src/p` has a file `CATKIN_IGNORE`; give that folder"), "{said}");
    let (status, said, asides) = urdd(root, &["lint", "--xacro", "ws/src/p"]);
    assert_eq!(status, Some(0), "{said}{asides}");
}

#[test]
fn packages_that_go_in_circles_get_an_answer() {
    let folder = testkit::temporary::folder();
    let count = 500;
    for k in 0..count {
        let next = (k + 1) % count;
        put(
            folder.path(),
            &format!("ws/src/p{k}/package.xml"),
            &format!("<package><name>p{k}</name></package>"),
        );
        let text = format!(
            "<xacro:include filename='$(find p{next})/a.xacro'/><xacro:include filename='$(find none{k})/b.xacro'/><xacro:macro name='m{k}'><xacro:m{next}/></xacro:macro>"
        );
        put(folder.path(), &format!("ws/src/p{k}/a.xacro"), &robot(&text));
    }
    put(folder.path(), "ws/src/twin/package.xml", "<package><name>p7</name></package>");
    put(folder.path(), "ws/src/twin/robot.xacro", &robot("<link name='a'/><xacro:m1/>"));
    let begun = std::time::Instant::now();
    let (status, said, asides) = urdd(folder.path(), &["lint", "ws", "--xacro"]);
    assert_eq!(status, Some(0), "{said}{asides}");
    for line in ["500 files define macros", "2 packages are named `p7`"] {
        assert!(asides.contains(line), "{line} in {asides}");
    }
    assert!(!asides.contains("no robot here calls"), "each macro calls the next one: {asides}");
    assert!(begun.elapsed().as_secs() < 60);
}

#[test]
fn a_site_shows_the_robots_that_could_be_made() {
    let folder = testkit::temporary::folder();
    package(folder.path());
    put(folder.path(), "ws/src/p/urdf/broken.xacro", &robot("<link name='a'/>"));
    let (status, _, said) = urdd(folder.path(), &["view", "ws", "--xacro", "--export", "site"]);
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("broken") && said.contains("could not be made"), "{said}");
    let site = folder.path().join("site");
    let robots = json(&site.join(&named(&site)["robots.json"]));
    let names: Vec<&str> =
        robots.as_array().unwrap().iter().map(|one| one["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["robot"]);
}

#[test]
fn packages_of_all_folders_that_are_named_are_found_and_those_beside_a_given_one() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    put(root, "one/package.xml", "<package><name>one</name></package>");
    put(root, "one/urdf/asks.xacro", &robot("<link name='a'/>"));
    let mesh =
        "<collision><geometry><mesh filename='package://far/part.obj'/></geometry></collision>";
    let text = format!("<robot name='m'><link name='a'>{mesh}</link></robot>");
    put(root, "one/urdf/meshes.urdf", &text);
    for name in ["far", "near"] {
        let text = format!("<package><name>{name}</name></package>");
        put(root, &format!("two/deep/sources/{name}_of_us/package.xml"), &text);
    }
    put(
        root,
        "two/deep/sources/far_of_us/part.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n",
    );
    put(root, "two/other.urdf", ROBOT);
    let lint = |paths: &[&str]| {
        let arguments = [&["lint", "--xacro", "--format", "json"], paths].concat();
        let (_, said, asides) = urdd(root, &arguments);
        let report: Value =
            serde_json::from_str(&said).unwrap_or_else(|_| panic!("{said}{asides}"));
        let urdds = report["urdds"].as_array().unwrap().clone();
        let of = |end: &str| {
            let is_it = |one: &&Value| one["path"].as_str().unwrap().ends_with(end);
            urdds.iter().find(is_it).unwrap_or_else(|| panic!("{said}")).clone()
        };
        let unseen = of("meshes.urdf")["geometry_not_verified"].as_array().map_or(0, Vec::len);
        (of("asks.xacro")["verdict"] == "unreadable", unseen > 0)
    };
    assert_eq!(lint(&["one"]), (true, true));
    assert_eq!(lint(&["one", "two"]), (false, false));
    assert_eq!(lint(&["one", "--package", "near=two/deep/sources/near_of_us"]), (false, false));
}

//! Where meshes are found.

use std::fs;
use std::path::Path;

use crate::generate::{ascii_stl, read_json, urdd};

/// Lays out a workspace: the URDF's own package, others, and a mesh in each, which says where it is.
fn workspace() -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    for path in [
        "ws/own_description/urdf/meshes/near.stl",
        "ws/own_description/meshes/own.stl",
        "ws/beside/meshes/a.stl",
        "given/meshes/a.stl",
        "ros/found_by_folder/a.stl",
        "ros/deep/er/another_name/a.stl",
        "ament/share/by_ament/a.stl",
        "models/by_model/a.stl",
        "ws/own_description/meshes/with space.stl",
        "ws/own_description/meshes/Upper.STL",
    ] {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, ascii_stl(&path.display().to_string(), "0 1 0")).unwrap();
    }
    for (path, name) in [("ws/own_description", "own"), ("ros/deep/er/another_name", "by_xml")] {
        let text = format!("<package><name> {name} </name></package>");
        fs::write(folder.path().join(path).join("package.xml"), text).unwrap();
    }
    folder
}

/// Where the mesh of a name was found, relative to the workspace; otherwise the message.
fn found(folder: &Path, filename: &str) -> Result<String, String> {
    let urdf = folder.join("ws/own_description/urdf/robot.urdf");
    let xml = format!(
        "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"{filename}\"/></geometry></visual></link></robot>"
    );
    fs::write(&urdf, xml).unwrap();
    let target = folder.join("out");
    let output = urdd(&["generate", "--force", "-o"])
        .arg(&target)
        .arg(&urdf)
        .arg("--package")
        .arg(format!("given={}", folder.join("given").display()))
        .env("ROS_PACKAGE_PATH", folder.join("ros"))
        .env("AMENT_PREFIX_PATH", folder.join("ament"))
        .env("GAZEBO_MODEL_PATH", folder.join("models"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let said = String::from_utf8(output.stderr).unwrap();
    let module = read_json(&target.join("mesh_modules/original_meshes_module/module.json"));
    match module["references"][0]["path"].as_str() {
        Some(path) => {
            let text = fs::read_to_string(target.join(path)).unwrap();
            let place = text.lines().next().unwrap().strip_prefix("solid ").unwrap();
            Ok(place.strip_prefix(&format!("{}/", folder.display())).unwrap().to_owned())
        }
        None => Err(said),
    }
}

#[test]
fn each_way_to_name_a_mesh() {
    let folder = workspace();
    let here = folder.path().display().to_string();
    for (filename, place) in [
        ("meshes/near.stl", "ws/own_description/urdf/meshes/near.stl"),
        ("./meshes/../../meshes/own.stl", "ws/own_description/meshes/own.stl"),
        ("../meshes/own.stl", "ws/own_description/meshes/own.stl"),
        ("package://own/meshes/own.stl", "ws/own_description/meshes/own.stl"),
        ("package://own_description/meshes/own.stl", "ws/own_description/meshes/own.stl"),
        ("package://beside/meshes/a.stl", "ws/beside/meshes/a.stl"),
        ("package://given/meshes/a.stl", "given/meshes/a.stl"),
        ("package://found_by_folder/a.stl", "ros/found_by_folder/a.stl"),
        ("package://by_xml/a.stl", "ros/deep/er/another_name/a.stl"),
        ("package://by_ament/a.stl", "ament/share/by_ament/a.stl"),
        ("model://by_model/a.stl", "models/by_model/a.stl"),
        ("$(find own)/meshes/own.stl", "ws/own_description/meshes/own.stl"),
        (" ../meshes/own.stl ", "ws/own_description/meshes/own.stl"),
        ("..\\meshes\\own.stl", "ws/own_description/meshes/own.stl"),
        ("package://own/meshes/with%20space.stl", "ws/own_description/meshes/with space.stl"),
        (&*format!("{here}/given/meshes/a.stl"), "given/meshes/a.stl"),
        (&*format!("file://{here}/given/meshes/a.stl"), "given/meshes/a.stl"),
        (&*format!("file://localhost{here}/given/meshes/a.stl"), "given/meshes/a.stl"),
        ("file://../meshes/own.stl", "ws/own_description/meshes/own.stl"),
    ] {
        assert_eq!(found(folder.path(), filename).as_deref(), Ok(place), "{filename}");
    }
}

#[test]
fn what_is_not_found_says_where_it_was_looked_for() {
    let folder = workspace();
    for (filename, words) in [
        ("package://given/gone.stl", "given/gone.stl"),
        ("package://nobody/a.stl", "--package nobody=FOLDER"),
        ("model://nobody/a.stl", "--package nobody=FOLDER"),
        ("../meshes/upper.stl", "Upper.STL, whose case differs"),
        ("meshes", "which is a folder"),
        ("http://example.org/a.stl", "network"),
        ("s3://bucket/a.stl", "`s3://`"),
    ] {
        let said = found(folder.path(), filename).unwrap_err();
        assert!(said.contains(words), "{filename}: {said}");
        assert!(said.contains("robot.urdf:1:50: "), "{filename}: {said}");
    }
}

/// A package is called as its `package.xml` says, whatever its folder is called. Without one, its folder has to have its name.
#[test]
fn a_package_beside_the_robots_is_found_by_its_manifest_and_one_of_a_near_name_is_named() {
    let folder = workspace();
    for (file, text) in [
        ("ws/tools-ros2/package.xml", "<package><name>tools</name></package>"),
        ("ws/tools-ros2/meshes/a.stl", ""),
        ("ws/arm-parts/meshes/a.stl", ""),
        ("ws/Hand/package.xml", "<package><name>Hand</name></package>"),
    ] {
        let path = folder.path().join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        let mesh = || ascii_stl(&path.display().to_string(), "0 1 0");
        fs::write(&path, if text.is_empty() { mesh() } else { text.to_owned() }).unwrap();
    }
    let there = found(folder.path(), "package://tools/meshes/a.stl");
    assert_eq!(there.as_deref(), Ok("ws/tools-ros2/meshes/a.stl"));
    for (filename, words) in [
        (
            "package://arm_parts/meshes/a.stl",
            "there is the folder `arm-parts`, which has this file; write `arm-parts`, rename the folder to `arm_parts`",
        ),
        (
            "package://hand/a.stl",
            "there is the package `Hand`; write `Hand`, or say --package hand=",
        ),
        // The robot is in `own`.
        ("package://owm/meshes/own.stl", "there is the package `own`, which has this file"),
        ("package://owm/meshes/none.stl", "there is no package `owm` at or above"),
        ("package://own2/meshes/own.stl", "there is no package `own2` at or above"),
    ] {
        let said = found(folder.path(), filename).unwrap_err();
        assert!(said.contains(words), "{filename}: {said}");
    }
}

#[test]
fn a_package_that_is_given_is_looked_for_nowhere_else() {
    let folder = workspace();
    // There is one with the same name above the URDF.
    fs::create_dir_all(folder.path().join("ws/given/meshes")).unwrap();
    fs::write(folder.path().join("ws/given/meshes/b.stl"), ascii_stl("b", "0 1 0")).unwrap();
    let said = found(folder.path(), "package://given/meshes/b.stl").unwrap_err();
    assert!(!said.contains("ws/given"), "{said}");
}

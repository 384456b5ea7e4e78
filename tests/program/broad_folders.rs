//! The home folder and what is above it hold more than a robot: no project, and no robot's own folder.

use std::fs;
use std::path::Path;
use std::process::Command;

/// Files below `users/me`: an MJCF and a URDF that name a file of a folder beside their own.
fn machine() -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    let mesh = "<link name=\"base\"><visual><geometry><mesh filename=\"../meshes/part.stl\"/></geometry></visual></link>";
    let urdf = format!("<robot name=\"arm\">{mesh}</robot>");
    let mjcf = "<mujoco><include file=\"../other/part.xml\"/><worldbody><body name=\"b\"><geom size=\"1\"/></body></worldbody></mujoco>";
    let stl = fs::read(
        Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("conformance/robots/meshes/welding_arm/forearm.stl"),
    );
    let stl = stl.expect("a mesh");
    for (path, bytes) in [
        ("users/me/.git/HEAD", b"".as_slice()),
        ("users/me/robot/arm.xml", mjcf.as_bytes()),
        ("users/me/other/part.xml", b"<mujoco/>"),
        ("users/me/urdf/arm.urdf", urdf.as_bytes()),
        ("users/me/meshes/part.stl", &stl),
        ("users/urdf/arm.urdf", urdf.as_bytes()),
        ("users/meshes/part.stl", &stl),
        ("elsewhere/file", b""),
    ] {
        let file = folder.path().join(path);
        fs::create_dir_all(file.parent().expect("a folder")).expect("a folder");
        fs::write(file, bytes).expect("written");
    }
    folder
}

#[test]
fn files_beside_a_robots_folder_are_not_read_from_a_home_folder() {
    let folder = machine();
    let root = folder.path();
    let of = |home: &str, words: &[&str]| {
        let out = tempfile::tempdir().expect("a folder");
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        let command = command.args(words).arg("-o").arg(out.path().join("made")).current_dir(root);
        // What Windows has for it.
        let command = command.env("HOME", root.join(home)).env("USERPROFILE", root.join(home));
        let output = command.output().expect("the program");
        (output.status.code(), String::from_utf8(output.stderr).expect("UTF-8"))
    };
    let cases: [(&str, &[&str]); 3] = [
        // Kept in Git, it looks like a project.
        ("users/me", &["import", "users/me/robot/arm.xml"]),
        // It has a folder `urdf`.
        ("users/me", &["generate", "--modules", "original_meshes", "users/me/urdf/arm.urdf"]),
        // As above it.
        ("users/me", &["generate", "--modules", "original_meshes", "users/urdf/arm.urdf"]),
    ];
    for (home, words) in cases {
        let (status, said) = of(home, words);
        assert_ne!(status, Some(0), "{words:?}: {said}");
        assert!(said.contains("outside of the folders"), "{words:?}: {said}");
        // As of another person.
        let (status, said) = of("elsewhere", words);
        assert_eq!(status, Some(0), "{words:?}: {said}");
    }
}

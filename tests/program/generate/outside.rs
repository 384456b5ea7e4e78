//! What a URDF must not make us publish: files that do not belong to the robot, by any name.

#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use urdd_generate::note::NoteKind;
use urdd_generate::{GenerateError, Generated, Selection, Settings, SourceSettings, generate};

use crate::generate::{ascii_stl, bytes_below, findings_of, read_json, urdd};

const SECRET: &str = "sesame-7431";

/// A folder of the machine: a robot in a package, other packages beside it, a user's secrets, and private meshes.
fn machine() -> tempfile::TempDir {
    let machine = testkit::temporary::folder();
    let png = png();
    let mesh = ascii_stl("mesh", "0 1 0").into_bytes();
    let secret = format!("-----BEGIN KEY-----\n{SECRET}\n").into_bytes();
    let package = |name: &str| format!("<package><name>{name}</name></package>").into_bytes();
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("ws/robot/package.xml", package("robot")),
        ("ws/robot/meshes/a.stl", mesh.clone()),
        ("ws/robot/secret.txt", secret.clone()),
        ("ws/other/package.xml", package("other")),
        ("ws/other/meshes/b.stl", mesh.clone()),
        ("ws/plain/meshes/c.stl", mesh.clone()),
        ("secret/id_rsa", secret.clone()),
        ("secret/key.stl", [secret.clone(), vec![b'x'; 200]].concat()),
        ("secret/key.mtl", secret.clone()),
        ("secret/key.png", secret),
        ("private/part.stl", mesh),
        ("private/photo.png", png.clone()),
        ("ws/robot/textures/own.png", png),
    ];
    for (path, bytes) in files {
        let path = machine.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
    fs::create_dir_all(machine.path().join("ws/robot/urdf")).unwrap();
    machine
}

/// One white pixel.
fn png() -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\0\0\0\0".to_vec();
    bytes.extend([0x3a, 0x7e, 0x9b, 0x55]);
    bytes
}

fn robot(meshes: &[&str]) -> String {
    let visual = |name: &&str| {
        format!("<visual><geometry><mesh filename=\"{name}\"/></geometry></visual>\n")
    };
    let visuals: String = meshes.iter().map(visual).collect();
    format!("<robot name=\"r\"><link name=\"a\">\n{visuals}</link></robot>")
}

/// A URDD of meshes, those that the URDF in `ws/robot/urdf` names; original meshes only.
fn made(
    machine: &Path,
    meshes: &[&str],
    allowed: &[&str],
) -> (PathBuf, Result<Generated, GenerateError>) {
    let source = machine.join("ws/robot/urdf/r.urdf");
    fs::write(&source, robot(meshes)).unwrap();
    let target = machine.join("out");
    let settings = Settings {
        selection: Selection::parse(["original_meshes"]).unwrap(),
        source: SourceSettings {
            allowed_folders: allowed.iter().map(|path| machine.join(path)).collect(),
            ..SourceSettings::default()
        },
        ..Settings::default()
    };
    let made = generate(&source, &target, &settings, &());
    (target, made)
}

/// The carried files, by their path below `meshes/`.
fn carried(target: &Path) -> BTreeMap<String, Vec<u8>> {
    let folder = "mesh_modules/original_meshes_module/meshes/";
    let files = bytes_below(target).into_iter();
    let files =
        files.filter_map(|(path, bytes)| Some((path.strip_prefix(folder)?.to_owned(), bytes)));
    files.collect()
}

/// The faults of a URDD; a mesh that is not carried is a warning.
fn errors_of(target: &Path) -> Vec<String> {
    let findings = findings_of(target).into_iter();
    let errors = findings.filter(|(_, severity, _)| severity == "error");
    errors.map(|(code, _, words)| format!("{code}: {words}")).collect()
}

fn assert_no_secret(target: &Path, case: &str) {
    for (path, bytes) in bytes_below(target) {
        let text = String::from_utf8_lossy(&bytes);
        assert!(!text.contains(SECRET), "{case}: {path} holds the secret");
    }
}

#[test]
fn a_mesh_outside_of_the_robots_folders_is_refused() {
    let machine = machine();
    let here = machine.path().display().to_string();
    let root = machine.path().join("ws/robot");
    symlink(machine.path().join("private/part.stl"), root.join("meshes/link.stl")).unwrap();
    symlink(machine.path().join("private"), root.join("linked")).unwrap();
    symlink(machine.path().join("secret/id_rsa"), root.join("meshes/key.stl")).unwrap();
    for name in [
        "/etc/passwd",
        "/proc/self/pagemap",
        "file:///proc/self/environ",
        "../../../secret/id_rsa",
        "../../../secret/key.stl",
        "package://robot/../../private/part.stl",
        "package://robot/../../secret/id_rsa",
        "package:///etc/hostname",
        "package://etc/hostname",
        "model://etc/hostname",
        "$(find etc)/hostname",
        "..%2f..%2f..%2fprivate/part.stl",
        "..\\..\\..\\private\\part.stl",
        &*format!("{here}/private/part.stl"),
        &*format!("file://{here}/private/part.stl"),
        "../meshes/link.stl",
        "../linked/part.stl",
        "../meshes/key.stl",
    ] {
        let (target, made) = made(machine.path(), &["../meshes/a.stl", name], &[]);
        let error = made.expect_err(name);
        assert_eq!(error.code(), "outside", "{name}: {error}");
        let words = error.to_string();
        assert!(words.contains("r.urdf:3:"), "{name}: {words}");
        assert!(words.contains(&format!("`{name}`")), "{name}: {words}");
        assert!(words.contains("--allow-folder FOLDER"), "{name}: {words}");
        assert!(!target.exists(), "{name}: something was written");
    }
    // A name that no package has.
    for name in ["package://../secret/id_rsa", "package://./../secret/id_rsa", "package://"] {
        let (target, made) = made(machine.path(), &[name], &[]);
        let made = made.unwrap();
        assert_eq!(made.notes[0].kind, NoteKind::MeshNotFound, "{name}");
        assert_no_secret(&target, name);
    }
}

#[test]
fn each_mesh_outside_is_a_line_of_its_own() {
    let machine = machine();
    let urdf = machine.path().join("ws/robot/urdf/r.urdf");
    fs::write(&urdf, robot(&["/etc/passwd", "../../../secret/id_rsa"])).unwrap();
    let output = urdd(&["generate", "--output"])
        .arg(machine.path().join("out"))
        .arg(&urdf)
        .output()
        .unwrap();
    let words = String::from_utf8(output.stderr).unwrap();
    assert_eq!(words.lines().count(), 3, "{words}");
    assert!(!words.contains("\\n"), "{words}");
}

#[test]
fn a_batch_goes_on_and_the_status_says_so() {
    let machine = machine();
    let folder = machine.path().join("ws/robot/urdf");
    fs::write(folder.join("bad.urdf"), robot(&["/etc/passwd"])).unwrap();
    fs::write(folder.join("good.urdf"), robot(&["../meshes/a.stl"])).unwrap();
    let output = urdd(&["generate", "--modules", "original_meshes", "-o"])
        .arg(machine.path().join("out"))
        .arg(&folder)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let words = String::from_utf8(output.stderr).unwrap();
    assert!(words.contains("mesh `/etc/passwd` is outside"), "{words}");
    let names = fs::read_dir(machine.path().join("out")).unwrap();
    let names: Vec<_> = names.map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names, ["good"]);
}

#[test]
fn what_is_no_mesh_is_not_carried_wherever_it_lies() {
    let machine = machine();
    let root = machine.path().join("ws/robot");
    symlink(root.join("secret.txt"), root.join("meshes/inside.stl")).unwrap();
    symlink("secret.txt", root.join("secret.obj")).unwrap();
    fs::write(root.join("token.obj"), format!("token {SECRET}\n")).unwrap();
    fs::write(root.join("token.gltf"), format!("{{\"token\": \"{SECRET}\"}}")).unwrap();
    let cases: &[(&str, &[&str])] = &[
        ("../secret.txt", &[]),
        ("../meshes/inside.stl", &[]),
        ("../secret.obj", &[]),
        ("../token.obj", &[]),
        ("../token.gltf", &[]),
        // Allowed, but still not a mesh.
        ("../../../secret/id_rsa", &["secret"]),
        ("/proc/self/environ", &["/"]),
        ("/proc/version", &["/proc"]),
        ("/etc/passwd", &["/etc"]),
    ];
    for (name, allowed) in cases {
        let (target, made) = made(machine.path(), &[name], allowed);
        let made = made.unwrap_or_else(|error| panic!("{name}: {error}"));
        let kinds: Vec<NoteKind> = made.notes.iter().map(|note| note.kind).collect();
        assert_eq!(kinds, [NoteKind::MeshNotFound], "{name}: {:?}", made.notes);
        assert_eq!((made.meshes.named, made.meshes.not_found), (1, 1), "{name}");
        assert_eq!(carried(&target), BTreeMap::new(), "{name}");
        assert_no_secret(&target, name);
        assert_eq!(errors_of(&target), [""; 0], "{name}");
    }
}

/// `/proc/self/pagemap` is gigabytes long and claims to be empty; `/proc/kmsg` blocks forever.
#[cfg(target_os = "linux")]
#[test]
fn files_without_end_are_not_read_without_end() {
    let machine = machine();
    for name in ["/proc/self/pagemap", "/proc/kmsg", "/proc/self/mem", "/proc/kpagecount"] {
        let (target, made) = made(machine.path(), &[name], &["/"]);
        let made = made.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(made.notes[0].kind, NoteKind::MeshNotFound, "{name}");
        assert_eq!(carried(&target), BTreeMap::new(), "{name}");
    }
}

#[test]
fn what_stands_in_the_place_of_a_mesh_is_said() {
    let machine = machine();
    let meshes = machine.path().join("ws/robot/meshes");
    let status = std::process::Command::new("mkfifo").arg(meshes.join("pipe.stl")).status();
    assert!(status.unwrap().success());
    symlink("ring.stl", meshes.join("ring.stl")).unwrap();
    symlink("gone.stl", meshes.join("link.stl")).unwrap();
    for (name, words) in [
        ("pipe.stl", "pipe.stl, which is not a regular file)"),
        ("ring.stl", "ring.stl, a link that leads nowhere)"),
        ("link.stl", "link.stl, a link that leads nowhere)"),
        ("PIPE.stl", "pipe.stl, whose case differs)"),
    ] {
        let (_, made) = made(machine.path(), &[&format!("../meshes/{name}")], &[]);
        let note = made.unwrap().notes[0].to_string();
        assert!(note.contains(words), "{name}: {note}");
    }
}

#[test]
fn pipes_and_devices_are_no_meshes() {
    let machine = machine();
    let pipe = machine.path().join("ws/robot/meshes/pipe.stl");
    let status = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(status.unwrap().success());
    symlink("/dev/zero", machine.path().join("ws/robot/meshes/zero.stl")).unwrap();
    for name in ["../meshes/pipe.stl", "../meshes/zero.stl", "/dev/zero", "/dev/tty"] {
        let (target, made) = made(machine.path(), &[name], &["/"]);
        assert_eq!(made.unwrap().notes[0].kind, NoteKind::MeshNotFound, "{name}");
        assert_eq!(carried(&target), BTreeMap::new(), "{name}");
    }
}

/// Side files of each format that are links to secrets, are elsewhere, or have other content than they claim.
#[test]
fn side_files_are_carried_only_as_what_they_are() {
    let machine = machine();
    let root = machine.path().join("ws/robot/meshes");
    symlink(machine.path().join("secret/key.mtl"), root.join("link.mtl")).unwrap();
    symlink(machine.path().join("secret/key.png"), root.join("link.png")).unwrap();
    symlink(machine.path().join("private/photo.png"), root.join("photo.png")).unwrap();
    fs::write(root.join("fake.png"), SECRET).unwrap();
    fs::write(root.join("fake.mtl"), SECRET).unwrap();
    fs::write(root.join("fake.bin"), SECRET).unwrap();
    let texture = |path: &str| format!("newmtl m\nmap_Kd {path}\n");
    for (name, path) in [
        ("far.mtl", "../../../secret/key.png"),
        ("linked.mtl", "link.png"),
        ("photo.mtl", "photo.png"),
        ("far_photo.mtl", "../../../private/photo.png"),
        ("faked.mtl", "fake.png"),
        ("bin.mtl", "fake.bin"),
        ("own.mtl", "../textures/own.png"),
    ] {
        fs::write(root.join(name), texture(path)).unwrap();
    }
    let dae = |image: &str| {
        let mut text = fs::read_to_string(
            Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/generate/textured.dae"),
        )
        .unwrap();
        text = text.replace("IMAGE", image);
        text
    };
    let obj =
        |library: &str| format!("mtllib {library}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
    // The mesh, and the other carried files.
    let cases: &[(&str, String, &[&str])] = &[
        ("a.obj", obj("link.mtl"), &[]),
        ("a.obj", obj("../../../secret/key.mtl"), &[]),
        ("a.obj", obj("fake.mtl"), &[]),
        ("a.obj", obj("../secret.txt"), &[]),
        ("a.obj", obj("far.mtl"), &["far.mtl"]),
        ("a.obj", obj("linked.mtl"), &["linked.mtl"]),
        ("a.obj", obj("photo.mtl"), &["photo.mtl"]),
        ("a.obj", obj("far_photo.mtl"), &["far_photo.mtl"]),
        ("a.obj", obj("faked.mtl"), &["faked.mtl"]),
        ("a.obj", obj("bin.mtl"), &["bin.mtl"]),
        ("a.obj", obj("own.mtl"), &["meshes/own.mtl", "textures/own.png"]),
        ("a.dae", dae("link.png"), &[]),
        ("a.dae", dae("../../../secret/key.png"), &[]),
        ("a.dae", dae("photo.png"), &[]),
        ("a.dae", dae("fake.png"), &[]),
        ("a.dae", dae("../textures/own.png"), &["textures/own.png"]),
    ];
    for (name, text, expected) in cases {
        fs::write(root.join(name), text).unwrap();
        let mesh = format!("../meshes/{name}");
        let (target, made) = made(machine.path(), &[&mesh], &[]);
        let made = made.unwrap_or_else(|error| panic!("{text}: {error}"));
        let files = carried(&target);
        let beside: Vec<&str> =
            files.keys().map(String::as_str).filter(|path| !path.ends_with(name)).collect();
        assert_eq!(beside, *expected, "{text}");
        assert_no_secret(&target, text);
        let is_whole = expected.iter().any(|path| path.ends_with(".png"));
        assert_eq!(made.notes.is_empty(), is_whole, "{text}: {:?}", made.notes);
        assert_eq!(errors_of(&target), [""; 0], "{text}");
    }
}

#[test]
fn what_is_taken_from_elsewhere_is_named_and_no_path_of_the_machine_is_carried() {
    let machine = machine();
    let here = machine.path().display().to_string();
    let private = format!("{here}/private/part.stl");
    fs::create_dir_all(machine.path().join("deep/er/meshes")).unwrap();
    let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
    fs::write(machine.path().join("deep/er/meshes/o.obj"), obj).unwrap();
    fs::write(
        machine.path().join("deep/er/meshes/m.mtl"),
        "newmtl m\nmap_Kd ../../../private/photo.png\n",
    )
    .unwrap();
    let deep = format!("{here}/deep/er/meshes/o.obj");
    let names = ["../meshes/a.stl", "package://other/meshes/b.stl", &private, &deep];
    let (target, outcome) = made(machine.path(), &names, &["private", "deep"]);
    let outcome = outcome.unwrap();
    let files: Vec<String> = carried(&target).into_keys().collect();
    assert_eq!(
        files,
        [
            "a.stl",
            "other/meshes/b.stl",
            "outside_1/part.stl",
            "outside_2/m.mtl",
            "outside_2/o.obj",
            "outside_2/photo.png",
        ]
    );
    let said: Vec<&str> = outcome
        .notes
        .iter()
        .filter(|note| note.kind == NoteKind::Outside)
        .map(|note| note.problem.as_str())
        .collect();
    assert_eq!(said.len(), 5, "{said:?}");
    for (said, file) in said.iter().zip(["b.stl", "part.stl", "o.obj", "m.mtl", "photo.png"]) {
        assert!(said.ends_with(file) && said.contains(&here), "{said}");
    }
    // The URDF is carried unchanged; nothing else reveals paths of the machine.
    let folder = machine.path().file_name().unwrap().to_str().unwrap();
    for (path, bytes) in bytes_below(&target) {
        let text = String::from_utf8_lossy(&bytes).replace(&private, "").replace(&deep, "");
        assert!(!text.contains(folder), "{path}");
        assert!(!path.contains("private") && !path.contains("deep"), "{path}");
    }
    // Without the folders it is refused.
    let (_, outcome) = made(machine.path(), &names, &["private"]);
    assert_eq!(outcome.unwrap_err().code(), "outside");
}

/// As `colcon build --symlink-install` lays packages out.
#[test]
fn links_of_an_installed_package_to_its_sources_are_followed() {
    let machine = machine();
    let share = machine.path().join("install/share");
    for package in ["robot", "other"] {
        fs::create_dir_all(share.join(package).join("meshes")).unwrap();
        let source = machine.path().join("ws").join(package);
        symlink(source.join("package.xml"), share.join(package).join("package.xml")).unwrap();
    }
    let mesh = machine.path().join("ws/other/meshes/b.stl");
    symlink(mesh, share.join("other/meshes/b.stl")).unwrap();
    fs::create_dir_all(share.join("robot/urdf")).unwrap();
    let text = robot(&["package://other/meshes/b.stl", "package://robot/meshes/a.stl"]);
    let source = machine.path().join("ws/robot/urdf/r.urdf");
    fs::write(&source, text).unwrap();
    let linked = share.join("robot/urdf/r.urdf");
    symlink(&source, &linked).unwrap();
    let output = urdd(&["generate", "--modules", "original_meshes", "-o"])
        .arg(machine.path().join("out"))
        .arg(&linked)
        .env("AMENT_PREFIX_PATH", machine.path().join("install"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let files: Vec<String> = carried(&machine.path().join("out")).into_keys().collect();
    assert_eq!(files, ["other/meshes/b.stl", "robot/meshes/a.stl"]);
}

/// Many robots are not in a package: `urdf/` and `meshes/` in a folder.
#[test]
fn meshes_beside_a_folder_of_urdfs_are_the_robots_own() {
    let machine = machine();
    let robot_folder = machine.path().join("ws/plain");
    fs::create_dir(robot_folder.join("urdf")).unwrap();
    let source = robot_folder.join("urdf/r.urdf");
    fs::write(&source, robot(&["../meshes/c.stl", "package://plain/meshes/c.stl"])).unwrap();
    let core = Settings {
        selection: Selection::parse(["original_meshes"]).unwrap(),
        ..Settings::default()
    };
    let target = machine.path().join("out");
    let made = generate(&source, &target, &core, &()).unwrap();
    assert_eq!(made.notes, []);
    assert_eq!(
        read_json(&target.join("mesh_modules/original_meshes_module/module.json"))["files"]
            .as_array()
            .unwrap()
            .len(),
        1
    );
    // A folder of another name contains one robot's URDF, and the files beside it do not belong to that robot.
    let other = machine.path().join("ws/plain/downloads");
    fs::create_dir(&other).unwrap();
    let source = other.join("r.urdf");
    fs::write(&source, robot(&["../meshes/c.stl"])).unwrap();
    let error = generate(&source, &machine.path().join("two"), &core, &()).unwrap_err();
    assert_eq!(error.code(), "outside");
}

#[test]
fn a_folder_to_allow_that_is_none_is_wrong_usage() {
    let machine = machine();
    let source = machine.path().join("ws/robot/urdf/r.urdf");
    fs::write(&source, robot(&[])).unwrap();
    let output = urdd(&["generate", "--allow-folder", "no/such/folder", "-o"])
        .arg(machine.path().join("out"))
        .arg(&source)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    let words = String::from_utf8(output.stderr).unwrap();
    assert!(words.contains("--allow-folder: no/such/folder is not a folder"), "{words}");
}

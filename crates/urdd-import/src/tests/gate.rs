//! Which files an import reads and carries.

use std::fs;
use std::path::Path;

use crate::{Imported, import};
use urdd_source::Settings;
use urdd_source::note::NoteKind;

fn imported(path: &Path) -> Imported {
    import(path, &Settings::default()).unwrap().unwrap()
}

fn stl() -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend(1_u32.to_le_bytes());
    for x in [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0_f32] {
        bytes.extend(x.to_le_bytes());
    }
    bytes.extend([0; 2]);
    bytes
}

/// Files that are there, in the project, and no meshes or images: by their own names, by others, by what their type is said
/// to be.
#[test]
fn a_file_that_is_not_what_it_is_named_as_is_not_carried() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    for (path, text) in [
        (".env", "KEY=CANARY\n"),
        (".git/config", "[remote]\n url=CANARY\n"),
        ("bot/notes.obj", "# CANARY\nusemtl x\n"),
        ("bot/photo.png", "\u{89}PNG CANARY"),
    ] {
        fs::create_dir_all(root.join(path).parent().unwrap()).unwrap();
        fs::write(root.join(path), text).unwrap();
    }
    let assets = "<mesh name=\"m\" file=\"../.env\"/><mesh name=\"n\" file=\"../.git/config\" content_type=\"model/stl\"/>\
        <mesh name=\"o\" file=\"notes.obj\"/><texture name=\"t\" type=\"2d\" file=\"photo.png\"/><material name=\"p\" texture=\"t\"/>";
    let geoms: String =
        ["m", "n", "o"].map(|mesh| format!("<geom type=\"mesh\" mesh=\"{mesh}\"/>")).concat();
    let text = format!(
        "<mujoco><asset>{assets}</asset><worldbody><body><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/>\
        {geoms}<geom size=\"1\" material=\"p\"/></body></worldbody></mujoco>"
    );
    let path = root.join("bot/r.xml");
    fs::write(&path, text).unwrap();
    let imported = imported(&path);
    for (name, bytes) in &imported.files {
        let text = String::from_utf8_lossy(bytes);
        assert!(!text.contains("CANARY"), "{name}: {text}");
    }
    let said: Vec<String> = imported.report.remarks.iter().map(ToString::to_string).collect();
    for mesh in ["../.env", "../.git/config", "notes.obj"] {
        let is_said = |note: &&String| note.contains(mesh) && note.contains("it is left out");
        assert_eq!(said.iter().filter(is_said).count(), 1, "{mesh}: {said:?}");
    }
    let lost = imported.report.lost().find(|(what, _)| what.contains("not found or read"));
    assert_eq!(lost, Some(("meshes and images that are not found or read", 3)));
}

#[test]
fn files_from_elsewhere_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().canonicalize().unwrap();
    let model = "<sdf version=\"1.7\"><model name=\"h\"><link name=\"k\"/></model></sdf>";
    for (path, bytes) in [
        ("Pictures/s.stl", stl()),
        ("bot/own.stl", stl()),
        (".hidden/s.sdf", model.into()),
        ("other/package.xml", "<package><name>other</name></package>".into()),
        ("other/a.stl", stl()),
    ] {
        fs::create_dir_all(root.join(path).parent().unwrap()).unwrap();
        fs::write(root.join(path), bytes).unwrap();
    }
    let visual = |uri: &str| {
        format!(
            "<visual name=\"{uri}\"><geometry><mesh><uri>{uri}</uri></mesh></geometry></visual>"
        )
    };
    let uris = ["model://Pictures/s.stl", "package://other/a.stl", "own.stl"].map(visual).concat();
    let text = format!(
        "<sdf version=\"1.7\"><model name=\"m\"><link name=\"l\">{uris}</link>\
        <include><uri>model://.hidden/s.sdf</uri></include></model></sdf>"
    );
    fs::write(root.join("bot/r.sdf"), text).unwrap();
    let imported = imported(&root.join("bot/r.sdf"));
    let outside = imported.report.remarks.iter().filter(|note| note.kind == NoteKind::Outside);
    let outside: Vec<&str> = outside.map(|note| note.problem.as_str()).collect();
    let named = |file: &str| outside.iter().any(|said| said.contains(file));
    assert!(
        named(".hidden/s.sdf") && named("Pictures/s.stl") && named("other/a.stl"),
        "{outside:?}"
    );
    assert_eq!(outside.len(), 3, "its own are not named: {outside:?}");
}

/// A file that is no image, by a name and as a texture of many materials, in MJCF and SDF.
#[test]
fn what_is_no_image_is_charged_each_time_that_it_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path();
    // 2 MB, so that the account is overdrawn by some 200 uses and not by 40.
    fs::write(root.join("t.png"), vec![b'x'; 2 << 20]).unwrap();
    let sdf = |uses: usize| {
        let visual = |number| {
            format!(
                "<visual name=\"v{number}\"><geometry><sphere><radius>1</radius></sphere></geometry>\
                <material><pbr><metal><albedo_map>t.png</albedo_map></metal></pbr></material></visual>"
            )
        };
        let visuals: String = (0..uses).map(visual).collect();
        format!(
            "<sdf version=\"1.7\"><model name=\"m\"><link name=\"l\">{visuals}</link></model></sdf>"
        )
    };
    let mjcf = |uses: usize| {
        let many = |of: &dyn Fn(usize) -> String| (0..uses).map(of).collect::<String>();
        let materials = many(&|n| format!("<material name=\"m{n}\" texture=\"t\"/>"));
        let geoms = many(&|n| format!("<geom size=\"1\" material=\"m{n}\"/>"));
        format!(
            "<mujoco><asset><texture name=\"t\" type=\"2d\" file=\"t.png\"/>{materials}</asset>\
            <worldbody><body>{geoms}</body></worldbody></mujoco>"
        )
    };
    for (name, few, many) in [("r.sdf", sdf(40), sdf(300)), ("r.xml", mjcf(40), mjcf(300))] {
        let path = root.join(name);
        fs::write(&path, few).unwrap();
        assert!(import(&path, &Settings::default()).is_ok(), "{name}");
        fs::write(&path, many).unwrap();
        let refused = import(&path, &Settings::default()).unwrap_err().to_string();
        assert!(refused.contains("needs more memory or work"), "{name}: {refused}");
    }
}
